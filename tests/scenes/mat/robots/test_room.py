"""Robots that are wide on their surface: matches have their radius, and arenas that are too tight are not offered."""

import pytest

from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.robot_kinds import DEFAULT
from pigaming_app.hardware.session.real import RealSession
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.mat.before_match import UnavailablePage
from pigaming_app.scenes.mat.mat import SessionMat
from pigaming_app.scenes.mat.robots.match_scene import RealMatch
from pigaming_app.scenes.play.scene import match_of
from pigaming_app.ui.input.events import Button
from tests.matches import setup_of
from tests.scenes.arcade import Arcade

WIDE = DEFAULT._replace(radius_mm=75.0)  # 57 px on the emulated mat
SMALL = 1199.0  # mm, of a field on 65 inches, where a 3pi is 63 px in radius


def test_a_match_has_the_radius_of_its_robots_or_says_why_not(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Rig, "kind", lambda rig, robot: WIDE)
    scene = match_of(arcade.context, setup_of("pitanks", "level3 level3", "classic"), [], (0, 1))
    assert isinstance(scene, RealMatch)
    assert scene.match.state.radius == pytest.approx(75.0 / scene.session.mm, abs=0.06)
    scene.on_leave()
    page = match_of(arcade.context, setup_of("pitanks", "level3 level3", "courtyard"), [], (0, 1))
    assert isinstance(page, UnavailablePage)
    said = arcade.context.words.sentence(page.reason)
    assert said.startswith("Courtyard takes a field at least 2927 mm wide for robots of 150 mm"), said


def test_the_lobby_offers_the_arenas_that_robots_fit_into(arcade: Arcade) -> None:
    settings = arcade.context.settings
    settings.mat, settings.real, settings.arena_mm = True, [1], SMALL
    arcade.context.mat = SessionMat(arcade.context, RealSession(settings))
    arcade.open(Lobby(arcade.context, "pitanks"))
    arcade.press(Button.FIRE, Button.START)
    assert arcade.shown(MatchSetupPage).arenas[:2] == ("islands", "trenches")
    assert "classic" not in arcade.shown(MatchSetupPage).arenas
    arcade.press(Button.BACK)
    settings.arena_mm = 2112.0
    arcade.press(Button.START)
    assert "classic" in arcade.shown(MatchSetupPage).arenas
