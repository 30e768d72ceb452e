"""The list of replays, operated by keys and mouse; saving on the results page."""

from datetime import datetime, timedelta

import pytest

from pigaming_app.games.replay import Replay, to_match
from pigaming_app.scenes.flow.stack import Stack
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.recordings import store
from pigaming_app.scenes.replays.page import CONFIRM_SECONDS, ReplaysPage
from pigaming_app.scenes.replays.view import ROWS, cross_box, row_box
from pigaming_app.scenes.replays.watch import ReplayScene
from pigaming_app.scenes.results.scene import Results
from pigaming_app.scenes.title.scene import Title
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets.button_prompts import places
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.measuring import faults, measuring
from tests.scenes.recordings.test_store import NOON, replay

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")

__all__ = ["replay"]


def opened(arcade: Arcade, replay: Replay, count: int) -> ReplaysPage:
    """The page with so many replays, one a minute."""
    for i in range(count):
        store.save(replay, NOON + timedelta(minutes=i))
    page = ReplaysPage(arcade.context)
    arcade.open(page)
    arcade.wait(0.5)
    return page


def test_the_title_leads_to_it_in_a_kiosk_too(arcade: Arcade) -> None:
    for arcade.context.kiosk in (False, True):
        title = Title(arcade.context)
        arcade.stack = Stack(title)
        arcade.click(*title.focus.rect("replays").center)
        arcade.shown(ReplaysPage)
        arcade.press(Button.FIRE)
        assert arcade.stack.top is title, "there is nothing to play"


def test_fire_plays_the_focused_replay_and_back_returns_to_its_row(arcade: Arcade, replay: Replay) -> None:
    page = opened(arcade, replay, 3)
    arcade.press(Button.DOWN)
    arcade.press(Button.FIRE)
    assert arcade.shown(ReplayScene).replay == replay
    arcade.press(Button.BACK)
    assert arcade.shown(ReplaysPage) is page
    assert page.entry.path == store.paths()[1]
    arcade.wait(0.5)
    arcade.click(*row_box(2).center)
    arcade.shown(ReplayScene)
    arcade.press(Button.BACK)
    arcade.press(Button.BACK)
    assert arcade.stack.top is arcade.setup


def test_pages_turn_around_the_end(arcade: Arcade, replay: Replay) -> None:
    page = opened(arcade, replay, ROWS + 2)
    first = page.entry
    arcade.press(Button.RIGHT)
    arcade.wait(0.2)
    assert page.entry.path == store.paths()[ROWS]
    assert page.entry.read, "files are read when they are shown"
    arcade.press(Button.RIGHT)
    assert page.entry is first
    arcade.press(Button.LEFT)
    assert page.page == 1


def test_deleting_takes_two_presses_in_time(arcade: Arcade, replay: Replay) -> None:
    page = opened(arcade, replay, 2)
    arcade.press(Button.X)
    arcade.shown(ReplaysPage)
    assert len(store.paths()) == 2
    arcade.wait(CONFIRM_SECONDS + 0.1)
    arcade.press(Button.X)
    assert len(store.paths()) == 2, "too late: it asks again"
    arcade.press(Button.DOWN)
    arcade.press(Button.X)
    assert len(store.paths()) == 2, "another row: it asks again"
    victim = page.entry.path
    arcade.press(Button.X)
    assert victim not in store.paths()
    arcade.shown(ReplaysPage)
    x, y = cross_box(0).center
    arcade.click(x, y)
    assert len(store.paths()) == 1
    arcade.click(x, y)
    assert store.paths() == []
    arcade.shown(ReplaysPage)
    arcade.press(Button.X)


def test_in_a_kiosk_nothing_is_deleted(arcade: Arcade, replay: Replay) -> None:
    arcade.context.kiosk = True
    opened(arcade, replay, 1)
    for _ in range(3):
        arcade.press(Button.X)
    assert len(store.paths()) == 1
    arcade.click(*cross_box(0).center)
    arcade.shown(ReplayScene)


def test_a_damaged_file_is_one_line_and_a_vanished_one_a_sentence(arcade: Arcade, replay: Replay) -> None:
    page = opened(arcade, replay, 2)
    (store.folder() / "x.replay").write_bytes(b"noise")
    page.entries = ReplaysPage(arcade.context).entries
    arcade.wait(0.5)
    damaged = next(i for i, entry in enumerate(page.entries) if entry.path.name == "x.replay")
    arcade.click(*row_box(damaged).center)
    assert arcade.sounds.heard[-1] == "error"
    page.entries[1 if damaged == 0 else 0].path.unlink()
    arcade.click(*row_box(1 if damaged == 0 else 0).center)
    assert arcade.shown(ReplaysPage) is page
    assert page.message == arcade.context.words("replays.gone")


@pytest.mark.parametrize("language", LANGUAGES)
def test_texts_keep_off_each_other(
    arcade: Arcade, replay: Replay, monkeypatch: pytest.MonkeyPatch, language: str
) -> None:
    arcade.context.words.switch(language)
    (store.folder()).mkdir(parents=True)
    (store.folder() / f"{'long name ' * 12}.replay").write_bytes(b"noise")
    page = opened(arcade, replay, ROWS)
    with measuring(monkeypatch) as screen:
        for button in (None, Button.X, Button.RIGHT):
            if button:
                arcade.press(button)
            arcade.wait(0.5)
            screen.marks.clear()
            page.draw(screen)
            assert faults(screen) == []


def ended(arcade: Arcade, replay: Replay) -> Results:
    """The results page of a match, ready for input."""
    setup, outcome = replay.setup, to_match(replay).outcome()
    scene = Results(arcade.context, outcome, setup, [KEYS[0], None, None, None], MatchScene, recording=replay)
    scene.age = 9.0
    arcade.open(scene)
    return scene


def test_the_last_match_is_saved_once_from_the_results(arcade: Arcade, replay: Replay) -> None:
    results = ended(arcade, replay)
    assert "Save replay" in [text for _, text in results.prompts.labels]
    arcade.press(Button.UP)
    arcade.press(Button.UP)
    (path,) = store.paths()
    assert store.load(path) == replay
    assert "Save replay" not in [text for _, text in results.prompts.labels]
    arcade.shown(Results)
    assert abs(store.saved_at(path) - datetime.now()) < timedelta(minutes=1)


def test_a_free_device_saves_nothing(arcade: Arcade, replay: Replay) -> None:
    ended(arcade, replay)
    arcade.press(Button.UP, KEYS[1])
    assert store.paths() == []


def test_what_cannot_be_saved_says_so_and_may_be_tried_again(arcade: Arcade, replay: Replay) -> None:
    results = ended(arcade, replay)
    store.folder().parent.mkdir(parents=True, exist_ok=True)
    store.folder().write_text("a file in its place")
    arcade.press(Button.UP)
    assert arcade.sounds.heard[-1] == "error"
    arcade.shown(Results)
    store.folder().unlink()
    arcade.click(
        *next(
            ((left + right) / 2, results.prompts.y)
            for (left, right), button in zip(ends(results), results.prompts.buttons, strict=True)
            if button is Button.UP
        )
    )
    assert len(store.paths()) == 1


def ends(results: Results) -> list[tuple[float, float]]:
    return places(results.prompts.labels, results.prompts.room)
