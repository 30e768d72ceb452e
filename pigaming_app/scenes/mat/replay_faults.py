"""Faults of real robots in a replay: a mark on the timeline, and a plate with icon and sentence when it happens."""

from collections.abc import Callable, Sequence

import pygame

from pigaming_app.hardware.control.match_recording import RecordedFault
from pigaming_app.scenes.mat.fault_icons import sign
from pigaming_app.sim.world import HZ
from pigaming_app.ui.draw import ALARM, BODY, ICE, MIST, PLAYERS, THIN, GlowCanvas, badge, cut_box, text_width
from pigaming_app.ui.draw.layers import fit_size
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.widgets.caption import MARGIN, Caption

SHOWN = 4 * HZ  # ticks for which a plate stays
MOST, TOP, PITCH = 3, 206, 84  # plates at a time; px of the highest, and between two
ROOM = 1340  # px, widest sentence
MARK, BELOW = 8, 5  # px: half width of a mark, and its distance below the timeline


class ReplayFaults:
    """The faults of a replay."""

    def __init__(self, faults: Sequence[RecordedFault], words: Words) -> None:
        self.faults, self.words = faults, words

    def draw(self, screen: pygame.Surface, tick: int) -> None:
        """Draw the plates of the faults that began within the last seconds before a tick.

        First those of all robots, which explain those of one, then those that stopped the match, then the newest.
        """
        shown = [fault for fault in self.faults if fault.tick <= tick < fault.tick + SHOWN]
        shown.sort(key=lambda fault: (fault.robot is not None, not fault.pauses, -fault.tick))
        for i, fault in enumerate(shown[:MOST]):
            number = 1 if fault.robot is None else fault.robot + 1
            waited = round(fault.seconds) if fault.pauses else 0
            sentence = self.words(f"replay.fault_{fault.name}", robot=number)
            then = self.words("replay.waited", seconds=waited) if waited else ""
            plate(fault.name, fault.robot, sentence, then).draw(screen, 960, TOP + PITCH * i)

    def draw_marks(self, screen: pygame.Surface, place: Callable[[int], float], y: int) -> None:
        """Draw a mark below the timeline at `y` (px) for each fault; `place`: x (px) of a tick."""
        for fault in self.faults:
            x, top = place(fault.tick), y + BELOW
            pygame.draw.polygon(screen, ALARM, [(x, top), (x + MARK, top + 1.5 * MARK), (x - MARK, top + 1.5 * MARK)])


@cached
def plate(name: str, robot: int | None, sentence: str, then: str) -> Caption:
    """Icon of the fault, the robot's badge, the sentence, and how long the match waited."""
    line = f"{sentence} {then}".strip()
    size = fit_size(line, BODY, ROOM, "body")
    lead = 108 + (0 if robot is None else 68)
    wide, high = round(text_width(line, size, "body")) + lead + 32, 72
    color = ALARM if robot is None else PLAYERS[robot]
    ink = GlowCanvas(wide + 2 * MARGIN, high + 2 * MARGIN).set_transform(MARGIN, MARGIN)
    outline = cut_box(0, 0, wide, high, 14)
    ink.solid(outline).line(outline, color, THIN, True)
    sign(ink, name, 56, high / 2, 30, ALARM)
    if robot is not None:
        badge(ink, robot, 132, high / 2, 24)
    ink.text(sentence, size, lead, high / 2, ICE, "body")
    if then:
        ink.text(then, size, lead + text_width(f"{sentence} ", size, "body"), high / 2, MIST, "body")
    return Caption(ink.sprite(0.6), wide, high)
