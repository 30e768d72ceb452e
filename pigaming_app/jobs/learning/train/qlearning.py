"""A table, learned in self-play. Ctrl-C ends the training after the current match and saves the result.

`--resume` continues from the saved file; the result is the same, to the last bit, as without the interruption.
"""

import json
from dataclasses import dataclass
from time import perf_counter
from typing import NamedTuple

from pigaming_app.ai.learning import training
from pigaming_app.ai.qlearning.recipe import RECIPES, Recipe
from pigaming_app.ai.qlearning.table_files import TableError
from pigaming_app.games.arenas import load as load_arena
from pigaming_app.games.setup import MAX_MINUTES, MIN_MINUTES, ChoiceError, require_game
from pigaming_app.jobs.learning.train.options import OutputOptions, changed, check_outputs
from pigaming_app.jobs.learning.train.outputs import csv_of, png_of, two_plots
from pigaming_app.jobs.learning.train.progress import bar, end_line, end_of, interrupts, note, show
from pigaming_app.jobs.terminal.options import GameOption, JsonOption, SeedOption, decimal, flag, integer, option
from pigaming_app.jobs.terminal.refusal import Refusal, refused
from pigaming_app.scenes.files import load_table, save_table
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import HZ
from pigaming_app.storage.safe_files import write_atomic

SHOWN_EVERY = 0.1  # s, interval of the progress line
MEASURES = 10  # of a training, spread evenly
MEASURED = 10  # matches for each
RIVAL = "the thesis robot"  # whom it meets: `classic`, as the lobby names it


class Point(NamedTuple):
    """State of a training; wins, ties and losses against the thesis robot."""

    matches: int
    experiences: int
    temperature: float
    states: int
    pairs: int
    wins: int
    ties: int
    losses: int


@dataclass(frozen=True, kw_only=True)
class QlearningOptions(OutputOptions, JsonOption, SeedOption, GameOption):
    """What is learned, in how many matches."""

    reward: int = option("published reward; default 1", integer(), 1, choices=[1, 2])
    matches: int = option("matches of self-play; default 200", integer(), 200, metavar="NUMBER")
    minutes: float = option("length of a match; default 2", decimal(0.0, 3600.0), 2.0)
    arena: str = option("name, or path of a .toml file; default classic", default="classic")
    plain: bool = flag("without numba: the same table, slower")


def run(options: QlearningOptions) -> int:
    """Train, save and print the result; 130 after Ctrl-C. Raises Refusal or NotSaved."""
    with refused(ChoiceError, ArenaError, TableError):
        return _train_and_save(options)


def _train_and_save(options: QlearningOptions) -> int:
    _check(options)
    learner = _begin(options)
    points: list[Point] = []
    if learner.fast and not training.is_compiled():
        note("compiling the training, once")
    learner.warm()
    with interrupts() as stopped:
        note("Ctrl-C ends the training after the current match and saves the result")
        seconds = _train(learner, options, points, stopped)
        save_table(learner.trained(options.out.stem), options.out)
        if options.csv:
            write_atomic(options.csv, csv_of(Point._fields, points))
        if options.curve:
            write_atomic(options.curve, _curve_of(points, options))
    _print(learner, options, points, seconds, bool(stopped))
    return end_of(stopped)


def _check(options: QlearningOptions) -> None:
    """Check before the training whatever would fail after it. Raises Refusal, ChoiceError, ArenaError or NotSaved."""
    require_game(options.game)
    if options.game != training.GAME:
        raise Refusal(f"train qlearning: learns {training.GAME} only, not {options.game}")
    if not 1 <= options.matches <= 1_000_000:
        raise Refusal(f"--matches: {options.matches}; possible are 1 to 1000000")
    if not MIN_MINUTES <= options.minutes <= MAX_MINUTES:
        raise Refusal(f"--minutes: {options.minutes:g}; possible are {MIN_MINUTES:g} to {MAX_MINUTES:g}")
    load_arena(training.GAME, options.arena)
    check_outputs(options, "table")


def _recipe(options: QlearningOptions) -> Recipe:
    """The recipe with the changes of --set. Raises Refusal."""
    try:
        return changed(RECIPES[options.reward], options.set)
    except ValueError as wrong:
        raise Refusal(f"--set: {wrong}") from None


