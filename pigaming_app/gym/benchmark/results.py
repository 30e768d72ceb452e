"""Results of a task as a file: which agents, by how long a training, and how their matches ended.

Whoever has it, and the files of the agents beside it, can play all of it again and compare every number.
"""

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import mean, stdev
from typing import Annotated, Any

from msgspec import Meta

from pigaming_app import __version__
from pigaming_app.ai.brain.archive import names
from pigaming_app.ai.brain_files import is_path, stem_of
from pigaming_app.ai.learning.league import wilson
from pigaming_app.ai.networks import files as networks
from pigaming_app.ai.ppo.task_file import history_of
from pigaming_app.ai.qlearning import table_files as tables
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.engine_hash import engine_hash
from pigaming_app.games.setup import ChoiceError
from pigaming_app.gym.benchmark.protocol import Digest, MatchCounts, evaluate, score_of
from pigaming_app.gym.benchmark.tasks import BUDGETS, FORMAT, PARTNERS, RIVAL, RIVAL_DECISIONS, RIVAL_SEED, TASKS
from pigaming_app.storage.parsing import ParseError, describe_error, name_of, parse_json, quote, read_text
from pigaming_app.storage.schema import Count, Line, Share, from_json, to_plain

AUTHORS = ("seed", "decisions")  # theirs to fill in, for an agent whose file does not have them
DIGITS = 6  # of a score
STUDENT = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262)  # 97.5 % of t, by degrees of freedom
FileName = Annotated[str, Meta(pattern=r"^[A-Za-z0-9_][A-Za-z0-9_.-]{0,79}\Z")]  # beside the results, or an AI's name
Note = Callable[[str], None]


class ResultsError(ValueError):
    """Results are not valid, or do not play out as they say: one line with file, key and reason."""


@dataclass(frozen=True, kw_only=True)
class BenchmarkRun:
    """An agent and its matches. What is None is not known: AIs of this program, models of other programs."""

    agent: FileName
    sha256: Digest | None = None  # of its file
    seed: int | None = None  # of its training
    decisions: Count | None = None  # of its training
    rival: Digest | None = None  # SHA-256 of the best response, rival_AGENT.npz
    score: Share
    conditions: Mapping[Line, MatchCounts]


@dataclass(frozen=True, kw_only=True)
class BenchmarkResults:
    """All runs of one method on one task; each is a training of its own."""

    task: Line
    method: Line
    version: Line = __version__
    engine: Digest
    runs: Annotated[tuple[BenchmarkRun, ...], Meta(min_length=1, max_length=100)]


def measured(task: str, folder: Path, agents: Sequence[str], method: str, note: Note) -> BenchmarkResults:
    """Evaluate agents: names of AIs, or of files in a folder. `note` takes a line about each. Raises ResultsError."""
    if task not in TASKS:
        raise ResultsError(f"no task '{task}'; there are {', '.join(TASKS)}")
    known = [_identified(task, folder, agent) for agent in agents]
    runs = tuple(BenchmarkRun(**one, **_evaluated(task, folder, one["agent"], note)) for one in known)
    results = BenchmarkResults(task=task, method=method, engine=engine_hash(TASKS[task].game), runs=runs)
    return from_json(text_of(results), BenchmarkResults, FORMAT)


def text_of(results: BenchmarkResults) -> str:
    """The content of a file."""
    return json.dumps({"format": FORMAT, **to_plain(results)}, indent=1, ensure_ascii=False) + "\n"


def verify(path: Path, note: Note) -> BenchmarkResults:
    """Read results, play all their matches again, and compare every number. Raises ResultsError."""
    try:
        results = _read(read_text(path))
        _compare({"engine": engine_hash()}, {"engine": results.engine}, "")
        for place, run in _placed(results):
            _compare(_identified(results.task, path.parent, run.agent), to_plain(run), place)
        for place, run in _placed(results):
            _compare(_evaluated(results.task, path.parent, run.agent, note), to_plain(run), place)
    except (OSError, ParseError, ResultsError) as error:
        raise ResultsError(f"{name_of(path)}: {describe_error(error)}") from None
    return results


def _read(text: str) -> BenchmarkResults:
    """The results in a file. Raises ParseError, or ResultsError for a key that there is not and for an empty method."""
    results = from_json(text, BenchmarkResults, FORMAT)
    _require_known(parse_json(text), {"format": FORMAT, **to_plain(results)})
    if not results.method.strip():
        raise ResultsError("method: it is empty; tell how the agents learned, in a few words")
    return results


def _require_known(told: Any, known: Any, place: str = "") -> None:
    """Raises ResultsError for a key of the file that results do not have."""
    if isinstance(known, dict):
        for key, value in told.items():
            if key not in known:
                raise ResultsError(f"{place}{key} is not a key here; there are {', '.join(known)}")
            _require_known(value, known[key], f"{place}{key}.")
    elif isinstance(known, list | tuple):
        for k, value in enumerate(told):
            _require_known(value, known[k], f"{place.removesuffix('.')}[{k}].")


def _placed(results: BenchmarkResults) -> Iterator[tuple[str, BenchmarkRun]]:
    """The runs with their places. Raises ResultsError for an unknown task and for an agent that is named twice."""
    if results.task not in TASKS:
        raise ResultsError(f"task: no task {quote(results.task)}; there are {', '.join(TASKS)}")
    seen = dict[str, int]()
    for k, run in enumerate(results.runs):
        other = seen.setdefault(run.sha256 or run.agent, k)
        if other < k:
            raise ResultsError(f"runs[{k}].agent: the same one as in runs[{other}]")
        yield f"runs[{k}].", run


