"""The arcade's loop: it starts, it survives a scene that fails, it takes a picture, it leaves a settings file."""

import pygame
import pytest

from pigaming_app.scenes.app import App, Options, run
from pigaming_app.scenes.title import Title


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path / "home"))
    yield tmp_path
    pygame.display.quit()


class Broken:
    """A scene that fails when it moves."""

    def entered(self):
        pass

    def on(self, press):
        return None

    def update(self, seconds):
        raise ValueError("on purpose")

    def draw(self, screen):
        pass


def test_it_starts_and_keeps_its_settings(home):
    assert run(Options(headless=True, frames=3, step=1 / 60)) == 0
    assert (home / "home" / "config" / "settings.toml").is_file()


def test_a_picture_of_the_title(home):
    picture = home / "title.png"
    assert run(Options(headless=True, shot=picture, shot_at=0.1, step=1 / 60)) == 0
    assert picture.stat().st_size > 20_000


def test_a_scene_that_fails_gives_way_to_the_title(home):
    shown = []
    options = Options(headless=True, first=lambda house: Broken(), frames=6, step=1 / 60)
    recovered = App._recovered

    def seen(running):
        went_on = recovered(running)
        shown.append(running.stack.top)
        return went_on

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(App, "_recovered", seen)
        assert run(options) == 0
    assert [type(scene) for scene in shown] == [Title]
    assert "on purpose" in (home / "home" / "data" / "pigaming.log").read_text()


def test_a_pointer_that_lies_there_does_not_take_the_focus(home):
    titles = []

    def title(house):
        titles.append(Title(house))
        pygame.event.post(pygame.event.Event(pygame.MOUSEMOTION, pos=(960, 600), rel=(0, 0), buttons=(0, 0, 0)))
        return titles[0]

    run(Options(headless=True, first=title, frames=3, step=1 / 60))
    assert titles[0].focus.name == "pitanks"
