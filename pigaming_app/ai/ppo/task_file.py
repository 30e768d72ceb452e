"""Task files: by what a network learns, in TOML. The code of a game has the formulas, its file all numbers and names.

game = "race"
updates = 2000
arenas = ["classic", "hairpin"]
variants = ["standard"]
match_minutes = [10.0]
rivals = ["hand3"]
line_ups = [{ share = 1, seats = ["learner", "hand3"] }]
[training]
matches = 160
[rewards]
…
"""

import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass, fields, is_dataclass, replace
from pathlib import Path
from typing import Annotated, Any, NamedTuple

from msgspec import Meta

from pigaming_app.ai.brain.archive import BrainFileError, read
from pigaming_app.ai.brain_files import is_path
from pigaming_app.ai.networks.files import MAX_BYTES, TrainedNetwork, decode
from pigaming_app.ai.networks.policy import HIDDEN, SIZES
from pigaming_app.ai.ppo.learner import STANDARD, Hyper
from pigaming_app.ai.ppo.task import EXPLOITER, LEARNER, LEARNERS, OFF, POOL, Length, LineUp, Task, no_habits
from pigaming_app.games.arenas import SURPRISE, arenas
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, require_one_of
from pigaming_app.sim.rng import SEEDS
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.parsing import ParseError, describe_error, name_of, parse_toml, quote, read_text
from pigaming_app.storage.schema import Line, Share, between, one_of, typed

SUFFIX = ".task.toml"
TEAM = "team"  # critic
UNIFORM, PRIORITISED = "uniform", "pfsp"  # how members of the pool are drawn
MOST_SURPRISES, MOST_RIVALS = 1_000, 5  # each rival has columns in the curve of a network's file
PPO = "ppo"  # the learner of networks that record their task; those of other libraries have none
MOST_STARTS = 20  # networks in a row, each continued from the next
HELD_BACK = 900_000_000  # arenas from this seed on are for measurements only

Names = Annotated[tuple[Line, ...], Meta(min_length=1, max_length=1_000)]
Minutes = Annotated[float, between(0.05, 60.0)]
Weight = Annotated[float, between(-1e6, 1e6)]


class TaskFileError(ChoiceError):
    """A task file is not valid; the message is one line and begins with the file's name."""


@dataclass(frozen=True)
class FiledLineUp:
    """A `LineUp` in a file; seats that are left out are off."""

    share: Annotated[int, between(1, 10_000)]
    seats: Annotated[tuple[Line, ...], Meta(min_length=1, max_length=ROBOTS)]
    teams: Annotated[tuple[Annotated[int, between(0, ROBOTS - 1)], ...], Meta(max_length=ROBOTS)] = ()
    variants: tuple[Line, ...] = ()
    arenas: tuple[Line, ...] = ()

    def __post_init__(self) -> None:
        if self.teams and len(self.teams) != ROBOTS:
            raise ValueError(f"teams: {ROBOTS} numbers are needed, one for each seat")


@dataclass(frozen=True, kw_only=True)
class TaskFile:
    """The content of a task file."""

    game: Line
    seed: Annotated[int, between(0, SEEDS - 1)] = 1
    updates: Annotated[int, between(1, 1_000_000)] | None = None
    decisions: Annotated[int, between(1, 10**12)] | None = None
    minutes: Annotated[float, between(0.01, 10_000.0)] | None = None
    units: int = HIDDEN
    arenas: Names
    surprises: Annotated[int, between(0, MOST_SURPRISES)] = 0  # arenas made from seeds, for half of the matches
    variants: Names
    match_minutes: Annotated[tuple[Minutes, ...], Meta(min_length=1, max_length=100)]
    rivals: Annotated[tuple[Line, ...], Meta(min_length=1, max_length=MOST_RIVALS)]
    pairs: bool = False
    pool: Annotated[str, one_of(UNIFORM, PRIORITISED)] = UNIFORM
    critic: Annotated[str, one_of(TEAM)] | None = None  # None: the value function sees what the policy sees
    cut: Share = 0.0
    sharpness: Annotated[float, between(0.0, 10.0)] = 1.0
    line_ups: Annotated[tuple[FiledLineUp, ...], Meta(min_length=1, max_length=200)]
    training: Hyper = STANDARD
    rewards: Mapping[str, float] | None = None
    habits: Mapping[str, float] | None = None

    def __post_init__(self) -> None:
        if sum(length is not None for length in (self.updates, self.decisions, self.minutes)) > 1:
            raise ValueError("updates, decisions, minutes: one of them at most")
        if self.units not in SIZES:
            wanted = f"a multiple of {SIZES.step} from {SIZES.start} to {SIZES[-1]}"
            raise ValueError(f"units: expected {wanted}, got {self.units}")
        if not any(LEARNER in line_up.seats for line_up in self.line_ups):
            raise ValueError(f"line_ups: nobody is {LEARNER}")
        others = [{*line_up.seats} - {OFF} for line_up in self.line_ups]
        if self.pool == PRIORITISED and not ({LEARNER, EXPLOITER} in others and {LEARNER, POOL} in others):
            raise ValueError(f"pool: {PRIORITISED} needs line-ups of {LEARNER} and {EXPLOITER}, {LEARNER} and {POOL}")


