"""A choice that is ruled out changes nothing: each decision is played twice, with and without it."""

import copy

import gymnasium
import numpy as np
import pytest

import pigaming_app.gym  # registers the environments
from pigaming_app.sim.record import digest

FIRE, TURBO = 2, 3  # heads
LATER = pytest.mark.long, pytest.mark.again
CASES = [
    ("PiTanks-v0", "pickups"),
    ("PiTanks-v0", "original"),
    ("RobotRace-v0", "standard"),
    ("RobotFactory-v0", "standard"),
    *(pytest.param("PiTanks-v0", rules, marks=LATER) for rules in ("party", "plain", "classic")),
    *(pytest.param(name, "party", marks=LATER) for name in ("RobotRace-v0", "RobotFactory-v0")),
]


def after(env, action, head):
    """The match after a decision with the choice and without it, apart from the button itself."""
    for pressed in (0, 1):
        twin = copy.deepcopy(env)
        twin.step([*action[:head], pressed, *action[head + 1 :]])
        state = twin.matches.states[0]
        if head == FIRE:
            state.actions[0].fire = 0
            for latch in (getattr(state, "racers", None) or getattr(state, "loads", None) or ())[:1]:
                for name in ("fire_held", "pressed", "refused"):  # what it remembers of the button
                    if hasattr(latch, name):
                        setattr(latch, name, 0)
        else:
            state.actions[0].turbo, state.robots[0].turbo = 0, 0.0  # the meter does not fill while it is held
        yield digest(state)


@pytest.mark.parametrize(("name", "rules"), CASES)
def test_choices_that_are_ruled_out_change_nothing(name, rules):
    chance = np.random.default_rng(7)
    env = gymnasium.make(name, compiled=False, variant=rules, arena="all", minutes=1.0).unwrapped
    env.reset(seed=3)
    in_vain, of_use = {FIRE: 0, TURBO: 0}, {FIRE: 0, TURBO: 0}
    for _ in range(70):
        drive, turn, fire, _ = (chance.integers(n) for n in env.action_space.nvec)
        action = [int(drive) if chance.random() < 0.2 else 2, int(turn), int(fire), int(chance.random() < 0.8)]
        masks = env.action_masks()
        assert masks.shape == (env.action_space.nvec.sum(),)
        assert masks[:-3].all()
        assert masks[-2]
        for head, allowed in ((FIRE, masks[-3]), (TURBO, masks[-1])):
            if not allowed or chance.random() < 0.1:
                without, pressed = after(env, action, head)
                assert allowed or without == pressed, (head, env.matches.states[0].tick)
                in_vain[head] += not allowed
                of_use[head] += allowed and without != pressed
        if env.step(action)[2]:
            env.reset()
    assert in_vain[FIRE]
    assert in_vain[TURBO] or (rules == "party" and name == "RobotRace-v0")
    assert of_use[TURBO] or rules in ("original", "plain", "classic")
    assert of_use[FIRE] or name != "PiTanks-v0"


def test_masks_are_those_of_every_match_and_agent():
    options = {"compiled": False, "agents": 2, "opponents": ()}
    pairs, match = gymnasium.make_vec("PiTanks-v0", 4, **options), pigaming_app.gym.parallel_env("pitanks", **options)
    pairs.reset(seed=3)
    match.reset(seed=4)
    for k in range(4):
        action = np.array([[2, 3, 0, 0], [2, 3, 0, 0], [2, 3, 1, 0], [2, 3, k == 0, 0]], int)
        pairs.step(action)
        match.step({"player_0": action[2], "player_1": action[3]})
        masks = pairs.action_masks()
        assert np.array_equal(masks[2:], np.stack([*match.action_masks().values()]))
        assert masks[:, -3].tolist() == [True, True, False, k > 3]
    with pytest.raises(ValueError, match=r"^action_masks: sticks have no choices"):
        gymnasium.make("PiTanks-v0", compiled=False, continuous=True).unwrapped.action_masks()
