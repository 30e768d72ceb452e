"""Replays: files with a limit, protected ones, full disks; the list of them, and saving on the results page."""

import os
import time
from datetime import datetime, timedelta
from pathlib import Path

import pytest

from pigaming_app.ai.registry import new_match
from pigaming_app.games.replay import Replay, recorded, to_match, verify
from pigaming_app.scenes.flow.scene import Stack
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.recordings import store
from pigaming_app.scenes.recordings.store import LIMIT, StoreError
from pigaming_app.scenes.replays.page import CONFIRM_SECONDS, ReplaysPage
from pigaming_app.scenes.replays.view import ROWS, cross_box, row_box
from pigaming_app.scenes.replays.watch import ReplayScene
from pigaming_app.scenes.results.scene import Results
from pigaming_app.scenes.title.scene import Title
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets.button_prompts import places
from tests.disks import failing_at
from tests.matches import finished
from tests.scenes.arcade import KEYS, Arcade, setup
from tests.scenes.measuring import faults, measuring

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed", "home")

NOON = datetime(2026, 5, 9, 12, 0, 0)


@pytest.fixture(scope="module")
def replay() -> Replay:
    match = finished(new_match(setup("human level5 off level1", 0.05)))
    return recorded(match)


def opened(arcade: Arcade, replay: Replay, count: int) -> ReplaysPage:
    """The page with so many replays, one a minute."""
    for i in range(count):
        store.save(replay, NOON + timedelta(minutes=i))
    page = arcade.open(ReplaysPage(arcade.context))
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
    arcade.press(Button.DOWN, Button.FIRE)
    assert arcade.shown(ReplayScene).replay == replay
    arcade.press(Button.BACK)
    assert arcade.shown(ReplaysPage) is page
    assert page.entry.path == store.paths()[1]
    arcade.wait(0.5)
    arcade.click(*row_box(2).center)
    arcade.shown(ReplayScene)
    arcade.press(Button.BACK, Button.BACK)
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
    arcade.press(Button.DOWN, Button.X)
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
    arcade.press(*[Button.X] * 3)
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
def test_texts_keep_off_each_other(arcade: Arcade, replay: Replay, monkeypatch: pytest.MonkeyPatch) -> None:
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
    arcade.press(Button.UP, device=KEYS[1])
    assert store.paths() == [], "a free device saves nothing"
    assert "Save replay" in [text for _, text in results.prompts.labels]
    arcade.press(Button.UP, Button.UP)
    (path,) = store.paths()
    assert store.load(path) == replay
    assert "Save replay" not in [text for _, text in results.prompts.labels]
    arcade.shown(Results)
    assert abs(store.saved_at(path) - datetime.now()) < timedelta(minutes=1)


def test_what_cannot_be_saved_says_so_and_may_be_tried_again(arcade: Arcade, replay: Replay) -> None:
    results = ended(arcade, replay)
    store.folder().parent.mkdir(parents=True, exist_ok=True)
    store.folder().write_text("a file in its place")
    arcade.press(Button.UP)
    assert arcade.sounds.heard[-1] == "error"
    arcade.shown(Results)
    store.folder().unlink()
    ends = places(results.prompts.labels, results.prompts.room)[results.prompts.buttons.index(Button.UP)]
    arcade.click(sum(ends) / 2, results.prompts.y)
    assert len(store.paths()) == 1


def test_the_name_has_date_game_and_players(replay: Replay) -> None:
    path = store.save(replay, NOON)
    assert path.name == "2026-05-09_12-00-00_pitanks_human-level5-level1.replay"
    assert path.parent == store.folder()
    assert store.saved_at(path) == NOON
    again = store.load(path)
    assert again == replay
    assert again is not None
    assert verify(again)


def test_two_of_the_same_second_are_two_files(replay: Replay) -> None:
    names = {store.save(replay, NOON).name for _ in range(3)}
    assert len(names) == 3
    assert all(store.saved_at(store.folder() / name) == NOON for name in names)


def test_the_latest_comes_first_whatever_its_name(replay: Replay) -> None:
    old, new = store.save(replay, NOON), store.save(replay, NOON + timedelta(days=1))
    foreign = store.folder() / "holiday.replay"
    foreign.write_bytes(old.read_bytes())
    os.utime(foreign, (time.time(), (NOON + timedelta(hours=1)).timestamp()))
    (store.folder() / "notes.txt").write_text("no replay")
    assert store.paths() == [new, foreign, old]


def test_no_folder_no_replays() -> None:
    assert store.paths() == []


def full_folder(replay: Replay) -> list[Path]:
    first = store.save(replay, NOON)
    raw = first.read_bytes()
    for i in range(1, LIMIT):
        when = NOON + timedelta(minutes=i)
        first.with_name(f"{when:{store.DATE}}_pitanks_human-level5-level1.replay").write_bytes(raw)
    return store.paths()


def test_beyond_the_limit_the_oldest_goes_unless_it_is_protected_or_named_by_somebody_else(replay: Replay) -> None:
    paths = full_folder(replay)
    kept = paths[-1]
    kept.chmod(0o444)
    foreign = paths[-2].rename(paths[-2].with_name("mine.replay"))
    os.utime(foreign, (0, NOON.timestamp()))
    store.save(replay, NOON + timedelta(days=1))
    left = store.paths()
    assert len(left) == LIMIT
    assert {kept, foreign} <= {*left}
    assert paths[-3] not in left
    assert {*paths[:-3]} <= {*left}


def test_protected_files_are_never_deleted_so_one_more_is_refused(replay: Replay) -> None:
    paths = full_folder(replay)
    for path in paths:
        path.chmod(0o444)
    with pytest.raises(StoreError, match=r"replays\.all_kept"):
        store.save(replay)
    assert store.paths() == paths


@pytest.mark.parametrize("step", range(1, 4))
def test_a_full_disk_deletes_nothing_and_leaves_nothing(replay: Replay, step: int) -> None:
    store.save(replay, NOON)
    before = sorted(store.folder().iterdir())
    with failing_at(step) as made, pytest.raises(StoreError, match=r"replays\.disk_full"):
        store.save(replay)
    assert len(made) > step
    assert sorted(store.folder().iterdir()) == before


def test_an_unwritable_folder_is_one_sentence(replay: Replay, home: Path) -> None:
    (home / "data").mkdir(parents=True)
    (home / "data" / "replays").write_text("a file in its place")
    assert store.paths() == []
    with pytest.raises(StoreError, match=r"replays\.no_writing"):
        store.save(replay)


def test_deleting_what_has_vanished_is_no_error(replay: Replay) -> None:
    path = store.save(replay)
    store.delete(path)
    store.delete(path)
    assert store.load(path) is None
