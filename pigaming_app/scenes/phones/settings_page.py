"""The operator's page of phones: on or off, the network, and the code."""

import logging

import pygame

from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.navigation import Navigation
from pigaming_app.scenes.flow.stack import Push, StackOperation
from pigaming_app.scenes.phones.join import JoinByPhone, draw_code, plain, trouble
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import MAX_NAME, folders
from pigaming_app.ui.draw import ALARM, FOCUS, MIST, STEEL, THIN
from pigaming_app.ui.draw.layers import LEFT, backdrop
from pigaming_app.ui.draw.text import paragraph
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.input.phones.network import Network, PhonesUnavailable, networks
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.focus import Focus
from pigaming_app.ui.widgets.labels import black_out, frame, heading, sign
from pigaming_app.ui.widgets.setting_row import SettingValue

IDLE = 90.0  # s without input until the title
SENTENCE_SECONDS = 3.0
ROWS = ("enabled", "network", "code")
STATUS_Y = 640  # px: what phones find at the moment
log = logging.getLogger("pigaming")


class PhonesPage:
    """The page. Changes apply and are saved at once."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.focus = Focus(dials.spots(ROWS))
        hints = [
            (Button.RIGHT, "options.hint_change"),
            (Button.FIRE, "options.hint_ok"),
            (Button.BACK, "options.hint_back"),
        ]
        self.navigation = Navigation(context, self.focus, hints, IDLE, SENTENCE_SECONDS)
        self.networks: list[Network] = []

    def on_enter(self) -> None:
        """Look which networks there are."""
        try:
            self.networks = networks()
        except PhonesUnavailable:
            self.networks = []  # the status says why

    def handle(self, event: InputEvent) -> StackOperation:
        """Left and right change a row, FIRE changes or opens it."""
        event = self.navigation.prompts.as_button(event)
        if event.button is Button.CLICK:
            self.focus.handle(event)
        value = self._value(self.focus.name)
        if step := dials.step_of(event, self.focus, value):
            self._change(self.focus.name, max(0, min(len(value.options) - 1, value.chosen + step)))
            return None
        if self.focus.activated(event) and (event.button is not Button.CLICK or value.kind == "deed"):
            if value.kind == "deed":
                return self._open()
            self._change(self.focus.name, (value.chosen + 1) % len(value.options))
            return None
        return self.navigation.handle(event) if event.button is not Button.CLICK else None

    def update(self, seconds: float) -> StackOperation:
        return self.navigation.update(seconds)

    def draw(self, screen: pygame.Surface) -> None:
        words, focus, host = self.context.words, self.focus.name, self.context.phone_host
        screen.blit(backdrop(), (0, 0))
        heading(words("options.phones")).draw(screen)
        black_out(screen, dials.PANEL)
        dials.draw(screen, words, self.focus, "phones", {name: self._value(name) for name in ROWS})
        frame(*dials.PANEL.size).draw(screen, *dials.PANEL.topleft)
        dials.describe(screen, words(f"phones.{focus}"), words(f"phones.{focus}_line"))
        if host.url:
            draw_code(screen, host.url, pygame.Rect(0, 0, 330, 330).move(dials.CENTRE[0] - 165, dials.CENTRE[1] - 165))
        else:
            sign("phone", 120, FOCUS if host.on else STEEL, THIN).draw(screen, *dials.CENTRE)
        lines = paragraph(self._status(), dials.W - 40, 4, ALARM if host.trouble else MIST)
        for i, lit in enumerate(lines):
            lit.draw(screen, LEFT + 40, STATUS_Y + 58 * i)
        self.navigation.prompts.draw(screen)

    def _status(self) -> str:
        words, host = self.context.words, self.context.phone_host
        if self.navigation.sentence:
            return self.navigation.sentence
        if host.trouble:
            return trouble(words, host)
        return words("phones.listening", address=plain(host.url)) if host.url else words("phones.are_off")

    def _value(self, name: str) -> SettingValue:
        words, settings = self.context.words, self.context.settings
        if name == "enabled":
            return SettingValue("toggle", (words("options.off"), words("options.on")), int(settings.phones))
        if name == "code":
            return SettingValue("deed", (words("options.open"),))
        chosen, known = settings.phones_network, self._names()
        names = [words("phones.first_network"), *(f"{one.name}: {one.address}" for one in self.networks)]
        if chosen and chosen not in known:
            return SettingValue("arrows", (*names, chosen), len(names))
        return SettingValue("arrows", tuple(names), known.index(chosen) + 1 if chosen else 0)

    def _names(self) -> list[str]:
        """The names under which the networks are stored."""
        return [one.name if len(one.name) <= MAX_NAME else one.address for one in self.networks]

    def _change(self, name: str, chosen: int) -> None:
        settings = self.context.settings
        if name == "enabled":
            settings.phones = bool(chosen)
        elif name == "network":
            known = ["", *self._names()]
            if chosen < len(known):
                settings.phones_network = known[chosen]
        self.context.sounds.play("move")
        try:
            settings.save(folders().config)
        except NotSaved as problem:
            log.warning("%s", problem)
            self.navigation.show_message(self.context.words("app.unsaved"))

    def _open(self) -> StackOperation:
        if not self.context.phone_host.on:
            self.navigation.show_message(self.context.words("phones.are_off"))
            self.context.sounds.play("error")
            return None
        self.context.sounds.play("accept")
        return Push(JoinByPhone(self.context, lambda: []))
