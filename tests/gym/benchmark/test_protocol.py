"""An evaluation plays the matches that the arcade plays, tick by tick, whatever the body and the robots."""

import hashlib
from dataclasses import replace

import gymnasium
import pytest

from pigaming_app.ai.ppo.registry import TASKS as TRAININGS
from pigaming_app.ai.ppo.task_file import check_names
from pigaming_app.ai.registry import make_brain
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, make_setup
from pigaming_app.gym import OptionError
from pigaming_app.gym.benchmark import protocol
from pigaming_app.gym.benchmark.tasks import AGENT, MADE, MATCHES, PARTNERS, SEED, SHIPPED, TASKS, Condition
from pigaming_app.sim.drivetrain import Drivetrain, Wheel, to_toml
from pigaming_app.sim.plant import SimPlant
from pigaming_app.sim.record import digest
from pigaming_app.sim.rng import training_seed
from pigaming_app.sim.world import ROBOTS

SLOW = Drivetrain(Wheel(290.0, 0.05), Wheel(240.0, 0.0), 70.0, 0.15, 0.12)
PAIR = Condition((AGENT, "hand1", "hand2", "hand1"), ("islands", "classic"), (0, 1, 0, 1))


def in_the_arcade(task, condition, agent, matches, robot=None):
    """Points and digest of the same matches, each one a `Match` on the arcade's own plant."""
    points, digests = 0.0, []
    for number in range(matches):
        names = [agent if name == AGENT else name for name in condition.seats]
        mine = condition.seats.index(AGENT) ^ (number % 2)
        names = [names[seat ^ (number % 2)] for seat in range(len(names))]
        arena = condition.arenas[number // 2 % len(condition.arenas)]
        seed = SEED + number // 2
        setup = make_setup(task.game, names, arena, task.minutes, seed, task.variant, condition.teams, names)
        match = Match(setup, lambda state: SimPlant(state, (robot,) * ROBOTS) if robot else SimPlant(state))
        for seat, name in enumerate(names):
            match.sit(seat, make_brain(task.game, name, seed * ROBOTS + seat))
        while not match.over:
            match.tick()
        rank = games()[task.game].ranking_key
        lead = rank(match.state, mine) - rank(match.state, mine ^ 1)
        points += 0.5 * (1 + (lead > 0) - (lead < 0))
        digests.append(digest(match.state))
    return points, hashlib.sha256("".join(digests).encode()).hexdigest()


@pytest.mark.parametrize("robot", [None, SLOW])
def test_its_matches_are_those_of_the_arcade(robot, tmp_path, monkeypatch):
    """Also on measured robots: with one robot in the file nothing is drawn."""
    monkeypatch.setattr(protocol, "can_compile", lambda: False)
    monkeypatch.setattr(protocol, "MEASURED", tmp_path / "robots.toml")
    (tmp_path / "robots.toml").write_text(to_toml([SLOW]))
    condition = replace(PAIR, measured=robot is not None)
    task = replace(TASKS["pitanks-duel"], minutes=0.05, conditions={"one": condition})
    found = protocol.evaluate(task, "hand2", matches=4)["one"]
    assert (found.points, found.digest) == in_the_arcade(task, condition, "hand2", 4, robot)
    assert found.wins + found.ties + found.losses == 4


@pytest.mark.long
@pytest.mark.again  # both bodies: test_every_game.py
@pytest.mark.parametrize("name", ["pitanks-partner", "pitanks-robots", "race-duel"])
def test_both_bodies_play_the_same(name, monkeypatch):
    task = replace(TASKS[name], minutes=0.2)
    compiled = protocol.evaluate(task, "net", matches=4)
    monkeypatch.setattr(protocol, "can_compile", lambda: False)
    assert protocol.evaluate(task, "net", matches=4) == compiled


def test_no_training_can_use_what_an_evaluation_plays():
    task = TRAININGS["pitanks"]
    check_names(replace(task, arenas=("surprise-1000",)))
    for arena in MADE:
        with pytest.raises(ChoiceError, match="held back"):
            check_names(replace(task, arenas=(arena,)))
        with pytest.raises(OptionError, match="held back"):
            gymnasium.make("PiTanks-v0", arena=arena)
    assert max(map(training_seed, (0, 10**9))) < 0 < SEED
    conditions = [one for task in TASKS.values() for one in task.conditions.values()]
    assert {arena for one in conditions for arena in one.arenas} == {*MADE, *SHIPPED["pitanks"], *SHIPPED["race"]}
    assert {one.seats[2] for one in TASKS["pitanks-partner"].conditions.values() if one.counts} == {*PARTNERS}
    assert MATCHES % 20 == 0, "each arena, from both sides, equally often"
