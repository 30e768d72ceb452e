"""Explanations of brains: consistent with their actions, plain values, without side effects on the match."""

from collections.abc import Iterator, Mapping
from math import isfinite, pi

import pytest

from pigaming_app.ai.brain.kind import BrainPlayer, no_weights
from pigaming_app.ai.brain.thoughts import BULLET, GOAL, OPPONENT, PETALS, WALL, Thoughts, blend, petal, towards
from pigaming_app.ai.explanations.registry import explain_of, thoughts_of
from pigaming_app.ai.factory.mind import PERIOD
from pigaming_app.ai.pitanks import fsm, gunner
from pigaming_app.ai.qlearning.features import NONE, SECTORS, state
from pigaming_app.ai.qlearning.recipe import Recipe
from pigaming_app.ai.qlearning.table import ACTIONS, MOVES, Learned, QTable, player, set_recipe
from pigaming_app.ai.race import racer
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.factory.state import INPUT, RAW, A
from pigaming_app.games.match import Match
from pigaming_app.games.registry import OURS
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.plugins.parts import plugins
from pigaming_app.ui.i18n import texts
from tests.matches import match_of, mind_of, run

ALL = [
    (game, name)
    for game, brains in BRAINS.items()
    for name in brains
    if explain_of(brains[name], game) or game in OURS  # those of ours must
]
KEPT = 0.9  # value of the second best move, as a share of the best


def taught(best: int = MOVES.index((1.0, 1.0, 1)), reward: float = 10.0) -> BrainPlayer:
    """A player whose table has the same best move in every state, and a second best nearly as good."""
    table = QTable()
    set_recipe(table, Recipe())
    for k in range(0, len(table.q), ACTIONS):
        table.q[k + best], table.q[k + (best + 1) % ACTIONS] = reward, KEPT * reward
        table.n[k + best] = 7
    return BrainPlayer(player("taught", Learned(table)), seed=1)


def play(game: str, *brains: str, seed: int = 1, variant: str = "") -> Match:
    """A match with these brains on its first seats."""
    return match_of(game, brains, "", 2.0, seed, variant)


def by_hand(game: str, besides: str = "") -> list[str]:
    """A brain of the game without learned weights, another one than `besides`, which explains itself."""
    kinds = {name: kind for name, kind in BRAINS[game].items() if explain_of(kind, game) and kind.weights is no_weights}
    return [next(name for name in kinds if name not in ("idle", "random", besides))]


def thoughts(match: Match, seat: int = 0) -> Thoughts:
    told = thoughts_of(match, seat)
    assert told is not None
    return told


# ------------------------------------------------------------------------------------------------------- all of them


def line_ups() -> Iterator[tuple[str, list[str]]]:
    """All brains of each game and two of Auto, four at a time; the last few with one made by hand."""
    for game in BRAINS:
        names = [*(name for other, name in ALL if other == game), "auto1", "auto9"]
        for k in range(0, len(names), ROBOTS):
            yield game, [*names[k:], *by_hand(game) * ROBOTS][:ROBOTS]


LINE_UPS = list(line_ups())


@pytest.mark.parametrize("ticks", [300, pytest.param(1500, marks=pytest.mark.long)])
@pytest.mark.parametrize(("game", "brains"), LINE_UPS)
def test_a_match_plays_out_alike_whether_anybody_asks_or_not_and_what_is_told_has_words(game, brains, ticks):
    """With `explain` called for every seat, match and minds stay bit-identical."""
    words, watched, alone = texts("en"), play(game, *brains, seed=3), play(game, *brains, seed=3)
    for tick in range(ticks):
        if tick % 3 == 0:
            for seat in range(ROBOTS):
                check(thoughts(watched, seat), words)
        watched.tick()
        alone.tick()
    assert digest(watched.state) == digest(alone.state)
    for seat in range(ROBOTS):
        assert digest(mind_of(watched, seat)) == digest(mind_of(alone, seat))


def check(told: Thoughts, words: Mapping[str, str]) -> None:
    words[f"brain.{told.behaviour}"].format(**told.names)
    if told.reason:
        words[f"brain.because_{told.reason}"].format(**told.names)
    assert len(told.petals) == PETALS
    assert all(-1.0 <= value <= 1.0 for value in told.petals)
    assert all(0.0 <= value <= 1.0 for value in told.utilities.values())
    assert all(-1.0 <= value <= 1.0 for value in told.moves.values())
    assert all(isfinite(value) for value in told.facts.values())
    assert all(isfinite(sight.x) and isfinite(sight.y) for sight in told.percepts)
    assert not (told.utilities and told.moves)
    if told.chosen:
        assert told.chosen in told.utilities or told.chosen in told.moves


