"""Fairness: what a lead is worth, by hand and beside matches of the arcade, and what the job prints."""

import json
from dataclasses import replace

import pytest

from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import BRAINS
from pigaming_app.jobs.balance.fairness import EVERY, LEVEL, FairnessOptions, Lead, fairness, leader, leads, run, table
from pigaming_app.sim.kernel import can_compile
from tests.matches import match_of, setup_of

TURNED = Lead((LEVEL, 0, 0, 1, 1), 1)  # 0 leads first and at half time, 1 wins
HELD = Lead((LEVEL, LEVEL, 1, LEVEL, 1), 1)  # one leader, once level
TIE = Lead((0, 1, LEVEL, 1, LEVEL), LEVEL)
LATE = Lead((LEVEL, LEVEL, LEVEL, LEVEL), 0)  # decided by its last tick, after the last sample


def test_a_hand_made_set_of_matches() -> None:
    found = fairness("all", [TURNED, HELD, TIE, LATE], [0, 1])
    assert (found.matches, found.ties, found.wins) == (4, 1, (1, 2))
    assert found.shares == [1 / 3, 2 / 3]
    assert found.turned == 0.5, "one of two with a leader at half time; the others had none, or were a tie"
    assert found.first == 0.5, "one of two, as in the late one nobody led in time"
    assert found.changes == 0.5, "1, 0, 1, 0"


def test_a_set_without_winners() -> None:
    found = fairness("all", [TIE, TIE], [0, 1])
    assert (found.ties, found.wins, found.turned, found.first, found.changes) == (2, (0, 0), 0.0, 0.0, 1.0)


def test_the_line_of_an_arena() -> None:
    head, line = table([fairness("yard", [TURNED, HELD, TIE, LATE], [0, 1])], "team")
    assert head.split() == ["ties", "team", "1", "team", "2", "turned", "first", "changes"]
    shown = "yard 25.0 % 33.3 [6, 79] 66.7 [21, 94] 50.0 % 50.0 % 0.5"  # Wilson's intervals of 1 and 2 in 3
    assert " ".join(line.split()) == shown


def test_who_leads() -> None:
    assert leader({0: 3.0, 1: 2.0}) == 0
    assert leader({0: 3.0, 1: 3.0, 2: 1.0}) == LEVEL
    assert leader({2: -1.0, 3: -4.0}) == 2


@pytest.mark.parametrize(
    ("game", "brains"), [("pitanks", ["random"] * 4), ("race", ["random"] * 2), ("football", ["random"] * 2)]
)
def test_leads_are_those_of_the_same_matches_in_the_arcade(game, brains) -> None:
    setups = [setup_of(game, brains, "", 0.1, seed) for seed in (1, 2)]
    kinds = [BRAINS[game][name] for name in brains]
    for setup, found in zip(setups, leads(setups, Batch(setups, kinds, fast=False)), strict=True):
        match = match_of(game, brains, "", 0.1, setup.seed)
        seen = []
        while not match.over:
            match.tick()
            if match.state.tick % EVERY == 0 and not match.over:
                rows = match.outcome().rows
                best = {row.team for row in rows if row.place == 1}
                seen.append(best.pop() if len(best) == 1 else LEVEL)
        won = match.outcome().winners
        assert found == Lead(tuple(seen), match.state.robots[won[0]].team if won else LEVEL)


@pytest.mark.long
@pytest.mark.again
@pytest.mark.skipif(not can_compile(), reason="needs numba")
def test_compiled_matches_lead_as_plain_ones() -> None:
    setups = [setup_of("race", ["random"] * 4, "", 0.2, seed) for seed in range(4)]
    kinds = [BRAINS["race"]["random"]] * 4
    assert leads(setups, Batch(setups, kinds, fast=True)) == leads(setups, Batch(setups, kinds, fast=False))


def test_the_job_prints_every_arena_and_all(capsys, monkeypatch) -> None:
    monkeypatch.setattr("pigaming_app.jobs.balance.fairness.can_compile", lambda: False)
    options = FairnessOptions(game="pitanks", seats="idle", matches=2, minutes=0.05, variant="plain")
    assert run(replace(options, json=True)) == 0
    rows = json.loads(capsys.readouterr().out)["arenas"]
    assert [row["arena"] for row in rows][-1] == "all"
    assert {(row["ties"], *row["wins"]) for row in rows[:-1]} == {(2, 0, 0, 0, 0)}
    assert rows[-1]["ties"] == 2 * (len(rows) - 1)
    assert run(options) == 0
    assert len(capsys.readouterr().out.splitlines()) == len(rows) + 1
