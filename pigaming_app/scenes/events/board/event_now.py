"""What the second screen shows of an event, as plain values: who plays, who is next and on which pad."""

from collections.abc import Sequence
from dataclasses import dataclass

from pigaming_app.events.spec import Fixture
from pigaming_app.scenes.events.drivers import driver_label, people_of, suggested
from pigaming_app.scenes.events.names import shortened, versus
from pigaming_app.scenes.events.next_page import EventMatch, NextMatch
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.flow.brain_names import brain_name
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Scene
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.ui.draw import ARROWS
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Device


@dataclass(frozen=True)
class Called:
    """An entrant on a seat. `sign` and `driver`: icon and name of who or what drives, on a card; `device`: name of the
    device in a sentence, where arrow keys are a word; `brain`: name of the AI.
    """

    seat: int
    name: str
    sign: str
    driver: str
    device: str
    brain: str


@dataclass(frozen=True)
class EventNow:
    """A running event, the match that is being played and the open ones after it, the next one first."""

    running: RunningEvent
    playing: Fixture | None
    coming: tuple[Fixture, ...]
    called: tuple[Called, ...]  # of the first of `coming`


def event_match(scene: Scene | object) -> EventMatch | None:
    """The match of an event that a scene plays."""
    after = getattr(scene, "after", None)
    return after if isinstance(after, EventMatch) else None


def event_now(context: Context, scenes: Sequence[Scene]) -> EventNow | None:
    """The event on the stack, if any: a page of it, a match of it, or the moment after one."""
    for scene in reversed(scenes):
        page = scene.then if isinstance(scene, WinnersMoment) else scene
        match = event_match(page)
        running = match.running if match else getattr(page, "running", None)
        if isinstance(running, RunningEvent):
            fixture = match.fixture if match and match.fixture.number not in running.event.outcomes else None
            coming = tuple(one for one in running.event.open if one != fixture)
            claims = page.seats.claims if isinstance(page, NextMatch) else {}
            seats = called(context, running, coming[0], claims) if coming else ()
            return EventNow(running, fixture, coming, seats)
    return None


def called(context: Context, running: RunningEvent, fixture: Fixture, claims: dict[int, Device]) -> tuple[Called, ...]:
    """Who plays a match, and on which device; `claims`: the seats that are taken."""
    words, people = context.words, people_of(running, fixture)
    found = []
    for seat, name in enumerate(fixture.entrants):
        brain = running.brain(name)
        device = None if brain else claims.get(seat) or suggested(context.controls, people, seat)
        sign, driver = driver_label(words, context.controls, device, brain)
        device_name = words("match.arrows") if driver and driver[0] in ARROWS else driver
        robot = brain_name(words, fixture.game, brain) if brain else ""
        found.append(Called(seat, name, sign, driver, device_name, robot))
    return tuple(found)


def next_line(words: Words, now: EventNow) -> str:
    """The next match in one line: names with their devices; empty if there is none."""
    names = [f"{shortened(one.name)} ({one.device})" if one.device else shortened(one.name) for one in now.called]
    return words("scoreboard.next", names="  –  ".join(names)) if names else ""


def now_line(words: Words, now: EventNow) -> str:
    """The match that is being played in one line; empty if there is none."""
    return words("scoreboard.now", names=versus(now.playing.entrants)) if now.playing else ""
