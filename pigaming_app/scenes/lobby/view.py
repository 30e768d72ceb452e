"""Rendering of the lobby: four cards, the current message and the button prompts."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import pygame

from pigaming_app.ai.registry import level_of
from pigaming_app.games.game import ALLIES, FREE, PAIRS
from pigaming_app.scenes.features.registry import join_offer
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.driving import PICTURES
from pigaming_app.scenes.flow.match_words import stars_of, steering
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.lobby import seat_card as card
from pigaming_app.scenes.lobby.seats import AI, DRIVE, EMPTY, HUMAN, PLACES, REAL, RIVALS, TEAM, LobbySeats
from pigaming_app.ui.draw import FOCUS, LABEL, PLAYERS, Color, dim
from pigaming_app.ui.draw.layers import backdrop, span
from pigaming_app.ui.draw.sprites import HEADINGS, step
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.widgets.button_prompts import ButtonPrompts
from pigaming_app.ui.widgets.focus import FocusSpot
from pigaming_app.ui.widgets.labels import black_out, blit_sprite, call_to_action, heading, pulse
from pigaming_app.ui.widgets.player_card import MIDDLE, H, W, ask_bar, ready_bar

TOP, MESSAGE_Y, LINE_Y = 216, 884, 932
CODE, CODE_BOX = "code", pygame.Rect(24, 130, W - 48, W - 48)  # px on a card: the QR code for phones
ROLL_IN = 0.35  # s, a robot's drive onto its turntable


@dataclass
class LobbyState:
    """Animation state of the page, in s."""

    clock: float = 0.0
    seated: list[float] = field(default_factory=lambda: [9.0] * PLACES)  # time since each seat was taken
    starting: float | None = None  # remaining countdown
    countdown: float = 1.0  # full countdown
    message: str = ""  # last event
    label: str = ""  # button in the message
    message_left: float = 0.0  # remaining display time of the message
    pointer_left: float = 0.0  # remaining display time of the mouse focus

    def advance(self, seconds: float) -> None:
        self.clock += seconds
        self.message_left -= seconds
        self.pointer_left -= seconds
        self.seated = [age + seconds for age in self.seated]


class LobbyPage:
    """The lobby page of `seats`. `now`: animation state; `fact`: text beside the title; `driving`: a device's style."""

    def __init__(
        self,
        context: Context,
        seats: LobbySeats,
        now: LobbyState,
        fact: Callable[[], str],
        access: Access,
        driving: Callable[[Device], str],
    ) -> None:
        self.context, self.seats, self.now, self.fact, self.access = context, seats, now, fact, access
        self.driving = driving
        self.offer = join_offer(context)

    def draw(self, screen: pygame.Surface) -> None:
        screen.blit(backdrop(), (0, 0))
        heading(self.context.words("lobby.title"), self.fact()).draw(screen)
        black_out(screen, *map(card_rect, range(PLACES)))
        for seat in range(PLACES):
            self._card(screen, seat)
        self._message(screen)
        self.prompts.draw(screen)

    @property
    def prompts(self) -> ButtonPrompts:
        """Prompts for the device used last, if it may act."""
        seat = self.seats.seat_of(self.access.hint_device)
        full = not self.seats.of_kind(EMPTY)
        hints = [
            (Button.FIRE, "lobby.hint_join" if seat is None else "lobby.hint_ready"),
            (Button.BACK, "lobby.hint_back" if seat is None else "lobby.hint_leave"),
            (Button.Y, "lobby.hint_fewer" if full and self.seats.of_kind(AI) else "lobby.hint_add"),
        ]
        if self.seats.team_mode == FREE:
            hints.append((Button.X, "lobby.hint_alone" if self.seats.teams else "lobby.hint_teams"))
        return self.context.prompts(
            [*hints, (Button.START, "lobby.hint_setup")], device=lambda: self.access.hint_device
        )

    @property
    def open_to_phones(self) -> bool:
        """True if people can join by phone now."""
        return self.offer is not None and self.offer.open

    @property
    def free(self) -> list[Device]:
        """The devices that may still join: pads first, then keyboard clusters."""
        return [device for device in self.context.controls.offered() if self.seats.seat_of(device) is None]

    @property
    def invited(self) -> tuple[str, ...]:
        """Distinct labels of the buttons with which free devices can join."""
        controls, words = self.context.controls, self.context.words
        return tuple(dict.fromkeys(words.key_name(controls.label(device, Button.FIRE)) for device in self.free))

    @property
    def code_seat(self) -> int | None:
        """The empty seat whose card shows the QR code for phones: the last one; None if phones cannot join."""
        empty = self.seats.of_kind(EMPTY)
        return empty[-1] if empty and self.open_to_phones else None

    def _card(self, screen: pygame.Surface, seat: int) -> None:
        words, place, (x, y) = self.context.words, self.seats.places[seat], card_rect(seat).topleft
        title = words("lobby.seat", player=seat + 1)
        if place.kind == EMPTY:
            if self.offer and seat == self.code_seat:
                card.by_phone(seat, title, words("lobby.by_phone"), words("lobby.or_press")).draw(screen, x, y)
                self.offer.draw_code(screen, CODE_BOX.move(x, y))
                return
            if seat in self.seats.of_kind(EMPTY)[len(self.free) :]:
                menus = {"options": words("title.options"), "controls": words("options.controls")}
                phones = words("lobby.by_phone") if self.open_to_phones else words("lobby.phones", **menus)
                card.plug_in(seat, title, words("lobby.plug"), phones if self.offer else "").draw(screen, x, y)
                return
            card.empty(seat, title).draw(screen, x, y)
            level = pulse(self.now.clock) if seat == self.seats.of_kind(EMPTY)[0] else 0
            card.invitation(seat, words("lobby.press_to_join"), self.invited, level).draw(screen, x, y)
            return
        card.frame(seat, title, place.ready or place.kind == AI).draw(screen, x, y)
        self._robot(screen, seat)
        if self.seats.teams:
            color = self._selected(seat, TEAM)
            if self.seats.team_mode == PAIRS:
                card.side(words(f"lobby.side_{place.team + 1}"), place.team, color).draw(screen, x, y)
            else:
                card.team(words("lobby.team", team=place.team + 1), place.team, color).draw(screen, x, y)
        if place.device:
            controls, style = self.context.controls, self.driving(place.device)
            name = steering(words, controls, place.device)
            card.driver(controls.sign(place.device), name).draw(screen, x, y)
            color = self._selected(seat, DRIVE)
            card.driving(words(f"lobby.drive_{style}"), PICTURES[style], color).draw(screen, x, y)
        else:
            card.driver("ai", words("lobby.mate" if self.seats.team_mode == ALLIES else "lobby.ai")).draw(screen, x, y)
        if self.seats.mat:
            key = "lobby.real" if place.real else "lobby.simulated"
            color = self._selected(seat, REAL)
            card.real(words(key), place.real, real_y(self.seats), color).draw(screen, x, y)
        self._bar(screen, seat)

    def _selected(self, seat: int, row: str) -> Color | None:
        """Colour of a row if the person on the seat has selected it."""
        if self.seats.places[seat].kind == AI or self.seats.row(seat) != row:
            return None
        return PLAYERS[seat]

    def _bar(self, screen: pygame.Surface, seat: int) -> None:
        words, place, (x, y) = self.context.words, self.seats.places[seat], card_rect(seat).topleft
        if place.kind == AI:
            chosen = [PLAYERS[i] for i in self.seats.of_kind(HUMAN) if self.seats.row(i) == RIVALS]
            card.strength(*level_words(words, place.strength), chosen[0] if chosen else None).draw(screen, x, y)
        elif place.ready:
            ready_bar(seat, words("lobby.ready")).draw(screen, x, y)
        else:
            label = words.key_name(self.context.controls.label(place.device, Button.FIRE))
            ask_bar(label, words("lobby.if_ready"), pulse(self.now.clock, 5)).draw(screen, x, y)

    def _robot(self, screen: pygame.Surface, seat: int) -> None:
        place, (x, y) = self.seats.places[seat], card_rect(seat).topleft
        middle_y, scale, r = card.ROBOTS[int(self.seats.teams) + int(self.seats.mat)]
        speed = 14 if place.ready else 3
        turn = int(self.now.clock * speed) % card.TURNS
        card.turntable(seat, turn, place.ready, r).draw(screen, round(x + MIDDLE), y + middle_y)
        coming = max(0.0, 1.0 - self.now.seated[seat] / ROLL_IN) ** 2
        hop = 8 * abs(math.sin(self.now.clock * 7 + seat)) if place.ready else 0.0
        look = 0.0 if place.ready else glance(self.now.clock, seat)
        sprite = card.robot(seat, step(card.UP + look, HEADINGS), scale)
        blit_sprite(screen, sprite, x + MIDDLE, y + middle_y + 120 * coming - hop)

    def _message(self, screen: pygame.Surface) -> None:
        words, waiting = self.context.words, self.seats.waiting
        if self.now.starting is not None:
            call_to_action(words("lobby.starting"), "", LABEL).draw(screen, 960, MESSAGE_Y)
            reach = round(864 * (1.0 - max(0.0, self.now.starting) / self.now.countdown))
            screen.fill(dim(FOCUS, 0.25), (960 - reach, LINE_Y - 5, 2 * reach, 10))
            screen.fill(FOCUS, (960 - reach, LINE_Y - 2, 2 * reach, 4))
            return
        if self.now.message_left > 0.0:
            call_to_action(self.now.message, self.now.label, LABEL).draw(screen, 960, MESSAGE_Y)
            return
        if waiting:
            place = self.seats.places[waiting[0]]
            message = words("lobby.wait", player=waiting[0] + 1, button="{button}")
            label = words.key_name(self.context.controls.label(place.device, Button.FIRE))
        else:
            first = words("lobby.first_phone" if self.open_to_phones else "lobby.first")
            message, label = first if not self.seats.robots else problem(self.seats, words), ""
        call_to_action(message, label, LABEL, pulse(self.now.clock, 5)).draw(screen, 960, MESSAGE_Y)


