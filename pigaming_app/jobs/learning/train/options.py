"""Options of trainings, checked before they begin."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from os.path import realpath
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from pigaming_app.jobs.terminal.options import (
    ONE_OF,
    GameOption,
    Groups,
    JsonOption,
    decimal,
    flag,
    integer,
    option,
    path,
    word,
)
from pigaming_app.jobs.terminal.refusal import Refusal, require
from pigaming_app.sim.rng import SEEDS
from pigaming_app.storage.safe_files import require_writable

T = TypeVar("T")

DEFAULT_MINUTES, DEFAULT_WORKERS, DEFAULT_DECISIONS = 10.0, 2, 5_000_000


def changed(recipe: T, settings: Iterable[str]) -> T:
    """A dataclass of numbers with changes of the form NAME=NUMBER. Raises ValueError."""
    kinds: dict[str, Any] = {field.name: field.type for field in fields(recipe)}  # type: ignore[arg-type]
    changes: dict[str, Any] = {}
    for text in settings:
        name, equals, value = text.partition("=")
        if name not in kinds or not equals:
            raise ValueError(f"{text!r}; NAME=NUMBER is needed, with one of {', '.join(kinds)}")
        try:
            changes[name] = kinds[name](value)
        except ValueError:
            raise ValueError(f"{text!r}; {value!r} is not such a number") from None
    return replace(recipe, **changes)  # type: ignore[type-var]


@dataclass(frozen=True, kw_only=True)
class OutputOptions:
    """The files of a training."""

    out: Path = option("what is learned (.npz)", path, required=True, metavar="FILE")
    resume: bool = flag("continue from that file")
    set: tuple[str, ...] = option("change a hyperparameter", default=(), action="append", metavar="NAME=NUMBER")
    curve: Path | None = option("learning curve (PNG; extra `plots`)", path, metavar="FILE")
    csv: Path | None = option("learning curve as numbers", path, metavar="FILE")


def check_outputs(options: OutputOptions, noun: str, beside: Sequence[Path] = ()) -> None:
    """Check before a training whatever would fail after it. `beside`: further files. Raises Refusal or NotSaved."""
    if options.out.suffix != ".npz":
        raise Refusal(f"--out: {options.out}: the name of a {noun} ends in .npz")
    if options.curve and options.curve.suffix.lower() != ".png":
        raise Refusal(f"--curve: {options.curve}: the name of a picture ends in .png")
    outputs: list[tuple[str, Path | None]] = [("out", options.out), *(("out", one) for one in beside)]
    outputs += [("csv", options.csv), ("curve", options.curve)]
    taken: set[str] = set()
    for name, file in outputs:
        if file is None:
            continue
        if file.is_dir() or not file.absolute().parent.is_dir():
            raise Refusal(f"--{name}: {file}: there is no such folder, or it is one itself")
        if realpath(file) in taken:
            raise Refusal(f"--{name}: {file}: another file of this training has that name")
        taken.add(realpath(file))
        require_writable(file)
    if options.curve:
        require("plots")


@dataclass(frozen=True, kw_only=True)
class PpoOptions(OutputOptions, JsonOption, GameOption):
    """What is learned, for how long, and by which machines."""

    GROUPS: ClassVar[Groups] = {
        ONE_OF: ("updates", "decisions", "minutes"),
        ("several machines", "The same network, bit for bit, as without them."): ("ray", "workers"),
    }

    task: Path | None = option("task file (.toml); default: the game's own, see `train task`", path, metavar="FILE")
    seed: int | None = option("random seed; default: that of the task file", integer(0, SEEDS - 1), metavar="NUMBER")
    updates: int | None = option(
        "length; the same seed gives the same network", integer(high=1_000_000), metavar="NUMBER"
    )
    decisions: int | None = option("length, in decisions, approximately", integer(high=10**12), metavar="NUMBER")
    minutes: float | None = option("length; default: that of the task file", decimal(0.01, 10_000.0), metavar="NUMBER")
    base: str | None = option("network to continue, a name or a file", name=("--from",), metavar="AI")
    population: bool = flag("against exploiters that start from its present weights, and members of a pool that win")
    tensorboard: Path | None = option("folder for TensorBoard, a row each update", path, metavar="FOLDER")
    copies: Path | None = option("folder for a copy each tenth; the strongest is the result", path, metavar="FOLDER")
    ray: str | None = option("Ray cluster, auto, or local (extra `ray`)", word, metavar="ADDRESS")
    workers: int | None = option(f"processes that play; default {DEFAULT_WORKERS}", integer(), metavar="NUMBER")
    against: str | None = None  # to beat this one alone, by this set of rules; see the job `exploit`
    variant: str | None = None
