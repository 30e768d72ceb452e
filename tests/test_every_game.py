"""Properties of every game on each of its arenas; a game in games() is tested without further registration."""

import os
from itertools import product
from math import isfinite

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")

import pytest

from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import AIS, BRAINS, make_brain
from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.game import ALONE, Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.sim.record import digest, numbers
from pigaming_app.sim.things.spec import ThingSpec, Use, written
from tests.cases import one_in

SQUARE = ((0.0, 0.0), (50.0, 0.0), (50.0, 50.0), (0.0, 50.0))
EVERY_VARIANT = [(game, variant) for game, rules in games().items() for variant in rules.variants]
EVERY_ARENA = [(game, arena) for game in games() for arena in arenas(game)]
THINGS = {
    game: [ThingSpec(Use(use), tuple((x + u, y + v) for u, v in SQUARE), 4.0) for use, x, y in things]
    for game, things in {
        "pitanks": (("wall", 300, 450), ("mud", 800, 640), ("line", 500, 300)),
        "factory": (("wall", 800, 380), ("mud", 420, 120), ("line", 500, 800)),
        "race": (("wall", 790, 110), ("mud", 300, 180), ("line", 1300, 780)),
    }.items()
}
BY_HAND = {"pitanks": "fsm", "factory": "hand3", "race": "hand3"}
TWINS_TICKS = 20_000  # over all matches of the comparison of the two bodies


def setup(game, arena=None, seed=1, variant=None, minutes=0.2, teams=None):
    """A setup with the highest goal, so that only time ends the match."""
    rules = games()[game].variants[variant or games()[game].default.name]
    one, two, three, four = (Seat("random", team) for team in teams or rules.teams)
    goal = max(rules.goals, default=0)
    return Setup(game, arena or arenas(game)[0], (one, two, three, four), minutes, seed, rules.name, goal)


def companies():
    """Every arena with each team assignment of its game."""
    for game, arena in EVERY_ARENA:
        yield game, arena, games()[game].default.teams
        if games()[game].default.team_mode != ALONE:
            yield game, arena, (0, 0, 1, 1)


def company(game, by_hand=False):
    """Brains for the four seats: the best one, or a machine by hand, if any, and random ones."""
    kinds = BRAINS[game]
    best = kinds[BY_HAND.get(game, "random")] if by_hand else kinds[AIS[game].chauffeur]
    return [best, kinds["random"], kinds["random"], kinds["random"]]


def with_things(game, folder):
    """The file of the game's first arena with a box, mud and a line on it."""
    path = folder / "things.toml"
    path.write_text(load(game, arenas(game)[0]).source + written(THINGS.get(game, THINGS["pitanks"])), encoding="utf-8")
    return path


def played(setup, brains=("random",) * 4):
    match = Match(setup)
    for seat, brain in enumerate(brains):
        match.sit(seat, make_brain(setup.game, brain, setup.seed * 4 + seat))
    while not match.over:
        match.tick()
    return match


@pytest.mark.parametrize("game", games())
def test_the_same_seed_is_the_same_match_and_another_is_another(game):
    one, same, other = (played(setup(game, seed=seed)) for seed in (1, 1, 2))
    assert digest(one.state) == digest(same.state)
    assert digest(one.state) != digest(other.state)


@pytest.mark.parametrize(("game", "arena"), EVERY_ARENA)
def test_a_random_match_ends_when_its_time_is_up(game, arena):
    ends_in_time(played(setup(game, arena)))


@pytest.mark.parametrize(("game", "variant"), EVERY_VARIANT)
def test_every_rule_set_ends_in_its_time_and_overtime(game, variant):
    ends_in_time(played(setup(game, variant=variant, teams=games()[game].variants[variant].teams)))


def ends_in_time(match):
    """By its minutes; only a rule set with overtime may exceed them."""
    over = match.seconds - 60 * match.setup.minutes
    assert -1e-6 < over <= games()[match.setup.game].variants[match.setup.variant].overtime + 1e-6
    assert match.outcome().rows[0].place == 1
    assert all(isfinite(number) for number in numbers(match.state))


BODIES = [  # compiling takes long
    pytest.param(*one, marks=[] if one == ("pitanks", False) else [pytest.mark.long, pytest.mark.again])
    for one in product(games(), (False, True))
]


