"""Controls, tested with virtual pads: real events of the real library."""

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from math import sqrt
from pathlib import Path

import pygame
import pytest

from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent, StickState
from pigaming_app.ui.input.filters import FIRST_REPEAT, NEXT_REPEAT, apply_dead_zone
from tests.ui.input.virtual_pad import NINTENDO, PLAYSTATION, VirtualPad

MOUSE = Device("mouse")
STILL = StickState()
PLATFORM = {"linux": "Linux", "darwin": "Mac OS X"}.get(sys.platform, "Windows")


@pytest.fixture
def pads() -> Iterator[ExitStack]:
    with ExitStack() as stack:
        yield stack


def heard(controls: Controls) -> list[tuple[Button, Device]]:
    """The button presses for all pending SDL events."""
    return [(press.button, press.device) for press in controls.presses(pygame.event.get())]


def plug(controls: Controls, pads: ExitStack, *, plain: bool = False) -> tuple[VirtualPad, Device]:
    pad = pads.enter_context(VirtualPad(plain=plain))
    device = Device("pad", pad.number)
    assert heard(controls) == [(Button.FOUND, device)]
    return pad, device


def test_four_pads_of_one_make_are_four_devices(controls: Controls, pads: ExitStack) -> None:
    four = [plug(controls, pads) for _ in range(4)]
    assert controls.pads() == [device for _, device in four]
    for pad, device in four:
        pad.press("a")
        assert heard(controls) == [(Button.FIRE, device)]
        assert [controls.drive(other).fire for _, other in four] == [other == device for _, other in four]
        pad.release("a")
        assert heard(controls) == []


def test_a_fifth_pad_is_just_another_device(controls: Controls, pads: ExitStack) -> None:
    devices = [plug(controls, pads)[1] for _ in range(5)]
    assert len(set(devices)) == 5
    assert controls.pads() == devices


def test_a_pad_that_was_there_at_the_start_is_known_and_not_found_again(pads: ExitStack) -> None:
    pygame.display.init()
    pad = pads.enter_context(VirtualPad())
    controls = Controls()
    assert controls.pads() == [Device("pad", pad.number)]
    assert controls.last == Device("pad", pad.number)
    assert heard(controls) == []


@pytest.mark.parametrize(
    ("button", "meaning"),
    [
        ("a", Button.FIRE),
        ("b", Button.BACK),
        ("x", Button.X),
        ("y", Button.Y),
        ("start", Button.START),
        ("up", Button.UP),
    ],
)
def test_every_press_is_reported_once(controls: Controls, pads: ExitStack, button: str, meaning: Button) -> None:
    pad, device = plug(controls, pads)
    pad.press(button)
    assert heard(controls) == [(meaning, device)]
    pad.release(button)
    assert heard(controls) == []


def test_the_stick_drives_ahead_and_clockwise(controls: Controls, pads: ExitStack) -> None:
    pad, device = plug(controls, pads)
    pad.stick(0.0, -1.0)
    heard(controls)
    assert controls.drive(device) == StickState(linear=1.0)
    pad.stick(1.0, 0.0)
    heard(controls)
    assert controls.drive(device) == StickState(angular=1.0)
    pad.stick(0.0, 1.0)
    heard(controls)
    assert controls.drive(device) == StickState(linear=-1.0)


def test_a_thumb_that_rests_on_the_stick_drives_nowhere(controls: Controls, pads: ExitStack) -> None:
    pad, device = plug(controls, pads)
    pad.stick(0.17, -0.17)  # 0.24 from the middle
    assert heard(controls) == []
    assert controls.drive(device) == STILL


def test_beyond_the_dead_zone_a_stick_starts_at_zero() -> None:
    assert apply_dead_zone(0.25, 0.0) == (0.0, 0.0)
    assert apply_dead_zone(0.26, 0.0)[0] == pytest.approx(0.01 / 0.7)
    assert apply_dead_zone(0.0, -0.6) == pytest.approx((0.0, -0.5))
    assert apply_dead_zone(sqrt(0.5), sqrt(0.5)) == pytest.approx((1.0, 1.0))
    assert apply_dead_zone(-1.0, 1.0) == pytest.approx((-1.0, 1.0))
    assert apply_dead_zone(0.95, 0.0) == pytest.approx((1.0, 0.0))
    assert max(apply_dead_zone(0.18, 0.18)) < 0.01  # a circle, not a square


