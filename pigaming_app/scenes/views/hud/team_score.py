"""HUD of a game whose teams matter more than their robots: boxes in the colours of the teams, and large totals."""

import pygame

from pigaming_app.scenes.views.background import Bit
from pigaming_app.scenes.views.hud import parts
from pigaming_app.scenes.views.hud.score import ScoreHud, TeamPanel
from pigaming_app.scenes.views.sprites.teams import TEAMS, emblem
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import number_width
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import numeral

W, TOP, BOTTOM = 228, 20, 128  # px: width, upper and lower edge of a total
DIGITS, LARGER = 132, 146  # px, type sizes: legible from five metres, larger than the clock; of larger texts
NARROW = 104  # px, for three digits
SIGN, SIGN_X = 20, 32  # px: radius of the emblem, and its distance from the outer edge


class TeamHud(ScoreHud):
    """Panels of the seats, and totals next to the clock."""

    sum_w = W
    duels = True

    def color(self, seat: int) -> kit.Color:
        return TEAMS[self.teams[seat] % len(TEAMS)]

    def sum_bits(self, panel: TeamPanel, points: int, leads: bool) -> list[Bit]:
        text, second = numeral(points), panel.x > 960
        room = W - SIGN_X - SIGN
        size = parts.number_size(text, room - 8, LARGER if kit.reads_large() else DIGITS, NARROW)
        x = panel.x + (room - number_width(text, size)) / 2 + (0 if second else W - room)
        at = panel.x - parts.EDGE, TOP - parts.EDGE
        bits: list[Bit] = [(total_frame(panel.team % len(TEAMS), leads, second), at, None)]
        color = kit.mix(self.color(panel.mates[0].seat), kit.WHITE, 0.7)
        return bits + parts.number_bits(text, size, x, (TOP + BOTTOM) / 2, color)


@cached
def total_frame(team: int, leads: bool, second: bool) -> pygame.Surface:
    """Box of a team's total, bold if it leads; its emblem at the outer edge, on the right if `second`."""
    high, color = BOTTOM - TOP, TEAMS[team]
    ink, outline = parts.plate(W, high), kit.cut_box(0, 0, W, high)
    if leads:
        ink.fill(outline, kit.dim(color, 0.16))
    ink.line(outline, color, kit.BOLD if leads else kit.THIN, True)
    emblem(ink, team, W - SIGN_X if second else SIGN_X, high / 2, SIGN)
    return ink.lit(0.7)
