"""An arcade without screens, in a process of its own: it claims matches and draws their results by lot.

python -m tests.jobs.events.arcade_alone PLACE NAME LOG: the file of the event, or the address of a desk whose PIN is on
standard input. Each result is in the log before it is in the event, and again after that.
"""

import json
import os
import sys
import time
from contextlib import suppress
from pathlib import Path
from random import Random

from pigaming_app.events import event_files
from pigaming_app.events.network.link import link_of
from pigaming_app.events.network.mirror import host_at
from pigaming_app.events.spec import Fixture, Result
from pigaming_app.jobs.events.joining import joined
from pigaming_app.scenes.events.running import RunningEvent

PAUSE = 0.05  # s


def main(place: str, name: str, log: Path) -> None:
    path = joined(host_at(place, 0), name) if place.startswith("http") else Path(place)
    running, random = RunningEvent(path, event_files.latest(path), arcade=name), Random(os.getpid())
    link = link_of(path, name)
    print("ready", flush=True)
    while link is None or link.path == path:
        running.refresh()
        running.claim()
        fixture = running.event.next_at(name)
        time.sleep(random.uniform(PAUSE, 4 * PAUSE))
        if fixture is None or running.event.pause is not None:
            continue
        if running.event.calls.get(fixture.number) == name:
            play(running, fixture, random, log)


def play(running: RunningEvent, fixture: Fixture, random: Random, log: Path) -> None:
    scores = {one: float(random.randrange(10)) for one in fixture.entrants}
    order = sorted(scores, key=lambda one: -scores[one])
    level = len({*scores.values()}) == 1
    places = (tuple(sorted(order)),) if level else tuple((one,) for one in order)
    outcome = Result(fixture.number, places, scores, note=f"{running.arcade} {random.random()}")
    note(log, "played", outcome)
    with suppress(ValueError):  # others were faster
        if running.change(lambda event: event.record(outcome)):
            note(log, "saved", outcome)


def note(log: Path, word: str, outcome: Result) -> None:
    with log.open("a") as file:
        print(json.dumps([word, outcome.fixture, outcome.note, dict(outcome.scores)]), file=file)
        file.flush()
        os.fsync(file.fileno())


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], Path(sys.argv[3]))