def test_no_text_is_written_that_no_brain_says():
    """Each key of the table [brain] occurs in the sources of a brain or of the overlay."""
    from pigaming_app import ASSETS

    package = ASSETS.parent / "pigaming_app"
    files = [file for room in ("ai", "scenes/brain", "scenes/play") for file in (package / room).rglob("*.py")]
    files += [file for plugin in plugins() for file in plugin.folder.rglob("*.py")]
    sources = "\n".join(file.read_text(encoding="utf-8") for file in files)
    keys = [key.removeprefix("brain.") for key in texts("en") if key.startswith("brain.")]
    assert len(keys) > 40
    for key in keys:
        said = key.removeprefix("because_").removeprefix("looks_").removesuffix("_one")  # looks_TOPIC; the singular
        assert f'"{said}"' in sources or f'"brain.{said}"' in sources, key


def test_before_its_first_look_nobody_knows_anything():
    for game, name in ALL:
        if name not in ("idle", "random"):
            assert thoughts(play(game, name, *by_hand(game))).behaviour == "starts"


def test_a_rose_points_where_it_is_told_to():
    assert max(range(PETALS), key=lambda k: towards(pi / 2)[k]) == 4 == petal(pi / 2)
    assert petal(-0.05) == 0
    assert petal(-pi / 8) == PETALS - 1
    both = blend(towards(0.0), towards(pi, -2.0))
    assert (both[0], both[8]) == (1.0, -1.0)


# ------------------------------------------------------------------------------------------------------------ PiTanks


@pytest.mark.parametrize(("lead", "state", "reason"), [(3, fsm.DEFEND, "ahead"), (-3, fsm.ATTACK, "behind")])
def test_who_leads_hides_and_who_is_behind_hunts(lead, state, reason):
    match = play("pitanks", "fsm", "idle", variant="plain")
    match.state.robots[0].score = lead
    run(match, 20)
    told = thoughts(match)
    assert told.facts["state"] == state
    assert told.facts["lead"] == lead
    assert told.reason == reason
    assert told.chosen == ("cover" if lead > 0 else "attack")
    assert told.utilities[str(told.chosen)] == 1.0


