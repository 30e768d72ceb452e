"""HUD of PiTanks: active powers in the panels, and a banner in place of the clock."""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

from pigaming_app.games.pitanks.scoring import is_overtime
from pigaming_app.games.pitanks.state import POWERS
from pigaming_app.scenes.views.background import Background, Bit
from pigaming_app.scenes.views.hud.parts import CLOCK
from pigaming_app.scenes.views.hud.score import ScoreHud
from pigaming_app.scenes.views.pitanks.banner import Banner
from pigaming_app.scenes.views.sprites.effects import timer_ring
from pigaming_app.scenes.views.sprites.pickups import small_icon
from pigaming_app.ui.draw import FOCUS, THIN
from pigaming_app.ui.i18n import Words

PITCH = 58  # px between powers


class PiTanksHud(ScoreHud):
    """Keeps the HUD up to date."""

    def __init__(self, background: Background, state: Any, players: list[str], words: Words | None) -> None:
        super().__init__(background, state, players, bool(state.rules.turbo))
        self.state, self.banner = state, Banner(words)

    def jobs(self) -> Iterator[Callable[[], object]]:
        yield from self.banner.jobs(self.state)
        yield from super().jobs()

    def leads(self, state: Any, seat: int, alone: bool) -> bool:
        """True for the sole leader; in overtime for all who are level at the top."""
        return not state.tanks[seat].barred if is_overtime(state) else alone

    def extras(self, state: Any, seat: int) -> tuple[tuple[int, int], ...]:
        """(remaining 0..48, power) of every active power, soonest to end first."""
        life = max(1, state.rules.power_life)
        held = [(min(48, -(-48 * left // life)), i) for i, left in enumerate(state.tanks[seat].powers) if left]
        return tuple(sorted(held))

    def extra_bits(self, extras: Any, right: int, middle: int, room: int) -> list[Bit]:
        """Powers with their timers."""
        bits: list[Bit] = []
        for i, (left, power) in enumerate(extras[: max(0, room // PITCH)]):
            cx = right - 42 - PITCH * i
            for image, dx, dy in (small_icon(POWERS[power], FOCUS, 15), timer_ring(FOCUS, left, 26, THIN)):
                bits.append((image, (cx + dx, middle - 1 + dy), None))
        return bits

    def show_clock(self, state: Any) -> None:
        if phase := self.banner.content(state):
            self.parts.show("clock", phase, CLOCK.x, CLOCK.w, partial(self.banner.bits, *phase))
        else:
            super().show_clock(state)
