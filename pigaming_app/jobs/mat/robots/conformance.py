"""`robots check DRIVER`: the promises of a driver as a table; exit code 1 if one does not hold."""

import json
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from pigaming_app.hardware.drivers.fitness import match_problem
from pigaming_app.hardware.drivers.ours import OURS
from pigaming_app.jobs.mat.sessions import require_driver
from pigaming_app.jobs.terminal.refusal import Refusal, require
from pigaming_app.storage.parsing import one_line

if TYPE_CHECKING:
    from pigaming_app.hardware.drivers.conformance import Finding
    from pigaming_app.hardware.drivers.driver import RobotDriver

VERDICTS = {True: "holds", False: "FAILS", None: "-"}


class CheckOptions(Protocol):
    """The seed of the emulated robots, and whether the table is data."""

    @property
    def emulate(self) -> int | None: ...

    @property
    def json(self) -> bool: ...


def check(options: CheckOptions, words: Sequence[str]) -> int:
    """Run the check that these words ask for. Raises Refusal."""
    if len(words) != 2 or words[0] != "check":
        raise Refusal("robots: no words, setup, update, or check and a driver: robots check udp")
    driver = require_driver(words[1], "robots check")
    require("hardware")
    from pigaming_app.hardware.drivers.conformance import Conformance
    from pigaming_app.hardware.emulator.wifi.boards import NoMicroPython
    from pigaming_app.hardware.proof.stands import stand_of
    from pigaming_app.ui.i18n import english

    seed = 1 if options.emulate is None else options.emulate
    try:
        stand = stand_of(driver, seed)
    except NoMicroPython as error:
        raise Refusal(f"robots check {driver.name}: {error}") from None
    except Exception as error:
        raise Refusal(_failure(driver, error)) from None
    if stand is None:
        problem = match_problem(driver)
        assert problem is not None
        raise Refusal(f"robots check {driver.name}: {english().long_sentence(problem)}")
    findings = []
    try:
        for finding in Conformance(driver, stand, seed).run():
            findings.append(finding)
            if not options.json:
                _print(finding, first=len(findings) == 1)
    except Exception as error:
        raise Refusal(_failure(driver, error)) from None
    finally:
        stand.close()
    fit = driver.problem is None and all(finding.holds is not False for finding in findings)
    if options.json:
        rows = [{**finding._asdict(), "holds": finding.holds} for finding in findings]
        print(json.dumps({"driver": driver.name, "seed": seed, "promises": rows, "for_matches": fit}))
    else:
        print(english().long_sentence(driver.problem) if driver.problem else f"for matches: {'yes' if fit else 'no'}")
    return 0 if fit else 1


def _failure(driver: "RobotDriver", error: Exception) -> str:
    """The line that says which error a plug-in's emulated robots raised, and where. Raises the error of our own."""
    if driver.name in OURS:
        raise error
    place = traceback.extract_tb(error.__traceback__)[-1]
    where = f"{Path(place.filename).name}, line {place.lineno}"
    return one_line(f"robots check {driver.name}: its emulated robots failed: {where}: {type(error).__name__}: {error}")


def _print(finding: "Finding", first: bool) -> None:
    if first:
        print(f"{'promise':20}{'declared':58}{'measured':28}")
    print(f"{finding.promise:20}{finding.declared:58}{finding.measured:28}{VERDICTS[finding.holds]}", flush=True)
