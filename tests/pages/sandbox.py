"""A folder in which commands of the pages run, in this process: short, without numba, robots or windows that stay."""

import argparse
import re
import runpy
import shutil
import sys
import tomllib
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pigaming_app.ai.networks.files import encode
from pigaming_app.ai.ppo import shard, win_rates
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.ppo.task_file import file_of, read_task, text_of
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games import setup
from pigaming_app.games.registry import games
from pigaming_app.jobs import arcade, cli, play
from pigaming_app.jobs.bench import phones
from pigaming_app.jobs.learning.train import ppo_training
from pigaming_app.jobs.mat import robots
from pigaming_app.jobs.registry import jobs
from pigaming_app.jobs.terminal import refusal
from pigaming_app.scenes import start
from pigaming_app.sim import kernel
from pigaming_app.sim.drivetrain import NOMINAL, to_toml
from tests.ai.networks.onnx.tiny_onnx import model
from tests.ai.networks.random_network import random_network
from tests.ai.ppo.plain import TINY, plain_loop
from tests.pages.commands import ROOT
from tests.pages.stand_ins import EMULATED, LIMITS, MINUTES, WITHOUT_ROBOTS

ENTRANTS = "AAA=level1,BBB=idle,CCC=random"
EVENT = ("--game", "pitanks", "--format", "roundrobin", "--entrants", ENTRANTS)
CLASS = "Klasse;Name;Vorname\n5a;Silva;Ana\n5b;Moreira;Ana\n5a;Reis;Eva\n5b;Sousa;Rui\n"
FILES: dict[str, Callable[[Path], object]] = {  # that a page takes for granted, made where it names them
    "mine.npz": lambda file: file.write_bytes(encode(random_network(1, "pitanks"))),
    "racer.npz": lambda file: file.write_bytes(encode(random_network(1, "race"))),
    "my.onnx": lambda file: file.write_bytes(model(np.zeros((128, 14)))),
    "agent.onnx": lambda file: file.write_bytes(model(np.zeros((128, 14)))),
    "robots.toml": lambda file: file.write_text(to_toml([NOMINAL] * 4), encoding="utf-8"),
    "mine.toml": lambda file: shutil.copy(ROOT / "assets/arenas/pitanks/islands.toml", file),
    "my.task.toml": lambda file: file.write_text(text_of(file_of(replace(TASKS["pitanks"], minutes=(0.05,))))),
    "class.csv": lambda file: file.write_text(CLASS, encoding="utf-8"),
    "cup.json": lambda file: cli.main(["event", "new", str(file), *EVENT]),
    "match.replay": lambda file: cli.main(["play", *["--seats", "idle,idle", "--headless", "--record"], str(file)]),
}


class Accepted(BaseException):
    """Raised in place of running a command whose words were accepted."""


class Sandbox:
    """Runs commands; `only_parse`: until their words are accepted."""

    only_parse = False
    asked: set[str]  # extras that the last command asked for

    def __init__(self, patch: pytest.MonkeyPatch, folder: Path) -> None:
        home = folder / "home"
        for variable in ("PIGAMING_HOME", "HOME", "XDG_CONFIG_HOME"):
            patch.setenv(variable, str(home))
        (folder / "here").mkdir()
        patch.chdir(folder / "here")
        self._limit_arguments(patch)
        seat_hunter(patch)
        lacks = refusal.missing

        def noted(extra: str) -> str:
            self.asked.add(extra)
            return lacks(extra)

        patch.setattr(refusal, "missing", noted)
        shorten_matches(patch)
        shorten_trainings(patch)
        close_windows(patch)
        for module in [kernel, *sys.modules.values()]:
            if getattr(module, "can_compile", None) is COMPILES:
                patch.setattr(module, "can_compile", lambda: False)

    def lend(self, command: str, written: list[str]) -> None:
        """Make the files that a command reads, unless an earlier one has made them."""
        for name, make in FILES.items():
            if name in command and name not in written and not Path(name).exists():
                make(Path(name))

    def run(self, words: list[str]) -> int:
        """The exit code of a command."""
        self.asked = set()
        match [word for word in words if word not in ("-X", "pigaming") or word is words[0]]:
            case ["python3", "main.py", *rest] | ["main.py", *rest] | ["pigaming", *rest]:
                return cli.main(rest)
            case ["python3" | ".venv/bin/python", "-m", module, *rest]:
                return scripted(module, rest)
            case [job, *_] if job in jobs():
                return cli.main(words)
        raise AssertionError(f"{words}: not known how to run this; see tests/pages/stand_ins.py")

    def parse(self, words: list[str]) -> int:
        """0 if a command of ours accepts its words; of others, those that install this project are looked at."""
        if words[0] in ("pip", "pipx", "uv", "uvx"):
            return int(not is_installable(words))
        foreign = words[1:3] in (["-m", "pip"], ["-m", "venv"]) or not {"main.py", "pigaming", "-m"} & {*words}
        if foreign and words[0] not in jobs():
            return 0
        if "-m" in words and "parse_args" not in source_of(words[words.index("-m") + 1]):
            return 0
        self.only_parse = True
        try:
            return self.run(words)
        except Accepted:
            return 0
        finally:
            self.only_parse = False

    def _limit_arguments(self, patch: pytest.MonkeyPatch) -> None:
        parse = argparse.ArgumentParser.parse_known_args

        def limited(parser: Any, *words: Any) -> Any:
            found, rest = parse(parser, *words)
            if self.only_parse:
                if rest and "for_pytest" not in found:
                    raise AssertionError(f"{parser.prog}: {rest}")
                raise Accepted
            if parser.prog.endswith(EMULATED) and not any(getattr(found, name, None) for name in WITHOUT_ROBOTS):
                found.emulate = 1
            if getattr(found, "emulate", None):
                found.emulate = 1  # the arena that is calibrated already
            if getattr(found, "speed", None) == "1" and found.headless:
                found.speed = "max"
            for name, most in next((row for end, row in LIMITS.items() if parser.prog.endswith(f" {end}")), {}).items():
                setattr(found, name, least(getattr(found, name), most))
            return found, rest

        patch.setattr(argparse.ArgumentParser, "parse_known_args", limited)


