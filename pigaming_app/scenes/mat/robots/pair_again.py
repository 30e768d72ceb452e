"""Pairing during a match: every robot spins in turn, to identify which radio drives which marker.

The result is applied at once. If a robot did not spin as commanded, the page reports it and waits; otherwise it closes
and the match resumes.
"""

import math

import pygame

from pigaming_app.hardware.commissioning.pairing import Pairing, PairingCase
from pigaming_app.scenes.flow.scene import Pop, StackOperation
from pigaming_app.scenes.flow.timestep import FixedTimestep
from pigaming_app.scenes.mat.calibration.corner_markers import draw_corners
from pigaming_app.scenes.mat.robots.fleet_state import worst_finding
from pigaming_app.scenes.mat.robots.flood_light import UNSEEN, FloodLight, looking
from pigaming_app.scenes.mat.things.moved_page import InterruptedMatch
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.sim.world import ROBOTS
from pigaming_app.ui.draw import ALARM, BODY, ICE
from pigaming_app.ui.draw.layers import paragraph, text
from pigaming_app.ui.input.events import Button, InputEvent

LOOKS = 3.0  # s, timeout of the search before the first spin
GOOD = (PairingCase.FITS, PairingCase.SWAPPED, PairingCase.ABSENT)
TITLE_Y, SAID_Y = 42, 480  # px


class PairAgain(Page):
    """Pairing page over a match whose robots stand still."""

    idle = math.inf
    prompts_y, prompts_room, closing = 102, 1560, (Button.START,)

    def __init__(self, match: InterruptedMatch) -> None:
        super().__init__(match.context)
        self.match = match
        self.flood, self.timestep = FloodLight(match.context), FixedTimestep()
        self.pairing: Pairing | None = None
        self.sentence = ""  # fault, once all have spun
        self.clock = 0.0

    @property
    def hints(self) -> Hints:
        if self.sentence:
            return (Button.FIRE, "mat.hint_retry"), (Button.BACK, "mat.hint_done")
        return ((Button.BACK, "mat.hint_stop"),)

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE repeats a finished pairing and aborts a running one; BACK, START and STOP abort at any time."""
        if event.button is Button.FIRE and self.sentence:
            self.pairing, self.sentence, self.clock = None, "", 0.0
            return None
        if event.button is Button.STOP:
            self.match.plant.safety.all_stop()
        return self.leave() if event.button in (Button.FIRE, Button.STOP) else None

    def leave(self) -> StackOperation:
        """Stop the robots."""
        self.match.plant.rig.send([None] * ROBOTS)
        return super().leave()

    def advance(self, seconds: float) -> StackOperation:
        """Search for all robots, then spin one after the other."""
        seconds = self.match.session.advance(seconds)
        self.clock += seconds
        self.flood.update(seconds, bool(self.missing) and not self.sentence)
        for _ in range(self.timestep.due(seconds)):
            if self.pairing is None:
                self.match.plant.watch()
            elif not self.sentence and self.pairing.tick():
                return self._apply(self.pairing)
        if self.pairing is None and (self.clock > LOOKS or not self.missing):
            self.pairing = Pairing(self.match.plant.rig)
        return None

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the discs on a dark page, or the floodlight while a robot is missing."""
        words = self.context.words
        if self.flood.full:
            self.flood.draw(screen, looking(words, self.missing), words("mat.pairing"))
            draw_corners(screen)
            return
        screen.fill((0, 0, 0))
        text(words("mat.pairing"), BODY, ICE, "body", "c", 1728).draw(screen, 960, TITLE_Y)
        self.prompts.draw(screen)
        for i, line in enumerate(paragraph(self.sentence, 1300, 3, ALARM, "c") if self.sentence else ()):
            line.draw(screen, 960, SAID_Y + 60 * i)
        self.flood.draw(screen, "")
        self.match.robots.draw_overlay(screen)

    @property
    def missing(self) -> list[int]:
        """Robots of the match that are not visible."""
        seen = self.match.plant.rig.sense()
        return [robot for robot in sorted(self.match.real) if seen[robot].age > UNSEEN]

    def _apply(self, pairing: Pairing) -> StackOperation:
        """Apply the result; close if there is no fault."""
        turned = [finding.marker for finding in pairing.findings if finding.case in GOOD and finding.marker is not None]
        self.match.robots.apply_pairing(pairing.channels, turned)
        fault = worst_finding([finding for finding in pairing.findings if finding.case not in GOOD])
        if fault is None:
            self.context.sounds.play("accept")
            return Pop()
        marker = 0 if fault.marker is None else fault.marker + 1
        self.sentence = self.context.words(f"fleet.case_{fault.case}", radio=fault.channel + 1, marker=marker)
        self.context.sounds.play("error")
        return None
