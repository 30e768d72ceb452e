"""Join by phone: the QR code, large enough for a phone two metres away, beside the address in plain text.

In the lobby, phones join and get ready while the page stays; any other device returns to the lobby and acts there.
"""

import math
from collections.abc import Callable, Sequence

import pygame

from pigaming_app.scenes.flow.scene import Context, Pop, Push, StackOperation, Swap
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.phones.list_page import shown_name
from pigaming_app.storage.settings import Settings
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import (
    LEFT,
    RIGHT,
    Layer,
    LitImage,
    fit_lines,
    fit_size,
    fit_text,
    paragraph,
    text,
    wrap,
)
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.input.phones.host import PhoneHost
from pigaming_app.ui.web.code import qr_code, wifi_text
from pigaming_app.ui.web.wifi import password
from pigaming_app.ui.widgets.labels import pulse, sign

IDLE = 60.0  # s without input until the title
PATIENCE = 20.0  # s without a visitor, after which network and firewall are named
CODE = pygame.Rect(LEFT, 206, 726, 726)
TEXT_X = CODE.right + 72
ROOM = RIGHT - TEXT_X
STEPS_Y, STEP, ADDRESS_Y, SEATS_Y, HELP_Y = 250, 98, 600, 716, 848
SEAT_W = 152
WIFI = pygame.Rect(TEXT_X, 196, 306, 306)  # px: the code of the Wi-Fi, in place of the drawings of the steps
QUEUE_Y, NAMED = 868, 4  # px; phones named as the next ones
Devices = Sequence[Device | None]


class JoinByPhone(Page):
    """The page. `devices`: of the seats. `lobby`: handles the presses of phones; None over a paused match. `ready`:
    true when the lobby goes on.
    """

    title = "phones.title"
    hints = ((Button.BACK, "phones.hint_back"),)

    def __init__(
        self,
        context: Context,
        devices: Callable[[], Devices],
        lobby: Callable[[InputEvent], StackOperation] | None = None,
        ready: Callable[[], bool] = lambda: False,
    ) -> None:
        super().__init__(context)
        self.devices, self.lobby, self.ready = devices, lobby, ready
        self.idle = IDLE if lobby else math.inf
        self.host = context.shared(phone_host)

    def handle(self, event: InputEvent) -> StackOperation:
        """Phones act in the lobby below; the first press of another device returns there."""
        event = self.prompts.as_button(event)
        phone = event.device.kind == "phone"
        if event.button is Button.FOUND and phone:
            self.context.sounds.play("move")
        if event.button is Button.POINT or (self.lobby is None and event.button in (Button.FOUND, Button.LOST)):
            return None
        if event.button is Button.BACK and (self.lobby is None or not phone):
            return self.leave()
        if event.button is Button.CLICK:
            return Pop()
        if self.lobby is None:
            return None if phone else Pop()
        operation = self.lobby(event)
        if isinstance(operation, Push):
            return Swap(operation.scene)
        stays = event.button in (Button.FOUND, Button.LOST) or (phone and not self.ready())
        return operation or (None if stays else Pop())

    def advance(self, seconds: float) -> StackOperation:
        """Return when phones are off."""
        return None if self.host.on else Pop()

    @property
    def subtitle(self) -> str:
        return self.context.words("phones.line")

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the code, the address and the seats, or the trouble."""
        words, host = self.context.words, self.host
        if host.url:
            draw_code(screen, host.url, CODE)
            settings = self.context.settings
            last = words("phones.step_press")
            if settings.phones_wifi:
                draw_wifi(screen, settings, WIFI)
                beside((words("phones.wifi_step"), words("phones.page_step"), last)).draw(screen)
            else:
                steps((words("phones.step_wifi"), words("phones.step_scan"), last)).draw(screen)
            address(words("phones.type"), plain(host.url)).draw(screen)
            self._seats(screen)
            if queue := self._queue():
                line, size = fit_text(queue, kit.BODY, ROOM, "body")
                text(line, size, kit.MIST, "body", "l").draw(screen, TEXT_X, QUEUE_Y)
            elif host.server and not host.server.visited and self.age > PATIENCE:
                hint(words("phones.firewall", port=host.server.port)).draw(screen)
        else:
            sign("phone", 150, kit.STEEL, kit.THIN).draw(screen, *CODE.center)
            for i, lit in enumerate(paragraph(trouble(words, host), ROOM, 4, kit.ALARM)):
                lit.draw(screen, TEXT_X, CODE.centery - 60 + 58 * i)

    def _seats(self, screen: pygame.Surface) -> None:
        """The seats, with the phones that have joined, and the phones that have not."""
        devices = self.devices()
        for seat in range(4):
            device = devices[seat] if seat < len(devices) else None
            seat_sign(seat, self.context.controls.sign(device) if device else "").draw(
                screen, TEXT_X + SEAT_W * seat, SEATS_Y
            )
        waiting = [device for device in self.context.controls.handhelds() if device not in devices]
        count = sum(device.kind == "phone" for device in waiting) + len(self.host.roster.queue())
        if count:
            sign("phone", 40, kit.FOCUS, kit.THIN, pulse(self.age)).draw(screen, TEXT_X + SEAT_W * 4 + 76, SEATS_Y + 40)
            number(f"× {count}").draw(screen, TEXT_X + SEAT_W * 4 + 126, SEATS_Y + 40)

    def _queue(self) -> str:
        """The phones that come next, by name; empty if nobody waits."""
        words, queue = self.context.words, self.host.roster.queue()
        names = [shown_name(guest, words) for guest in queue[:NAMED]]
        more = [f"+ {len(queue) - NAMED}"] if len(queue) > NAMED else []
        return words("phones.in_queue", names="  ·  ".join(names + more)) if names else ""


def draw_wifi(screen: pygame.Surface, settings: Settings, box: pygame.Rect) -> None:
    """Draw the code of the Wi-Fi in the middle of a box."""
    code = qr_code(wifi_text(settings.phones_wifi, password(settings)), box.w, kit.BLACK, kit.ICE)
    screen.blit(code, code.get_rect(center=box.center))


def draw_code(screen: pygame.Surface, url: str, box: pygame.Rect) -> None:
    """Draw the QR code in the middle of a box; capitals alone make its modules larger."""
    code = qr_code(url.upper(), box.w, kit.BLACK, kit.ICE)
    screen.blit(code, code.get_rect(center=box.center))


def plain(url: str) -> str:
    """The address as it is typed."""
    return url.removeprefix("http://")


def trouble(words: Words, host: PhoneHost) -> str:
    """Why phones cannot join, in one sentence; empty if they can."""
    return words(f"phones.{host.trouble.key}", **host.trouble.values) if host.trouble else ""


def _radio(ink: kit.GlowCanvas, x: float, y: float) -> None:
    ink.disc(x, y + 24, 6, kit.ICE)
    for r in (22, 42):
        ink.arc(x, y + 24, r, -math.pi / 2 - 0.8, -math.pi / 2 + 0.8, kit.ICE, kit.THIN)


def _scan(ink: kit.GlowCanvas, x: float, y: float) -> None:
    kit.icon(ink, "phone", x, y, 34, kit.ICE, kit.THIN)
    ink.line(kit.cut_box(x - 9, y - 12, 18, 18, 3), kit.FOCUS, kit.THIN, True)


def _press(ink: kit.GlowCanvas, x: float, y: float) -> None:
    ink.ring(x, y, 28, kit.ICE, kit.THIN).text("A", kit.BODY, x, y, kit.ICE, "head", "c")


SKETCHES = (_radio, _scan, _press)  # of the steps: the network, the code, the button


@cached
@resumable
def steps(lines: tuple[str, ...]) -> Steps[LitImage]:
    """The numbered steps, top left of the text's column."""
    layer = Layer(TEXT_X, STEPS_Y - 50, ROOM, STEP * len(lines))
    for i, line in enumerate(lines):
        y = STEPS_Y + STEP * i
        layer.glow.ring(TEXT_X + 34, y, 34, kit.FOCUS, kit.THIN)
        layer.canvas.crisp.text(str(i + 1), kit.LABEL, TEXT_X + 34, y, kit.FOCUS, "head", "c")
        SKETCHES[i](layer.glow, TEXT_X + 124, y)
        layer.canvas.body(line, TEXT_X + 188, y, kit.ICE, "l", fit_size(line, kit.BODY, ROOM - 188, "body"))
        yield
    return (yield from layer.render_steps())


