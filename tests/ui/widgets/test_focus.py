"""One focus for pad, keyboard and mouse."""

import pygame
import pytest

from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.focus import GLIDE, Focus, FocusSpot

PAD, MOUSE = Device("pad", 7), Device("mouse")


@pytest.fixture
def focus(controls: object) -> Focus:
    """A title: two tiles above, three chips below."""
    tiles = [FocusSpot(name, pygame.Rect(100 + 600 * i, 100, 500, 400)) for i, name in enumerate(("tanks", "race"))]
    chips = [
        FocusSpot(name, pygame.Rect(100 + 200 * i, 600, 160, 60)) for i, name in enumerate(("how", "options", "quit"))
    ]
    return Focus([*tiles, *chips])


def go(focus: Focus, *acts: Button, repeat: bool = False) -> str:
    for button in acts:
        focus.handle(InputEvent(button, PAD, repeat))
    return focus.name


def test_directions_lead_to_what_lies_there(focus: Focus) -> None:
    assert go(focus, Button.RIGHT) == "race"
    assert go(focus, Button.DOWN) == "quit"
    assert go(focus, Button.LEFT, Button.LEFT) == "how"
    assert go(focus, Button.UP) == "tanks"


def test_past_the_last_comes_the_first_but_not_while_a_key_is_held(focus: Focus) -> None:
    assert go(focus, Button.RIGHT, Button.RIGHT) == "tanks"
    assert go(focus, Button.LEFT, repeat=True) == "tanks"
    assert go(focus, Button.LEFT) == "race"


def test_a_press_into_nothing_changes_nothing(controls: object) -> None:
    alone = Focus([FocusSpot("only", pygame.Rect(0, 0, 10, 10))])
    assert not any(
        alone.handle(InputEvent(button, PAD)) for button in (Button.UP, Button.DOWN, Button.LEFT, Button.RIGHT)
    )
    assert alone.name == "only"


def test_the_mouse_focuses_what_it_points_at_and_a_click_chooses_it(focus: Focus) -> None:
    assert focus.handle(InputEvent(Button.POINT, MOUSE, at=(320.0, 620.0)))
    assert focus.name == "options"
    click = InputEvent(Button.CLICK, MOUSE, at=(320.0, 620.0))
    assert focus.activated(click) == "options"
    beside = InputEvent(Button.CLICK, MOUSE, at=(10.0, 10.0))
    assert not focus.handle(beside)
    assert focus.activated(beside) is None


def test_fire_and_start_choose_what_is_in_focus_and_back_does_not(focus: Focus) -> None:
    assert focus.activated(InputEvent(Button.FIRE, PAD)) == "tanks"
    assert focus.activated(InputEvent(Button.START, PAD)) == "tanks"
    assert focus.activated(InputEvent(Button.BACK, PAD)) is None


def test_the_corners_are_there_after_120_ms_and_most_of_the_way_after_half_of_that(focus: Focus) -> None:
    go(focus, Button.RIGHT)
    assert focus.box.x == 100
    focus.update(GLIDE / 2)
    assert focus.box.x == 100 + round(600 * (1 - 0.5**3))
    focus.update(GLIDE / 2)
    assert focus.box == pygame.Rect(700, 100, 500, 400)
    assert pytest.approx(0.12) == GLIDE


def test_replaced_spots_keep_the_focus_if_it_still_exists(focus: Focus) -> None:
    go(focus, Button.RIGHT)
    focus.set_spots([FocusSpot("race", pygame.Rect(0, 0, 100, 100)), FocusSpot("how", pygame.Rect(0, 200, 100, 100))])
    assert focus.name == "race"
    focus.set_spots([FocusSpot("how", pygame.Rect(0, 200, 100, 100))])
    assert focus.name == "how"
