"""The page of consent: what is recorded, and each person takes a seat, chooses an age band and agrees.

When all on the seats have agreed, another press goes on to match setup with AIs on the other seats. Without the consent
of all of them there is no play test.
"""

import pygame

from pigaming_app.scenes.flow.access import Access, Right
from pigaming_app.scenes.flow.match_words import steering
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.lobby import seat_card as card
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.lobby.scene import empty_seats
from pigaming_app.scenes.lobby.seats import AI, EMPTY, HUMAN, PLACES
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.scenes.playtest import pictures
from pigaming_app.scenes.playtest.replays import AGES
from pigaming_app.ui.draw import ICE, LABEL, PLAYERS
from pigaming_app.ui.draw.layers import LEFT, RIGHT, paragraph, span
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.labels import black_out, blit_sprite, call_to_action, pulse
from pigaming_app.ui.widgets.player_card import MIDDLE, H, W, ask_bar, ready_bar

TEXT_Y, TEXT_PITCH, TOP, CALL_Y = 206, 44, 288, 925  # px


class ConsentPage(Page):
    """`agreed`: the age band of each device, once all have agreed; `ages`: those chosen so far."""

    right = Right.PLAY
    title, idle, prompts_y = "playtest.title", 120.0, 995

    def __init__(self, context: Context, game: str) -> None:
        self.game, self.seats = game, empty_seats(context, game)
        self.ages: dict[Device, int] = {}
        self.agreed: dict[Device, str] = {}
        super().__init__(context, gate=Access(context, self.seats.devices))

    def on_enter(self) -> None:
        """First display, or return from match setup: everybody has to agree again."""
        self.context.sounds.music("title")
        self.seats.reset_ready()
        self.agreed = {}
        for seat in self.seats.of_kind(AI):
            self.seats.leave(seat)

    @property
    def hints(self) -> Hints:
        """Of the device that acts."""
        assert self.gate is not None
        seated = self.seats.seat_of(self.gate.hint_device) is not None
        fire = "playtest.hint_agree" if seated else "playtest.hint_join"
        change = [(Button.RIGHT, "playtest.hint_age")] if seated else []
        return [(Button.FIRE, fire), *change, (Button.BACK, "playtest.hint_back")]

    @property
    def subtitle(self) -> str:
        return self.context.words(f"games.{self.game}")

    # ---- input

    def handle(self, event: InputEvent) -> StackOperation:
        """Each device acts on its own seat; a free one can join."""
        self.untouched = 0.0
        assert self.gate is not None
        admitted = self.gate.admit(self.prompts.as_button(event))
        if admitted is None:
            return self._fire(event.device) if event.button in (Button.FIRE, Button.START) else None
        match admitted.button:
            case Button.FIRE | Button.START if admitted.device.kind != "mouse":
                return self._fire(admitted.device)
            case Button.LEFT | Button.RIGHT:
                self._change_age(admitted.device, 1 if admitted.button is Button.RIGHT else -1)
            case Button.BACK | Button.LEAVE_SEAT | Button.LOST:
                return self._back(admitted)
        return None

    def _fire(self, device: Device) -> StackOperation:
        """Join, agree once an age is chosen, or go on."""
        seat = self.seats.seat_of(device)
        if seat is None:
            seat = self.seats.join(device)
            self.context.sounds.play("error" if seat is None else "join", seat)
        elif device not in self.ages:
            self.show_message(self.context.words("playtest.choose_age", player=seat + 1), wrong=True)
            self.context.sounds.play("error")
        elif not self.seats.places[seat].ready:
            self.seats.places[seat].ready = True
            self.context.sounds.play("ready", seat)
        elif not self.seats.waiting:
            return self._go()
        return None

    def _go(self) -> StackOperation:
        self.agreed = {device: AGES[self.ages[device]] for device in self.seats.devices() if device}
        while self.seats.add_ai() is not None:
            pass
        self.context.sounds.play("accept")
        return Push(MatchSetupPage(self.context, self.game, self.seats))

    def _change_age(self, device: Device, by: int) -> None:
        seat = self.seats.seat_of(device)
        if seat is None or self.seats.places[seat].ready:
            return
        first = 0 if by > 0 else len(AGES) - 1
        now = self.ages.get(device)
        self.ages[device] = first if now is None else max(0, min(len(AGES) - 1, now + by))
        self.context.sounds.play("move")

    def _back(self, event: InputEvent) -> StackOperation:
        """Revoke the consent, then leave the seat, then the page."""
        seat = self.seats.seat_of(event.device)
        if seat is None:
            return self.leave() if event.button is Button.BACK else None
        self.context.sounds.play("back")
        if event.button is not Button.LOST and self.seats.places[seat].ready:
            self.seats.places[seat].ready = False
        else:
            self.seats.leave(seat)
            self.ages.pop(event.device, None)
        return None

    # ---- picture

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the text, the cards and what is still missing."""
        what = self.context.words("playtest.what")
        for i, line in enumerate(paragraph(what, RIGHT - LEFT, 2, ICE)):
            line.draw(screen, LEFT, TEXT_Y + TEXT_PITCH * i)
        black_out(screen, *map(card_box, range(PLACES)))
        for seat in range(PLACES):
            self._card(screen, seat)

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the message, or what is to be done, above the prompts."""
        call = self.message or self._call()
        call_to_action(call, "", LABEL, pulse(self.age, 5)).draw(screen, 960, CALL_Y)
        self.prompts.draw(screen)

    def _call(self) -> str:
        words, waiting = self.context.words, self.seats.waiting
        if not self.seats.of_kind(HUMAN):
            return words("lobby.first")
        if not waiting:
            return words("playtest.all_agreed")
        device = self.seats.places[waiting[0]].device
        return words("playtest.agrees" if device in self.ages else "playtest.choose_age", player=waiting[0] + 1)

    def _card(self, screen: pygame.Surface, seat: int) -> None:
        words, place, (x, y) = self.context.words, self.seats.places[seat], card_box(seat).topleft
        title = words("lobby.seat", player=seat + 1)
        if place.kind == EMPTY or place.device is None:
            self._empty_card(screen, seat, title)
            return
        self._robot(screen, seat)
        controls, chosen = self.context.controls, self.ages.get(place.device)
        card.frame(seat, title, place.ready).draw(screen, x, y)
        card.driver(controls.sign(place.device), steering(words, controls, place.device)).draw(screen, x, y)
        age = words("playtest.age" if chosen is None else f"playtest.age_{AGE_KEYS[chosen]}")
        pictures.age(age, None if place.ready else PLAYERS[seat]).draw(screen, x, y)
        if place.ready:
            ready_bar(seat, words("playtest.agreed")).draw(screen, x, y)
        else:
            label = words.key_name(controls.label(place.device, Button.FIRE))
            ask_bar(label, words("playtest.agree"), pulse(self.age, 5)).draw(screen, x, y)

    def _empty_card(self, screen: pygame.Surface, seat: int, title: str) -> None:
        words, (x, y), buttons = self.context.words, card_box(seat).topleft, self._joining()
        if not buttons:
            card.plug_in(seat, title, words("lobby.plug"), "").draw(screen, x, y)
            return
        card.empty(seat, title).draw(screen, x, y)
        level = pulse(self.age) if seat == self.seats.of_kind(EMPTY)[0] else 0
        card.invitation(seat, words("playtest.join"), buttons, level).draw(screen, x, y)

    def _robot(self, screen: pygame.Surface, seat: int) -> None:
        (x, y), ready = card_box(seat).topleft, self.seats.places[seat].ready
        middle, scale, r = card.ROBOTS[0]
        turn = int(self.age * (14 if ready else 3)) % card.TURNS
        card.turntable(seat, turn, ready, r).draw(screen, round(x + MIDDLE), y + middle)
        blit_sprite(screen, card.robot(seat, card.UPRIGHT, scale), x + MIDDLE, y + middle)

    def _joining(self) -> tuple[str, ...]:
        """Distinct labels of the buttons with which free devices can join."""
        controls, words = self.context.controls, self.context.words
        free = [device for device in controls.offered() if self.seats.seat_of(device) is None]
        return tuple(dict.fromkeys(words.key_name(controls.label(device, Button.FIRE)) for device in free))


AGE_KEYS = tuple(band.replace("-", "_") for band in AGES)


def card_box(seat: int) -> pygame.Rect:
    """The box of a seat's card."""
    return pygame.Rect(span(3 * seat, 3)[0], TOP, W, H)