def spots(seats: LobbySeats, code_seat: int | None = None) -> list[FocusSpot]:
    """Mouse targets: arrows and teams on the cards, the QR code, then the cards."""
    targets = []
    if code_seat is not None:
        targets.append(FocusSpot(f"{CODE} {code_seat}", CODE_BOX.move(card_rect(code_seat).topleft)))
    for seat, place in enumerate(seats.places):
        x, y = card_rect(seat).topleft
        if place.kind == AI:
            _, top, _, high = card.STRENGTH
            targets.append(FocusSpot(f"weaker {seat}", pygame.Rect(x + 24, y + top, 100, high)))
            targets.append(FocusSpot(f"stronger {seat}", pygame.Rect(x + W - 124, y + top, 100, high)))
        rows = {TEAM: (seats.teams, card.ROW_Y), DRIVE: (place.device, card.DRIVE_Y), REAL: (seats.mat, real_y(seats))}
        for row, (there, middle) in rows.items():
            if there and place.kind != EMPTY:
                box = pygame.Rect(x + 24, y + middle - card.ROW_H // 2, W - 48, card.ROW_H)
                targets.append(FocusSpot(f"{row} {seat}", box))
    return [*targets, *(FocusSpot(f"seat {seat}", card_rect(seat)) for seat in range(PLACES))]


def level_words(words: Words, brain: str) -> tuple[str, str]:
    """The name of an AI on its card, and the stars above it: none unless it is a level."""
    if level := level_of(brain):
        return words("lobby.level", level=level), stars_of(level)
    return words(f"lobby.{brain}"), ""


def real_y(seats: LobbySeats) -> int:
    """Centre of the row of the real robot, px from the top of a card."""
    return card.REAL_Y if seats.teams else card.ROW_Y


def problem(seats: LobbySeats, words: Words) -> str:
    """The reason why a match cannot start, or ""."""
    if seats.robots < (1 if seats.team_mode == ALLIES else 2):
        return words("lobby.more")
    return words("lobby.teams_need") if seats.one_team else ""


def card_rect(seat: int) -> pygame.Rect:
    x, w = span(3 * seat, 3)
    return pygame.Rect(x, TOP, w, H)


def glance(seconds: float, seat: int) -> float:
    """Viewing angle of a waiting robot, rad off straight ahead: quick turns with pauses."""
    angles = (0.0, -0.42, 0.3, 0.0, 0.46, -0.2)
    at = seconds / 1.4 + 0.37 * seat
    i, into = int(at), at % 1.0
    now, then = angles[(i + 2 * seat) % len(angles)], angles[(i + 1 + 2 * seat) % len(angles)]
    share = max(0.0, min(1.0, (into - 0.75) / 0.25))
    return now + (then - now) * share * share * (3.0 - 2.0 * share)
