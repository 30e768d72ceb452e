"""The first minute: presses from the title to driving, through the main loop, and the keys shown to whoever is new."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pygame
import pytest

from pigaming_app.ai.game_ai import ONE_BUTTON
from pigaming_app.games.registry import games
from pigaming_app.scenes.app import App
from pigaming_app.scenes.flow.used_keys import FIRE, STEER, TURBO, UsedKeys
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.play import first_keys
from pigaming_app.scenes.play.first_keys import BELOW_ROUNDS, CORNERS, HIGH, PRAISE, corners, sign
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.play.side_hints import ROOM
from pigaming_app.scenes.start import opened
from pigaming_app.scenes.title.scene import Title
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, StickState
from tests.cases import repeated
from tests.matches import setup_of
from tests.scenes.arcade import KEYS, Arcade
from tests.ui.input.virtual_pad import VirtualPad

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")
STEP = 1 / 30
PAUSE = 20  # frames after a press, in which a page opens
MOST = 3


class Keyboard:
    """The arrows and Space of a real keyboard, by pygame's events."""

    def hold(self, button: str) -> None:
        self._post(pygame.KEYDOWN, button)

    def let_go(self, button: str) -> None:
        self._post(pygame.KEYUP, button)

    def _post(self, kind: int, button: str) -> None:
        name = {"fire": "SPACE", "right": "D", "left": "A"}[button]
        key, scancode = (
            getattr(pygame, f"K_{name.lower() if len(name) == 1 else name}"),
            getattr(pygame, f"KSCAN_{name}"),
        )
        pygame.event.post(pygame.Event(kind, {"key": key, "scancode": scancode, "mod": 0, "unicode": ""}))


class Pad(VirtualPad):
    """A pad, with the same names of buttons."""

    def hold(self, button: str) -> None:
        self.press({"fire": "a"}.get(button, button))

    def let_go(self, button: str) -> None:
        self.release({"fire": "a"}.get(button, button))


@contextmanager
def plugged(device: str) -> Iterator[Keyboard | Pad]:
    if device == "keyboard":
        yield Keyboard()
        return
    pad = Pad()
    with pad:
        yield pad


def frames(app: App, count: int) -> None:
    for _ in range(count):
        app._frame(STEP)


def pressed(app: App, hands: Keyboard | Pad, button: str, tile: str = "") -> int:
    """One press, held until the focus of the title is on a tile where one is wanted."""
    title = app.stack.scenes[0]
    assert isinstance(title, Title)
    hands.hold(button)
    for _ in range(60):
        frames(app, 1)
        if not tile or title.focus.name == tile:
            break
    hands.let_go(button)
    frames(app, PAUSE)
    return 1


def presses_until_driving(app: App, hands: Keyboard | Pad, game: str) -> int:
    """Presses from the title until the robots of a match drive."""
    title = app.stack.top
    assert isinstance(title, Title)
    frames(app, PAUSE)
    names, count = title.tiles.names, 0
    if title.focus.name != game:
        ahead = (names.index(game) - names.index(title.focus.name)) % len(names)
        count += pressed(app, hands, "right" if ahead < len(names) - 1 else "left", game)
    while not isinstance(app.stack.top, MatchScene):
        count += pressed(app, hands, "fire")
        assert count < 10, type(app.stack.top).__name__
        for _ in range(120):  # whatever goes on by itself
            if not isinstance(app.stack.top, MatchScene):
                frames(app, 1)
    match = app.stack.top
    assert any(device for device in match.devices)
    for _ in range(300):
        if match.match.state.tick == 0:
            frames(app, 1)
    assert match.match.state.tick > 0
    return count


@pytest.mark.long
@pytest.mark.parametrize("device", repeated(["keyboard", "pad"]))
def test_at_most_three_presses_lead_from_the_title_to_driving(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, device: str
) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    counts = {}
    with opened(Options(headless=True, step=STEP)) as app, plugged(device) as hands:
        title = app.stack.top
        assert isinstance(title, Title)
        for _ in ("first", "later"):
            for game in games():
                counts[game] = presses_until_driving(app, hands, game)
                app.stack.scenes[1:] = []
                title.on_enter()
                title.focus.move_to(title.tiles.names[0])
            assert max(counts.values()) <= MOST, counts
            assert counts[title.tiles.names[0]] == 2


