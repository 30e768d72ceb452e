"""Who drives each seat of a match: devices are assigned here only.

A seat whose device is unplugged asks for a new one; without an answer an AI drives until somebody presses FIRE. The
same happens at idle seats: one without input for a while is asked, then an AI takes over. Only running match time
counts, and the device keeps its claim: any button takes the seat back at once. Any free device takes the seat of an AI
by holding FIRE (see `access`). A phone that is locked keeps its claim, too, and no other phone takes its seat; it halts
the match once only.
"""

import math
import secrets
from collections.abc import Collection, Sequence

import pygame

from pigaming_app.ai.game_ai import ONE_BUTTON, STAND_IN
from pigaming_app.ai.registry import make_brain, make_person
from pigaming_app.scenes.flow.access import TAKE_SECONDS, Access
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.flow.used_keys import UsedKeys
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.views.rumble import Rumble
from pigaming_app.ui.draw import PLAYERS
from pigaming_app.ui.input.events import Button, Device, InputEvent, StickState
from pigaming_app.ui.input.hold import HoldTimers
from pigaming_app.ui.widgets.caption import RING_STEPS, caption, hold_ring

IDLE_LIMIT = 15.0  # seconds without any input until the seat is asked
ANSWER_LIMIT = 5.0  # seconds to answer


class IdleSeats:
    """Idle time of each seat, and the claims of devices that went idle."""

    def __init__(self) -> None:
        self.idle_for: dict[int, float] = {}
        self.claims: dict[Device, int] = {}  # seat by idle device

    def touch(self, seat: int) -> None:
        """Input at a seat."""
        self.idle_for[seat] = 0.0

    def prompted(self) -> dict[int, float]:
        """Remaining seconds of the seats being asked."""
        return {seat: IDLE_LIMIT + ANSWER_LIMIT - idle for seat, idle in self.idle_for.items() if idle >= IDLE_LIMIT}

    def update(self, seconds: float, driven: Collection[int]) -> list[int]:
        """Advance the seats in `driven`; returns those that did not answer."""
        self.idle_for = {seat: self.idle_for.get(seat, 0.0) + seconds for seat in driven}
        return [seat for seat, idle in self.idle_for.items() if idle >= IDLE_LIMIT + ANSWER_LIMIT]

    def leave(self, device: Device, seat: int) -> None:
        """An AI takes over for a device."""
        self.claims[device] = seat

    def reassign(self, seat: int, device: Device | None) -> None:
        """A seat has a new driver: drops all claims to it and the driver's claims to other seats."""
        self.touch(seat)
        self.claims = {claimant: left for claimant, left in self.claims.items() if left != seat and claimant != device}

    def forget(self, device: Device) -> None:
        """Drop the claim of an unplugged device; a phone that is locked comes back as the same device."""
        if device.kind != "phone":
            self.claims.pop(device, None)