def _begin(options: QlearningOptions) -> training.TableTraining:
    """A fresh training, or the saved one. Raises Refusal or TableError."""
    recipe, fast = _recipe(options), False if options.plain else can_compile()
    if not options.resume:
        return training.TableTraining(recipe, options.seed, options.arena, fast, minutes=options.minutes)
    saved = load_table(options.out)
    requested = (recipe, options.seed, options.arena, options.minutes)
    names = ("reward (or --set)", "seed", "arena", "minutes")
    present = (saved.recipe, saved.seed, saved.arena, saved.minutes)
    for name, new, old in zip(names, requested, present, strict=True):
        if new != old:
            raise Refusal(f"--resume: {options.out.name} was trained with another {name}")
    if saved.other_engine:
        note(f"{options.out.name}: trained with another version of the engine; what it learned may fit less")
    return training.resumed(saved, fast)


def _train(
    learner: training.TableTraining, options: QlearningOptions, points: list[Point], stopped: list[int]
) -> float:
    """Train for the requested matches or until stopped; returns the training time without measurements, s."""
    match_ticks = round(options.minutes * 60 * HZ)
    every = max(1, -(-options.matches // MEASURES))
    seconds, shown = 0.0, 0.0
    _note(learner, points)
    while learner.matches < options.matches and not stopped:
        began = perf_counter()
        learner.run(match_ticks)
        seconds += perf_counter() - began
        if learner.matches % every == 0 or learner.matches == options.matches:
            _note(learner, points)
        if perf_counter() - shown > SHOWN_EVERY or learner.matches >= options.matches:
            shown = perf_counter()
            _show(learner, options.matches, points[-1])
    end_line()
    return seconds


def _note(learner: training.TableTraining, points: list[Point]) -> None:
    """Append the present state of the training, with a measurement against the thesis robot after the first match."""
    score = learner.measure(matches=MEASURED) if learner.matches else (0, 0, 0)
    pairs = int(learner.table.pairs)
    points.append(Point(learner.matches, learner.experiences, learner.temperature, learner.visited, pairs, *score))


def _show(learner: training.TableTraining, matches: int, last: Point) -> None:
    """Print a line of progress."""
    score = f"{RIVAL} {last.wins}-{last.ties}-{last.losses}" if last.matches else f"{RIVAL} not met yet"
    line = (
        f"{bar(learner.matches / matches)} {learner.matches}/{matches} matches  {learner.experiences:,} experiences  "
        f"T {learner.temperature:.3f}  {learner.visited:,} states  {score}"
    )
    show(line, milestone=last.matches == learner.matches)


def _curve_of(points: list[Point], options: QlearningOptions) -> bytes:
    """The learning curve as a PNG file: results against the thesis robot, states visited, temperature."""
    figure, score, seen = two_plots()
    matches = [point.matches for point in points]
    for word, colour in (("wins", "tab:green"), ("ties", "tab:gray"), ("losses", "tab:red")):
        shares = [getattr(point, word) / MEASURED if point.matches else float("nan") for point in points]
        score.plot(matches, shares, color=colour, marker="o", label=f"{word} against {RIVAL}")
    score.set(title=f"Reward {options.reward}, seed {options.seed}", ylabel="share", ylim=(-0.03, 1.03))
    score.legend()
    seen.plot(matches, [point.states for point in points], color="tab:blue", marker="o", label="states visited")
    seen.set(xlabel="matches of self-play", ylabel="states visited")
    heat = seen.twinx()
    heat.plot(matches, [point.temperature for point in points], color="tab:orange", label="temperature")
    heat.set(ylabel="temperature")
    figure.legend(loc="outside lower center", ncols=2, handles=[*seen.lines, *heat.lines])
    return png_of(figure)


def _print(
    learner: training.TableTraining, options: QlearningOptions, points: list[Point], seconds: float, stopped: bool
) -> None:
    """Print the result."""
    last = points[-1]
    if options.json:
        result = {
            "reward": options.reward,
            "seed": options.seed,
            **last._asdict(),
            "matches": learner.matches,
            "experiences": learner.experiences,
            "measured": MEASURED if last.matches else 0,
            "seconds": seconds,
            "compiled": learner.fast,
            "finished": not stopped,
            "out": str(options.out),
        }
        print(json.dumps(result))
        return
    how = "compiled" if learner.fast else "plain"
    score = f"; {last.wins}-{last.ties}-{last.losses} of {MEASURED} against {RIVAL}" if last.matches else ""
    print(f"{learner.matches} matches, {learner.experiences:,} experiences, {learner.visited:,} states: {options.out}")
    print(f"trained in {seconds:.1f} s ({how}){score}")
