"""The run of `train ppo`."""

import json
import os
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from time import monotonic
from typing import Any, NamedTuple

from pigaming_app.ai.brain.archive import BrainFileError
from pigaming_app.ai.learning.rollout import rehearse
from pigaming_app.ai.networks.files import encode as encode_network
from pigaming_app.ai.ppo.product import encode, restore, trained_network
from pigaming_app.ai.ppo.ray_workers import NoCluster, RayShards
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.ppo.shard import is_compiled
from pigaming_app.ai.ppo.task import NO_LENGTH, SHARDS, Length, Task
from pigaming_app.ai.ppo.task_file import read_task
from pigaming_app.ai.ppo.training import Diverged, Gather, Origin, Training, in_threads, scores_at, start_of
from pigaming_app.ai.ppo.win_rates import DuelScore
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, require_game, require_one_of
from pigaming_app.jobs.learning.train.copies import FrozenCopies, RatedCopy, strongest
from pigaming_app.jobs.learning.train.live_page import page_of
from pigaming_app.jobs.learning.train.options import DEFAULT_MINUTES, DEFAULT_WORKERS, PpoOptions, changed
from pigaming_app.jobs.learning.train.progress import bar, end_line, end_of, interrupts, note, show
from pigaming_app.jobs.learning.train.telemetry import TrainingTable
from pigaming_app.jobs.learning.train.tensorboard import TensorboardFile
from pigaming_app.jobs.terminal.refusal import Refusal, refused
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.safe_files import NotSaved, write_all_atomic, write_atomic

MEASURED_EVERY = 25  # updates
MEASURED, MEASURED_AT_END = 10, 40  # matches against each rival
CURVE, MEASURED_AGAINST = 10, 200  # points of the curve of a best response, and matches for each
SAVED_EVERY = 60.0  # s


class Measures(NamedTuple):
    """How often progress is measured, in updates, by how many matches, and by how many at the end."""

    every: int
    matches: int
    at_end: int


def train_and_save(options: PpoOptions, beside: Path) -> int:
    """Train, save and print the result; 130 after Ctrl-C. `beside`: the checkpoint. Raises Refusal or NotSaved."""
    with refused(ChoiceError, BrainFileError):
        training = _begin(options, beside)
        copies = FrozenCopies(training, options.copies, options.out.stem) if options.copies else None
    events = TensorboardFile(options.tensorboard, training.updates) if options.tensorboard else None
    if copies:
        copies.add()
    if not is_compiled(training.task):
        note("compiling the training, once; it takes a minute")
    with (
        refused(Diverged, NoCluster, BrainFileError),
        ThreadPoolExecutor(min(SHARDS, os.cpu_count() or 1)) as threads,
        _players(training, threads, options) as (gather, sync),
    ):
        measures = _measures(training, options)
        scores = training.measure(measures.matches, threads)  # also compiles
        with interrupts() as stopped:
            note("Ctrl-C ends the training after the current update and saves the result")
            table = TrainingTable(training, options.csv if options.resume else None)
            save = partial(_save, table, sync, options, beside)
            follow = partial(_follow, table, events, copies, threads)
            _train(table, measures, scores, gather, threads, save, follow, stopped)
            scores = training.measure(measures.at_end, threads)
            if copies:
                table.copies = copies.rated(threads)
            save()
        chosen = strongest(table.copies) if table.copies and not stopped else None
        if copies and chosen:
            copies.copied(chosen, options.out)
    _print(table, scores, options, bool(stopped), chosen)
    return end_of(stopped)