def test_the_pull_out_of_cover_grows_while_nobody_shows():
    match = run(play("pitanks", "fsm", "idle", variant="plain"), 20)
    mind = mind_of(match)
    for waited, pull in ((0, 0.0), (mind.patience // 2, 0.5), (mind.patience, 1.0), (3 * mind.patience, 1.0)):
        mind.unseen = waited
        utilities = thoughts(match).utilities
        assert (utilities["attack"], utilities["cover"]) == pytest.approx((pull, 1.0 - pull), abs=0.01)
    mind.seen, mind.state, mind.unseen = 0, fsm.ATTACK, mind.patience + 1
    assert (thoughts(match).behaviour, thoughts(match).reason) == ("hunt", "nobody")


def test_a_goal_is_where_it_is_going_and_a_sight_where_it_believes_the_other_to_be():
    match = run(play("pitanks", "fsm", "fsm", seed=2), 60)
    mind, told = mind_of(match), thoughts(match)
    seen = {sight.kind: sight for sight in told.percepts}
    assert (seen[OPPONENT].x, seen[OPPONENT].y) == (mind.obs.others[0].x, mind.obs.others[0].y)
    if GOAL in seen:
        assert (seen[GOAL].x, seen[GOAL].y) == (mind.senses.route.goal_x, mind.senses.route.goal_y)
    assert told.names["player"] == 2


def test_it_says_that_it_dodges_exactly_when_it_would():
    match = run(play("pitanks", "fsm", "idle", variant="plain"), 10)
    view, said = mind_of(match).obs, []
    for threat, bearing in ((9.0, 0.0), (0.5, pi / 2), (0.5, 0.0), (0.69, 0.4)):
        view.threat, view.threat_bearing, view.threat_side = threat, bearing, 5.0
        action = match.state.actions[0]
        action.linear = 0.25
        before = digest(match.state)
        said.append((thoughts(match).behaviour == "dodge", thoughts(match).rose[petal(bearing)] < 0.5))
        assert digest(match.state) == before
        fsm.dodge(view, action)
        assert said[-1][0] == (action.linear != 0.25)
    assert (True, True) in said


def test_it_knows_that_it_is_stuck():
    match = run(play("pitanks", "fsm", "idle"), 20)
    mind = mind_of(match)
    mind.stuck_ticks = fsm.STUCK_TICKS // 2
    assert thoughts(match).utilities["free"] == pytest.approx(0.5)
    mind.state = fsm.BREAK_FREE
    told = thoughts(match)
    assert (told.behaviour, told.reason, told.chosen) == ("free", "stuck", "free")


def gunner_in_fight(brain: str = "hand3", variant: str = "party") -> Match:
    """A gunner on seat 0 that has noticed an idle robot 400 px in front of it, in the open, with its gun ready."""
    match = play("pitanks", brain, "idle", variant=variant)
    one, two = match.state.robots[0], match.state.robots[1]
    one.x, one.y, one.heading = 600.0, 600.0, 0.0
    two.x, two.y = 1000.0, 600.0
    return run(match, 40)


@pytest.mark.parametrize(
    ("change", "behaviour", "reason"),
    [
        ({}, "duel", "sees"),
        ({"others.0.bounty": 1}, "duel", "bounty"),
        ({"others.0.lit": 1}, "duel", "lit"),
        ({"finale": 1}, "duel", "finale"),
        ({"overtime": 1, "finale": 1}, "duel", "overtime"),
        ({"others.0.protected": 60}, "swing", "immune"),
        ({"knocked_out": 10}, "out", "hit"),
        ({"threat": 0.4, "threat_bearing": pi / 2}, "dodge", "bullet"),
        ({"threat": 0.4, "threat_bearing": pi / 2, "protected": 50}, "duel", "sees"),
    ],
)
def test_a_gunner_gives_the_reason_of_its_behaviour(change, behaviour, reason):
    match = gunner_in_fight()
    mind = mind_of(match)
    mind.state, mind.shot, mind.obs.threat, mind.obs.protected = gunner.FIGHT, 500, 9.0, 0
    mind.obs.others[0].protected = 0
    for path, value in change.items():
        *parts, name = path.split(".")
        setattr(mind.obs.others[0] if parts else mind.obs, name, value)
    told = thoughts(match)
    assert (told.behaviour, told.reason) == (behaviour, reason)
    assert told.names["player"] == 2


def test_a_gunner_swings_aside_after_a_shot_and_only_hand1_watches_it():
    for brain, first in (("hand1", "watch"), ("hand3", "swing")):
        match = gunner_in_fight(brain)
        mind = mind_of(match)
        mind.state, mind.shot, mind.obs.others[0].protected, mind.obs.threat = gunner.FIGHT, 0, 0, 9.0
        assert thoughts(match).behaviour == first
        assert ("wait" in thoughts(match).utilities) == (brain == "hand1")
        mind.shot = mind.watch
        assert (thoughts(match).behaviour, thoughts(match).reason) == ("swing", "reloads")
        mind.shot = mind.watch + mind.swing
        assert thoughts(match).behaviour == "duel"


def test_a_gunner_hunts_whoever_leads():
    match = run(play("pitanks", "hand2", "idle", variant="plain"), 20)
    for lead in (-5, 0, 5):
        match.state.robots[0].score = lead
        run(match, 10)
        told = thoughts(match)
        assert (told.behaviour, told.reason, told.chosen) == ("hunt", "nearest", "attack")
        assert told.facts["lead"] == lead


# --------------------------------------------------------------------------------------------------------------- race


def test_a_driver_who_has_missed_a_line_says_that_it_goes_back():
    match = run(play("race", "hand3", "hand1"), 100)
    mind = mind_of(match)
    mind.obs.past, mind.obs.return_x, mind.obs.return_y = 2 * racer.SLACK, 321.0, 123.0
    told = thoughts(match)
    assert (told.behaviour, told.reason, told.chosen) == ("return", "missed", "back")
    assert [(sight.x, sight.y) for sight in told.percepts if sight.kind == GOAL] == [(321.0, 123.0)]


def test_who_has_finished_is_not_stuck_though_nothing_moves_it_any_more():
    match = run(play("race", "hand3", "hand1"), 100)
    mind = mind_of(match)
    mind.obs.finished, mind.state = 1, racer.BREAK_FREE
    assert (thoughts(match).behaviour, thoughts(match).reason) == ("done", "finish")


def test_a_driver_makes_way_to_the_side_on_which_it_passes():
    match = run(play("race", "hand3", "hand1"), 100)
    mind = mind_of(match)
    mind.obs.past, own = -100.0, mind.line * mind.obs.ahead.ideal
    for aside, behaviour in ((-60.0, "pass_left"), (60.0, "pass_right"), (0.0, None)):
        mind.lane = own + aside
        told = thoughts(match)
        assert (told.behaviour == behaviour) if behaviour else not told.behaviour.startswith("pass")


# ------------------------------------------------------------------------------------------------------------ factory


def test_who_carries_a_raw_pallet_goes_to_a_machine_a():
    match = play("factory", "hand3", "hand3", "hand3", "hand3")
    told = []
    for _ in range(1500):
        match.tick()
        view, mind = mind_of(match).obs, mind_of(match)
        slot = view.slots[mind.target]
        busy = mind.near or mind.freeing > 0 or mind.resting > 0 or view.frozen
        if view.carries == RAW + 1 and mind.carried == view.carries and slot.kind == INPUT and not busy:
            assert slot.makes == A
            told.append(thoughts(match))
    assert told
    for one in told:
        assert (one.behaviour, one.reason, one.chosen, one.names["machine"]) == ("bring", "raw", "put", "A")
        goal = [sight for sight in one.percepts if sight.kind == GOAL]
        assert len(goal) == 1


def test_a_frozen_driver_waits():
    match = run(play("factory", "hand2", "hand2", "hand2", "hand2"), 60)
    mind_of(match).obs.frozen = 50
    told = thoughts(match)
    assert (told.behaviour, told.reason, told.chosen) == ("frozen", "bumped", "wait")
    assert told.utilities["wait"] == 1.0
    assert max(told.rose) <= 0.0, "it wants to go nowhere"
    assert PERIOD == 5


# ------------------------------------------------------------------------------------------------------------- tables


def test_a_table_shows_its_state_its_values_and_the_move_it_drew():
    match = play("pitanks", "idle", "idle", variant="classic")
    match.sit(0, taught())
    run(match, 6)
    told = thoughts(match)
    mind = mind_of(match)
    assert told.chosen == tuple(int(part) for part in MOVES[mind.move])
    assert told.behaviour == "shoot"
    assert told.moves[(1, 1, 1)] == 1.0
    assert len(told.moves) == ACTIONS
    here = state(*(int(told.facts[name]) for name in ("opponent", "wall", "bullet")))
    assert here == mind.state
    assert told.facts["bullet"] == NONE
    assert {sight.kind for sight in told.percepts} == {OPPONENT, WALL}
    assert (told.reason, told.names["count"]) == ("tried", 7)
    assert told.names["percent"] == 100, "10 against 9 at a temperature of 1/50"


def test_what_a_table_has_never_seen_it_says():
    match = play("pitanks", "idle", "idle", variant="classic")
    empty = taught(reward=0.0)
    empty.weights.n[:] = [0] * len(empty.weights.n)
    match.sit(0, empty)
    told = thoughts(run(match, 6))
    assert told.reason == "new"
    assert set(told.moves.values()) == {0.0}
    assert told.rose == [0.0] * SECTORS
    assert told.names["percent"] == round(100 / ACTIONS)


def test_the_rose_of_a_table_says_where_it_would_have_the_opponent():
    match = play("pitanks", "idle", "idle", variant="classic")
    brain = taught(reward=0.0)
    match.sit(0, brain)
    run(match, 6)
    wall = int(thoughts(match).facts["wall"])
    brain.weights.q[state(3, wall, NONE) * ACTIONS + 5] = 8.0
    for k in range(state(9, wall, NONE) * ACTIONS, state(9, wall, NONE) * ACTIONS + ACTIONS):
        brain.weights.q[k] = -2.0
    rose = thoughts(match).rose
    assert rose[3] == 1.0
    assert rose[9] == pytest.approx(-0.5), "the root of a quarter"
    assert sum(abs(value) for value in rose) == pytest.approx(1.5)


def test_a_bullet_that_comes_is_among_what_a_table_sees():
    match = play("pitanks", "idle", "hand3", variant="classic", seed=4)
    match.sit(0, taught())
    kinds = set()
    for _ in range(1500):
        match.tick()
        kinds |= {sight.kind for sight in thoughts(match).percepts}
    assert BULLET in kinds
