"""The match scene: countdown, driving, time up, results.

Devices are assigned to seats here only. A seat whose device is unplugged asks for a new one; without an answer an AI
drives until somebody presses FIRE. The same happens at idle seats (see `idle_seats`). Any free device takes the seat
of an AI by holding FIRE (see `access`).
"""

import math
import secrets
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

import pygame

from pigaming_app.ai.game_ai import CHAUFFEUR, ONE_BUTTON
from pigaming_app.ai.registry import make_brain, make_person, new_match
from pigaming_app.games.game import Setup
from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.features.replays import replay_of
from pigaming_app.scenes.flow.access import TAKE_SECONDS, Access
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.match_words import tagline
from pigaming_app.scenes.flow.stack import Push, Scene, StackOperation, Swap
from pigaming_app.scenes.play.countdown import CENTRE, Countdown, clear_of, signs
from pigaming_app.scenes.play.ending import PREWARM_MS, Ending
from pigaming_app.scenes.play.idle_seats import IdleSeats
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.reconnect import Reconnect, StillThere
from pigaming_app.scenes.play.round_break import draw_margin
from pigaming_app.scenes.play.rule_card import rule_card
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.results.headline import EndedMatch
from pigaming_app.scenes.results.scene import Results, SceneFactory
from pigaming_app.scenes.results.winner import AfterMatch
from pigaming_app.scenes.views.rumble import Rumble
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.plant import Plant, SimPlant
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.storage.day_log import PlayedMatch, now
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import FOCUS, LABEL, PLAYERS
from pigaming_app.ui.draw.frame_budget import PrewarmQueue
from pigaming_app.ui.draw.text import text, wrap
from pigaming_app.ui.input.events import Button, Device, InputEvent, StickState
from pigaming_app.ui.input.hold import HoldTimers
from pigaming_app.ui.widgets.caption import RING_STEPS, Caption, caption, hold_ring

LEAD_SECONDS = 0.8  # seconds before the countdown, to look round
RESUME_STEP = 0.5  # seconds per number after an interruption
HALT_AFTER = 60.0  # seconds without any input until the match is halted
NOTICE_SECONDS = 3.0  # seconds for which a notice is shown
NOTICE_AT = (960, 206)  # its centre on the canvas


