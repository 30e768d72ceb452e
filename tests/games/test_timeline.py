"""Jumps in a replay lead to exactly the states of the match."""

from time import thread_time

import pytest

from pigaming_app.ai.registry import new_match
from pigaming_app.games.registry import games
from pigaming_app.games.replay import Replay, decode, encode
from pigaming_app.games.setup import make_setup
from pigaming_app.games.timeline import EVERY, Timeline
from pigaming_app.sim.record import digest

LENGTH = 3 * EVERY + 30  # ticks


@pytest.fixture(scope="module", params=games())
def played(request: pytest.FixtureRequest) -> tuple[Replay, dict[int, str], object]:
    """A replay, digests of some of its ticks, and the outcome at its end."""
    brains = ["random"] * 3 + ["hand2"]
    match = new_match(make_setup(request.param, brains, None, 2.0, 4, None, None, ["hand2", "random"]))
    digests = {0: digest(match.state)}
    while match.state.tick < LENGTH:
        match.tick()
        digests[match.state.tick] = digest(match.state)
    return decode(encode(match), "match"), digests, match.outcome()


@pytest.mark.parametrize("explored", [0, EVERY, 2 * LENGTH])
def test_every_jump_leads_to_the_state_of_the_match(played: tuple[Replay, dict[int, str], object], explored: int):
    replay, digests, ended = played
    timeline = Timeline(replay)
    timeline.explore(explored)
    assert timeline.explored == min(explored, LENGTH)
    for tick in (LENGTH, 0, EVERY, EVERY - 1, 2 * EVERY + 77):
        match = timeline.match_at(tick)
        assert match.state.tick == tick
        assert digest(match.state) == digests[tick]
    match = timeline.match_at(EVERY + 3)
    while match.state.tick < LENGTH:
        match.tick()
    assert digest(match.state) == digests[LENGTH]
    assert bytes(match.log.ticks) == replay.ticks
    assert match.outcome() == ended


def test_a_jump_beyond_either_end_stops_there(played: tuple[Replay, dict[int, str], object]) -> None:
    timeline = Timeline(played[0])
    assert timeline.match_at(-500).state.tick == 0
    assert timeline.match_at(10**9).state.tick == LENGTH


def test_a_jump_is_fast_where_the_timeline_is_explored(played: tuple[Replay, dict[int, str], object]) -> None:
    timeline = Timeline(played[0])
    timeline.explore(LENGTH)
    durations = []
    for tick in (LENGTH, LENGTH - 1, EVERY - 1):
        began = thread_time()
        timeline.match_at(tick)
        durations.append(thread_time() - began)
    assert min(durations) < 0.05
