"""The code by which a phone becomes the camera, the steps on the phone, and what it sends."""

import pygame

from pigaming_app.hardware.vision.phone import size_of
from pigaming_app.scenes.flow.scene import Context, StackOperation
from pigaming_app.scenes.mat.phone_camera.host import phone_camera_host
from pigaming_app.scenes.pages.page import Page
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size, fit_text, paragraph, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.web.code import qr_code
from pigaming_app.ui.widgets.labels import sign

CODE = pygame.Rect(LEFT, 206, 726, 726)
TEXT_X = CODE.right + 72
ROOM = RIGHT - TEXT_X
STEPS_Y, STEP, ADDRESS_Y, STATE_Y = 246, 92, 640, 790  # px
PATIENCE = 20.0  # s without a phone, after which network and firewall are named
STEPS = ("scan", "warning", "allow", "hang")


class PhoneCameraPage(Page):
    """The page; the phone is the camera of the settings."""

    title = "phone_camera.title"
    hints = ((Button.BACK, "phone_camera.hint_back"),)
    idle = 600.0

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.host = context.shared(phone_camera_host)

    @property
    def subtitle(self) -> str:
        return self.context.words("phone_camera.line")

    def advance(self, seconds: float) -> StackOperation:
        self.host.follow(True, self.context.settings.phones_network, self.context.words)
        return None

    def paint(self, screen: pygame.Surface) -> None:
        words, host = self.context.words, self.host
        if not host.url:
            sign("phone", 150, kit.STEEL, kit.THIN).draw(screen, *CODE.center)
            reason = words(f"phones.{host.trouble.key}", **host.trouble.values) if host.trouble else ""
            for i, line in enumerate(paragraph(reason, ROOM, 4, kit.ALARM)):
                line.draw(screen, TEXT_X, CODE.centery - 60 + 58 * i)
            return
        code = qr_code(host.url.upper(), CODE.w, kit.BLACK, kit.ICE)  # capitals alone make its modules larger
        screen.blit(code, code.get_rect(center=CODE.center))
        steps(tuple(words(f"phone_camera.step_{name}") for name in STEPS)).draw(screen)
        address(words("phone_camera.type"), host.url).draw(screen)
        if not host.feed.live and self.age > PATIENCE:
            for i, line in enumerate(paragraph(words("phones.firewall", port=host.port), ROOM, 3, kit.MIST)):
                line.draw(screen, TEXT_X, STATE_Y + 48 * i)
            return
        state, live = self._state()
        shown, size = fit_text(state, kit.BODY, ROOM, "body")
        text(shown, size, kit.GREEN if live else kit.MIST, "body", "l").draw(screen, TEXT_X, STATE_Y)

    def _state(self) -> tuple[str, bool]:
        """What the phone sends, and whether it does."""
        words, feed = self.context.words, self.host.feed
        if not feed.live or feed.seen is None:
            return words("phone_camera.waiting"), False
        width, height = size_of(feed.seen.jpeg) or (0, 0)
        delay = round(1000.0 * feed.delay)
        return words("phone_camera.sends", width=width, height=height, rate=round(feed.rate), delay=delay), True


@cached
def steps(lines: tuple[str, ...]) -> LitImage:
    """The numbered steps."""
    layer = Layer(TEXT_X, STEPS_Y - 50, ROOM, STEP * len(lines))
    for i, line in enumerate(lines):
        y = STEPS_Y + STEP * i
        layer.glow.ring(TEXT_X + 34, y, 34, kit.FOCUS, kit.THIN)
        layer.canvas.crisp.text(str(i + 1), kit.LABEL, TEXT_X + 34, y, kit.FOCUS, "head", "c")
        layer.canvas.body(line, TEXT_X + 96, y, kit.ICE, "l", fit_size(line, kit.BODY, ROOM - 96, "body"))
    return layer.render()


@cached
def address(label: str, url: str) -> LitImage:
    """The address in plain text, below a label."""
    layer = Layer(TEXT_X, ADDRESS_Y - 30, ROOM, 150)
    layer.canvas.body(label, TEXT_X, ADDRESS_Y, kit.MIST, "l", 34)
    layer.canvas.text(url, fit_size(url, kit.SUB, ROOM), TEXT_X, ADDRESS_Y + 66, kit.FOCUS)
    return layer.render()
