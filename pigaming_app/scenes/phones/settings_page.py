"""The operator's page of phones: on or off, the network, and the code."""

import pygame

from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Push, StackOperation
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.phones.join import JoinByPhone, draw_code, plain, trouble
from pigaming_app.storage.settings import MAX_NAME
from pigaming_app.ui.draw import ALARM, FOCUS, MIST, STEEL, THIN, text_width
from pigaming_app.ui.draw.layers import LEFT
from pigaming_app.ui.draw.text import SMALLEST, fit_text, paragraph
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.input.phones.network import NetworkInterface, PhonesUnavailable, networks
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.labels import sign
from pigaming_app.ui.widgets.setting_row import SettingValue

ROWS = ("enabled", "network", "code")
STATUS_Y = 640  # px: what phones find at the moment


class PhonesPage(SettingsPage):
    """The page. Changes apply and are saved at once."""

    right = Right.SETTINGS
    table, title = "phones", "options.phones"

    def __init__(self, context: Context) -> None:
        self.networks: list[NetworkInterface] = []
        self.host = context.shared(phone_host)
        super().__init__(context, ROWS)

    def on_enter(self) -> None:
        """Look which networks there are."""
        try:
            self.networks = networks()
        except PhonesUnavailable:
            self.networks = []  # the status says why

    def paint(self, screen: pygame.Surface) -> None:
        super().paint(screen)
        lines = paragraph(self._status(), dials.W - 40, 4, ALARM if self.host.trouble else MIST)
        for i, lit in enumerate(lines):
            lit.draw(screen, LEFT + 40, STATUS_Y + 58 * i)

    def draw_picture(self, screen: pygame.Surface, name: str, chosen: int) -> None:
        host, (x, y) = self.host, dials.CENTRE
        if host.url:
            draw_code(screen, host.url, pygame.Rect(x - 165, y - 165, 330, 330))
        else:
            sign("phone", 120, FOCUS if host.on else STEEL, THIN).draw(screen, x, y)

    def _status(self) -> str:
        words, host = self.context.words, self.host
        if host.trouble:
            return trouble(words, host)
        return words("phones.listening", address=plain(host.url)) if host.url else words("phones.are_off")

    def value(self, name: str) -> SettingValue:
        words, settings = self.context.words, self.context.settings
        if name == "enabled":
            return self.switch(settings.phones)
        if name == "code":
            return self.action("options.open")
        chosen, known = settings.phones_network, self._names()
        names = [words("phones.first_network"), *map(shown, self.networks)]
        if chosen and chosen not in known:
            return SettingValue("arrows", (*names, chosen), len(names))
        return SettingValue("arrows", tuple(names), known.index(chosen) + 1 if chosen else 0)

    def _names(self) -> list[str]:
        """The names under which the networks are stored."""
        return [one.name if len(one.name) <= MAX_NAME else one.address for one in self.networks]

    def apply(self, name: str, chosen: int) -> None:
        settings, known = self.context.settings, ["", *self._names()]
        if name == "enabled":
            settings.phones = bool(chosen)
        elif chosen < len(known):
            settings.phones_network = known[chosen]

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        if not self.host.on:
            self.show_message(self.context.words("phones.are_off"))
            self.context.sounds.play("error")
            return None
        self.context.sounds.play("accept")
        return Push(JoinByPhone(self.context, lambda: []))


def shown(network: NetworkInterface) -> str:
    """Name and address of a network; a long name is cut off rather than the address."""
    address = f": {network.address}"
    room = dials.VALUE_ROOM - text_width(address, SMALLEST, "body")
    return fit_text(network.name, SMALLEST, room, "body")[0] + address