def test_the_d_pad_drives_too(controls: Controls, pads: ExitStack) -> None:
    pad, device = plug(controls, pads)
    pad.press("up", "left")
    heard(controls)
    assert controls.drive(device) == StickState(linear=1.0, angular=-1.0)


def test_triggers_and_shoulder_fire_and_boost(controls: Controls, pads: ExitStack) -> None:
    pad, device = plug(controls, pads)
    pad.triggers(left=0.0, right=1.0)
    assert heard(controls) == [(Button.FIRE, device)]
    assert controls.drive(device) == StickState(fire=True)
    pad.triggers(left=1.0, right=0.5)  # a trembling finger, still down
    assert heard(controls) == []
    pad.triggers(left=1.0, right=0.0)
    assert heard(controls) == []
    assert controls.drive(device) == StickState(turbo=True)
    pad.triggers(left=0.0, right=0.0)
    pad.press("rightshoulder")
    heard(controls)
    assert controls.drive(device) == StickState(turbo=True)


def test_a_tap_between_two_ticks_still_fires_once(controls: Controls, pads: ExitStack) -> None:
    pad, device = plug(controls, pads)
    pad.tap("a")
    assert heard(controls) == [(Button.FIRE, device)]
    assert controls.drive(device) == StickState(fire=True)
    assert controls.drive(device) == STILL


def test_a_cable_pulled_at_full_speed_stops_the_robot(controls: Controls, pads: ExitStack) -> None:
    pad, device = plug(controls, pads)
    pad.stick(0.0, -1.0)
    pad.press("a")
    heard(controls)
    assert controls.drive(device) == StickState(linear=1.0, fire=True)
    pad.unplug()
    assert controls.drive(device) == STILL  # before the event was read
    assert heard(controls) == [(Button.LOST, device)]
    assert controls.drive(device) == STILL
    assert not controls.connected(device)
    assert controls.repeats(10.0) == []
    assert controls.pads() == []


def test_a_pad_that_comes_back_is_a_new_device(controls: Controls, pads: ExitStack) -> None:
    pad, before = plug(controls, pads)
    pad.unplug()
    assert heard(controls) == [(Button.LOST, before)]
    again, after = plug(controls, pads)
    assert after != before
    again.press("a")
    assert heard(controls) == [(Button.FIRE, after)]


def test_a_pad_pulled_and_plugged_within_one_frame(controls: Controls, pads: ExitStack) -> None:
    pad, before = plug(controls, pads)
    pad.unplug()
    again = pads.enter_context(VirtualPad())
    assert set(heard(controls)) == {(Button.LOST, before), (Button.FOUND, Device("pad", again.number))}
    assert controls.pads() == [Device("pad", again.number)]


def test_duplicate_and_stale_device_events_change_nothing(controls: Controls, pads: ExitStack) -> None:
    _, device = plug(controls, pads)
    for event in (pygame.JOYDEVICEADDED, pygame.CONTROLLERDEVICEADDED):
        for index in (0, 7):
            pygame.event.post(pygame.Event(event, device_index=index, guid="0"))
    for event in (pygame.JOYDEVICEREMOVED, pygame.CONTROLLERDEVICEREMOVED):
        pygame.event.post(pygame.Event(event, instance_id=999))
    pygame.event.post(pygame.Event(pygame.CONTROLLERBUTTONDOWN, instance_id=999, button=0))
    assert heard(controls) == []
    assert controls.pads() == [device]


def test_a_held_direction_presses_again_until_it_is_let_go(controls: Controls, pads: ExitStack) -> None:
    pad, device = plug(controls, pads)
    pad.stick(0.0, 1.0)
    assert heard(controls) == [(Button.DOWN, device)]
    again = [InputEvent(Button.DOWN, device, repeat=True)]
    assert controls.repeats(FIRST_REPEAT - 0.01) == []
    assert controls.repeats(0.02) == again
    assert controls.repeats(NEXT_REPEAT - 0.01) == []
    assert controls.repeats(0.02) == again
    assert controls.repeats(5.0) == again  # at most one, however long a frame took
    pad.stick(0.0, 0.0)
    assert heard(controls) == []
    assert controls.repeats(5.0) == []


