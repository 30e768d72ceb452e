"""Pages of a match with real robots in any state, without robots, for tests of their texts."""

from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pygame

from pigaming_app.hardware.control.safety import REMOTE, RULES, Fault, SafetyRule
from pigaming_app.hardware.radio.packets import LAST_ARENA
from pigaming_app.hardware.radio.serial_line import radio_message
from pigaming_app.hardware.robot_kinds import KINDS
from pigaming_app.hardware.scan.things import Thing, ThingKind, ThingLayout
from pigaming_app.hardware.session.guide import GuideStep
from pigaming_app.hardware.session.real import RealSession
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.mat.before_match import UnplayablePage
from pigaming_app.scenes.mat.mat import SessionMat
from pigaming_app.scenes.mat.radio.page import RadioPage
from pigaming_app.scenes.mat.robots.fault_page import FaultPage
from pigaming_app.scenes.mat.robots.guide_page import GuidePage
from pigaming_app.scenes.mat.robots.menu import RobotsMenu
from pigaming_app.scenes.mat.things.arena_page import ArenaPage
from pigaming_app.sim.world import RADIUS
from pigaming_app.storage.messages import OperatorMessage
from tests.scenes.arcade import KEYS, Arcade, setup

PAUSING = {rule.name: rule for rule in RULES if rule.pauses}
PAUSING |= {REMOTE[name]: replace(rule, name=REMOTE[name]) for name, rule in PAUSING.items() if name in REMOTE}
GROUNDLESS: Any = SimpleNamespace(ground=None, radius=lambda robots: RADIUS)  # a session that was never calibrated
WHERE = "/dev/serial/by-id/usb-FTDI_FT231X_USB_UART_DN02MQBC-if00-port0"  # a long port


def fault_page(arcade: Arcade, rule: SafetyRule) -> FaultPage:
    """The page of a fault, with a cause and a second fault."""
    faults = [
        Fault(name, None if PAUSING[name].everyone else 3, PAUSING[name].response, True, 0.0)
        for name in (rule.name, "foreign")
    ]
    late = OperatorMessage("ros_late", seconds="88.8")
    cause = SimpleNamespace(fault=late if rule.name in REMOTE.values() else OperatorMessage("radio_denied", port=WHERE))
    latched = {3} if rule.latched else set[int]()
    safety = SimpleNamespace(latched=latched, stopped=rule.name == "stopped")
    match: Any = SimpleNamespace(
        context=arcade.context,
        plant=SimpleNamespace(faults=faults, safety=safety, rig=SimpleNamespace(camera=cause, link=cause)),
        access=Access(arcade.context, lambda: KEYS),
        real={0, 1, 2, 3},
        runner=SimpleNamespace(picture=lambda: pygame.Surface((1920, 1080))),
        robots=SimpleNamespace(
            draw_overlay=lambda screen: None,
            advance_paused=lambda seconds: None,
            advance_examined=lambda seconds: None,
        ),
        preparing=False,
        watch=SimpleNamespace(note=lambda screen: None, examine=lambda: None, places=[]),
    )
    page = FaultPage(match)
    page.update(0.0)
    return page


def arena_page(arcade: Arcade, things: Sequence[Thing] = (), fault: OperatorMessage | None = None) -> ArenaPage:
    """Build your arena, with these things on the mat and the first one selected; walls are in the way in one arena."""
    arcade.context.mat = SessionMat(arcade.context, GROUNDLESS)
    page = ArenaPage(arcade.context)
    page._take(ThingLayout(tuple(things)), False)
    if page.arenas:
        page.arenas.end()
        page.arenas._thread.join()
        page.arenas.blocked = {"pitanks": ["trenches"]} if things[0].kind is ThingKind.TALL else {}
    page.fault = fault
    return page


def radio_page(arcade: Arcade, message: str = "") -> RadioPage:
    """Arena and radio, with the longest arena number, the longest kind of robot, and a message about a radio."""
    session: Any = SimpleNamespace(emulated=False, arena_id=LAST_ARENA, advance=lambda seconds: seconds)
    arcade.context.mat = SessionMat(arcade.context, session)
    arcade.context.settings.kinds = [max(KINDS, key=lambda kind: len(kind.name)).key, "", "", ""]
    page = RadioPage(arcade.context)
    page.arena, page.module = LAST_ARENA, 4
    if message:
        page._show(radio_message(message, WHERE, "CH 1A"))
    return page


def guide(arcade: Arcade) -> GuidePage:
    """The guide with some steps done, and a calibration that no longer holds."""
    session: Any = RealSession(arcade.context.settings)
    arcade.context.mat = SessionMat(arcade.context, session)
    menu = RobotsMenu(arcade.context)
    page = GuidePage(arcade.context, menu._page, lambda: "")
    page.steps |= {name: GuideStep(name, True) for name in ("robots", "sheet", "pin")}
    other = OperatorMessage("other_display", theirs="2: 3840 × 2160, in a window", ours="1: 1920 × 1080")
    page.steps["calibrate"] = GuideStep("calibrate", False, other)
    page.heard = 4
    page.focus.move_to("calibrate")
    return page


def thing(kind: ThingKind) -> Thing:
    """A thing in the middle of the mat."""
    return Thing(kind, ((650.0, 300.0), (950.0, 300.0), (950.0, 600.0), (650.0, 600.0)), 80.0, 3.0)


def unplayable(arcade: Arcade) -> UnplayablePage:
    """The page on which a thing is in the way; it is not left."""

    def nowhere() -> Scene:
        raise AssertionError

    return UnplayablePage(arcade.context, setup("human human off off"), KEYS, nowhere, nowhere)
