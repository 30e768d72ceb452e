"""Phones as pads as a feature: the server, its page in the options, and the QR code in the lobby and over a match."""

import math
from collections.abc import Callable, Sequence

import pygame

from pigaming_app.scenes.features.feature import Feature, JoinOffer, OptionRow, Service
from pigaming_app.scenes.flow.scene import Context, Scene, Stack, StackOperation
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.ui.draw import FOCUS, ICE, LINE, GlowCanvas, icon
from pigaming_app.ui.input.events import Device, InputEvent


class PhoneService(Service):
    """Follows the settings, gives phones their turns, and shows each its seat and score; those who wait cheer."""

    def __init__(self, context: Context) -> None:
        from pigaming_app.scenes.phones.link import PhoneLink

        self.link = PhoneLink(context)

    def update(self, seconds: float, stack: Stack) -> None:
        self.link.update(stack.scenes)
        self.link.audience.advance(seconds)

    def draw(self, screen: pygame.Surface) -> None:
        self.link.audience.draw(screen)

    def close(self) -> None:
        self.link.host.close()


class PhoneOffer:
    """A QR code leads to the page by which a phone becomes a pad."""

    def __init__(self, context: Context) -> None:
        self.context, self.host = context, context.shared(phone_host)

    @property
    def on(self) -> bool:
        return self.host.on

    @property
    def open(self) -> bool:
        return bool(self.host.url)

    def draw_code(self, screen: pygame.Surface, box: pygame.Rect) -> None:
        from pigaming_app.scenes.phones.join import draw_code

        draw_code(screen, self.host.url, box)

    def page(
        self,
        devices: Callable[[], Sequence[Device | None]],
        lobby: Callable[[InputEvent], StackOperation] | None = None,
        ready: Callable[[], bool] = lambda: False,
    ) -> Scene:
        from pigaming_app.scenes.phones.join import JoinByPhone

        return JoinByPhone(self.context, devices, lobby, ready)


def service(context: Context, options: Options) -> Service:
    return PhoneService(context)


def join(context: Context) -> JoinOffer:
    return PhoneOffer(context)


def settings_page(context: Context) -> Scene:
    from pigaming_app.scenes.phones.settings_page import PhonesPage

    return PhonesPage(context)


def sketch(ink: GlowCanvas, beat: int) -> None:
    """Draw a phone, at every other beat with waves."""
    icon(ink, "phone", 0, 10, 130, FOCUS, LINE)
    if beat:
        for side in (-1, 1):
            start = (math.pi if side < 0 else 0.0) - 0.5
            ink.arc(0, 10, 150, start, start + 1.0, ICE, LINE)


FEATURE = Feature(
    "phones",
    rooms=("scenes.phones", "ui.input.phones"),
    options={"phones": OptionRow("controls", "remap", settings_page, sketch)},
    service=service,
    join=join,
)