def test_a_trembling_stick_presses_once(controls: Controls, pads: ExitStack) -> None:
    pad, device = plug(controls, pads)
    made = []
    for reach in (0.59, 0.61, 0.5, 0.61, 0.41, 0.7):
        pad.stick(reach, 0.0)
        made += heard(controls)
    assert made == [(Button.RIGHT, device)]
    pad.stick(0.39, 0.0)
    heard(controls)
    pad.stick(-1.0, 0.0)
    assert heard(controls) == [(Button.LEFT, device)]


def test_a_pad_without_a_mapping_plays_as_a_plain_joystick(controls: Controls, pads: ExitStack) -> None:
    pad, device = plug(controls, pads, plain=True)
    assert controls.name(device) == "Joystick"
    pad.press(0)
    assert heard(controls) == [(Button.FIRE, device)]
    pad.stick(0.0, -1.0)
    assert heard(controls) == [(Button.UP, device)]
    assert controls.drive(device) == StickState(linear=1.0, fire=True)
    pad.release(0)
    pad.stick(0.0, 0.0)
    pad.hat(1, 0)
    pad.press(9, 5)
    assert sorted(act.name for act, _ in heard(controls)) == ["RIGHT", "START"]
    assert controls.drive(device) == StickState(angular=1.0, turbo=True)
    pad.hat(0, 0)
    heard(controls)
    assert controls.repeats(1.0) == []
    pad.unplug()
    assert heard(controls) == [(Button.LOST, device)]
    assert controls.drive(device) == STILL


def test_a_mapping_file_of_the_community_makes_a_plain_pad_a_known_one(
    controls: Controls, pads: ExitStack, tmp_path: Path
) -> None:
    plug(controls, pads, plain=True)
    guid = pygame.joystick.Joystick(0).get_guid()
    file = tmp_path / "gamecontrollerdb.txt"
    file.write_text(f"{guid},Odd Pad,a:b3,b:b0,start:b11,leftx:a2,lefty:a3,platform:{PLATFORM},\n")
    story = """
import pygame
from pigaming_app.ui.input.controls import Controls
from tests.ui.input.virtual_pad import VirtualPad
pygame.display.init()
with VirtualPad(plain=True) as pad:
    controls = Controls()
    pad.press(3, 11)
    print(*sorted(press.button.name for press in controls.presses(pygame.event.get())), controls.name(controls.last))
"""
    there = {**os.environ, "SDL_GAMECONTROLLERCONFIG_FILE": str(file)}  # SDL reads it once, so use a fresh process
    root = Path(__file__).parents[3]
    said = subprocess.run(
        [sys.executable, "-c", story], env=there, cwd=root, capture_output=True, text=True, check=True
    )
    assert said.stdout.split() == ["FIRE", "START", "Xbox"]


@pytest.mark.parametrize(
    ("name", "usb", "kind", "fire"),
    [
        ("PS4 Controller", PLAYSTATION, "PlayStation", "Cross"),
        ("Nintendo Switch Pro Controller", NINTENDO, "Nintendo", "A"),
        ("Nobody's Gamepad", (0x1234, 0x5678), "Xbox", "A"),
    ],
)
def test_hints_name_the_button_as_it_is_printed(
    controls: Controls, pads: ExitStack, name: str, usb: tuple[int, int], kind: str, fire: str
) -> None:
    pads.enter_context(VirtualPad(name, usb))
    [(_, device)] = heard(controls)
    assert controls.name(device) == kind
    assert controls.label(device, Button.FIRE) == fire
    assert controls.label(None, Button.FIRE) == "SPACE"  # the pad has not been used yet


def test_hints_follow_the_device_used_last(controls: Controls, pads: ExitStack) -> None:
    pad, device = plug(controls, pads)
    pad.press("b")
    heard(controls)
    assert controls.last == device
    assert controls.label(None, Button.BACK) == "B"
    controls.presses([pygame.Event(pygame.KEYDOWN, key=0, scancode=pygame.KSCAN_KP5, mod=0, unicode="")])
    assert controls.label(None, Button.BACK) == "ESC"
    assert controls.label(None, Button.FIRE) == "NUM 0"
    assert controls.moves(controls.last) == "8456"
    assert controls.label(MOUSE, Button.FIRE) == ""
