"""An arcade whose event another computer has: it follows that one, says when it is cut off, and catches up."""

import time
from collections.abc import Callable
from pathlib import Path

import pygame
import pytest

from pigaming_app.events.event_files import save, update
from pigaming_app.events.network.mirror import Host, note
from pigaming_app.scenes.events.feature import LIVE_SECONDS, LinkService
from pigaming_app.scenes.events.next_page import LOOK, NextMatch
from pigaming_app.scenes.events.next_view import THEN_Y
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.ui.draw.layers import LEFT, RIGHT
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.web.server import PageServer
from tests.events.examples import ranked
from tests.scenes.arcade import Arcade
from tests.scenes.events.desk.examples import cup, desk_on
from tests.scenes.events.desk.test_joining import admitted
from tests.scenes.events.drawn import an_event, running
from tests.ui.web.client import LONG, serving

pytestmark = pytest.mark.usefixtures("_no_threads_stay", "_nothing_prewarmed")


def until(reached: Callable[[], object]) -> None:
    end = time.monotonic() + LONG
    while not reached():
        assert time.monotonic() < end
        time.sleep(0.02)


def copied(path: Path, folder: Path, host: Host) -> RunningEvent:
    """The event of a file as another computer runs it."""
    folder.mkdir()
    save(folder / "cup.json", cup(path))
    note(folder / "cup.json", host)
    return RunningEvent(folder / "cup.json", cup(path), arcade="right")


def test_it_follows_the_other_computer_says_when_it_is_cut_off_and_catches_up(arcade: Arcade, tmp_path: Path) -> None:
    path = tmp_path / "cup.json"
    save(path, an_event())
    desk = desk_on(path)
    service = LinkService(arcade.context)
    try:
        with serving(desk) as server:
            host = admitted(server)
            run = copied(path, tmp_path / "there", host)
            page = arcade.open(NextMatch(arcade.context, run))
            page.on_enter()
            service.update(LIVE_SECONDS, arcade.stack)
            until(lambda: cup(path).calls == {1: "right"})
            update(path, lambda event: event.withdraw(event.entrants[3].name))
            until(lambda: cup(run.path).withdrawn)
            arcade.wait(LOOK + 0.2)
            assert run.event.withdrawn
        until(lambda: service._link and service._link.trouble)
        service.update(LIVE_SECONDS, arcade.stack)
        assert run.alone
        arcade.wait(0.1, draw=True)
        fixture = run.event.open[0]
        assert run.change(lambda event: event.record(ranked(fixture, *fixture.entrants)))
        assert not cup(path).outcomes.get(fixture.number)
        again = PageServer(desk, server.address, server.port)
        again.start()
        try:
            until(lambda: cup(path).outcomes.get(fixture.number))
            until(lambda: service._link and not service._link.trouble)
            service.update(LIVE_SECONDS, arcade.stack)
            assert not run.alone
        finally:
            again.stop()
    finally:
        service.close()


def test_an_event_of_this_computer_has_no_link(arcade: Arcade) -> None:
    service = LinkService(arcade.context)
    arcade.open(NextMatch(arcade.context, running(an_event())))
    service.update(LIVE_SECONDS, arcade.stack)
    assert service._link is None


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_page_says_that_it_is_cut_off(arcade: Arcade, language: str) -> None:
    arcade.context.words.switch(language)
    run = running(an_event(count=8, wide=True))
    page = arcade.open(NextMatch(arcade.context, run))
    shown = []
    for run.alone in (False, True, False):
        page.draw(arcade.screen)
        shown.append(pygame.image.tobytes(arcade.screen.subsurface((LEFT, THEN_Y - 30, RIGHT - LEFT, 60)), "RGB"))
    assert shown[0] == shown[2] != shown[1]
