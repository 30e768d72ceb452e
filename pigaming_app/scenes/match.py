"""A match: three, two, one, go; people and AIs drive; time is up; the results.

Only here devices meet seats. A seat whose device is gone asks for it, and when nobody comes an AI drives on until
somebody presses FIRE for it.
"""

import secrets
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any
from weakref import proxy

import pygame

from pigaming_app.ai import make, seated
from pigaming_app.ai.brain import Hands
from pigaming_app.games.game import Setup
from pigaming_app.scenes.countdown import CENTRE, Countdown, clear_of, popped, show, signs
from pigaming_app.scenes.frame_budget import Ahead
from pigaming_app.scenes.house import House
from pigaming_app.scenes.ink import ALARM, FOCUS, LABEL, PLAYERS
from pigaming_app.scenes.limits import tagline
from pigaming_app.scenes.page import text
from pigaming_app.scenes.pane import lines_of
from pigaming_app.scenes.pause import Pause
from pigaming_app.scenes.plate import Plate, plate
from pigaming_app.scenes.press import Act, Device, Drive, Press
from pigaming_app.scenes.reconnect import Reconnect, StillThere
from pigaming_app.scenes.results import Results
from pigaming_app.scenes.stack import Push, Scene, Swap, Turn
from pigaming_app.scenes.stage import Stage
from pigaming_app.settings import folders
from pigaming_app.sim.plant import Plant, SimPlant

LEAD = 0.8  # seconds in which one looks round before the countdown
RESUME = 0.5  # seconds for each number after an interruption
FREEZE = 1.5  # seconds between the last tick and the results
STILL = 60.0  # seconds without a hand on anything
NOTICE = 3.0  # seconds for which a line over the match stays
WARM = 7.0  # ms of a frame for sprites while nobody moves
STAND_IN = "normal"  # the brain that drives on for somebody


