"""PiTanks' magazine against a second implementation, which keeps the times at which spent shots are loaded again."""

from itertools import pairwise
from random import Random

import pytest

from pigaming_app.games.pitanks.rules import judge
from pigaming_app.games.pitanks.state import MINE, RAPID, TRIPLE
from pigaming_app.sim.world import HZ
from tests.floor import pitanks

BESIDE_A_WALL = (1500.0, 100.0, 0.0)  # its bullets are gone at once, so their number does not hold fire
PAUSE, LOADING = 25, 80  # ticks


class Gun:
    """A gun with five shots; `play` returns 1 for each tick in which it fires."""

    def __init__(self):
        self.loaded, self.ready = [], 0  # ticks at which spent shots are loaded again, in order; next shot at all

    def play(self, tick, fire):
        self.loaded = [at for at in self.loaded if at > tick]
        if not fire or tick < self.ready or len(self.loaded) == 5:
            return 0
        self.loaded.append(max([tick, *self.loaded]) + LOADING)
        self.ready = tick + PAUSE
        return 1


def shots(match, presses):
    """Shots of the first robot in each tick, by the rules."""
    fired = []
    for fire in presses:
        match.actions[0].fire, before = fire, match.tanks[0].shots
        judge(match)
        fired.append(match.tanks[0].shots - before)
    return fired


def presses(random, ticks):
    """FIRE, held and released for random times."""
    held: list[int] = []
    fire = 0
    while len(held) < ticks:
        fire = 1 - fire
        held += [fire] * random.choice((1, 2, 10, 30, 100, 400))
    return held[:ticks]


@pytest.mark.parametrize("variant", ["party", "pickups"])
@pytest.mark.parametrize("seed", range(6))
def test_each_shot_is_fired_in_the_tick_of_the_second_implementation(seed, variant):
    match, gun, held = pitanks([BESIDE_A_WALL], variant=variant), Gun(), presses(Random(seed), 2900)
    fired = shots(match, held)
    assert fired == [gun.play(tick, fire) for tick, fire in enumerate(held)]
    assert sum(fired) > 15


def test_fire_held_is_six_shots_and_then_one_every_1_6_s():
    """The first loads again while the other five are fired."""
    fired = shots(pitanks([BESIDE_A_WALL], variant="party"), [1] * (20 * HZ))
    at = [tick for tick, shot in enumerate(fired) if shot]
    assert at[:6] == [PAUSE * i for i in range(6)]
    assert at[6:] == [LOADING * i for i in range(2, 2 + len(at[6:]))]


@pytest.mark.parametrize("variant", ["original", "plain", "classic"])
def test_other_rules_have_endless_magazines(variant):
    match = pitanks([BESIDE_A_WALL], variant=variant)
    assert sum(shots(match, [1] * (20 * HZ))) == 20 * HZ / PAUSE
    assert match.tanks[0].spent == 0


def test_rapid_fire_empties_a_magazine_in_a_second_and_loads_three_times_as_fast():
    match = pitanks([BESIDE_A_WALL], variant="party")
    match.tanks[0].powers[RAPID] = 8 * HZ + 1
    fired = shots(match, [1] * (8 * HZ))
    at = [tick for tick, shot in enumerate(fired) if shot]
    assert at[:7] == [0, 10, 20, 30, 40, 50, 60]
    assert {b - a for a, b in pairwise(at[7:])} == {LOADING // 3, LOADING // 3 + 1}


def test_three_bullets_at_once_are_one_shot_and_a_mine_is_none():
    match = pitanks([BESIDE_A_WALL], variant="party")
    tank = match.tanks[0]
    tank.powers[TRIPLE] = HZ
    assert shots(match, [1]) == [3]
    assert tank.spent == LOADING
    tank.powers[MINE] = HZ
    assert sum(shots(match, [0] * PAUSE + [1])) == 0
    assert tank.spent == LOADING - PAUSE - 1
    assert match.mines[0].alive


@pytest.mark.parametrize("protected", [0, 38, 100])
def test_an_empty_gun_loads_once_the_robot_no_longer_blinks(protected):
    match = pitanks([BESIDE_A_WALL], variant="party")
    match.tanks[0].spent, match.tanks[0].protected = 5 * LOADING, protected
    fired = shots(match, [1] * 200)
    assert fired.index(1) == LOADING + max(0, protected - 1) - 1
