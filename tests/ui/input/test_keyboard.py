"""One keyboard as four devices, and the mouse."""

import pygame

from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent, StickState

WASD, ARROWS, IJKL, KEYPAD = (Device("keys", number) for number in range(4))
MOUSE = Device("mouse")
STILL = StickState()


def key(code: int, down: bool = True, mod: int = 0) -> pygame.Event:
    """A key event with a keycode of no layout: only its scancode counts."""
    return pygame.Event(pygame.KEYDOWN if down else pygame.KEYUP, key=0, scancode=code, mod=mod, unicode="")


def test_four_drive_on_one_keyboard_at_once(controls: Controls) -> None:
    pressed = (
        pygame.KSCAN_W, pygame.KSCAN_D, pygame.KSCAN_SPACE,
        pygame.KSCAN_DOWN, pygame.KSCAN_RCTRL,
        pygame.KSCAN_J, pygame.KSCAN_O,
        pygame.KSCAN_KP8, pygame.KSCAN_KP4, pygame.KSCAN_KP0, pygame.KSCAN_KP_PLUS,
    )  # fmt: skip
    made = controls.presses(key(code) for code in pressed)
    assert [(event.button, event.device) for event in made] == [
        (Button.UP, WASD), (Button.RIGHT, WASD), (Button.FIRE, WASD),
        (Button.DOWN, ARROWS), (Button.FIRE, ARROWS),
        (Button.LEFT, IJKL), (Button.LEAVE_SEAT, IJKL),
        (Button.UP, KEYPAD), (Button.LEFT, KEYPAD), (Button.FIRE, KEYPAD), (Button.LEAVE_SEAT, KEYPAD),
    ]  # fmt: skip
    assert controls.drive(WASD) == StickState(1.0, 1.0, fire=True)
    assert controls.drive(ARROWS) == StickState(-1.0, 0.0, fire=True)
    assert controls.drive(IJKL) == StickState(0.0, -1.0, turbo=True)
    assert controls.drive(KEYPAD) == StickState(1.0, -1.0, fire=True, turbo=True)
    controls.presses(key(code, down=False) for code in pressed)
    assert all(controls.drive(device) == STILL for device in (WASD, ARROWS, IJKL, KEYPAD))


def test_opposite_keys_cancel_out(controls: Controls) -> None:
    controls.presses([key(pygame.KSCAN_A), key(pygame.KSCAN_D), key(pygame.KSCAN_W)])
    assert controls.drive(WASD) == StickState(linear=1.0)


def test_no_key_sticks_when_the_window_loses_the_focus(controls: Controls) -> None:
    controls.presses([key(pygame.KSCAN_W), key(pygame.KSCAN_SPACE), key(pygame.KSCAN_UP)])
    controls.presses([pygame.Event(pygame.WINDOWFOCUSLOST)])
    assert controls.drive(WASD) == controls.drive(ARROWS) == STILL
    assert controls.repeats(5.0) == []
    assert [event.button for event in controls.presses([key(pygame.KSCAN_W)])] == [Button.UP]


def test_keys_for_the_window_manager_press_nothing(controls: Controls) -> None:
    assert controls.presses([key(pygame.KSCAN_TAB, mod=pygame.KMOD_LALT)]) == []
    assert controls.presses([key(pygame.KSCAN_RETURN, mod=pygame.KMOD_LGUI)]) == []


def test_the_keys_of_all_count_for_the_cluster_used_last(controls: Controls) -> None:
    made = controls.presses([key(pygame.KSCAN_RETURN), key(pygame.KSCAN_UP), key(pygame.KSCAN_ESCAPE)])
    assert [(event.button, event.device) for event in made] == [
        (Button.START, WASD),
        (Button.UP, ARROWS),
        (Button.BACK, ARROWS),
    ]


def test_the_mouse_points_and_clicks_on_the_canvas() -> None:
    pygame.display.init()
    controls = Controls(to_canvas=lambda mouse: (mouse[0] * 2.0, mouse[1] * 2.0))
    motion = pygame.Event(pygame.MOUSEMOTION, pos=(10, 20), rel=(1, 1), buttons=(0, 0, 0))
    buttons = [pygame.Event(pygame.MOUSEBUTTONDOWN, pos=(30, 40), button=button) for button in (1, 2, 4)]
    assert controls.presses([motion, *buttons]) == [
        InputEvent(Button.POINT, MOUSE, at=(20.0, 40.0)),
        InputEvent(Button.CLICK, MOUSE, at=(60.0, 80.0)),
    ]
    assert controls.last == WASD
    assert controls.drive(MOUSE) == STILL