class MatchScene:
    """One match, from its countdown to its results. `devices`: the device of each seat; None: an AI, or nobody yet.

    `humans`: seats of people, present or away; `ai_assisted`: those for whom an AI has driven, for a
    while or with one button; `join_allowed`: true if a free device may take the seat of an AI. `game_choice`: see
    `Results`. `rounds`: the rounds before this one, in a match of several; None: it is the only one. `arena`: that of
    the setup with things on it; its results are no records. `after`: makes the scene that follows in place of the
    results; nobody then joins the match or restarts it. It may have `names`, those of the entrants on the first seats.
    """

    def __init__(
        self,
        context: Context,
        setup: Setup,
        devices: Sequence[Device | None] = (),
        speed: float = 1.0,
        plant: Callable[[Any], Plant] = SimPlant,
        game_choice: SceneFactory | None = None,
        rounds: Rounds | None = None,
        after: "Callable[[MatchScene], AfterMatch] | None" = None,
        arena: Arena | None = None,
    ) -> None:
        self.context, self.setup, self.speed, self.game_choice = context, setup, speed, game_choice
        self.rounds, self.plant_factory, self.after, self.arena = rounds, plant, after, arena
        self.humans = [i for i, seat in enumerate(setup.seats) if seat.brain == "human"]
        self.devices: list[Device | None] = [*devices, None, None, None, None][: len(setup.seats)]
        self.match = new_match(setup, plant, arena)
        self.names: Sequence[str] = getattr(after, "names", ())
        self.runner = MatchRunner(context, self.match, rumble=self._rumble, names=self.names)
        self.countdown = Countdown(lead=LEAD_SECONDS)
        self.countdown_at = CENTRE
        self.rule_card: tuple[Caption, tuple[int, int]] | None = None
        self.signs = PrewarmQueue(signs(*(context.words(f"match.{name}") for name in ("go", "time", "finish"))))
        self.begun = self.prewarmed = self.stop_requested = self.restart_requested = False
        self.idle = self.notice_left = 0.0
        self.notice: Caption | None = None
        self.notice_at = NOTICE_AT
        self.ending = Ending(context, self.runner, rounds, self._next)
        self.access = Access(context, lambda: self.devices)
        self.joining = HoldTimers(context.controls, TAKE_SECONDS)
        self.idle_seats = IdleSeats()
        self.began, self.noted = now(), False  # for the day log
        self.ai_assisted: set[int] = set()
        self.join_allowed = self.restart_allowed = after is None
        self.stood_in: Sequence[int] = ()  # seats of people of an event for whom an AI drives: set by `after`
        for seat in self.humans:
            self._sit(seat, self.devices[seat])
        if self.humans and arena is None:
            self.runner.view.enable_persistence(folders().data)

    # ---- lifecycle

    def on_enter(self) -> None:
        """Start, or resume after an interruption."""
        self.context.sounds.music(True)
        self.context.controls.forget_taps()
        self.joining.clear()
        if self.begun and not self.match.over:
            self.countdown = Countdown(RESUME_STEP) if not self.countdown.locked else Countdown()
        self.begun = True
        self.idle = 0.0

    def on_leave(self) -> None:
        self.context.controls.stop_rumble()
        self._note()

    def handle(self, event: InputEvent) -> StackOperation:
        """START or Escape of a seated device pauses; a free one takes a seat driven by an AI."""
        if self.match.over:
            self.ending.handle(event)
            if self.ending.round_break is None:
                return None
        if event.button is Button.LOST:
            self.idle_seats.forget(event.device)
        if self.return_seat(event):
            return None
        admitted = self.access.admit(event)
        if event.button is Button.FIRE and self.is_free(event.device):
            self._request_seat(event)
        if admitted is None:
            return None
        self.idle = 0.0
        if admitted.device in self.devices:
            self.idle_seats.touch(self.devices.index(admitted.device))
        if event.button is Button.BRAIN:
            self.next_brain()
        if event.button is Button.START or (event.button is Button.BACK and self._escapes(admitted.device)):
            return Push(Pause(self, admitted.device))
        return None

    def update(self, seconds: float) -> StackOperation:
        self.notice_left -= seconds
        if self.restart_requested:
            return Swap(self.rematch(self.context, self.setup, self.devices))
        if self.match.over and not self.ending.begun:
            self.ending.begin(self._without_records)
            self._note()
        if self.stop_requested:
            return self.ending.stop(seconds)
        if self.match.over and self.ending.round_break is None:
            return self.ending.update(seconds)
        if held := self.access.update(seconds):
            return Push(Pause(self, held.device))
        if lost := self.unplugged_seats:
            return Push(Reconnect(self, lost[0]))
        for event in self.joining.update(seconds):
            self._join(event.device)
        if pause := self.ending.round_break:
            return self._begin_round() if self.ending.wait_for_round(pause, seconds) else None
        self.signs.work(0.0)
        self.prewarmed = self.prewarmed or self.runner.prewarm(PREWARM_MS if self.countdown.locked else 2.0)
        if self.countdown.shown and (sound := self.countdown.update(seconds)):
            self.context.sounds.play(sound)
        if self.countdown.locked:
            self.context.controls.forget_taps()
            self.runner.wait(seconds)
            return None
        self.idle += seconds
        self._replace_idle(seconds)
        if self.match.state.tick == 0:
            self.began = now()
        self.runner.advance(seconds, self.speed)
        if self.humans and self.idle > HALT_AFTER:
            return Push(StillThere(self))
        return None

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the arena, and the countdown, captions and notices over it; after the end the last hit again."""
        words = self.context.words
        if self.ending.draw(screen, self.picture):
            if self.ending.round_break:
                self._draw_notice(screen)
            return
        self.runner.draw(screen)
        if self.rounds:
            draw_margin(screen, words, self.rounds, self.runner.view.seats)
        if self.match.over and not self.stop_requested:
            self.ending.draw_sign(screen)
        elif self.countdown.shown:
            if self.match.game.timed and self.match.seconds < 1.0:
                self._draw_goal(screen)
            if self.countdown.locked:
                self.runner.draw_captions(screen, self.devices)
                self.countdown_at = clear_of(self.runner.robots())
                if self.match.state.tick == 0:
                    self._draw_rules(screen)
            self.countdown.draw(screen, words("match.go"), self.countdown_at)
        if not self.countdown.locked and not self.match.over:
            self.runner.draw_hints(screen, self.devices)
        for seat, left in self.idle_seats.prompted().items():
            sentence = words("match.still", seconds=max(1, math.ceil(left)))
            self.runner.draw_beside(screen, seat, caption(sentence, PLAYERS[seat], player=seat))
        self._draw_joining(screen)
        self._draw_notice(screen)

    def _draw_notice(self, screen: pygame.Surface) -> None:
        if self.notice and self.notice_left > 0.0:
            self.notice.draw(screen, *self.notice_at)

    def _draw_rules(self, screen: pygame.Surface) -> None:
        """Show the rule card where it hides no robot."""
        if self.rule_card is None:
            occupied = self.runner.occupied(self.devices)
            if self.notice and self.notice_left > 0.0:
                occupied.append(self.notice.box(self.notice_at))
            self.rule_card = rule_card(self.context.words, self.setup, occupied, self.countdown_at)
        card, centre = self.rule_card
        card.draw(screen, *centre)

    def _draw_goal(self, screen: pygame.Surface) -> None:
        """Show the number of laps in place of the stopped clock."""
        box = self.runner.view.clock
        screen.fill("black", box)
        lines = wrap(tagline(self.context.words, self.match.setup.game, self.match.setup.goal), LABEL, box.w, "head")
        for i, line in enumerate(lines):
            text(line, LABEL, FOCUS, "head", room=box.w).draw(screen, box.centerx, 80 + 58 * i - 29 * (len(lines) - 1))

    # ---- interface for the pages above

    @property
    def things(self) -> tuple[ThingSpec, ...]:
        """The things on the mat that are in play."""
        return self.arena.things if self.arena else ()

    @property
    def unplugged_seats(self) -> list[int]:
        """Seats whose device is unplugged and that have no driver."""
        gone = [(i, device) for i, device in enumerate(self.devices) if device]
        return [i for i, device in gone if not self.context.controls.connected(device)]

    @property
    def ai_replaced(self) -> list[int]:
        """Seats of people for whom an AI drives."""
        return [i for i in self.humans if self.devices[i] is None]

    def is_free(self, device: Device) -> bool:
        """True if this device drives no seat."""
        return device.kind != "mouse" and device not in self.devices

    def assign_seat(self, seat: int, device: Device | None) -> None:
        """Assign a seat to a device, or to an AI until somebody takes it. A replugged pad drives as before."""
        before = self.devices[seat]
        if device and before:
            self.context.driving.inherit(device, before)
        self._sit(seat, device)
        self.idle_seats.reassign(seat, device)
        name, sign = self.runner.driver(seat, device)
        name = name if device else self.context.words("match.back_in")
        self.notice, self.notice_left = caption(name, PLAYERS[seat], player=seat, sign=sign), NOTICE_SECONDS
        self.context.sounds.play("join", seat)

    def return_seat(self, event: InputEvent) -> bool:
        """Return its seat to an idle device on any press; true if done."""
        if event.device not in self.idle_seats.claims or event.button in (Button.STOP, Button.BRAIN):
            return False
        self.idle = 0.0
        self.assign_seat(self.idle_seats.claims[event.device], event.device)
        return True

    def style_of(self, device: Device) -> str:
        """The driving style of a device in this match."""
        return self.context.driving.of(device, self.setup.game, self.setup.variant)

    def next_brain(self) -> None:
        """Show the thoughts of the next AI, after the last none; show a notice if there is no AI."""
        if self.runner.brain and not self.runner.brain.seats:
            self.notice, self.notice_left = caption(self.context.words("brain.nobody"), sign="ai"), NOTICE_SECONDS
        elif self.runner.brain:
            self.runner.brain.next()

    def picture(self) -> pygame.Surface:
        """The match as drawn behind a page."""
        return self.runner.picture()

    def stop(self) -> None:
        """End the match now, with the current score."""
        self.stop_requested = True

    def restart(self) -> None:
        """Restart with another seed."""
        self.restart_requested = True

    def rematch(self, context: Context, setup: Setup, devices: Sequence[Device | None]) -> Scene:
        """The same match with another seed, from the first round."""
        again = fresh_rounds(self.rounds)
        return MatchScene(context, rematch_setup(setup, devices), devices, game_choice=self.game_choice, rounds=again)

    def next_round(self) -> Scene:
        """The next round, with the same seats."""
        setup = rematch_setup(self.setup, self.devices)
        return MatchScene(
            self.context, setup, self.devices, self.speed, self.plant_factory, self.game_choice, self.rounds
        )

    @property
    def extra_items(self) -> Mapping[str, Callable[[Access], Scene]]:
        """Additional pause items: page factories by name, given the access of the pause."""
        return {}

    @property
    def blocked(self) -> bool:
        """True if the match waits for an event that may never come."""
        return False

    @property
    def preparing(self) -> bool:
        """True while the countdown runs."""
        return self.countdown.locked

    @property
    def robots_kind(self) -> str:
        """What drives: simulated, emulated or real robots."""
        return "simulated"

    def advance_paused(self, seconds: float) -> None:
        """Advance by `seconds` while a page is open."""

    def draw_overlay(self, screen: pygame.Surface) -> None:
        """Draw overlays that must not be hidden by a page."""

    # ---- internals

    @property
    def takeable_seats(self) -> list[int]:
        """Seats driven by AIs, in the order of assignment to free devices: those of absent people first."""
        if not self.join_allowed:
            return self.ai_replaced
        robots = self.match.state.robots
        ais = [i for i, robot in enumerate(robots) if robot.present and i not in self.humans]
        return [*self.ai_replaced, *reversed(ais)]

    def _escapes(self, device: Device) -> bool:
        """True if BACK means Escape: on a pad or phone it is the turbo, unless nobody is seated."""
        return not device.has_stick or not self.access.seated

    def _request_seat(self, event: InputEvent) -> None:
        """FIRE on a free device: take an unclaimed seat at once, any other after holding."""
        claimed = self.idle_seats.claims.values()
        if vacant := [seat for seat in self.ai_replaced if seat not in claimed]:
            self.assign_seat(vacant[0], event.device)
        elif self.takeable_seats:
            self.joining.begin(event)
            self.notice, self.notice_left = caption(self.context.words("match.hold"), sign="ai"), NOTICE_SECONDS

    def _join(self, device: Device) -> None:
        """Give a device the seat of an AI."""
        if self.takeable_seats and self.is_free(device):
            seat = self.takeable_seats[0]
            if seat not in self.humans:
                self.humans.append(seat)
                self.ai_assisted.add(seat)
            self.idle = 0.0
            self.assign_seat(seat, device)

    def _draw_joining(self, screen: pygame.Surface) -> None:
        """A filling ring beside each robot that is about to be taken."""
        for (device, share), seat in zip(self.joining.shares.items(), self.takeable_seats, strict=False):
            if self.is_free(device):
                self.runner.draw_beside(screen, seat, hold_ring(seat, math.ceil(share * RING_STEPS)))

    def _replace_idle(self, seconds: float) -> None:
        """Replace people at idle seats by AIs."""
        controls = self.context.controls
        driven = {seat: device for seat in self.humans if (device := self.devices[seat])}
        for seat, device in driven.items():
            if controls.touched(device):
                self.idle_seats.touch(seat)
        for seat in self.idle_seats.update(seconds, driven):
            self.assign_seat(seat, None)
            self.idle_seats.leave(driven[seat], seat)

    def _sit(self, seat: int, device: Device | None) -> None:
        self.devices[seat] = device
        if device is None or self.style_of(device) == ONE_BUTTON:
            self.ai_assisted.add(seat)
        game = self.setup.game
        brain = (
            make_person(game, self.style_of(device), lambda: self._read(seat, device), new_seed())
            if device
            else make_brain(game, CHAUFFEUR, new_seed())
        )
        self.match.sit(seat, brain)
        self.runner.players[seat] = "human" if device else CHAUFFEUR

    def _read(self, seat: int, device: Device) -> StickState:
        """The state of a device for this tick."""
        mat = self.context.mat
        drive = (mat and mat.stick(seat, seat == self.humans[0])) or self.context.controls.drive(device)
        if drive.fire or drive.turbo or drive.linear or drive.angular:
            self.idle = 0.0
            self.idle_seats.touch(seat)
        return drive

    def _rumble(self, seat: int, rumble: Rumble) -> None:
        device = self.devices[seat]
        if device and self.context.settings.rumble:
            self.context.controls.rumble(device, *rumble)

    @property
    def _without_records(self) -> Collection[int]:
        """Seats whose results are no records: an AI has helped, the match was not played in real time, or things stood
        in the arena.
        """
        plain = self.speed == 1.0 and self.arena is None and not self.match.state.shifts
        return self.ai_assisted if plain else range(len(self.devices))

    def _note(self) -> None:
        """Note the match in the day log, once: when it is over or left. Of several rounds, the last one is noted."""
        match, rounds = self.match, self.rounds
        if self.noted or match.state.tick == 0 or (match.over and rounds and not rounds.done):
            return
        self.noted = True
        seconds = sum(outcome.seconds for outcome in rounds.outcomes) if rounds else 0.0
        if not (rounds and match.over):
            seconds += match.seconds
        seats = sum(robot.present for robot in match.state.robots)
        people = len(self.humans)
        self.context.day_log.add(
            PlayedMatch(
                self.began, self.setup.game, round(seconds, 2), people, seats - people, self.robots_kind, match.over
            )
        )

    def _begin_round(self) -> StackOperation:
        scene = self.next_round()
        if isinstance(scene, MatchScene):
            scene.idle_seats.claims |= self.idle_seats.claims
        return Swap(scene)

    def _next(self) -> tuple[EndedMatch, AfterMatch]:
        """The match, or the rounds played, and the scene that follows."""
        if self.after is None:
            results = self._results()
            return results.ended, results
        following = self.after(self)
        ended = EndedMatch(self.setup, self.match.outcome(), tuple(self.devices), self.names, self.stood_in)
        return ended, following

    def _results(self) -> Results:
        rounds = self.rounds if self.rounds and self.rounds.outcomes else None
        return Results(
            self.context,
            rounds.outcome() if rounds else self.match.outcome(),
            self.setup,
            self.devices,
            self.rematch,
            rounds.done if rounds else not self.stop_requested,
            () if rounds else self._without_records,
            self.game_choice,
            replay_of(self.match),
            rounds,
        )


def fresh_rounds(rounds: Rounds | None) -> Rounds | None:
    """As many rounds, none of them played."""
    return Rounds(rounds.best_of) if rounds else None


def rematch_setup(setup: Setup, devices: Sequence[Device | None]) -> Setup:
    """The same match with another seed; seats with a device become human."""
    drivers = [*devices, None, None, None, None]
    one, two, three, four = (replace(seat, brain="human") if drivers[i] else seat for i, seat in enumerate(setup.seats))
    return replace(setup, seats=(one, two, three, four), seed=new_seed())


def new_seed() -> int:
    """An unpredictable seed."""
    return secrets.randbelow(2**31 - 1) + 1
