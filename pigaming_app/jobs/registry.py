"""The jobs of this installation: those of the core, and those of each feature, declared in `jobs/FEATURE/__init__.py`.

A declaration is `JOBS`, the text of each job by its name, and `LOGS_REFUSALS = True` if the log keeps refusals, too.
The module of a job has its name. Declarations import nothing, so that a job starts quickly.
"""

from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import NamedTuple

from pigaming_app import jobs as room

OF_CORE = {
    "arcade": "the arcade; also without a job",
    "play": "one match, with or without a window",
    "new-game": "a package for a game of your own",
    "games": "games from elsewhere: list, on, off",
    "doctor": "check of the installation, with advice",
}


class Job(NamedTuple):
    """A job; its module lies below `jobs`."""

    name: str
    text: str
    package: str = ""
    logs_refusals: bool = False

    @property
    def module(self) -> str:
        return f"{self.package}.{self.name}".strip(".").replace("-", "_")


@cache
def jobs() -> dict[str, Job]:
    """The jobs by name: those of the core, then those of the features that are there."""
    found = {name: Job(name, text) for name, text in OF_CORE.items()}
    packages = [module.name for module in iter_modules(room.__path__) if module.ispkg]
    return found | {job.name: job for package in packages for job in _of(package)}


def _of(package: str) -> Iterator[Job]:
    """The jobs that a package of `jobs` declares."""
    try:
        declared = import_module(f"{room.__name__}.{package}")
    except ModuleNotFoundError:
        return
    for name, text in getattr(declared, "JOBS", {}).items():
        yield Job(name, text, package, getattr(declared, "LOGS_REFUSALS", False))
