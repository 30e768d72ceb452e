"""The last hit again, in slow motion: what is recorded, how it is played, and how it is skipped."""

from dataclasses import replace

import pytest

from pigaming_app.games.match import Match
from pigaming_app.games.pitanks.state import OWN_BULLETS
from pigaming_app.scenes.play.ending import FREEZE_SECONDS
from pigaming_app.scenes.play.last_hit import AFTER, BEFORE, SECONDS, LastHit
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import Results
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.sim.record import digest, from_bytes, to_bytes
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import Arcade, setup

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")


def party(minutes=0.05, brains="idle idle off off"):
    return replace(setup(brains, minutes), variant="party")


def strike(match, shooter, victim):
    """A bullet of `shooter` meets `victim` within the next tick."""
    state, robot = match.state, match.state.robots[victim]
    bullet = state.bullets[shooter * OWN_BULLETS]
    bullet.alive, bullet.fresh, bullet.x, bullet.y = 1, 0, robot.x, robot.y - 48.0
    bullet.vx, bullet.vy = 0.0, 560.0


def recorded(match, hits):
    """The recording of a match that is played to its end, with hits of seat 0 on seat 1 in these ticks."""
    hit, states = LastHit(), {}
    while not match.over:
        if match.state.tick + 1 in hits:
            match.state.tanks[1].protected = 0
            strike(match, 0, 1)
        match.tick()
        hit.record(match.state)
        states[match.state.tick] = digest(match.state)
    return hit, states


@pytest.mark.parametrize("hits", [[10, 100], [5], [60, 70]])
def test_the_recording_holds_the_states_around_the_last_hit(hits):
    hit, states = recorded(Match(party()), hits)
    at = hits[-1]
    expected = [states[tick] for tick in range(max(1, at - BEFORE), at + AFTER)]
    assert [digest(from_bytes(type(Match(party()).state), raw)) for raw in hit.snapshots] == expected


def test_a_hit_that_ends_the_match_is_the_last_state():
    match = Match(party())
    end = match.state.rules.ticks + 50  # in overtime
    hit, _ = recorded(match, [end])
    assert match.state.tick == end
    assert len(hit.snapshots) == BEFORE + 1
    assert hit.snapshots[-1] == to_bytes(match.state)


def ended(arcade, hits=(100,), variant="party"):
    """A match scene in the moment after its last tick."""
    scene = MatchScene(arcade.context, replace(party(), variant=variant))
    scene.match.state.rules.overtime = 0
    arcade.open(scene)
    arcade.until(lambda: not scene.opening.countdown.locked)
    while not scene.match.over:
        if scene.match.state.tick + 1 in hits:
            strike(scene.match, 0, 1)
        scene.runner.advance(0.02)
    arcade.frame()
    return scene


def test_the_hit_is_shown_before_the_results_and_changes_nothing(arcade: Arcade) -> None:
    scene = ended(arcade)
    played = digest(scene.match.state)
    arcade.until(lambda: scene.ending.again is not None and scene.ending.again.seconds > 0.0)
    hits = arcade.sounds.heard.count("hit")
    seen = set()
    seconds = 0.0
    while isinstance(arcade.stack.top, MatchScene):
        arcade.frame()
        seconds += 1 / 30
        assert scene.ending.again is not None
        seen.add(scene.ending.again.state.tick)
        if scene.ending.again.state.tick % 10 == 0:
            scene.draw(arcade.screen)
    assert seconds == pytest.approx(SECONDS, abs=0.1)
    assert seen == set(range(100 - BEFORE, 100 + AFTER))
    assert arcade.sounds.heard.count("hit") == hits + 1
    assert digest(scene.match.state) == played
    arcade.shown(WinnersMoment)


def test_any_press_skips_it_after_half_a_second(arcade: Arcade) -> None:
    scene = ended(arcade)
    arcade.until(lambda: scene.ending.again is not None)
    again = scene.ending.again
    assert again is not None
    arcade.press(Button.FIRE)
    arcade.until(lambda: again.seconds > 0.3)
    arcade.press(Button.LEFT)
    arcade.frame()
    assert isinstance(arcade.stack.top, MatchScene)
    arcade.until(lambda: again.seconds > 0.6)
    arcade.press(Button.POINT, Button.LOST)
    arcade.frame()
    assert isinstance(arcade.stack.top, MatchScene)
    arcade.press(Button.LEFT)
    arcade.frame()
    arcade.shown(WinnersMoment)


@pytest.mark.parametrize(("hits", "variant"), [((), "party"), ((100,), "plain")])
def test_without_a_hit_or_by_other_rules_the_results_follow_at_once(arcade: Arcade, hits, variant) -> None:
    scene = ended(arcade, hits, variant)
    assert scene.ending.again is None
    assert arcade.until(lambda: isinstance(arcade.stack.top, WinnersMoment)) <= FREEZE_SECONDS + 1.0


def test_a_stopped_match_shows_nothing_again(arcade: Arcade) -> None:
    scene = arcade.open(MatchScene(arcade.context, party(1.0)))
    arcade.until(lambda: not scene.opening.countdown.locked)
    strike(scene.match, 0, 1)
    arcade.wait(0.5)
    assert scene.match.state.last_hit
    scene.stop()
    arcade.until(lambda: isinstance(arcade.stack.top, Results))
    assert scene.ending.again is None
