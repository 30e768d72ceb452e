"""The part of the tour through the events: set-up, matches of AIs, table, corrections, poster, podium."""

from time import sleep

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Result
from pigaming_app.scenes.walk.steps import TourWalker, choose, home
from pigaming_app.sim.world import HZ

AIS = 4  # entrants


def events(walker: TourWalker) -> None:
    """A new Grand Prix of AIs, from the list of events to the podium, and back to the list."""
    walker.set_screen("events")
    choose(walker, "events")
    walker.wait_until(lambda: walker.shows("EventsPage"))
    walker.wait(0.5)
    set_up(walker)
    operate(walker)
    match(walker)
    correct(walker)
    finish(walker)
    home(walker)
    walker.set_screen("events")
    choose(walker, "events")
    walker.wait(0.5)
    walker.press("s", "tab", pause=0.5)
    walker.set_screen("events: managed")
    walker.press("s", "escape", pause=0.5)
    home(walker)


def set_up(walker: TourWalker) -> None:
    """Every format, the order of the games, the arenas; a name by letters, and AIs."""
    walker.set_screen("events: set-up")
    walker.press("space", pause=0.5)
    walker.press("d", "d", "d", "s", "d", "a", "s", pause=0.3)
    walker.set_screen("events: arenas")
    walker.press("space", pause=0.5)
    walker.press("s", "space", "space", "d", "escape", pause=0.3)
    walker.set_screen("events: entrants")
    walker.press("return", pause=0.5)
    walker.set_screen("events: letters")
    walker.press("space", pause=0.5)
    walker.press("w", "escape", pause=0.3)
    walker.set_screen("events: entrants")
    walker.press("d", *["space"] * AIS, "d", "space", pause=0.3)
    walker.press("return", pause=0.5)
    walker.set_screen("events: next match")
    walker.wait_until(lambda: walker.shows("NextMatch"))


def operate(walker: TourWalker) -> None:
    """Table, poster, and the operator's page with its title."""
    walker.wait(1.0)
    walker.set_screen("events: table")
    walker.press("w", pause=1.0)
    walker.press("d", "tab", pause=1.0)
    walker.wait_until(lambda: posted(walker))
    walker.set_screen("events: managed")
    walker.press("s", pause=0.5)
    walker.press("s", "d", "w", pause=0.3)
    walker.set_screen("events: title")
    walker.press("space", pause=0.5)
    walker.press("up", "down", "escape", "escape", "escape", pause=0.3)
    walker.set_screen("events: next match")
    walker.wait_until(lambda: walker.shows("NextMatch"))
    walker.wait(0.5)


def posted(walker: TourWalker) -> bool:
    """True once the poster is on the disk. It is written in real time, which passes more slowly than a walk."""
    sleep(0.02)
    return walker.top.poster is None


def match(walker: TourWalker) -> None:
    """A match of AIs as a show; its end is brought forward."""
    walker.press("space")
    walker.wait_until(lambda: walker.shows("MatchScene"))
    walker.set_screen("events: match")
    walker.wait(5.0)
    state = walker.top.match.state
    state.rules.ticks = min(state.rules.ticks, state.tick + HZ)
    walker.wait_until(lambda: walker.shows("NextMatch"))
    walker.set_screen("events: next match")
    walker.wait(1.0)


def correct(walker: TourWalker) -> None:
    """The results, and the correction of one with a reason in own words."""
    walker.set_screen("events: results")
    walker.press("w", "x", pause=0.5)
    walker.set_screen("events: correction")
    walker.press("space", "d", "s", "d", pause=0.3)
    walker.set_screen("events: reason")
    walker.press("x", "up", "escape", pause=0.5)
    walker.set_screen("events: correction")
    walker.press("escape", "escape", "escape", pause=0.3)
    walker.set_screen("events: next match")
    walker.wait_until(lambda: walker.shows("NextMatch"))


def finish(walker: TourWalker) -> None:
    """The podium, once all other matches have a result."""
    walker.top.running.change(ended)
    walker.set_screen("events: podium")
    walker.wait_until(lambda: walker.shows("EventPodiumPage"))
    walker.wait(6.0)
    walker.set_screen("events: table")
    walker.press("space", pause=1.0)


def ended(event: Event) -> Event:
    """The event with a result of every match, by the order of the seats."""
    while fixtures := event.open:
        event = event.record(Result(fixtures[0].number, tuple((name,) for name in fixtures[0].entrants)))
    return event