class Drivers:
    """The drivers of a match. `devices`: of each seat; None: an AI, or nobody yet.

    `people`: seats of people, present or away; `assisted`: those for whom an AI has driven, for a while or with one
    button; `quiet`: seconds of the match without any input; `may_join`: a free device may take the seat of an AI.
    """

    def __init__(self, context: Context, runner: MatchRunner, devices: Sequence[Device | None], may_join: bool) -> None:
        self.context, self.runner, self.may_join = context, runner, may_join
        self.match, self.setup = runner.match, runner.match.setup
        self.people = [i for i, seat in enumerate(self.setup.seats) if seat.brain == "human"]
        self.devices: list[Device | None] = [*devices, None, None, None, None][: len(self.setup.seats)]
        self.assisted: set[int] = set()
        self.access = Access(context, lambda: self.devices)
        self.idle, self.quiet = IdleSeats(), 0.0
        self.locked: set[Device] = set()  # phones that have halted the match
        self.used = context.shared(UsedKeys)
        self._joining = HoldTimers(context.controls, TAKE_SECONDS)
        for seat in self.people:
            self._sit(seat, self.devices[seat])

    @property
    def unplugged(self) -> list[int]:
        """Seats whose device is unplugged and that have no driver."""
        gone = [(i, device) for i, device in enumerate(self.devices) if device]
        return [i for i, device in gone if not self.context.controls.connected(device)]

    @property
    def replaced(self) -> list[int]:
        """Seats of people for whom an AI drives."""
        return [i for i in self.people if self.devices[i] is None]

    @property
    def takeable(self) -> list[int]:
        """Seats driven by AIs, in the order of assignment to free devices: those of absent people first."""
        if not self.may_join:
            return self.replaced
        robots = self.match.state.robots
        ais = [i for i, robot in enumerate(robots) if robot.present and i not in self.people]
        return [*self.replaced, *reversed(ais)]

    def takeable_by(self, device: Device) -> list[int]:
        """Those that a device may take: no phone gets the seat of another one."""
        others = {seat for owner, seat in self.idle.claims.items() if owner.kind == "phone" and owner != device}
        return [seat for seat in self.takeable if device.kind != "phone" or seat not in others]

    def is_free(self, device: Device) -> bool:
        """True if this device drives no seat."""
        return device.kind != "mouse" and device not in self.devices

    def escapes(self, device: Device) -> bool:
        """True if BACK means Escape: on a pad or phone it is the turbo, unless nobody is seated."""
        return not device.has_stick or not self.access.seated

    def style_of(self, device: Device) -> str:
        """The driving style of a device in this match."""
        return self.context.driving.of(device, self.setup.game)

    def resume(self) -> None:
        """The match goes on after an interruption: what is held does not count."""
        self.context.controls.forget_taps()
        self._joining.clear()
        self.quiet = 0.0

    def assign(self, seat: int, device: Device | None) -> None:
        """Assign a seat to a device, or to an AI until somebody takes it. A replugged pad drives as before."""
        before = self.devices[seat]
        if device and before:
            self.context.driving.inherit(device, before)
        self._sit(seat, device)
        self.idle.reassign(seat, device)
        name, sign = self.runner.driver(seat, device)
        name = name if device else self.context.words("match.back_in")
        self.runner.notice.show(caption(name, PLAYERS[seat], player=seat, sign=sign))
        self.context.sounds.play("join", seat)

    def stand_in(self, seat: int) -> None:
        """An AI drives for a device that is away, until it comes back; other than a phone, it comes as another one."""
        device = self.devices[seat]
        self.assign(seat, None)
        if device and (device.kind == "phone" or self.context.controls.connected(device)):
            self.idle.leave(device, seat)

    def replace_locked(self) -> None:
        """Replace phones that are locked by AIs if they have halted the match before."""
        for seat in self.unplugged:
            if self.devices[seat] in self.locked:
                self.stand_in(seat)

    def give_back(self, event: InputEvent) -> bool:
        """Give its seat back to an idle device on any press; true if done."""
        if event.device not in self.idle.claims or event.button in (Button.STOP, Button.BRAIN):
            return False
        self.quiet = 0.0
        self.assign(self.idle.claims[event.device], event.device)
        return True

    def admit(self, event: InputEvent) -> InputEvent | None:
        """The event if it counts; FIRE on a free device asks for a seat."""
        admitted = self.access.admit(event)
        if event.button is Button.FIRE and self.is_free(event.device):
            self._request(event)
        if admitted:
            self.quiet = 0.0
            if admitted.device in self.devices:
                self.idle.touch(self.devices.index(admitted.device))
        return admitted

    def join(self, seconds: float) -> None:
        """Give seats of AIs to devices that have held FIRE long enough."""
        for event in self._joining.update(seconds):
            if (takeable := self.takeable_by(event.device)) and self.is_free(event.device):
                seat = takeable[0]
                if seat not in self.people:
                    self.people.append(seat)
                    self.assisted.add(seat)
                self.quiet = 0.0
                self.used.forget(event.device)
                self.assign(seat, event.device)

    def replace_idle(self, seconds: float) -> None:
        """Replace people at idle seats by AIs."""
        self.quiet += seconds
        driven = {seat: device for seat in self.people if (device := self.devices[seat])}
        for seat, device in driven.items():
            if self.context.controls.touched(device):
                self.idle.touch(seat)
        for seat in self.idle.update(seconds, driven):
            self.stand_in(seat)

    def rumble(self, seat: int, rumble: Rumble) -> None:
        """Let the device of a seat rumble."""
        device = self.devices[seat]
        if device and self.context.settings.rumble:
            self.context.controls.rumble(device, *rumble)

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the question beside idle robots, and a filling ring beside each that is about to be taken."""
        for seat, left in self.idle.prompted().items():
            sentence = self.context.words("match.still", seconds=max(1, math.ceil(left)))
            self.runner.draw_beside(screen, seat, caption(sentence, PLAYERS[seat], player=seat))
        for (device, share), seat in zip(self._joining.shares.items(), self.takeable, strict=False):
            if self.is_free(device):
                self.runner.draw_beside(screen, seat, hold_ring(seat, math.ceil(share * RING_STEPS)))

    def _request(self, event: InputEvent) -> None:
        """FIRE on a free device: take an unclaimed seat at once, any other after holding."""
        claimed = self.idle.claims.values()
        if vacant := [seat for seat in self.replaced if seat not in claimed]:
            self.used.forget(event.device)
            self.assign(vacant[0], event.device)
        elif self.takeable_by(event.device):
            self._joining.begin(event)
            self.runner.notice.show(caption(self.context.words("match.hold"), sign="ai"))

    def _sit(self, seat: int, device: Device | None) -> None:
        self.devices[seat] = device
        if device is None or self.style_of(device) == ONE_BUTTON:
            self.assisted.add(seat)
        game = self.setup.game
        brain = (
            make_person(game, self.style_of(device), lambda: self._read(seat, device), new_seed())
            if device
            else make_brain(game, STAND_IN, new_seed())
        )
        self.match.sit(seat, brain)
        self.runner.players[seat] = "human" if device else STAND_IN
        self.runner.sit(seat, device)

    def _read(self, seat: int, device: Device) -> StickState:
        """The state of a device for this tick."""
        mat = self.context.mat
        drive = (mat and mat.stick(seat, seat == self.people[0])) or self.context.controls.drive(device)
        self.used.note(device, drive)
        if drive.fire or drive.turbo or drive.linear or drive.angular:
            self.quiet = 0.0
            self.idle.touch(seat)
        return drive


def new_seed() -> int:
    """An unpredictable seed."""
    return secrets.randbelow(2**31 - 1) + 1
