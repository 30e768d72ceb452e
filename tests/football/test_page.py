"""docs/football.md agrees with the code: numbers of the rules, levels, inputs, choices, rewards."""

import re
from pathlib import Path
from typing import Any

from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.sim.world import HZ
from pigaming_football import network, training
from pigaming_football.ai import HANDS, STRENGTHS
from pigaming_football.ai.footballer import STAYS
from pigaming_football.start import rules_of
from tests.football.pitch import setup

PAGE = " ".join((Path(__file__).parents[2] / "docs" / "football.md").read_text(encoding="utf-8").split())


def statements():
    """Parts of the page, with the numbers of the code."""
    rules, party = rules_of(setup()), rules_of(setup(variant="party"))
    yield f"| {rules.speed:g} px/s | `speed` |"
    yield f"| {rules.turn_rate:g} rad/s | `turn_rate` |"
    yield f"| {rules.radius:g} px | `radius` |"
    yield f"| {rules.friction:g} px/s² | `friction` |"
    yield f"| {rules.bounce:g}, {rules.robot_bounce:g} | `bounce`, `robot_bounce` |"
    yield f"| {rules.catch_reach:g} px, {rules.catch_angle:g} rad | `catch_reach`, `catch_angle` |"
    yield f"| ×{rules.held_speed:g} | `held_speed` |"
    yield f"| {rules.weakest:g} to {rules.strongest:g} px/s | `weakest`, `strongest` |"
    yield f"| {rules.kick_off:g} px/s | `kick_off` |"
    yield f"| {rules.near:g} px | `near` |"
    yield f"| points of a goal of the team that is behind | {rules.catch_up} | `catch_up` |"
    for name in ("hold", "charge", "cooldown", "celebration", "lonely", "jammed"):
        yield f"| {getattr(rules, name) / HZ:g} s | `{name}` |"
    yield f"ball has {party.mass:g} of the mass, friction {party.friction:g} px/s², and restitution {party.bounce:g}"
    yield f" and {party.robot_bounce:g}. "
    yield f"| share of full speed | {' | '.join(f'{one.speed:.2f}' for one in STRENGTHS)} |"
    yield f"| hasty for | {' | '.join(f'{100 * one.haste:.0f} %' for one in STRENGTHS)} |"
    yield f"goal only if it meets the ball up to {STAYS:g} s sooner"
    yield f"looks at the ball every | {' | '.join(f'{one.reaction / HZ:g} s' for one in STRENGTHS)} |"
    yield f"standard deviation | {' | '.join(f'{one.error:g} rad' for one in STRENGTHS)} |"
    for word, name in (("uses turbo", "turbo"), ("plays together", "passes")):
        yield f"| {word} | {' | '.join('yes' if getattr(one, name) else 'no' for one in STRENGTHS)} |"
    yield f"`hand3` has {HANDS[2].speed:g} of the speed, and an error of {HANDS[2].error:g} rad"
    yield f"a [network](networks.md) of {network.SIZE} inputs"
    yield f"`drive` {', '.join(f'{stick:g}'.replace('-', '−') for stick in network.DRIVES)};"
    yield f"`MultiDiscrete([{', '.join(str(count) for _, count in network.HEADS)}])`"
    reward: Any = TASKS["football"].reward
    habits: Any = TASKS["football"].habits
    yield f"| a point of lead | +{reward.goal:g} |"
    yield f"| +{reward.win:g}, −{-reward.tie:g}, −{-reward.defeat:g} |"
    yield f"| × {reward.first_advance:g}, falling to × {reward.advance:g} |"
    yield f"| × {reward.first_chase:g}, falling to × {reward.chase:g} |"
    yield f"In {100 * habits.late:.0f} % of the matches it sees others and the ball up to {habits.latest:g} s late"
    yield f"Tallies: {', '.join(f'`{name}`' for name in training.TALLIES.names[:2])}"


def test_the_page_says_what_is_so():
    assert [text for text in statements() if text not in PAGE] == []


def test_the_page_lists_the_inputs():
    listed = re.findall(r"\| ((?:`\w+`, )*`\w+`) \| (\d+)(?: each)? \|", PAGE)
    found = [(name, int(count)) for names, count in listed for name in re.findall(r"\w+", names)]
    assert found == [*network.GROUPS]
