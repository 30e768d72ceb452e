"""The view of a match: sounds and light of what happens to the ball; texts in all languages."""

import tomllib
from math import cos, pi, sin
from pathlib import Path

import pygame
import pytest

import pigaming_football
from pigaming_app.games.arenas import load
from pigaming_app.scenes.bench.frame_times import AllEffects
from pigaming_app.scenes.views.hud.parts import CLOCK, word_bits
from pigaming_app.scenes.views.preview import fitted
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.scenes.views.style import STYLE
from pigaming_app.ui.i18n import LANGUAGES, Words
from tests.football.pitch import ARENAS, match, put_ball, put_robot

TEXTS = Path(pigaming_football.__file__).parent / "text"


@pytest.fixture
def screen():
    pygame.display.init()
    pygame.font.init()
    return pygame.display.set_mode((1920, 1080))


def view_of(football, language="en"):
    return SCREENS["football"].view(
        football.arena, football.state, ["human", "level1", "level1", "level1"], AllEffects(), Words(language)
    )


def cues(football, view, ticks, fire=()):
    heard = []
    for _ in range(ticks):
        for k in range(4):
            football.state.actions[k].fire = int(k in fire)
        football.game.judge(football.state)
        heard += [name for name, _, _ in view.watch(football.state)]
    return heard


def test_a_goal_is_cheered_in_the_colour_of_who_scored(screen):
    football = match()
    view = view_of(football)
    football.state.ball.out = 0
    view.watch(football.state)
    put_ball(football.state, 1540.0, 450.0, 900.0)
    football.state.ball.touched = 1
    assert "delivered_ice" in cues(football, view, 5)
    assert view.particles.particles
    view.draw(screen, football.state, 1.0, 0.02)
    before = pygame.image.tobytes(screen, "RGB")
    assert view.scorer == 0
    for _ in range(120):
        view.draw(screen, football.state, 1.0, 0.02)
    assert pygame.image.tobytes(screen, "RGB") != before


@pytest.mark.parametrize(("behind", "word"), [(0, "Goal!"), (1, "Goal! It counts two")])
def test_a_goal_of_the_team_behind_is_announced_as_what_it_counts(screen, monkeypatch, behind, word):
    football = match()
    view, said = view_of(football), []
    monkeypatch.setattr(view, "announce", lambda text, *_: said.append(text))
    football.state.ball.out, football.state.robots[1].score = 0, behind
    view.watch(football.state)
    put_ball(football.state, 1540.0, 450.0, 900.0)
    football.state.ball.touched = 1
    cues(football, view, 5)
    assert said == [word]


def test_a_held_ball_that_counts_two_has_rays(screen):
    lights = []
    for behind in (0, 1):
        football = match(present=(0, 1))
        view, state = view_of(football), football.state
        state.ball.out, state.robots[1].score = 0, behind
        put_robot(state, 0, 500.0, 300.0)
        put_ball(state, 565.0, 300.0)
        cues(football, view, 3, fire=(0,))
        assert state.ball.holder == 1
        view.draw(screen, state, 1.0, 0.02)
        at = [(160 + 559 + round(52 * cos(k * pi / 4)), 140 + 300 + round(52 * sin(k * pi / 4))) for k in (1, 2, 6, 7)]
        lights.append(sum(sum(screen.get_at(spot)[:3]) for spot in at))
    assert lights[1] > lights[0] + 600


def test_catch_shot_and_bounce_are_heard(screen):
    football = match(present=(0,))
    view, state = view_of(football), football.state
    state.ball.out = 0
    put_robot(state, 0, 800.0, 200.0, heading=4.712388980384690)
    put_ball(state, 800.0, 135.0)
    view.watch(state)
    assert "lift" in cues(football, view, 30, fire=(0,))
    heard = cues(football, view, 20)
    assert "fire" in heard
    assert "set_down" in heard


def test_the_rolling_ball_turns_and_a_dropped_one_does_not(screen):
    football = match(present=())
    view, state = view_of(football), football.state
    state.ball.out = 0
    put_ball(state, 300.0, 300.0, 400.0)
    cues(football, view, 20)
    assert view.track.rolled > 3.0
    rolled = view.track.rolled
    put_ball(state, 1200.0, 600.0)
    cues(football, view, 2)
    assert view.track.rolled == rolled


@pytest.mark.parametrize("language", LANGUAGES)
def test_overtime_and_goals_have_words_that_fit(screen, language):
    football = match()
    view = view_of(football, language)
    football.state.golden_goal = 1
    view.draw(screen, football.state, 1.0, 0.02)
    words = view.hud.clock_words
    assert words.count("|") == 1
    bits = word_bits(words)
    assert max(image.get_width() for image, _, _ in bits) - 64 <= CLOCK.w - 24
    assert min(image.get_height() for image, _, _ in bits) >= 2 * 24 + 64, "legible"
    for goal in ("football.goal", "football.double_goal"):
        assert view.announcement(view.word(goal), STYLE.teams[0]).image.get_width() < 1200, goal


def test_the_lines_of_the_pitch_reach_the_walls(screen):
    """They are part of the floor, which is drawn again round a wall."""
    football = match(arena="bumpers")
    view = view_of(football)
    for _ in range(20):
        view.draw(screen, football.state, 1.0, 0.02)
    post = min((wall for wall in football.state.walls if wall.ax == wall.bx == 800.0), key=lambda wall: wall.by)
    for y in range(round(post.by + post.half) + 12, 290):
        assert max(screen.get_at((160 + 800, 140 + y))[:3]) > 40, y


@pytest.mark.parametrize("arena", ARENAS)
def test_the_preview_of_a_pitch_shows_how_wide_its_goals_are(screen, arena):
    """Two of them differ in nothing else."""
    pitch, steps = load("football", arena), SCREENS["football"].picture(load("football", arena), 1144, 648, False)
    try:
        while True:
            next(steps)
    except StopIteration as end:
        picture = end.value
    left, top, k = fitted(1144, 648)
    for x, inwards in ((0.0, 1.0), (1600.0, -1.0)):
        for side in (-1.0, 1.0):
            post = round(left + k * (x + 3.0 * inwards)), round(top + k * (450.0 + side * pitch.plan.mouth))
            assert max(picture.get_at(post)[:3]) > 150


def test_all_languages_have_the_same_texts():
    tables = [tomllib.loads((TEXTS / f"{language}.toml").read_text(encoding="utf-8")) for language in LANGUAGES]
    keys = [{(table, key) for table, texts in texts_of.items() for key in texts} for texts_of in tables]
    assert all(each == keys[0] for each in keys)