class MatchScene:
    """One match, from its countdown to its results. `devices`: who drives each seat; None: an AI, or nobody yet."""

    def __init__(
        self,
        house: House,
        setup: Setup,
        devices: Sequence[Device | None] = (),
        speed: float = 1.0,
        plant: Callable[[Any], Plant] = SimPlant,
    ) -> None:
        self.house, self.setup, self.speed = house, setup, speed
        self.humans = [i for i, seat in enumerate(setup.seats) if seat.brain == "human"]
        self.devices: list[Device | None] = [*devices, None, None, None, None][: len(setup.seats)]
        self.match = seated(setup, plant)
        self.stage = Stage(house, self.match)
        self.count = Countdown(lead=LEAD)
        self.spot = CENTRE
        self.signs = Ahead(signs(*(house.words(f"match.{name}") for name in ("go", "time", "finish"))))
        self.begun = self.warm = self.stopped = self.repeated = False
        self.idle = self.frozen = self.noticed = 0.0
        self.notice: Plate | None = None
        self.results: Results | None = None
        for seat in self.humans:
            self._sit(seat, self.devices[seat])
        if self.humans:
            self.stage.view.for_real(folders().data)

    # ---- what happens to it

    def entered(self) -> None:
        """Begin, or go on after an interruption."""
        self.house.sounds.music(True)
        if self.begun and not self.match.over:
            self.count = Countdown(RESUME) if not self.count.locked else Countdown()
        self.begun = True
        self.idle = 0.0

    def on(self, press: Press) -> Turn:
        """START or Escape pauses; FIRE on a free device takes back a seat that an AI holds for somebody."""
        self.idle = 0.0
        if self.match.over:
            return None
        if press.act is Act.BRAIN:
            self.think_aloud()
        if press.act is Act.START or (press.act is Act.BACK and press.device.kind == "keys"):
            return Push(Pause(self, press.device))
        if press.act is Act.FIRE and self.stood_in and self.free(press.device):
            self.hand(self.stood_in[0], press.device)
        return None

    def update(self, seconds: float) -> Turn:
        """Let the match run on."""
        self.noticed -= seconds
        if self.repeated:
            return Swap(self.again(self.house, self.setup, self.devices))
        if self.match.over or self.stopped:
            return self._end(seconds)
        if lost := self.lost:
            return Push(Reconnect(self, lost[0]))
        self.signs.work(0.0)
        self.warm = self.warm or self.stage.warm(WARM if self.count.locked else 2.0)
        if self.count.shown and (sound := self.count.update(seconds)):
            self.house.sounds.play(sound)
        if self.count.locked:
            self.stage.wait(seconds)
            return None
        self.idle += seconds
        self.stage.advance(seconds, self.speed)
        if self.humans and self.idle > STILL:
            return Push(StillThere(self))
        return None

    def draw(self, screen: pygame.Surface) -> None:
        """The arena, and over it what has to be said."""
        self.stage.draw(screen)
        words = self.house.words
        if self.match.over and not self.stopped:
            pop = min(4, int(self.frozen / 0.04))
            ending = "time" if self.match.seconds_left <= 0.0 else "finish"
            show(screen, popped(words(f"match.{ending}"), ALARM, pop))
        elif self.count.shown:
            if self.match.setup.game == "race" and self.match.seconds < 1.0:
                self._draw_laps(screen)
            if self.count.locked:
                self.stage.captions(screen, self.devices)
                self.spot = clear_of(self.stage.robots())
            self.count.draw(screen, words("match.go"), self.spot)
        if self.notice and self.noticed > 0.0:
            self.notice.draw(screen, 960, 206)

    def _draw_laps(self, screen: pygame.Surface) -> None:
        """How many laps the race has, in the place of its clock, which stands still."""
        box = self.stage.view.clock
        screen.fill("black", box)
        lines = lines_of(tagline(self.house.words, "race", self.match.setup.goal), LABEL, box.w, "head")
        for i, line in enumerate(lines):
            text(line, LABEL, FOCUS, "head", room=box.w).draw(screen, box.centerx, 80 + 58 * i - 29 * (len(lines) - 1))

    # ---- what the pages above it may do

    @property
    def lost(self) -> list[int]:
        """Seats whose device is gone and for whom nobody drives."""
        gone = [(i, device) for i, device in enumerate(self.devices) if device]
        return [i for i, device in gone if not self.house.controls.connected(device)]

    @property
    def stood_in(self) -> list[int]:
        """Seats of people for whom an AI drives."""
        return [i for i in self.humans if self.devices[i] is None]

    def free(self, device: Device) -> bool:
        """Nobody drives with this device."""
        return device.kind != "mouse" and device not in self.devices

    def hand(self, seat: int, device: Device | None) -> None:
        """Give a seat to a device, or to an AI that drives until somebody comes."""
        self._sit(seat, device)
        name, sign = self.stage.driver(seat, device)
        name = name if device else self.house.words("match.back_in")
        self.notice, self.noticed = plate(name, PLAYERS[seat], player=seat, sign=sign), NOTICE
        self.house.sounds.play("join", seat)

    def think_aloud(self) -> None:
        """Show what the next AI thinks, after the last one none; if there is no AI, say so."""
        if not self.stage.brain.seats:
            self.notice, self.noticed = plate(self.house.words("brain.nobody"), sign="ai"), NOTICE
        self.stage.brain.next()

    def picture(self) -> pygame.Surface:
        """The match as it lies behind a page."""
        return self.stage.picture()

    def stop(self) -> None:
        """End the match now; the results are what they are."""
        self.stopped = True

    def restart(self) -> None:
        """Begin anew, with another seed."""
        self.repeated = True

    def again(self, house: House, setup: Setup, devices: Sequence[Device | None]) -> Scene:
        """The same match with other luck."""
        return MatchScene(house, replace(setup, seed=new_seed()), devices)

    @property
    def extras(self) -> Mapping[str, Callable[[], Scene]]:
        """What else the pause offers: by its name, a page."""
        return {}

    @property
    def stuck(self) -> bool:
        """Whether it waits for something that may never come."""
        return False

    def hold(self, seconds: float) -> None:
        """Let time pass under a page."""

    def shine(self, screen: pygame.Surface) -> None:
        """Paint what no page may hide."""

    # ---- inside

    def _sit(self, seat: int, device: Device | None) -> None:
        self.devices[seat] = device
        scene = proxy(self)  # a cycle would keep the surfaces of a match that is over
        brain = Hands(lambda: scene._held(device)) if device else make(self.setup.game, STAND_IN, new_seed())
        self.match.sit(seat, brain)
        self.stage.players[seat] = "human" if device else STAND_IN

    def _held(self, device: Device) -> Drive:
        """How a device is held on the tick that acts on it."""
        drive = self.house.controls.drive(device)
        if drive.fire or drive.turbo or drive.linear or drive.angular:
            self.idle = 0.0
        return drive

    def _end(self, seconds: float) -> Turn:
        """The last picture stands while the results are made."""
        if self.results is None:
            finished = self.match.over and not self.stopped
            self.results = Results(self.house, self.match.outcome(), self.setup, self.devices, self.again, finished)
            if finished:
                self.house.sounds.play("go")
        ready = self.results.warm(WARM)
        self.frozen += seconds
        self.stage.wait(seconds)
        if ready and (self.stopped or self.frozen >= FREEZE):
            results, self.results = self.results, None  # which hold this scene, for a rematch
            return Swap(results)
        return None


def new_seed() -> int:
    """A seed that nobody can foresee."""
    return secrets.randbelow(2**31 - 1) + 1