COMPILES = kernel.can_compile


def least(value: Any, most: Any) -> Any:
    """The smaller of two numbers, as many of a list, or else `most`."""
    if isinstance(value, list):
        return value[:most]
    return min(value, most) if isinstance(value, int | float) and isinstance(most, int | float) else most


def seat_hunter(patch: pytest.MonkeyPatch) -> None:
    """Add the brain that docs/opponents.md prints, as the page asks its reader to."""
    page = (ROOT / "docs/opponents.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"^```python\n(.*?HUNTER = .*?)^```$", page, re.MULTILINE | re.DOTALL)
    printed: dict[str, Any] = {"__name__": "hunter"}
    exec(code, printed)
    patch.setitem(BRAINS["pitanks"], "hunter", printed["HUNTER"])


def shorten_matches(patch: pytest.MonkeyPatch) -> None:
    """Let matches of the usual length last for MINUTES, without overtime."""
    patch.setattr(setup, "MIN_MINUTES", MINUTES)
    for game in games().values():
        for name, rules in [*game.variants.items()]:
            short = replace(rules, default_minutes=MINUTES, overtime=0.0)  # type: ignore[arg-type]  # less than any choice
            patch.setitem(game.variants, name, short)


def shorten_trainings(patch: pytest.MonkeyPatch) -> None:
    """Let `train ppo` play a few plain matches of the first line-up."""

    def tiny(task: Any) -> Any:
        return replace(task, line_ups=task.line_ups[:1], rivals=("idle",), minutes=(MINUTES,), hyper=TINY)

    for name, task in [*TASKS.items()]:
        patch.setitem(TASKS, name, tiny(task))
    patch.setattr(ppo_training, "read_task", lambda *file: tiny(read_task(*file)))
    for module in (shard, win_rates):
        patch.setattr(module, "loop_of", plain_loop)
    for measured in ("MEASURED", "MEASURED_AT_END", "MEASURED_AGAINST"):
        patch.setattr(ppo_training, measured, 2)


def close_windows(patch: pytest.MonkeyPatch) -> None:
    """Close windows after two frames; a kiosk has no supervisor then, and phones and robots are heard for a moment."""
    run, measure = start.run, phones.measure
    patch.setattr(start, "run", lambda options: run(replace(options, frames=2)))
    patch.setattr(phones, "measure", lambda: measure(0.5))
    patch.setattr(robots, "LISTEN", 0.1)
    for job in (arcade, play):
        patch.setattr(job, "needs_supervisor", lambda arguments: False)


def scripted(module: str, words: list[str]) -> int:
    """The exit code of `python -m module words`."""
    before, sys.argv = sys.argv, [module, *words]
    known = None if hasattr(sys.modules.get(module), "__path__") else sys.modules.pop(module, None)
    try:
        runpy.run_module(module, run_name="__main__")
    except SystemExit as end:
        return int(end.code or 0)
    finally:
        sys.argv = before
        if known:
            sys.modules[module] = known
    return 0


def source_of(module: str) -> str:
    """The text of a module of the tests, or of its `__main__`."""
    place = ROOT / module.replace(".", "/")
    file = place / "__main__.py" if place.is_dir() else place.with_suffix(".py")
    return file.read_text(encoding="utf-8")


def is_installable(words: list[str]) -> bool:
    """True if a command of pip, pipx or uv names nothing, or this folder with extras that it has."""
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    named = [re.fullmatch(r"\.(?:\[([\w,]+)\])?", word) for word in words if word.startswith(".")]
    return all(place and {*(place[1] or "").split(",")} <= {"", *extras} for place in named)