def read_task(path: Path, code: Task, check: bool = True) -> Task:
    """The task of a game with the content of a file. Raises TaskFileError.

    Brains that are files lie beside it unless it has their whole path.
    `check`: whether all that it names exists.
    """
    try:
        file = parse_task_file(read_text(path))
        task = with_file(code, with_brains(file, lambda name: str(path.parent / name) if is_path(name) else name))
        if check:
            check_names(task)
        return task
    except (OSError, ParseError, ChoiceError) as error:
        raise TaskFileError(f"{name_of(path)}: {describe_error(error)}") from None


def parse_task_file(text: str) -> TaskFile:
    """The content of a task file. Raises ParseError, also for keys that there are not."""
    tables = parse_toml(text)
    _require_known(tables, TaskFile)
    line_ups = tables.get("line_ups")
    for k, line_up in enumerate(line_ups if isinstance(line_ups, list) else []):
        _require_known(line_up, FiledLineUp, f"line_ups[{k}].")
    _require_known(tables.get("training"), Hyper, "training.")
    for table in ("rewards", "habits"):
        for key, number in _entries(tables.get(table)):
            with _within(f"{table}.{key}: "):
                typed(number, Weight)
    return typed(tables, TaskFile)


@contextmanager
def _within(place: str) -> Iterator[None]:
    """Names the place in a ParseError of this context."""
    try:
        yield
    except ParseError as error:
        raise ParseError(f"{place}{error}") from None


def _entries(table: object) -> list[tuple[str, object]]:
    return list(table.items()) if isinstance(table, dict) else []


def with_file(code: Task, file: TaskFile) -> Task:
    """A task with the numbers and names of a file. Raises ParseError or ChoiceError."""
    if file.game != code.game:
        raise ParseError(f"game: it is for {quote(file.game)}, not {code.game}")
    count = max(1, round(file.surprises / len(file.arenas))) if file.surprises else 1
    return replace(
        code,
        reward=_called(code.reward, file.rewards, "rewards"),
        habits=no_habits if file.habits is None else _called(code.habits, file.habits, "habits"),
        arenas=(*file.arenas * count, *_surprises(file.surprises)),
        variants=file.variants,
        minutes=file.match_minutes,
        line_ups=tuple(
            LineUp(one.share, (*one.seats, *[OFF] * (ROBOTS - len(one.seats))), one.teams or None, *places)
            for one in file.line_ups
            for places in [(one.variants, one.arenas)]
        ),
        rivals=file.rivals,
        pairs=file.pairs,
        population=file.pool == PRIORITISED,
        team_critic=file.critic == TEAM,
        units=file.units,
        cut=file.cut,
        sharpness=file.sharpness,
        hyper=file.training,
        length=Length(file.seed, file.updates, file.decisions, file.minutes),
    )


def with_brains(file: TaskFile, named: Callable[[str], str]) -> TaskFile:
    """The same with another name of each brain."""
    line_ups = tuple(replace(one, seats=tuple(map(named, one.seats))) for one in file.line_ups)
    return replace(file, rivals=tuple(map(named, file.rivals)), line_ups=line_ups)


def file_of(task: Task) -> TaskFile:
    """The file from which `with_file` makes this task."""
    names = tuple(name for name in dict.fromkeys(task.arenas) if not SURPRISE.fullmatch(name))
    surprises = sum(1 for name in {*task.arenas} if SURPRISE.fullmatch(name))
    count = max(1, round(surprises / len(names))) if surprises and names else 1
    if task.arenas != (*names * count, *_surprises(surprises)):
        names, surprises = task.arenas, 0
    return TaskFile(
        game=task.game,
        **task.length._asdict(),
        arenas=names,
        surprises=surprises,
        variants=task.variants,
        match_minutes=task.minutes,
        rivals=task.rivals,
        pairs=task.pairs,
        pool=PRIORITISED if task.population else UNIFORM,
        critic=TEAM if task.team_critic else None,
        units=task.units,
        cut=task.cut,
        sharpness=task.sharpness,
        line_ups=tuple(
            FiledLineUp(one.share, one.seats, one.teams or (), one.variants, one.arenas) for one in task.line_ups
        ),
        training=task.hyper,
        rewards=_fields_of(task.reward),
        habits=_fields_of(task.habits),
    )


def text_of(file: TaskFile) -> str:
    """The content of a file as TOML, all hyper-parameters among it."""
    lines, tables = list[str](), list[str]()
    for name, value in asdict(file).items():
        if isinstance(value, Mapping):
            tables += ["", f"[{name}]", *(f"{key} = {_literal(number)}" for key, number in value.items())]
        elif name == "line_ups":
            lines += ["line_ups = [", *(f"    {_inline(line_up)}," for line_up in value), "]"]
        elif value is not None:
            lines.append(f"{name} = {_literal(value)}")
    return "\n".join([*lines, *tables, ""])


