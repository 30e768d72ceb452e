"""The operator's switch for the event's pages in a browser, with their address and its code."""

import pygame

from pigaming_app.scenes.events.desk.host import can_serve, desk_host
from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.ui.draw import ALARM, BLACK, FOCUS, ICE, MIST, STEEL, THIN
from pigaming_app.ui.draw.layers import LEFT, paragraph
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.labels import sign
from pigaming_app.ui.widgets.setting_row import SettingValue

STATUS_Y, SIZE = 480, 330  # px: what is served at the moment; the code


class DeskPage(SettingsPage):
    """The page. The server follows within a second."""

    right = Right.EVENTS
    table, title = "desk", "events.desk"

    def __init__(self, context: Context) -> None:
        self.host = context.shared(desk_host)
        super().__init__(context, ("enabled",))

    def paint(self, screen: pygame.Surface) -> None:
        super().paint(screen)
        key, values = self.host.trouble
        words, url = self.context.words, self.host.url.removeprefix("http://")
        lines = [words(key, **values)] if key else []
        if url:
            lines = [words("desk.everybody", address=url), words("desk.operator", address=f"{url}desk")]
        parts = [lit for line in lines for lit in paragraph(line, dials.W - 40, 3, ALARM if key else MIST)]
        for i, lit in enumerate(parts):
            lit.draw(screen, LEFT + 40, STATUS_Y + 58 * i)

    def draw_picture(self, screen: pygame.Surface, name: str, chosen: int) -> None:
        x, y = dials.CENTRE
        if self.host.url and can_serve():
            from pigaming_app.ui.web.code import qr_code

            code = qr_code(self.host.url.upper(), SIZE, BLACK, ICE)
            screen.blit(code, code.get_rect(center=(x, y)))
        else:
            sign("phone", 120, FOCUS if chosen else STEEL, THIN).draw(screen, x, y)

    def value(self, name: str) -> SettingValue:
        return self.switch(self.context.settings.desk)

    def apply(self, name: str, chosen: int) -> None:
        self.context.settings.desk = bool(chosen)