def _begin(options: PpoOptions, beside: Path) -> Training:
    """A fresh training, or the saved one. Raises Refusal, ChoiceError or BrainFileError."""
    require_game(options.game)
    if options.game not in TASKS:
        raise Refusal(f"train ppo: learns {', '.join(TASKS)} only, not {options.game}")
    if (options.workers or 0) > SHARDS:
        raise Refusal(f"--workers: {options.workers}; the matches are divided among {SHARDS} at most")
    start = _start(options)
    task = _task(options)
    _rehearse(task)
    length = _length(options, task)
    try:
        task = replace(task, hyper=changed(task.hyper, options.set))
        training = Training(task, length.seed, length.updates or 0, None, length.minutes, start)
    except ValueError as wrong:
        place = "--set: " if options.set else f"{options.task.name}: training." if options.task else ""
        raise Refusal(f"{place}{wrong}") from None
    if length.decisions is not None:
        training.planned = -(-length.decisions // training.decisions_of_update)
    if options.resume:
        restore(training, beside)
    return training


def _rehearse(task: Task) -> None:
    """Play a match of a plug-in's game before the training. Raises what it raises."""
    variant = games()[task.game].variants[task.variants[0]]
    one, two, three, four = (Seat("random", team) for team in variant.teams)
    seats, minutes = (one, two, three, four), task.minutes[0]
    setup = Setup(task.game, task.arenas[0], seats, minutes, 1, variant.name, variant.default_goal)
    rehearse(setup, [find_brain(task.game, "random")] * ROBOTS)


def _length(options: PpoOptions, task: Task) -> Length:
    """Seed and length: those of the command, else of the task."""
    length = NO_LENGTH._replace(updates=options.updates, decisions=options.decisions, minutes=options.minutes)
    if length[1:] == NO_LENGTH[1:]:
        length = task.length
    if length[1:] == NO_LENGTH[1:]:
        length = NO_LENGTH._replace(minutes=DEFAULT_MINUTES)
    return length._replace(seed=task.length.seed if options.seed is None else options.seed)


def _task(options: PpoOptions) -> Task:
    """The game as it is to be learned. Raises ChoiceError."""
    task = TASKS[options.game]
    if options.task is not None:
        task = read_task(options.task, task)
    if options.against is None:
        return task.populated() if options.population else task
    variant = options.variant or games()[options.game].default.name
    require_one_of("variant", variant, list(games()[options.game].variants))
    return task.against(options.against, variant)


def _start(options: PpoOptions) -> Origin | None:
    """The network to continue: with `against`, that one if it is a network. Raises ChoiceError."""
    if options.base is not None:
        return start_of(options.game, options.base)
    if options.against is not None:
        with suppress(ChoiceError):
            return start_of(options.game, options.against)
    return None


def _measures(training: Training, options: PpoOptions) -> Measures:
    if options.against is None:
        return Measures(MEASURED_EVERY, MEASURED, MEASURED_AT_END)
    return Measures(training.planned // CURVE or MEASURED_EVERY, MEASURED_AGAINST, MEASURED_AGAINST)


@contextmanager
def _players(training: Training, threads: Executor, options: PpoOptions) -> Iterator[tuple[Gather, Callable[[], None]]]:
    """Those who play the shards, and a function that brings the training's own shards up to date."""
    if options.ray is None:
        yield in_threads(training, threads), lambda: None
        return
    with RayShards(training, options.ray, options.workers or DEFAULT_WORKERS) as shards:
        yield shards.gather, shards.sync


def _train(
    table: TrainingTable,
    measures: Measures,
    scores: Mapping[str, DuelScore],
    gather: Gather,
    threads: Executor,
    save: Callable[[], None],
    follow: Callable[[], None],
    stopped: list[int],
) -> None:
    """Train to the end of the plan, or until stopped. `scores`: of the network as it is."""
    saved, training = monotonic(), table.training
    while not training.finished and not stopped:
        training.update(gather, threads)
        table.note()
        measured = training.updates % measures.every == 0
        if measured:
            scores = training.measure(measures.matches, threads)
        show(_line(training, scores), milestone=measured)
        follow()
        if monotonic() - saved > SAVED_EVERY:
            saved = monotonic()
            with _saved_later():
                save()
    end_line()


@contextmanager
def _saved_later() -> Iterator[None]:
    """Tells that a file was not written, and goes on: there may be room later."""
    try:
        yield
    except NotSaved as error:
        end_line()
        note(str(error))


def _follow(
    table: TrainingTable, events: TensorboardFile | None, copies: FrozenCopies | None, threads: Executor
) -> None:
    """Tell of an update, freeze a copy and rate it."""
    if events:
        with _saved_later():
            events.add(table.training.updates, table.numbers())
    if copies:
        with _saved_later():
            if copies.add():
                table.copies = copies.rated(threads)


def _save(table: TrainingTable, sync: Callable[[], None], options: PpoOptions, beside: Path) -> None:
    """Write network, checkpoint, table and page. Raises NotSaved or NoCluster."""
    sync()
    training, out = table.training, options.out
    write_all_atomic({out: encode_network(trained_network(training, out.stem)), beside: encode(training)})
    if options.csv:
        write_atomic(options.csv, table.csv())
    if options.curve:
        write_atomic(options.curve, page_of(table))


def _line(training: Training, scores: Mapping[str, DuelScore]) -> str:
    """A line of progress."""
    if training.minutes is None:
        done = f"{training.updates}/{training.planned} updates"
    else:
        done = f"{training.updates} updates  {training.seconds / 60:.1f}/{training.minutes:g} min"
    ends = "  ".join(f"{rival} {score.wins}-{score.ties}-{score.losses}" for rival, score in scores.items())
    return f"{bar(training.share)} {done}  {training.decisions / training.seconds:,.0f} decisions/s  {ends}"


def _print(
    table: TrainingTable,
    scores: Mapping[str, DuelScore],
    options: PpoOptions,
    stopped: bool,
    chosen: RatedCopy | None,
) -> None:
    """Print the result. `chosen`: the copy that is the result."""
    training = table.training
    speed = training.decisions / training.seconds if training.seconds else 0.0
    if options.json:
        result = {
            "game": training.task.game,
            "seed": training.seed,
            "updates": training.updates,
            "decisions": training.decisions,
            "seconds": training.seconds,
            "decisions_per_second": speed,
            "entropy": training.entropy,
            "rivals": {rival: _described(score) for rival, score in scores.items()},
            "curve": [
                {"decisions": point[1], **{rival: _described(score) for rival, score in found.items()}}
                for point in training.points
                for found in [scores_at(training.task, point)]
            ],
            "copies": [{"updates": copy.updates, **asdict(copy.rating)} for copy in table.copies],
            "chosen": chosen and chosen.updates,
            "finished": not stopped,
            "out": str(options.out),
        }
        print(json.dumps(result))
        return
    print(f"{training.updates} updates, {training.decisions:,} decisions: {options.out}")
    print(f"trained in {training.seconds:.1f} s, {speed:,.0f} decisions/s")
    if options.against is not None:
        for point in training.points[:-1]:
            print(f"{point[1] / 1e6:6.2f} million  {_sentence(scores_at(training.task, point)[options.against])}")
    for rival, score in scores.items():
        print(f"against {rival}: {_sentence(score)}")
    for updates, _, rating in table.copies:
        mark = "  the result" if chosen and chosen.updates == updates else ""
        print(
            f"copy after {updates:>7,} updates  {rating.rating:+5.0f} ({rating.low:+.0f} to {rating.high:+.0f}){mark}"
        )


def _described(score: DuelScore) -> dict[str, Any]:
    return {**score._asdict(), "share": score.share, "wilson95": score.interval}


def _sentence(score: DuelScore) -> str:
    low, high = score.interval
    return f"{score.wins}-{score.ties}-{score.losses}, {score.share:.1%} with ties for half ({low:.0%} to {high:.0%})"