def _compare(found: Mapping[str, Any], claimed: Mapping[str, Any], place: str) -> None:
    """Raises ResultsError for the first entry that differs from what was found; AUTHORS may, if nothing was."""
    for key, value in found.items():
        told = claimed.get(key)
        if isinstance(value, Mapping) and isinstance(told, Mapping):
            if extra := [name for name in told if name not in value]:
                raise ResultsError(f"{place}{key}.{extra[0]}: nothing of that name is played")
            _compare(value, told, f"{place}{key}.")
        elif told != value and not (value is None and key in AUTHORS) and not _is_more(key, told, value):
            raise ResultsError(f"{place}{key}: {quote(told)}, but it is {quote(value)}")


def _is_more(key: str, told: Any, value: Any) -> bool:
    """True for decisions of which the file does not know, such as those of a demonstrator."""
    return key == "decisions" and isinstance(told, int) and told > value


def _identified(task: str, folder: Path, agent: str) -> dict[str, Any]:
    """What is known of an agent without playing: the first fields of its run. Raises ResultsError."""
    found: dict[str, Any] = {"agent": agent, "sha256": None, "seed": None, "decisions": None, "rival": None}
    try:
        game = TASKS[task].game
        find_brain(game, _brain(folder, agent))
        if is_path(agent):
            raw = (folder / agent).read_bytes()
            found |= {"sha256": hashlib.sha256(raw).hexdigest(), **_training(task, raw, folder / agent)}
        if rival := _rival(task, folder, agent):
            found["rival"] = hashlib.sha256(_rival_file(Path(rival), agent)).hexdigest()
    except OSError as error:
        raise ResultsError(f"{Path(error.filename or agent).name}: {describe_error(error)}") from None
    except ValueError as error:
        raise ResultsError(str(error)) from None
    return found


def _brain(folder: Path, agent: str) -> str:
    return str(folder / agent) if is_path(agent) else agent


def _rival(task: str, folder: Path, agent: str) -> str:
    """The file of the best response, as `exploit` names it; empty if the task has none."""
    seats = {name for one in TASKS[task].conditions.values() for name in one.seats}
    return str(folder / f"rival_{stem_of(agent)}.npz") if RIVAL in seats else ""


def _training(task: str, raw: bytes, path: Path) -> dict[str, int]:
    """Seed and length of a training, from a file that has them, those of the networks that it continues included.

    Raises ValueError if it used what it must not.
    """
    agent, parts = path.name, names(raw)
    if parts == tables.PARTS.keys():
        table = tables.decode(raw, agent)
        return {"seed": table.seed, "decisions": int(table.rows["experiences"][0])}
    if parts != networks.PARTS.keys():
        return {}
    network = networks.decode(raw, agent)
    decisions, met, recorded = history_of(network, path.parent)
    if "partner" in task and (used := sorted(met & {*PARTNERS})):
        raise ValueError(f"{agent}: it was trained with {used[0]}, whom this task holds back")
    if "partner" in task and not recorded:
        raise ValueError(f"{agent}: nothing records with whom it was trained, or the network that it continues")
    if decisions is None:
        start = network.recipe["start"]
        raise ValueError(f"{agent}: it continues {start}, whose training is not known; {start}.npz belongs beside it")
    return {"seed": network.seed, "decisions": decisions}


def _rival_file(path: Path, agent: str) -> bytes:
    """The content of a rival's file. Raises ValueError unless it says that it is the one that the protocol asks for."""
    command = f"train it by exploit {agent} --decisions {RIVAL_DECISIONS}"
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise ValueError(f"{path.name}: {describe_error(error)}; {command}") from None
    rival = networks.decode(raw, path.name)
    if rival.seed != RIVAL_SEED or rival.decisions < RIVAL_DECISIONS:
        raise ValueError(f"{path.name}: {command}")
    return raw


def _evaluated(task: str, folder: Path, agent: str, note: Note) -> dict[str, Any]:
    """Play the matches of an agent: the last fields of its run. Raises ResultsError."""
    try:
        ends = evaluate(TASKS[task], _brain(folder, agent), _rival(task, folder, agent))
    except ChoiceError as error:
        raise ResultsError(str(error)) from None
    points, matches = score_of(TASKS[task], ends)
    low, high = wilson(points, matches)
    note(f"{agent}: {points / matches:.1%} of {matches} matches (Wilson 95 %: {low:.1%} to {high:.1%})")
    return {"score": round(points / matches, DIGITS), "conditions": to_plain(ends)}


def by_budget(results: BenchmarkResults) -> dict[int | None, tuple[float, float, float, int]]:
    """Mean score, its 95 % interval and the number of runs, by the budget that each fits; None: by none, or not known.

    The interval is that of Student's t over the runs: how much trainings with other seeds would differ. Of a single run
    it is Wilson's over its matches.
    """
    groups: dict[int | None, list[BenchmarkRun]] = {}
    for run in results.runs:
        fits = [budget for budget in BUDGETS if run.decisions is not None and run.decisions <= budget]
        groups.setdefault(fits[0] if fits else None, []).append(run)
    return {budget: (*_interval(results.task, runs), len(runs)) for budget, runs in groups.items()}


def _interval(task: str, runs: Sequence[BenchmarkRun]) -> tuple[float, float, float]:
    scores = [run.score for run in runs]
    if len(runs) == 1:
        return scores[0], *wilson(*score_of(TASKS[task], runs[0].conditions))
    return student_interval(scores)


def student_interval(shares: Sequence[float]) -> tuple[float, float, float]:
    """Mean of two shares or more, and its 95 % interval by Student's t, cut to 0 and 1."""
    middle, freedom = mean(shares), len(shares) - 1
    width = STUDENT[min(freedom, len(STUDENT)) - 1] * stdev(shares) / len(shares) ** 0.5
    return middle, max(0.0, middle - width), min(1.0, middle + width)
