"""The way from the box to the first match with real robots: what is done, and the next step."""

import json
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import count
from typing import TYPE_CHECKING

from pigaming_app.hardware.session.robot_session import RobotsUnavailable
from pigaming_app.jobs.mat.robots import LISTEN
from pigaming_app.jobs.mat.sessions import real_session
from pigaming_app.jobs.terminal.options import JsonOption
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.i18n import english

if TYPE_CHECKING:
    from pigaming_app.hardware.session.guide import GuideStep

COMMANDS = {
    "robots": "robots setup",
    "calibrate": "calibrate",
    "pair": "robots --pair",
    "drive": "robots --drive",
}  # for steps that have one


@dataclass(frozen=True, kw_only=True)
class GuideOptions(JsonOption):
    """How to print."""


def run(options: GuideOptions) -> int:
    """Print the steps."""
    from pigaming_app.hardware.session.guide import next_step, steps

    settings, _ = Settings.load(folders().config)
    heard, fault = _heard()
    found = steps(settings, folders().data, "real", None, heard, fault)
    if options.json:
        rows = [{"step": one.name, "done": one.done, "problem": _sentence(one.problem)} for one in found]
        print(json.dumps({"steps": rows, "next": next_step(found), "heard": heard}))
    else:
        print("\n".join(table(found, next_step(found))))
    return 0


def _heard() -> tuple[int, OperatorMessage | None]:
    """How many robots report by radio, and the fault of the radio."""
    session = real_session()
    try:
        link = session.open_link()
        time.sleep(LISTEN)
        if link is None:
            return 0, None
        return sum(link.telemetry.get(i) is not None and link.quality(i).share > 0.0 for i in range(ROBOTS)), link.fault
    except RobotsUnavailable as trouble:
        return 0, trouble.message
    finally:
        session.close()


def table(found: "Sequence[GuideStep]", after: str) -> Iterator[str]:
    """A line for each step, and what comes next: the step `after`; empty if all are done."""
    words = english()
    for number, step in zip(count(1), found):
        mark, line = "x" if step.done else " ", _sentence(step.problem) or words(f"guide.{step.name}_line")
        yield f"{number}. [{mark}] {words(f'guide.{step.name}'):18}{line}"
    command = COMMANDS.get(after)
    page = "Options, Robots, Guide" if command is None else f"Options, Robots, Guide, or: python3 main.py {command}"
    yield f"Next: {words(f'guide.{after}')} ({page})" if after else "All done: have fun!"


def _sentence(message: OperatorMessage | None) -> str | None:
    return english().long_sentence(message) if message else None