@cached
def beside(lines: tuple[str, ...]) -> LitImage:
    """The numbered steps beside the code of the Wi-Fi, each in up to two lines."""
    x, room = WIFI.right + 30, RIGHT - WIFI.right - 112
    layer = Layer(x, WIFI.y - 10, RIGHT - x, 350)
    for i, line in enumerate(lines):
        y = WIFI.y + 46 + 108 * i
        layer.glow.ring(x + 30, y, 30, kit.FOCUS, kit.THIN)
        layer.canvas.crisp.text(str(i + 1), kit.BODY, x + 30, y, kit.FOCUS, "head", "c")
        size, parts = fit_lines(line, room, 2, range(kit.BODY, 24, -2))
        for row, part in enumerate(parts):
            layer.canvas.body(part, x + 78, y + (row - (len(parts) - 1) / 2) * 1.2 * size, kit.ICE, "l", size)
    return layer.render()


@cached
@resumable
def address(label: str, url: str) -> Steps[LitImage]:
    """The address in plain text, below a label."""
    layer = Layer(TEXT_X, ADDRESS_Y - 90, ROOM, 150)
    layer.canvas.body(label, TEXT_X, ADDRESS_Y - 62, kit.MIST, "l", 34)
    layer.canvas.text(url, fit_size(url, kit.SUB, ROOM), TEXT_X, ADDRESS_Y + 6, kit.FOCUS)
    layer.glow.line([(TEXT_X, ADDRESS_Y + 66), (RIGHT, ADDRESS_Y + 66)], kit.dim(kit.STEEL, 0.6), kit.HAIR)
    yield
    return (yield from layer.render_steps())


@cached
def seat_sign(seat: int, kind: str) -> LitImage:
    """The badge of a seat, and its device, if any; upper left corner at (0, 0)."""
    layer = Layer(0, 0, SEAT_W - 12, 80)
    color = kit.PLAYERS[seat] if kind else kit.dim(kit.PLAYERS[seat], 0.45)
    kit.badge(layer.glow, seat, 36, 40, 32, color)
    if kind:
        kit.icon(layer.glow, kind, 100, 40, 26, kit.ICE, kit.THIN)
    return layer.render()


@cached
def number(count: str) -> LitImage:
    """A number, its left end at (0, 0)."""
    layer = Layer(0, -30, 110, 60)
    layer.canvas.text(count, kit.LABEL, 0, 0, kit.FOCUS)
    return layer.render()


@cached
def hint(advice: str) -> LitImage:
    """Advice in up to two lines at the foot of the text's column."""
    layer = Layer(TEXT_X, HELP_Y - 30, ROOM, 100)
    for i, line in enumerate(wrap(advice, 32, ROOM)[:2]):
        layer.canvas.body(line, TEXT_X, HELP_Y + 44 * i, kit.MIST, "l", 32)
    return layer.render()
