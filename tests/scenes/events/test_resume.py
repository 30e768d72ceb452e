"""A kiosk goes on with the running event after a crash or a power cut, until somebody leaves the event."""

import os
from pathlib import Path

import pytest

from pigaming_app.events import event_files, resume
from pigaming_app.events.spec import Format
from pigaming_app.scenes.app import App
from pigaming_app.scenes.events.choice import EventsPage
from pigaming_app.scenes.events.next_page import INPUT_LOCKOUT, NextMatch
from pigaming_app.scenes.events.podium_page import EventPodiumPage
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.flow.scene import Home, Push
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.start import opened
from pigaming_app.scenes.title.scene import Title
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders
from pigaming_app.ui.input.events import Button, Device, InputEvent
from tests.scenes.events.drawn import an_event, played, running

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")

STEP = 0.1  # s of a frame
KIOSK = Options(headless=True, kiosk=True, step=STEP, changed_settings={"pin_asked": True})
KEYS = Device("keys", 0)


@pytest.fixture(autouse=True)
def data(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    return folders().data


def frames(app: App, seconds: float) -> None:
    for _ in range(round(seconds / STEP)):
        app.compose(STEP)


def press(app: App, button: Button) -> None:
    app.stack.apply(app.stack.top.handle(InputEvent(button, KEYS)))


def shown(options: Options = KIOSK) -> type:
    """The page on which an arcade starts."""
    with opened(options) as app:
        app.compose(STEP)
        return type(app.stack.top)


def test_a_kiosk_starts_on_its_event_until_somebody_leaves_it(data: Path) -> None:
    run = running(an_event())
    with opened(KIOSK) as app:
        app.stack.apply(Push(EventsPage(app.context)))
        frames(app, 0.5)
        assert resume.marked(data) is None, "the list is no event"
        press(app, Button.DOWN)
        press(app, Button.FIRE)
        frames(app, STEP)
        assert resume.marked(data) == run.path
    assert shown() is NextMatch
    assert shown(Options(headless=True, step=STEP)) is Title, "not without --kiosk"
    with opened(KIOSK) as app:
        frames(app, INPUT_LOCKOUT + 0.5)
        assert [type(scene) for scene in app.stack.scenes] == [Title, NextMatch]
        press(app, Button.BACK)
        frames(app, STEP)
    assert resume.marked(data) is None
    assert shown() is Title


def test_a_match_belongs_to_its_event(data: Path) -> None:
    run = running(an_event(brains="level1"))
    resume.mark(data, run.path)
    with opened(KIOSK) as app:
        frames(app, INPUT_LOCKOUT + 0.5)
        press(app, Button.START)
        while not isinstance(app.stack.top, MatchScene):
            frames(app, STEP)
        frames(app, 5.0)
        assert isinstance(app.stack.top, MatchScene)
        assert resume.marked(data) == run.path
        app.stack.apply(Home())  # "end all matches now", a group's time is over
        frames(app, STEP)
    assert resume.marked(data) is None


def test_a_scene_that_fails_leads_back_to_the_event_once(data: Path) -> None:
    resume.mark(data, running(an_event()).path)
    with opened(KIOSK) as app:
        app.compose(STEP)
        assert app._recover()
        assert isinstance(app.stack.top, NextMatch)
        assert app._recover()
        assert isinstance(app.stack.top, Title), "its page may be what fails"


def test_an_event_that_is_over_opens_its_podium(data: Path) -> None:
    resume.mark(data, running(played(an_event(count=3))).path)
    assert shown() is EventPodiumPage


def test_a_power_cut_during_a_save_opens_the_backup(data: Path) -> None:
    run = running(an_event())
    run.change(lambda event: played(event, 1))
    resume.mark(data, run.path)
    run.path.write_text("{", encoding="utf-8")
    with opened(KIOSK) as app:
        app.compose(STEP)
        page = app.stack.top
        assert isinstance(page, NextMatch)
        assert page.running.event == an_event()


@pytest.mark.parametrize("damage", ["file", "mark", "folder", "gone", "other"])
def test_without_its_file_it_is_just_the_title(data: Path, damage: str) -> None:
    path = running(an_event(Format.KNOCKOUT)).path
    resume.mark(data, path)
    match damage:
        case "file":
            path.write_text("{", encoding="utf-8")
        case "mark":
            (data / resume.FILE).write_bytes(b"\xff\x00" + os.urandom(30))
        case "folder":
            resume.mark(data, data)
        case "gone":
            event_files.delete(path)
        case "other":
            path.write_text('{"format": 1, "spec": {}, "journal": []}', encoding="utf-8")
    assert shown() is Title
    assert resume.marked(data) is None


def test_a_full_disk_stops_nothing(data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(data: Path, path: Path, arcade: str) -> None:
        raise NotSaved("the disk is full")

    monkeypatch.setattr(resume, "mark", full)
    run = running(an_event())
    with opened(KIOSK) as app:
        app.stack.apply(Push(NextMatch(app.context, RunningEvent(run.path, run.event))))
        frames(app, 0.5)
        assert isinstance(app.stack.top, NextMatch)
