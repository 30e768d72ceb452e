"""Saved replays: names, the limit, protected files, full disks."""

import os
import time
from datetime import datetime, timedelta
from pathlib import Path

import pytest

from pigaming_app.ai.registry import new_match
from pigaming_app.games.replay import Replay, recorded, verify
from pigaming_app.scenes.recordings import store
from pigaming_app.scenes.recordings.store import LIMIT, StoreError
from tests.disks import failing_at
from tests.scenes.arcade import setup

NOON = datetime(2026, 5, 9, 12, 0, 0)


@pytest.fixture(scope="module")
def replay() -> Replay:
    match = new_match(setup("human level5 off level1", 0.05))
    while not match.over:
        match.tick()
    return recorded(match)


@pytest.fixture(autouse=True)
def _home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))


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


def test_an_unwritable_folder_is_one_sentence(replay: Replay, tmp_path: Path) -> None:
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "replays").write_text("a file in its place")
    assert store.paths() == []
    with pytest.raises(StoreError, match=r"replays\.no_writing"):
        store.save(replay)


def test_deleting_what_has_vanished_is_no_error(replay: Replay) -> None:
    path = store.save(replay)
    store.delete(path)
    store.delete(path)
    assert store.load(path) is None
