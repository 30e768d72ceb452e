"""The operator's page of phones: on or off, the network, the codes, how turns pass, and the list of all phones."""

from importlib.util import find_spec

import pygame

from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.pages.wifi import WIFI, wifi_line, wifi_typing, wifi_value
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.phones.join import JoinByPhone, draw_code, draw_wifi, plain, trouble
from pigaming_app.scenes.phones.list_page import PhoneList
from pigaming_app.storage.settings import MAX_NAME
from pigaming_app.ui.draw import ALARM, FOCUS, MIST, STEEL, THIN, text_width
from pigaming_app.ui.draw.layers import LEFT, RIGHT, SMALLEST, fit_text, text
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.web.network import NetworkInterface, ServerUnavailable, networks
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.labels import sign
from pigaming_app.ui.widgets.setting_row import SettingValue

ROWS = ("enabled", "network", "code", "list", "stay", "teams", *WIFI, "renew")
FIELDS = {"enabled": "phones", "stay": "phones_stay", "teams": "phones_teams"}  # settings of the rows that are switches
STATUS_Y = 924  # px: what phones find at the moment


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
        except ServerUnavailable:
            self.networks = []  # the status says why

    def paint(self, screen: pygame.Surface) -> None:
        super().paint(screen)
        if not self.message:
            line, size = fit_text(self._status(), SMALLEST, RIGHT - LEFT - 40, "body")
            text(line, size, ALARM if self.host.trouble else MIST, "body", "l").draw(screen, LEFT + 40, STATUS_Y)

    def draw_picture(self, screen: pygame.Surface, name: str, chosen: int) -> None:
        host, settings, (x, y) = self.host, self.context.settings, dials.CENTRE
        if name in WIFI and settings.phones_wifi and find_spec("segno"):
            draw_wifi(screen, settings, pygame.Rect(x - 165, y - 165, 330, 330))
        elif host.url and name not in (*WIFI, "list"):
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
        if name in FIELDS:
            return self.switch(getattr(settings, FIELDS[name]))
        if name in WIFI:
            return wifi_value(self, name)
        if name != "network":
            return self.action("phones.renew_now" if name == "renew" else "options.open")
        chosen, known = settings.phones_network, self._names()
        names = [words("phones.first_network"), *map(shown, self.networks)]
        if chosen and chosen not in known:
            return SettingValue("arrows", (*names, chosen), len(names))
        return SettingValue("arrows", tuple(names), known.index(chosen) + 1 if chosen else 0)

    def line(self, name: str) -> str:
        return wifi_line(self, name) if name in WIFI else super().line(name)

    def _names(self) -> list[str]:
        """The names under which the networks are stored."""
        return [one.name if len(one.name) <= MAX_NAME else one.address for one in self.networks]

    def apply(self, name: str, chosen: int) -> None:
        settings, known = self.context.settings, ["", *self._names()]
        if name in FIELDS:
            setattr(settings, FIELDS[name], bool(chosen))
        elif chosen < len(known):
            settings.phones_network = known[chosen]

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Open a page; a new code needs a held button."""
        if name in WIFI:
            self.context.sounds.play("accept")
            return Push(wifi_typing(self, name))
        if not self.host.on:
            self.show_message(self.context.words("phones.are_off"))
            self.context.sounds.play("error")
            return None
        if name == "renew":
            self.holding.begin(event)
            return None
        self.context.sounds.play("accept")
        return Push(PhoneList(self.context) if name == "list" else JoinByPhone(self.context, lambda: []))

    def held(self) -> StackOperation:
        """All phones have to scan a new code."""
        self.host.renew()
        self.show_message(self.context.words("phones.renewed"))
        self.context.sounds.play("ready")
        return None


def shown(network: NetworkInterface) -> str:
    """Name and address of a network; a long name is cut off rather than the address."""
    address = f": {network.address}"
    room = dials.VALUE_ROOM - text_width(address, SMALLEST, "body")
    return fit_text(network.name, SMALLEST, room, "body")[0] + address