@pytest.mark.parametrize(("game", "by_hand"), BODIES)
def test_both_bodies_play_the_same_match_to_the_last_bit(game, by_hand, tmp_path):
    names = [*arenas(game), str(with_things(game, tmp_path))]
    variants = [*games()[game].variants] * 2
    setups = [
        setup(game, name, seed, variant, minutes=60.0)
        for name in names
        for seed, variant in enumerate(variants, start=1)
    ]
    each = -(-TWINS_TICKS // len(setups))
    brains = company(game, by_hand)
    plain, fast = (Batch(setups, brains, fast) for fast in (False, True))
    for batch in (plain, fast):
        batch.play(each)
    assert sum(state.tick for state in plain.matches) >= TWINS_TICKS
    assert [digest(row) for row in fast.matches] == [digest(state) for state in plain.matches]
    for rows, minds in zip(fast.minds, plain.minds, strict=True):
        assert [digest(row) for row in rows] == [digest(mind) for mind in minds]
    assert any(any(scores) for scores in plain.scores())
    for i in range(0, len(setups), 3):
        alone = Batch([setups[i]], brains, fast=True)
        alone.play(each)
        assert digest(alone.matches[0]) == digest(fast.matches[i])


@pytest.mark.parametrize("game", games())
def test_a_match_of_a_batch_is_that_match_alone(game):
    """Plain; the compiled loop in the test above."""
    setups = [setup(game, seed=seed, variant=variant) for seed, variant in enumerate(games()[game].variants, start=3)]
    together = Batch(setups, company(game), False)
    together.play(300)
    for i, one in enumerate(setups):
        alone = Batch([one], company(game), False)
        alone.play(300)
        assert digest(alone.matches[0]) == digest(together.matches[i])


@pytest.mark.parametrize("game", games())
def test_a_batch_is_the_match_that_people_see(game):
    """The rollout and `Match` are two loops over the same rules."""
    match = played(setup(game, seed=9))
    batch = Batch([setup(game, seed=9)], [BRAINS[game]["random"]] * 4, False)
    batch.play(max(600, match.state.tick))  # overtime included
    assert digest(batch.matches[0]) == digest(match.state)


@pytest.mark.parametrize(("game", "arena", "teams"), list(companies()))
def test_every_number_of_every_view_is_finite(game, arena, teams):
    match = Match(setup(game, arena, teams=teams))
    for seat in range(4):
        match.sit(seat, make_brain(game, "random", seat))
    rules = games()[game]
    eyes, view = rules.senses(), rules.observation()
    while not match.over:
        match.tick()
        if match.state.tick % 20 == 0:
            before = digest(match.state)
            for seat in range(4):
                rules.observe(match.state, seat, eyes, view)
                assert all(isfinite(number) for number in numbers(view))
            assert digest(match.state) == before, "looking changes nothing"


@pytest.mark.parametrize(("game", "arena"), one_in(2, EVERY_ARENA))
def test_every_match_draws_headless_and_drawing_changes_nothing(game, arena):
    import pygame

    from pigaming_app.scenes.views.registry import SCREENS

    assert game in SCREENS, f"{game} has no view: add it to scenes.views.registry.SCREENS"
    from pigaming_app.scenes.bench.frame_times import AllEffects

    pygame.display.init()
    pygame.font.init()
    screen = pygame.display.set_mode((1920, 1080))
    match = Match(setup(game, arena))
    scene = SCREENS[game].view(match.arena, match.state, ["level1", "random", "random", "random"], AllEffects(), None)
    for seat in range(4):
        match.sit(seat, make_brain(game, "random", seat))
    screen.fill((1, 2, 3))
    blank = pygame.image.tobytes(screen, "RGB")
    for _ in range(100):
        match.tick()
        before = digest(match.state)
        scene.watch(match.state)
        if match.state.tick % 25 == 0:
            scene.draw(screen, match.state, 0.5, 0.02)
        assert digest(match.state) == before
    assert pygame.image.tobytes(screen, "RGB") != blank


def test_a_game_without_a_view_fails(monkeypatch):
    monkeypatch.setitem(games(), "unseen", games()["pitanks"])
    with pytest.raises(AssertionError, match="unseen has no view"):
        test_every_match_draws_headless_and_drawing_changes_nothing("unseen", arenas("pitanks")[0])
