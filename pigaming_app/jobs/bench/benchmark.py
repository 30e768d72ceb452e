"""PiGaming-Bench on the command line: its tasks, an evaluation of agents, and results that are played again."""

import json
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from pigaming_app.gym.benchmark.results import BenchmarkResults, ResultsError, by_budget, measured, text_of, verify
from pigaming_app.gym.benchmark.tasks import MATCHES, TASKS
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require_for_brains
from pigaming_app.storage.safe_files import NotSaved, require_writable, write_atomic
from pigaming_app.storage.schema import is_line, to_plain


def list_tasks(as_json: bool) -> int:
    """Print the tasks."""
    if as_json:
        print(json.dumps(to_plain(dict(TASKS))))
        return 0
    for name, task in TASKS.items():
        print(f"{name:16} {task.game}, {task.variant}: {task.text}")
        for condition, one in task.conditions.items():
            count = f"{MATCHES} matches in {', '.join(one.arenas)}"
            print(f"    {condition:12} {' '.join(one.seats)}: {count}{'' if one.counts else '; not counted'}")
    return 0


def evaluate(task: str, agents: Sequence[str], method: str, out: Path | None, as_json: bool) -> int:
    """Evaluate agents, print the scores and write the results. Raises Refusal or NotSaved."""
    if not agents:
        raise Refusal(f"{task}: name an agent, or several trainings of one method")
    folders = {Path(agent).absolute().parent for agent in agents if Path(agent).name != agent or Path(agent).is_file()}
    folder = out.absolute().parent if out else next(iter(folders), Path.cwd())
    if folders - {folder}:
        raise Refusal(f"{task}: agents lie in one folder, and their results beside them")
    if not is_line(method) or (out and not method.strip()):
        raise Refusal("--method: one line of plain text is needed")
    require_for_brains(agents)
    with refused(ResultsError, NotSaved):
        if out:
            require_writable(out)
        results = measured(task, folder, [Path(agent).name for agent in agents], method, _note)
        if out:
            write_atomic(out, text_of(results).encode())
    _print(results, as_json)
    return 0


def check(files: Sequence[str], as_json: bool) -> int:
    """Play the matches of a file of results again. Raises Refusal if anything differs."""
    if len(files) != 1:
        raise Refusal("verify: name one file of results")
    with refused(ResultsError):
        results = verify(Path(files[0]), _note)
    _print(results, as_json)
    if not as_json:
        print(f"{Path(files[0]).name}: every number is as it was")
    return 0


def _print(results: BenchmarkResults, as_json: bool) -> None:
    print(text_of(results) if as_json else "\n".join(_summary(results)))


def _summary(results: BenchmarkResults) -> Iterator[str]:
    """A line for each budget."""
    for budget, (score, low, high, count) in by_budget(results).items():
        within = f"{budget:,} decisions" if budget else "any number of decisions"
        count_of = f"{count} {'runs' if count > 1 else 'run'}"
        yield f"{results.task}, {results.method}, {within}: {score:.1%} (95 %: {low:.1%} to {high:.1%}), {count_of}"


def _note(line: str) -> None:
    print(line, file=sys.stderr, flush=True)
