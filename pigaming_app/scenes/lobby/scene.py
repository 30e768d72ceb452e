"""The lobby: FIRE joins, FIRE again means ready. AIs fill empty seats on request; teams are one press away.

When all people are ready and at least two robots take part, the match begins after a short countdown, during which
others can still join. START opens match setup instead. A seated device controls its own seat, a free one can only join
(see `access`); the mouse acts on the element under the pointer.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import partial

import pygame

from pigaming_app.ai.auto import NAME as AUTO
from pigaming_app.ai.game_ai import LEVELS, STAND_IN
from pigaming_app.ai.registry import AIS
from pigaming_app.games.game import FREE, Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.auto import AutoStrengths
from pigaming_app.scenes.flow.driving import PICTURES
from pigaming_app.scenes.flow.match_choice import choice_summary, last_choice
from pigaming_app.scenes.flow.match_words import rivals
from pigaming_app.scenes.flow.scene import Context, Home, Pop, Push, StackOperation
from pigaming_app.scenes.flow.used_keys import UsedKeys
from pigaming_app.scenes.lobby import seat_card as card
from pigaming_app.scenes.lobby.begin import begin, chosen_setup
from pigaming_app.scenes.lobby.game_choice import GameChoice
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.lobby.seats import AI, DRIVE, EMPTY, HUMAN, PLACES, REAL, RIVALS, TEAM, LobbySeats
from pigaming_app.scenes.lobby.view import CODE, LobbyPage, LobbyState, level_words, problem, spots
from pigaming_app.scenes.play.drivers import new_seed
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.ui.draw import PLAYERS
from pigaming_app.ui.draw.frame_budget import PrewarmQueue
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.focus import Focus

IDLE = 60.0  # s without input before the return to the title
COUNTDOWN, COUNTDOWN_ALONE = 1.2, 2.4  # s, countdown once all are ready; longer for one person with an AI
MESSAGE_SECONDS = 4.0  # s, display time of a message
PREWARM_MS = 3.0  # ms per frame for prewarming
CODE_SECONDS = 12.0  # s without input until the large QR code is shown
POINTER_SECONDS = 4.0  # s for which the mouse focus stays visible after a movement


def empty_seats(context: Context, game: str, mat: bool = False) -> LobbySeats:
    """The seats of a match by the rules chosen last, with the AIs chosen last where the game offers them."""
    team_mode = games()[game].variants[last_choice(context, game).variant].team_mode
    offered, last = rivals(game), context.settings.strength
    return LobbySeats(last if last in offered else STAND_IN, team_mode=team_mode, rivals=offered, mat=mat)


class Lobby:
    """The lobby of a game. `drivers`: initial driver of each seat, a device, an AI strength or None."""

    def __init__(self, context: Context, game: str, drivers: Sequence[Device | str | None] = ()) -> None:
        self.context, self.game = context, game
        self.seats = empty_seats(context, game, context.robots)
        for seat, place in enumerate(self.seats.places):
            place.real = seat + 1 in context.settings.real and not context.robots_problem
        for seat, driver in enumerate(drivers):
            if driver is not None:
                self.seats.seat(seat, driver)
        self.now = LobbyState()
        self.access = Access(context, self.seats.devices)
        self.page = LobbyPage(
            context, self.seats, self.now, lambda: choice_summary(context, game), self.access, self._driving
        )
        self.focus = Focus(spots(self.seats))
        self.prewarm_queue = PrewarmQueue(card.prewarm_jobs())
        self.prewarm_queue.append(self._row_jobs())
        self.warmup: MatchRunner | None = None
        self.code_due, self.code_open = not any(drivers), False  # the large QR code: opens an empty lobby

    @property
    def variant(self) -> str:
        """The rule set chosen last."""
        return last_choice(self.context, self.game).variant

    def _driving(self, device: Device) -> str:
        return self.context.driving.of(device, self.game)

    def on_enter(self) -> None:
        """Reset on first display and on return from match setup: everyone has to confirm again."""
        if self.code_open:
            self.code_open = False
            return
        self.context.sounds.music("title")
        self.now.starting = None
        self.seats.reset_ready()
        for seat in self.seats.of_kind(HUMAN):
            device = self.seats.places[seat].device
            if device and not self.context.controls.connected(device):
                self._unplugged(device)

    def handle(self, event: InputEvent) -> StackOperation:
        """Handle joining, readiness, leaving, AIs, teams and start."""
        mapped = self.page.prompts.as_button(event)
        admitted = self.access.admit(mapped)
        if admitted is None:
            self._try_join(mapped)
            self._update_countdown()
            return None
        event, device = admitted, admitted.device
        match event.button:
            case Button.FIRE:
                self._fire(device)
            case Button.START:
                return self._begin(device)
            case Button.BACK:
                return self._back(device)
            case Button.LEAVE_SEAT:
                self._leave(device)
            case Button.Y:
                self._add_ai()
            case Button.X if self.seats.team_mode == FREE:
                self.seats.teams = not self.seats.teams
                self.context.sounds.play("move")
            case Button.LEFT | Button.RIGHT | Button.UP | Button.DOWN:
                self._direct(device, event.button)
            case Button.LOST:
                self._unplugged(device)
            case Button.POINT | Button.CLICK:
                if self._mouse(event):
                    return self._open_code()
        self._update_countdown()
        return None

    def update(self, seconds: float) -> StackOperation:
        """Animate; go on when everyone is ready, leave when abandoned."""
        self.now.advance(seconds)
        self.focus.update(seconds)
        self.seats.offer(rivals(self.game))
        if self.access.update(seconds):
            self.context.sounds.play("back")
            return Pop()
        if self.now.starting is not None:
            self.now.starting -= seconds
            if self.now.starting <= 0.0:
                return self._play()
        if self._code_is_due():
            return self._open_code()
        self._prewarm()
        return Home() if self.context.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        self.page.draw(screen)
        if self.now.pointer_left > 0.0:
            self.focus.draw(screen)

    def _code_is_due(self) -> bool:
        """True if the large QR code should be shown: at first, and while nobody acts, as long as a seat is free."""
        if not self.page.open_to_phones or self.now.starting is not None:
            return False
        idle = self.context.idle > CODE_SECONDS
        due, self.code_due = (self.code_due or idle) and not self.seats.full, False
        return due

    def _open_code(self) -> StackOperation:
        self.code_open = True
        assert self.page.offer is not None
        return Push(self.page.offer.page(self.seats.devices, self.handle, lambda: self.now.starting is not None))

    def _prewarm(self) -> None:
        """Prewarm while people choose: first this page, then the sprites of the match."""
        if not self.prewarm_queue.work(PREWARM_MS):
            return
        now = last_choice(self.context, self.game)
        if self.warmup is None and self.context.preloader.ready(self.game, now.arena):
            one, two, three, four = (Seat("idle", team) for team in games()[self.game].variants[now.variant].teams)
            setup = Setup(self.game, now.arena, (one, two, three, four), now.minutes, 1, now.variant, now.goal)
            self.warmup = MatchRunner(self.context, Match(setup), loud=False)
        elif self.warmup:
            self.warmup.prewarm(PREWARM_MS)

    def _row_jobs(self) -> Iterator[Callable[[], object]]:
        """Prewarm jobs for the rows that appear when somebody joins and AIs fill the seats."""
        words = self.context.words
        for style in AIS[self.game].driving:
            for color in (*PLAYERS, None):
                yield partial(card.driving, words(f"lobby.drive_{style}"), PICTURES[style], color)
        for strength in (AUTO, *LEVELS):
            yield partial(card.strength, *level_words(words, strength), None)

    # ---- input

    def _try_join(self, event: InputEvent) -> None:
        """Handle a free device while others are seated: join, or show which of its buttons joins."""
        if event.button in (Button.FIRE, Button.START):
            self._fire(event.device)
        elif event.button in (Button.BACK, Button.X, Button.Y):
            words = self.context.words
            full = len(self.seats.of_kind(HUMAN)) == PLACES
            self.now.message = words("lobby.full") if full else words("lobby.join_first", button="{button}")
            self.now.label = words.key_name(self.context.controls.label(event.device, Button.FIRE))
            self.now.message_left = MESSAGE_SECONDS

    def _fire(self, device: Device) -> None:
        if device.kind == "mouse":  # click on the hint
            for waiting in self.seats.waiting:
                self.seats.places[waiting].ready = True
            return
        seat = self.seats.seat_of(device)
        if seat is not None:
            self.seats.places[seat].ready = True
            self.context.sounds.play("ready", seat)
            return
        seat = self.seats.join(device)
        if seat is None:
            self._say(self.context.words("lobby.full"), "error")
        else:
            self.context.shared(UsedKeys).forget(device)
            self.now.seated[seat] = 0.0
            self.context.sounds.play("join", seat)

    def _begin(self, device: Device) -> StackOperation:
        """START: match setup; everyone counts as ready. In an empty lobby the device joins instead."""
        if not self.seats.robots and device.kind != "mouse":
            self._fire(device)
            return None
        self._add_opponents()
        if message := problem(self.seats, self.context.words):
            self._say(message, "error")
            return None
        self.now.starting = None
        self.context.sounds.play("accept")
        return Push(MatchSetupPage(self.context, self.game, self.seats, game_choice))

    def _play(self) -> StackOperation:
        """Begin the match with the last choice of arena and rules, as soon as it is loaded."""
        chosen = last_choice(self.context, self.game)
        setup = chosen_setup(self.context, games()[self.game], chosen, self.seats, new_seed())
        match = begin(self.context, setup, chosen.rounds, self.seats, game_choice)
        if match:
            self.now.starting = None
            self.context.sounds.play("accept")
        return match

    def _back(self, device: Device) -> StackOperation:
        """BACK: revoke readiness, then leave the seat, then return to the title."""
        self.context.sounds.play("back")
        seat = self.seats.seat_of(device)
        if seat is None:
            return Pop()
        if self.seats.places[seat].ready:
            self.seats.places[seat].ready = False
        else:
            self._empty(seat)
        self._update_countdown()
        return None

    def _leave(self, device: Device) -> None:
        seat = self.seats.seat_of(device)
        if seat is not None:
            self._empty(seat)
            self.context.sounds.play("back")

    def _empty(self, seat: int) -> None:
        """A person leaves: the next one at the device may be another."""
        if device := self.seats.places[seat].device:
            self.context.shared(AutoStrengths).forget(device)
        self.seats.leave(seat)

    def _add_ai(self) -> None:
        """Add one AI; if every seat is taken, remove as many as possible. The countdown begins again."""
        self.now.starting = None
        seat = self.seats.add_ai()
        if seat is None:
            self.seats.remove_ais()
            self.context.sounds.play("back")
        else:
            self.now.seated[seat] = 0.0
            self.context.sounds.play("join", seat)

    def _direct(self, device: Device, button: Button) -> None:
        """Up and down select a row of the device's own card, left and right change it. Without a seat, all directions
        change the strength of the AIs.
        """
        seat = self.seats.seat_of(device)
        delta = 1 if button in (Button.RIGHT, Button.UP) else -1
        if seat is None:
            self._change_strength(delta)
        elif button in (Button.LEFT, Button.RIGHT):
            self._change_row(seat, self.seats.row(seat), delta)
        elif self.seats.step_row(seat, -delta):
            self.context.sounds.play("move")

    def _change_row(self, seat: int, row: str, delta: int) -> None:
        """Change a row of a person's card."""
        if row == REAL:
            self._swap(seat)
        elif row == TEAM:
            self._change_team(seat)
        elif row == RIVALS:
            self._change_strength(delta)
        elif device := self.seats.places[seat].device:
            self.context.driving.change(device, self.game, delta)
            self.context.sounds.play("move")

    def _change_strength(self, delta: int, seat: int | None = None) -> None:
        if self.seats.change_strength(delta, seat):
            self._save_strength()
            self.context.sounds.play("move")

    def _save_strength(self) -> None:
        """Save the AI strength as the default of the next lobby, unless only this game offers it."""
        if self.seats.strength in (AUTO, *LEVELS):
            self.context.settings.strength = self.seats.strength

    def _swap(self, seat: int) -> None:
        """Toggle between the real and the simulated robot of a seat, and save it as the default."""
        if reason := self.context.robots_problem:
            self._say(self.context.words.sentence(reason), "error")
            return
        self.seats.swap(seat)
        self.context.settings.real = [i + 1 for i, place in enumerate(self.seats.places) if place.real]
        self.context.sounds.play("move")

    def _change_team(self, seat: int) -> None:
        self.seats.change_team(seat)
        self.context.sounds.play("move")

    def _unplugged(self, device: Device) -> None:
        seat = self.seats.seat_of(device)
        if seat is not None:
            self._empty(seat)
            key = "lobby.phone_gone" if device.kind == "phone" else "lobby.unplugged"
            self._say(self.context.words(key, player=seat + 1), "back")

    def _mouse(self, event: InputEvent) -> bool:
        """Act on the element under the pointer; true if that is the QR code."""
        self.now.pointer_left = POINTER_SECONDS
        self.focus.handle(event)
        name = self.focus.activated(event)
        if name is None:
            return False
        what, seat = name.split()[0], int(name.split()[1])
        kind = self.seats.places[seat].kind
        if what == CODE:
            return True
        if what in (REAL, TEAM, DRIVE):
            self._change_row(seat, what, 1)
        elif what in ("weaker", "stronger"):
            self._change_strength(1 if what == "stronger" else -1, seat)
        elif kind == AI:
            self.seats.leave(seat)
            self.context.sounds.play("back")
        elif kind == EMPTY:
            self.seats.add_ai(seat)
            self.now.seated[seat] = 0.0
            self.context.sounds.play("join", seat)
        else:
            self.seats.places[seat].ready = not self.seats.places[seat].ready
            self.context.sounds.play("ready", seat)
        return False

    def _update_countdown(self) -> None:
        """Start the countdown when all are ready, cancel it otherwise."""
        self.focus.set_spots(spots(self.seats, self.page.code_seat))
        alone = len(self.seats.of_kind(HUMAN)) == 1
        if not self.seats.of_kind(HUMAN) or self.seats.waiting:
            self.now.starting = None
        elif self.now.starting is None:
            self._add_opponents()
            if not problem(self.seats, self.context.words):
                self.now.starting = self.now.countdown = COUNTDOWN_ALONE if alone else COUNTDOWN

    def _add_opponents(self) -> None:
        for seat in self.seats.add_opponents():
            self.now.seated[seat] = 0.0

    def _say(self, message: str, sound: str) -> None:
        self.now.message, self.now.label, self.now.message_left = message, "", MESSAGE_SECONDS
        self.context.sounds.play(sound)


def game_choice(context: Context, setup: Setup, devices: Sequence[Device | None]) -> GameChoice:
    """The game selection after a match, with a lobby factory."""
    return GameChoice(context, setup, devices, Lobby)
