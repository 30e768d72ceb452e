"""The pages outside a match: each opens in both languages, survives every input, and every text fits."""

from collections.abc import Callable, Iterator

import pytest

from pigaming_app.scenes.controls import pictures as gadgets
from pigaming_app.scenes.controls.controls_test import ControlsTest
from pigaming_app.scenes.flow.scene import Scene, Stack
from pigaming_app.scenes.howto import scene as howto
from pigaming_app.scenes.howto.scene import HowTo
from pigaming_app.scenes.lobby import match_setup_view as choice
from pigaming_app.scenes.lobby import seat_card as card
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.lobby.seats import LobbySeats
from pigaming_app.scenes.options.page import OptionsPage
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.replays.page import ReplaysPage
from pigaming_app.scenes.title.scene import Title
from pigaming_app.scenes.views import game_tile
from pigaming_app.ui.draw import layers as texts
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets import labels as page
from pigaming_app.ui.widgets import player_card
from pigaming_app.ui.widgets.button_prompts import ButtonPrompts, places
from tests.cases import one_in
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.measuring import empty_cache, lit_boxes
from tests.ui.input.virtual_pad import NINTENDO, PLAYSTATION

SMALLEST = 0.8  # minimum scale of a text
MOUSE = Device("mouse")
PLACES = [(x, y) for x in range(60, 1900, 115) for y in range(40, 1060, 85)]


def filled() -> LobbySeats:
    """Two people, two AIs, two teams."""
    seats = LobbySeats(teams=True)
    for device in KEYS[:2]:
        seats.join(device)
    seats.add_ai()
    seats.add_ai()
    return seats


PAGES: dict[str, Callable[[Arcade], Scene]] = {
    "title": lambda arcade: Title(arcade.context),
    "lobby": lambda arcade: Lobby(arcade.context, "pitanks"),
    "setup": lambda arcade: MatchSetupPage(arcade.context, "pitanks", filled()),
    "options": lambda arcade: OptionsPage(arcade.context),
    "operator": lambda arcade: OptionsPage(arcade.context, operator=True),
    "padtest": lambda arcade: ControlsTest(arcade.context),
    "howto": lambda arcade: HowTo(arcade.context),
    "replays": lambda arcade: ReplaysPage(arcade.context),
}


def top(arcade: Arcade, name: str) -> Scene:
    """Put a page on a stack of its own."""
    arcade.context.kiosk = name == "operator"
    arcade.stack = Stack(PAGES[name](arcade))
    return arcade.stack.top


@pytest.mark.parametrize("language", one_in(2, LANGUAGES))
@pytest.mark.parametrize("name", PAGES)
def test_every_page_survives_every_press_of_every_device(arcade: Arcade, name: str) -> None:
    """A page that led elsewhere is opened anew."""
    _, pad = arcade.plug()
    scene = top(arcade, name)
    for button in Button:
        for device in (*KEYS, pad, MOUSE, Device("pad", 99)):
            at = (960.0, 540.0) if device == MOUSE else None
            left = scene.handle(InputEvent(button, device, at=at)) or scene.update(1 / 60)
            scene = top(arcade, name) if left else scene
    scene.draw(arcade.screen)


@pytest.mark.parametrize("name", PAGES)
def test_a_mouse_may_click_anywhere(arcade: Arcade, name: str) -> None:
    scene = top(arcade, name)
    for at in PLACES:
        scene.handle(InputEvent(Button.POINT, MOUSE, at=at))
        left = scene.handle(InputEvent(Button.CLICK, MOUSE, at=at)) or scene.update(1 / 60)
        scene = top(arcade, name) if left else scene
    scene.draw(arcade.screen)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", one_in(2, PAGES))
def test_every_text_fits_its_place(arcade: Arcade, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    shrunk: dict[str, float] = {}

    def measured(text: str, size: int, width: float, face: str = "head") -> int:
        fits = true_size(text, size, width, face)
        shrunk[text] = min(shrunk.get(text, 1.0), fits / size)
        return fits

    true_size = texts.fit_size
    for module in (card, choice, gadgets, game_tile, howto, page, player_card, texts):
        monkeypatch.setattr(module, "fit_size", measured)
    with empty_cache():
        walk(arcade, top(arcade, name))
    assert {text: share for text, share in shrunk.items() if share < SMALLEST} == {}
    assert shrunk or name in ("padtest", "replays")


def walk(arcade: Arcade, scene: Scene) -> None:
    """Show every row of a page and every state of a seat."""
    for button in (Button.X, Button.Y, *[Button.FIRE] * 2, *[Button.Y] * 2, *[Button.DOWN, Button.RIGHT] * 11):
        if not isinstance(scene, Lobby) and button in (Button.FIRE, Button.Y):
            continue
        scene.handle(InputEvent(button, KEYS[0]))
        scene.update(1 / 60)
        scene.draw(arcade.screen)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", ["lobby", "setup", "options", "padtest"])
@pytest.mark.parametrize("kind", ["keys 0", "keys 1", "keys 3", "Xbox", "PlayStation", "Nintendo", "Joystick"])
def test_the_hints_of_every_device_fit_beside_each_other(arcade: Arcade, name: str, kind: str) -> None:
    if kind.startswith("keys"):
        device = KEYS[int(kind[-1])]
    else:
        usb = {"PlayStation": PLAYSTATION, "Nintendo": NINTENDO}.get(kind, (0x045E, 0x028E))
        _, device = arcade.plug(f"{kind} pad", usb, plain=kind == "Joystick")
    arcade.context.controls.last = device
    scene = top(arcade, name)
    for prompts in hints(scene, device):
        ends = places(prompts.labels, prompts.room)
        assert ends[0][0] >= 72, prompts.labels
        assert ends[-1][1] <= 1848, prompts.labels


def hints(scene: Scene, device: Device) -> Iterator[ButtonPrompts]:
    """All prompt rows of a page."""
    if isinstance(scene, Lobby):
        yield scene.page.prompts
        scene.handle(InputEvent(Button.X, device))
        scene.handle(InputEvent(Button.FIRE, device))
        yield scene.page.prompts
        for _ in range(3):
            scene.handle(InputEvent(Button.Y, device))
        yield scene.page.prompts
    elif isinstance(scene, Page):
        yield scene.prompts


@pytest.mark.parametrize("name", PAGES)
def test_a_page_in_motion_is_painted_all_over_in_every_frame(arcade: Arcade, name: str) -> None:
    scene = top(arcade, name)
    for _ in range(3):
        scene.update(0.3)
    arcade.screen.fill((200, 0, 0))
    scene.draw(arcade.screen)
    corners = [(0, 0), (1919, 0), (0, 1079), (1919, 1079)]
    assert all(arcade.screen.get_at(at)[:3] != (200, 0, 0) for at in corners)
    box = lit_boxes(arcade.screen)
    assert sum(one.w * one.h for one in box) > 20_000
