"""The trash: random deletions and returns against a second account, clocks, full disks, and hostile folders."""

import random
import shutil
from datetime import datetime, timedelta
from pathlib import Path

import pytest

from pigaming_app.events import event_files
from pigaming_app.scenes.editor import store as drawings
from pigaming_app.scenes.lab import saved_robots
from pigaming_app.scenes.recordings import store as replays
from pigaming_app.storage import trash
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders


@pytest.fixture(autouse=True)
def data(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    return folders().data


def write(path: Path, content: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(content)
    return path


def test_everything_that_people_delete_comes_back(data: Path) -> None:
    event = write(data / "events" / "cup.json", "event")
    write(data / "events" / "cup.json.bak", "backup")
    event_files.delete(event)
    drawing = write(drawings.own_file("race", "mine"), "drawing")
    drawings.delete("race", "mine")
    robot = write(saved_robots.file_of("ROBI"), "robot")
    saved_robots.delete_robot("ROBI")
    replay = write(data / "replays" / "a.replay", "replay")
    replays.delete(replay)
    found = trash.deleted()
    assert [one.kind for one in found] == ["replays", "robots", "arenas", "events"]
    assert not any(path.exists() for path in (event, drawing, robot, replay))
    for one in found:
        trash.restore(one)
    assert [path.read_text() for path in (event, drawing, robot, replay)] == ["event", "drawing", "robot", "replay"]
    assert (data / "events" / "cup.json.bak").read_text() == "backup"
    assert [*(data / "trash").rglob("*")] == []


def test_a_drawing_that_is_replaced_by_a_rename_comes_back(data: Path) -> None:
    write(drawings.own_file("race", "mine"), "mine")
    write(drawings.own_file("race", "other"), "other")
    drawings.rename("race", "mine", "other")
    (one,) = trash.deleted()
    assert one.path.read_text() == "other"


def test_an_event_of_another_folder_comes_back_among_the_events(data: Path, tmp_path: Path) -> None:
    event_files.delete(write(tmp_path / "elsewhere" / "cup.json", "event"))
    (one,) = trash.deleted()
    assert trash.restore(one) == data / "events" / "cup.json"


def test_what_is_gone_is_deleted_already(data: Path) -> None:
    trash.discard(data / "events" / "none.json", "events")
    assert trash.deleted() == []
    assert not data.exists()


@pytest.mark.parametrize("seed", range(8))
def test_random_deletions_and_returns_lose_nothing(data: Path, seed: int) -> None:
    """The second account: the contents, each either at a place or in the trash, never twice."""
    rng, contents = random.Random(seed), set()
    for step in range(60):
        files = [path for path in data.rglob("*.npz") if "trash" not in path.parts]
        act = rng.random()
        if act < 0.4:
            path = saved_robots.file_of(rng.choice(("ROBI", "ABCDEF", "A")))
            if not path.exists():
                contents.add(write(path, f"{step}").read_text())
        elif act < 0.75 and files:
            trash.discard(rng.choice(files), "robots")
        elif found := trash.deleted():
            restored = trash.restore(rng.choice(found))
            assert saved_robots.is_name(restored.stem)
        assert sorted(path.read_text() for path in data.rglob("*.npz")) == sorted(contents)


@pytest.mark.parametrize(("days", "left"), [(0, 1), (29, 1), (30, 1), (31, 0), (400, 0)])
def test_it_is_kept_for_thirty_days(data: Path, days: int, left: int) -> None:
    trash.discard(write(data / "replays" / "a.replay", "a"), "replays")
    trash.empty(datetime.now() + timedelta(days=days, minutes=-1))
    assert len(trash.deleted()) == left


def test_a_clock_that_was_never_set_costs_nothing(data: Path) -> None:
    """A board without a clock stamps 1970; an hour backwards is as harmless."""
    write(data / "trash" / "19700101-000012-000000" / "events" / "cup.json", "event")
    now = datetime(2026, 11, 29, 12)
    for hours in (0, -1, 24):
        trash.empty(now + timedelta(hours=hours))
        assert [one.name for one in trash.deleted()] == ["cup"]
    trash.empty(now + timedelta(days=31))
    assert trash.deleted() == []


def test_it_is_emptied_for_good(data: Path) -> None:
    trash.discard(write(data / "replays" / "a.replay", "a"), "replays")
    trash.empty()
    assert trash.deleted() == []


def test_strange_folders_are_left_alone(data: Path, tmp_path: Path) -> None:
    outside = write(tmp_path / "outside" / "precious.txt", "x")
    (data / "trash").mkdir(parents=True)
    for name in ("20261399-000000-000000", "notes", "20261129-101010-00000x"):
        write(data / "trash" / name / "events" / "cup.json", "x")
    (data / "trash" / "20200101-000000-000000").symlink_to(outside.parent)
    assert [one.name for one in trash.deleted()] == []
    trash.empty()
    trash.empty(datetime.now())
    assert outside.exists()
    assert len([*(data / "trash").iterdir()]) >= 3


def test_a_failure_leaves_the_file(data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = write(data / "replays" / "a.replay", "a")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(shutil, "move", full)
    with pytest.raises(NotSaved, match="not deleted"):
        trash.discard(path, "replays")
    assert path.exists()
