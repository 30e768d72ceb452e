"""The cost of the second screen: frames of one match with and without it, by turns, in one run.

A frame is events, update, draw, flip, and what the second screen paints in it; only the frame thread counts. The match
belongs to an event of 64, and every block with the second screen begins with another page, so that all of it is
painted.
"""

import json
from dataclasses import replace
from statistics import median, quantiles
from time import thread_time

from pigaming_app.events import event_files
from pigaming_app.events.event import Event
from pigaming_app.events.match_setup import setup_of
from pigaming_app.events.spec import MOST, Entrant, EventSpec, Format
from pigaming_app.scenes.app import App
from pigaming_app.scenes.events.next_page import EventMatch
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.kiosk.scoreboard.pages import Pages
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.start import opened
from pigaming_app.storage.settings import folders

FPS = 60
WARM = 600  # frames before the measurement: prewarming, countdown
BLOCK, BLOCKS = 90, 20  # frames of each, and their number; every second one with the second screen
PAGES = ("event", "scores", "standby")


def event_match(context: Context) -> MatchScene:
    """The first match of an event of AIs, long enough for the measurement."""
    entrants = tuple(Entrant(f"R{number:02}", "level2") for number in range(MOST))
    event = Event(EventSpec("Second screen", Format.SWISS, ("pitanks",), entrants, seats=4))
    folder = folders().data / event_files.FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    running = RunningEvent(folder / "bench.json", event)
    fixture = event.open[0]
    setup = replace(setup_of(event, fixture), minutes=8.0)
    return MatchScene(context, setup, after=EventMatch(running, fixture))


def frame(app: App, shown: bool) -> float:
    """Run one frame; returns its time, ms. `shown`: with the second screen."""
    start = thread_time()
    if app.compose(1 / FPS):
        app.context.canvas.flip()
    if shown:
        for service in app.services:
            service.show(1 / FPS, 1 / FPS - (thread_time() - start), app.stack.scenes)
    return 1000.0 * (thread_time() - start)


def compare() -> dict[str, float]:
    """Frame times with the second screen over those without it: median and 99th percentile; no unit."""
    options = Options(headless=True, without_title=True, scoreboard=1, first_scene=event_match)
    times: dict[bool, list[float]] = {True: [], False: []}
    with opened(options) as app:
        for _ in range(WARM):
            frame(app, True)
        for block in range(BLOCKS):
            shown = block % 2 == 0
            app.context.shared(Pages).chosen = PAGES[block // 2 % len(PAGES)]
            times[shown] += [frame(app, shown) for _ in range(BLOCK)]
    p99 = {shown: quantiles(found, n=100)[-1] for shown, found in times.items()}
    return {"median": median(times[True]) / median(times[False]), "p99": p99[True] / p99[False]}


if __name__ == "__main__":
    print(json.dumps(compare()))