def test_a_key_is_shown_until_its_player_has_used_it_and_a_new_player_sees_it_again() -> None:
    used = UsedKeys(None)  # type: ignore[arg-type]
    keys = (STEER, FIRE, TURBO)
    for drive, then in (
        (StickState(), STEER),
        (StickState(linear=0.1), STEER),
        (StickState(angular=-1.0), FIRE),
        (StickState(turbo=True), FIRE),
        (StickState(fire=True), ""),
    ):
        used.note(KEYS[0], drive)
        assert used.next_of(KEYS[0], keys) == then
    assert used.next_of(KEYS[1], keys) == STEER
    used.forget(KEYS[0])
    assert used.next_of(KEYS[0], keys) == STEER


def match_of(arcade: Arcade, game: str, devices: list[Device | None]) -> MatchScene:
    brains = " ".join("human" if device else "idle" for device in devices)
    scene = arcade.open(MatchScene(arcade.context, setup_of(game, brains, minutes=1.0), devices))
    scene.opening.countdown.seconds_left = 0.05
    arcade.until(lambda: scene.match.state.tick > 0)
    return scene


@pytest.mark.parametrize("game", list(games()))
def test_the_keys_follow_one_another_as_they_are_used(arcade: Arcade, game: str) -> None:
    pad, device = arcade.plug()
    scene = match_of(arcade, game, [device, None, None, None])
    shown = scene.first_keys.shown
    assert shown[device] == STEER
    pad.stick(0.0, -1.0)
    arcade.wait(0.2)
    pad.stick(0.0, 0.0)
    assert shown[device] == STEER, "lit for a moment"
    arcade.wait(PRAISE)
    assert shown[device] == (TURBO if game == "race" else FIRE)
    pad.tap("b")
    pad.tap("a")
    arcade.wait(PRAISE + 0.3)
    assert shown[device] == ""


def test_one_button_shows_that_button_only(arcade: Arcade) -> None:
    arcade.context.driving.chosen[KEYS[0]] = ONE_BUTTON
    for game in games():
        scene = match_of(arcade, game, [KEYS[0], None, None, None])
        arcade.context.shared(UsedKeys).forget(KEYS[0])
        scene.first_keys.shown.clear()
        arcade.frame()
        assert scene.first_keys.shown[KEYS[0]] == FIRE


def test_a_rematch_shows_nothing_that_was_used(arcade: Arcade) -> None:
    scene = match_of(arcade, "pitanks", [KEYS[0], None, None, None])
    arcade.context.shared(UsedKeys).note(KEYS[0], StickState(1.0, 1.0, True, True))
    again = arcade.open(scene.again(scene.setup, scene.devices, None))
    assert isinstance(again, MatchScene)
    arcade.wait(0.2)
    assert again.first_keys.shown[KEYS[0]] == ""


@pytest.mark.long
def test_a_sign_covers_no_part_of_the_arena(arcade: Arcade, controls: Controls) -> None:
    scene = match_of(arcade, "pitanks", list(KEYS))
    arcade.frame()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(first_keys.FirstKeys, "draw", lambda *_: None)
        scene.draw(arcade.screen)
        bare = pygame.surfarray.array3d(arcade.screen).astype(int)
    scene.first_keys.draw(arcade.screen)
    changed = np.abs(pygame.surfarray.array3d(arcade.screen).astype(int) - bare).max(2) > 24
    assert changed.any()
    assert not changed[164:1756, 136:].any()


@pytest.mark.parametrize("language", LANGUAGES)
def test_words_and_keys_fit_the_margin(controls: Controls, language: str) -> None:
    pygame.font.init()
    words = Words(language)
    doing = ("hint_drive", "hint_turbo", "hint_fire", "hint_lift", "hint_kick")
    for device in KEYS:
        for button in (Button.FIRE, Button.LEAVE_SEAT):
            for key in doing[1:]:
                image = sign(0, words.key_name(controls.label(device, button)), "", words(f"howto.{key}"), False)
                lit = pygame.surfarray.array3d(image.image).max(2) > 60
                columns, rows = np.nonzero(lit.any(1))[0], np.nonzero(lit.any(0))[0]
                assert columns[0] + image.at[0] >= -ROOM / 2 - 3
                assert columns[-1] + image.at[0] <= ROOM / 2 + 3
                assert rows[-1] + image.at[1] <= HIGH + 3


@pytest.mark.parametrize("rounds", [False, True])
def test_each_robot_has_a_corner_of_its_own_the_nearest_first(rounds: bool) -> None:
    at = corners([(300, 200), (1700, 900), (1700, 250), (300, 950)], rounds)
    assert at == [BELOW_ROUNDS if rounds else CORNERS[0], CORNERS[3], CORNERS[1], CORNERS[2]]
    assert len(set(corners([(300, 200)] * 4, rounds))) == 4


def test_a_show_of_ais_has_no_signs(arcade: Arcade) -> None:
    assert match_of(arcade, "pitanks", [None] * 4).first_keys.shown == {}
