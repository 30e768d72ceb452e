"""The operator's list of all phones: who plays, who waits; a press sends one away, another bans it."""

import pygame

from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.scene import Context, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.phones.cheers import COLORS
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import LEFT, SMALLEST, LitImage, fit_text, paragraph, span, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.input.phones.guest import Guest, Stage
from pigaming_app.ui.input.phones.roster import MAX_CONNECTED
from pigaming_app.ui.widgets.focus import Focus, FocusSpot

TOP, PITCH, ROWS = 222, 44, 16  # px of the first row; rows in each of two columns
NAME_X, STATE_X, ROOM = 56, 400, 270  # px from a row's left edge; of the state


class PhoneList(Page):
    """The page. It follows the phones as they come and go."""

    right = Right.SETTINGS
    title = "phones.list"
    hints = ((Button.FIRE, "phones.hint_remove"), (Button.X, "phones.hint_ban"), (Button.BACK, "phones.hint_back"))

    def __init__(self, context: Context) -> None:
        self.roster = context.shared(phone_host).roster
        self.guests = self.roster.guests()
        super().__init__(context, Focus(self._spots()))

    @property
    def subtitle(self) -> str:
        return f"{len(self.guests)} / {MAX_CONNECTED}"

    def advance(self, seconds: float) -> StackOperation:
        """Follow the phones."""
        self.guests = self.roster.guests()
        if (spots := self._spots()) != self.focus.spots:
            self.focus.set_spots(spots)
        return None

    def press(self, event: InputEvent) -> StackOperation:
        """X bans the phone with the focus."""
        if event.button is Button.X:
            self._send_away(ban=True)
            return None
        return super().press(event)

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        """Send a phone away."""
        self._send_away(ban=False)
        return None

    def paint(self, screen: pygame.Surface) -> None:
        """Draw a row for each phone."""
        words = self.context.words
        if not self.guests:
            for lit in paragraph(words("phones.list_empty"), 900, 1, kit.MIST):
                lit.draw(screen, LEFT, TOP)
            return
        places = {guest.number: place for place, guest in enumerate(self.roster.queue(), 1)}
        for guest, spot in zip(self.guests, self.focus.spots, strict=False):
            box, focused = spot.rect, spot.name == self.focus.name
            dot(guest.colour).draw(screen, box.x + 26, box.centery)
            ink = kit.ICE if focused else kit.MIST
            name, size = fit_text(shown_name(guest, words), 32, STATE_X - NAME_X - 16, "body")
            text(name, size, ink, "body", "l").draw(screen, box.x + NAME_X, box.centery)
            color = kit.FOCUS if guest.stage is Stage.PLAYING else ink
            text(state(guest, places.get(guest.number, 0), words), SMALLEST, color, "body", "l", ROOM).draw(
                screen, box.x + STATE_X, box.centery
            )
            text(played(guest, words), SMALLEST, kit.MIST, "body", "r", 160).draw(screen, box.right - 16, box.centery)
        self.focus.draw(screen)

    def _spots(self) -> list[FocusSpot]:
        spots = []
        for i, guest in enumerate(self.guests):
            x, w = span(6 * (i // ROWS), 6)
            box = pygame.Rect(x, TOP - 20 + PITCH * (i % ROWS), w, PITCH - 4)
            spots.append(FocusSpot(str(guest.number), box))
        return spots or [FocusSpot("", pygame.Rect(0, 0, 0, 0))]

    def _send_away(self, ban: bool) -> None:
        guest = next((guest for guest in self.guests if str(guest.number) == self.focus.name), None)
        if guest is None:
            self.context.sounds.play("refused")
            return
        words = self.context.words
        self.roster.remove(guest.number, ban)
        self.context.sounds.play("accept")
        self.show_message(words("phones.banned" if ban else "phones.removed", name=shown_name(guest, words)))


def shown_name(guest: Guest, words: Words) -> str:
    """The name of a phone, or its number."""
    return guest.name or words("phones.list_nameless", number=guest.number + 1)


def state(guest: Guest, place: int, words: Words) -> str:
    """What a phone does. `place`: in the queue."""
    if not guest.connected:
        return words("phones.list_away")
    return words(f"phones.list_{guest.stage.value}", place=place)


def played(guest: Guest, words: Words) -> str:
    """How many matches it has played."""
    return words.counted("phones.list_matches", guest.played, count=guest.played)


@cached
def dot(colour: int) -> LitImage:
    """A phone's colour, at (0, 0)."""
    return LitImage(kit.GlowCanvas(28, 28).disc(14, 14, 10, COLORS[colour % len(COLORS)]).plain(), (-14, -14))
