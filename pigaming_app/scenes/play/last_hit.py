"""The last hit of a match by the party rules, once more in slow motion before the results.

The states around the last hit are kept as bytes, so that real and simulated robots move again exactly as they did.
"""

from collections import deque
from functools import partial

import pygame

from pigaming_app.games.match import Match
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.flow.timestep import FixedTimestep
from pigaming_app.scenes.views.film import to_bytes
from pigaming_app.scenes.views.hud.parts import CLOCK
from pigaming_app.scenes.views.pitanks.view import PiTanksView
from pigaming_app.scenes.views.view import MatchView
from pigaming_app.sim.record import from_bytes
from pigaming_app.sim.world import DT, WIDTH
from pigaming_app.ui.draw import FOCUS, ICE, LABEL, LINE, GlowCanvas, badge
from pigaming_app.ui.draw.frame_budget import PrewarmQueue
from pigaming_app.ui.draw.layers import LitImage, text
from pigaming_app.ui.draw.surface_cache import cached, surfaces
from pigaming_app.ui.input.events import Button, InputEvent

BEFORE, AFTER = 28, 12  # ticks shown before and after the hit
SPEED = 0.25
SECONDS = (BEFORE + AFTER) * DT / SPEED
SKIP_AFTER = 0.5  # seconds from which a press ends it
NO_PRESS = (Button.POINT, Button.FOUND, Button.LOST)


def repeats_last_hit(match: Match) -> bool:
    """True by rules whose last hit is shown again."""
    return isinstance(match.state, PiTanks) and match.state.rules.knockout > 0


def slow_motion(context: Context, match: Match, view: MatchView, hit: "LastHit | None") -> "SlowMotion | None":
    """The slow motion of a recorded hit; None without one."""
    return SlowMotion(context, match, view, hit) if hit and hit.snapshots else None


class LastHit:
    """Snapshots of a match around its last hit so far."""

    def __init__(self) -> None:
        self.before: deque[bytes] = deque(maxlen=BEFORE)
        self.snapshots: list[bytes] = []
        self.tick = 0  # of the hit; 0: none

    def record(self, state: PiTanks) -> None:
        """Keep the state after a tick."""
        now = to_bytes(state)
        if state.last_hit > self.tick:
            self.tick, self.snapshots = state.last_hit, [*self.before]
        if self.tick and state.tick < self.tick + AFTER:
            self.snapshots.append(now)
        self.before.append(now)


class SlowMotion:
    """Plays the recorded hit in its own view, after that of the match."""

    def __init__(self, context: Context, match: Match, view: MatchView, hit: LastHit) -> None:
        self.context, self.snapshots = context, iter(hit.snapshots)
        self.state = from_bytes(PiTanks, next(self.snapshots))
        with surfaces.made_for(match.setup.game):
            self.view = PiTanksView(match.arena, self.state, view.players, context.settings, context.words)
        self.view.real = view.real
        seats = match.state.last_shooter, match.state.last_victim
        self.title = partial(title, context.words("pitanks.again"), *seats)
        self.jobs = PrewarmQueue([self._bake_background, self._bake_walls, self._bake_panels, self.title])
        self.timestep = FixedTimestep()
        self.seconds = self.undrawn = 0.0
        self.skipped = False

    @property
    def over(self) -> bool:
        """True when it has been shown or skipped."""
        return self.skipped or self.seconds >= SECONDS

    def prewarm(self, milliseconds: float) -> bool:
        """Prepare the first picture for up to `milliseconds`; true when done. The sprites are those of the match."""
        with surfaces.made_for("pitanks"):
            return self.jobs.work(milliseconds)

    def handle(self, event: InputEvent) -> None:
        """End it on any press, unless it has only just begun."""
        self.skipped |= event.button not in NO_PRESS and self.seconds >= SKIP_AFTER

    def update(self, seconds: float) -> None:
        """Advance by `seconds` of real time."""
        self.seconds += seconds
        self.undrawn += SPEED * seconds
        for _ in range(self.timestep.due(seconds, SPEED)):
            if snapshot := next(self.snapshots, None):
                self.state = from_bytes(PiTanks, snapshot)
                with surfaces.made_for("pitanks"):
                    sounds = self.view.watch(self.state)
                for name, player, x in sounds:
                    self.context.sounds.play(name, player, 2.0 * x / WIDTH - 1.0)

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the match as it was, and shooter and victim in place of the clock."""
        undrawn, self.undrawn = self.undrawn, 0.0
        with surfaces.made_for("pitanks"):
            self.view.draw(screen, self.state, self.timestep.blend, undrawn)
            screen.blit(self.view.background.bare, CLOCK, CLOCK)
            self.title().draw(screen, CLOCK.centerx, 0)

    def _bake_background(self) -> None:
        _ = self.view.background.surface

    def _bake_walls(self) -> None:
        self.view.walls.show_walls(self.state)

    def _bake_panels(self) -> None:
        self.view.hud.show(self.state)


@cached
def title(line: str, shooter: int, victim: int) -> LitImage:
    """The name of the scene, and below it the badges of shooter and victim."""
    ink = GlowCanvas(CLOCK.w, CLOCK.h).set_transform(CLOCK.w / 2, 0)
    badge(ink, shooter, -72, 98, 24)
    ink.line([(-28, 98), (24, 98)], ICE, LINE).line([(10, 84), (26, 98), (10, 112)], ICE, LINE)
    badge(ink, victim, 72, 98, 24)
    out = ink.lit(0.7)
    words = text(line, LABEL, FOCUS, "head", room=CLOCK.w - 24)
    out.blit(words.image, (CLOCK.w // 2 + words.at[0], 40 + words.at[1]), special_flags=pygame.BLEND_RGB_ADD)
    return LitImage(out, (-CLOCK.w // 2, 0))
