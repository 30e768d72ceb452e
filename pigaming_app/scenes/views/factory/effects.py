"""Particles and sounds for the events of Robot Factory."""

from collections.abc import Iterable

from pigaming_app.games.factory.state import FIRE, ICE, Factory
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.factory.announcements import FactoryAnnouncements
from pigaming_app.scenes.views.factory.events import (
    DELIVERY,
    DONE,
    LIFTED,
    RENEWED,
    SET_DOWN,
    SPOILED,
    STARTED,
    THAWED,
    FactoryEvent,
)
from pigaming_app.scenes.views.particles import Particles
from pigaming_app.scenes.views.sprites.factory import STATES
from pigaming_app.scenes.views.sprites.teams import TEAMS
from pigaming_app.scenes.views.view import SoundCue, ViewOptions
from pigaming_app.ui.draw import ALARM, FOCUS
from pigaming_app.ui.i18n import signed

POP = 0.12  # s, pop animation of a moved crate
JINGLES = {ICE: "delivered_ice", FIRE: "delivered_fire"}
WORD_UP, WORD_DOWN = 118.0, 110.0  # px from a pallet to a word over it, or below it near the upper edge
UPPER_EDGE = 230.0  # px


class CratePops:
    """Pop animation: a crate is slightly enlarged after being lifted or set down."""

    def __init__(self) -> None:
        self.since: dict[int, float] = {}

    def begin(self, pallet: int, now: float) -> None:
        """Start the animation of a pallet."""
        self.since[pallet] = now

    def tenths(self, pallet: int, now: float) -> int:
        """Current size in tenths."""
        share = (now - self.since.get(pallet, -9.0)) / POP
        return 10 if share >= 1.0 else 13 - round(3 * share)


def react(
    events: Iterable[FactoryEvent],
    state: Factory,
    particles: Particles,
    pops: CratePops,
    notes: FactoryAnnouncements,
    options: ViewOptions,
) -> list[SoundCue]:
    """Add particles and words for the events; returns their sounds."""
    cues: list[SoundCue] = []
    for event in events:
        x, y, sound = LEFT + event.x, TOP + event.y, event.kind
        word_y = y - WORD_UP if event.y > UPPER_EDGE else y + WORD_DOWN
        if event.kind in (LIFTED, SET_DOWN, DELIVERY, SPOILED, DONE, RENEWED, STARTED):
            pops.begin(event.what, particles.clock)
        match event.kind:
            case "delivered":
                team = state.pallets[event.what].team
                color, sound = TEAMS[team], JINGLES[team]
                particles.burst(x, y, color, 30, 30, 120)
                if options.flashes != "off":
                    particles.shock(x, y, color)
                if options.flashes == "full":
                    particles.glow(x, y, color)
                notes.add(particles.clock, x, word_y, "delivered", color)
                if event.player is not None:
                    particles.score(x, y - 20, signed(event.worth), event.player)
            case "stolen":
                particles.burst(x, y, TEAMS[1 - event.worth], 24, 30, 110)
                if options.flashes != "off":
                    particles.shock(x, y, TEAMS[event.worth])
            case "rush":
                particles.burst(x, y, FOCUS, 20, 34, 90)
                notes.add(particles.clock, x, word_y, "rush", FOCUS)
            case "expired":
                particles.burst(x, y, ALARM, 14, 34, 60)
            case "fast":
                particles.burst(x, y, FOCUS, 24, 80, 70)
            case "spoiled":
                particles.burst(x, y, ALARM, 24, 26, 100)
                if options.flashes == "full" and options.shake:
                    particles.shake()
            case "machine_done":
                particles.burst(x, y, STATES[state.pallets[event.what].state], 10, 26, 50)
            case "freeze":
                particles.burst(x, y, ALARM, 16, 50, 70)
        if event.kind not in (THAWED, STARTED):
            cues.append((sound, event.player, event.x))
    return cues