def _inline(table: Mapping[str, Any]) -> str:
    return "{ " + ", ".join(f"{key} = {_literal(value)}" for key, value in table.items() if value != ()) + " }"


def _literal(value: Any) -> str:
    """A text, number, truth value or list of these as TOML, which is like JSON there."""
    return json.dumps(value)


def check_names(task: Task) -> None:
    """Raises ChoiceError unless all arenas, rule sets and brains of a task exist."""
    from pigaming_app.ai.registry import find_brain  # late: it loads all brains

    own, rules = arenas(task.game), games()[task.game]
    for key, noun, names in _named(task):
        for name in names:
            try:
                if noun == "arena" and not (rules.surprise and SURPRISE.fullmatch(name)):
                    require_one_of(noun, name, own)
                elif noun == "arena":
                    require_trainable(name)
                elif noun == "variant":
                    require_one_of(noun, name, [*rules.variants])
                elif noun == "brain":
                    find_brain(task.game, name)
            except ChoiceError as error:
                raise ChoiceError(f"{key}: {error}") from None


def require_trainable(arena: str) -> None:
    """Raises ChoiceError for the name of a made arena that is held back, so that networks can be measured on it."""
    made = SURPRISE.fullmatch(arena)
    if made and int(made[1]) >= HELD_BACK:
        raise ChoiceError(f"{arena} is held back for measurements; trainings have those below {HELD_BACK}")


def _named(task: Task) -> Iterator[tuple[str, str, tuple[str, ...]]]:
    """What a task names: key, noun, names."""
    yield "arenas", "arena", task.arenas
    yield "variants", "variant", task.variants
    yield "rivals", "brain", task.rivals
    for k, line_up in enumerate(task.line_ups):
        yield f"line_ups[{k}].arenas", "arena", line_up.arenas
        yield f"line_ups[{k}].variants", "variant", line_up.variants
        brains = tuple(name for name in line_up.seats if name not in (*LEARNERS, POOL, OFF))
        yield f"line_ups[{k}].seats", "brain", brains


class TrainingHistory(NamedTuple):
    """The trainings of a network as one, those of the networks that it was continued from included."""

    decisions: int | None = None  # of its robots; None: not known
    met: frozenset[str] = frozenset()  # AIs on the seats of its matches, as far as recorded
    recorded: bool = False  # whether these are all


def history_of(network: TrainedNetwork, folder: Path, deeper: int = MOST_STARTS) -> TrainingHistory:
    """The history of a network. One that does not tell that of its start needs its file beside it, in `folder`."""
    recipe = network.recipe
    before = _before(recipe, folder, deeper) if recipe.get("start") else TrainingHistory(0, recorded=True)
    decisions = None if before.decisions is None else before.decisions + network.decisions
    try:
        seats = {name for line_up in parse_task_file(str(recipe["task"])).line_ups for name in line_up.seats}
    except (KeyError, ParseError):
        return TrainingHistory(decisions, before.met, before.recorded and recipe.get("learner") != PPO)
    return TrainingHistory(decisions, before.met | (seats - {*LEARNERS, POOL, OFF}), before.recorded)


def recipe_of(start: str, history: TrainingHistory) -> dict[str, Any]:
    """What a recipe tells of the network that was continued."""
    decisions, met, recorded = history
    return {"start": start, "start_decisions": decisions, "start_met": sorted(met), "start_recorded": recorded}


def _before(recipe: Mapping[str, Any], folder: Path, deeper: int) -> TrainingHistory:
    """The history of the network that was continued."""
    match recipe:
        case {"start_decisions": int(decisions), "start_met": list(met), "start_recorded": bool(recorded)}:
            return TrainingHistory(max(0, decisions), frozenset(map(str, met)), recorded)
    file = folder / f"{recipe['start']}.npz"
    try:
        return history_of(decode(read(file, MAX_BYTES), file.name), folder, deeper - 1) if deeper else TrainingHistory()
    except BrainFileError:
        return TrainingHistory()


def _surprises(count: int) -> tuple[str, ...]:
    return tuple(f"surprise-{seed}" for seed in range(1, count + 1))


def _called(code: Any, table: Mapping[str, float] | None, key: str) -> Any:
    """A function, or an instance of a dataclass with the fields in a table. Raises ParseError."""
    kind = code if isinstance(code, type) else type(code)
    if not is_dataclass(kind):
        if table:
            raise ParseError(f"{key}: the game has no numbers there")
        return code
    names = [field.name for field in fields(kind)]
    _require_known(table, kind, f"{key}.")
    if missing := [name for name in names if name not in (table or {})]:
        raise ParseError(f"{key}.{missing[0]} is missing")
    return kind(**(table or {}))


def _fields_of(called: Any) -> Mapping[str, float] | None:
    return asdict(called) if is_dataclass(called) and not isinstance(called, type) else None


def _require_known(table: object, kind: Any, place: str = "") -> None:
    """Raises ParseError if a table has a key that is no field of a dataclass."""
    names = [field.name for field in fields(kind)]
    for key, _ in _entries(table):
        if key not in names:
            raise ParseError(f"{place}{key} is not a key here; there are {', '.join(names)}")
