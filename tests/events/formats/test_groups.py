"""Groups and knock-out: worked by hand, and against a second implementation that knows the journal alone."""

from itertools import combinations, pairwise
from random import Random

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.formats.groups import groups
from pigaming_app.events.journal import Corrected, Recorded
from pigaming_app.events.spec import WALKOVER, Entrant, Format, Result
from tests.cases import one_in
from tests.events.examples import best_seed_wins, by_chance, level, new_event, pairs_of, played


def test_eight_entrants_of_whom_the_better_seed_always_wins():
    """Worked by hand: A has 1 4 5 8 and B 2 3 6 7; A1 meets B2, and B1 meets A2."""
    event = new_event(Format.GROUPS, 8)
    assert groups(event.progress.as_field()) == {"A": ("P1", "P4", "P5", "P8"), "B": ("P2", "P3", "P6", "P7")}
    assert {one.stage for one in event.open} == {"group A", "group B"}
    assert len(event.open) == 12
    event = played(event, rounds=3)
    assert [row.entrant for row in event.part_standings["A"]] == ["P1", "P4", "P5", "P8"]
    assert [row.points for row in event.part_standings["A"]] == [3, 2, 1, 0]
    assert pairs_of(event, 4) == [("P1", "P3"), ("P2", "P4")]
    event = played(event)
    assert pairs_of(event, 5) == [("P1", "P2")]
    assert [row.entrant for row in event.standings] == [f"P{seed}" for seed in (1, 2, 3, 4, 5, 6, 7, 8)]
    assert [row.place for row in event.standings] == [1, 2, 3, 3, 5, 5, 7, 7]


def test_two_of_one_group_can_meet_again_in_the_final_only():
    event = played(new_event(Format.GROUPS, 16), rounds=3)
    letters = {name: letter for letter, names in groups(event.progress.as_field()).items() for name in names}
    first = [tuple(sorted(letters[name] for name in pair)) for pair in pairs_of(event, 4)]
    assert first == [("A", "B"), ("C", "D"), ("A", "B"), ("C", "D")]
    halves = [{name for pair in pairs_of(event, 4)[i : i + 2] for name in pair} for i in (0, 2)]
    assert all(sorted(letters[name] for name in half) == ["A", "B", "C", "D"] for half in halves)


@pytest.mark.parametrize(
    ("count", "sizes"),
    [(3, [3]), (5, [5]), (6, [3, 3]), (11, [6, 5]), (12, [3] * 4), (25, [4, 3, 3, 3, 3, 3, 3, 3]), (64, [4] * 16)],
)
def test_sizes_of_the_groups(count, sizes):
    event = new_event(Format.GROUPS, count)
    assert sorted(map(len, groups(event.progress.as_field()).values()), reverse=True) == sizes
    event = played(event, by_chance(count))
    knocked = [one for one in event.fixtures if not one.stage.startswith("group")]
    assert len(knocked) == 2 * len(sizes) - 1
    assert knocked[-1].stage == "last"


def test_a_tie_counts_in_a_group_and_is_played_off_in_the_knock_out():
    event = new_event(Format.GROUPS, 6)
    event = event.record(level(event.open[0]))
    assert 1 in event.outcomes
    event = played(event, rounds=3)
    event = event.record(level(event.open[0]))
    assert event.open[0].extra == 1
    assert played(event).over


def test_the_next_of_the_group_takes_the_place_of_who_leaves_before_the_knock_out():
    event = played(new_event(Format.GROUPS, 8), rounds=3)
    assert pairs_of(event.withdraw("P4"), 4) == [("P1", "P3"), ("P2", "P5")]
    begun = event.record(best_seed_wins(event.open[0])).withdraw("P2")
    assert begun.outcomes[14].note == WALKOVER
    assert pairs_of(begun, 5) == [("P1", "P4")]


def test_a_group_match_is_final_once_a_match_that_follows_has_been_played():
    event = played(new_event(Format.GROUPS, 8), rounds=3)
    number = next(one.number for one in event.fixtures if {*one.entrants} == {"P4", "P5"})
    other = Result(number, (("P5",), ("P4",)), note="mixed up")
    assert pairs_of(event.correct(other), 4) == [("P1", "P3"), ("P2", "P5")]
    event = event.record(best_seed_wins(event.open[0]))
    with pytest.raises(ValueError, match=rf"^match {number} decides who goes on, and match 13 has been played since$"):
        event.correct(other)
    last = next(one.number for one in event.fixtures if {*one.entrants} == {"P5", "P8"})
    assert event.correct(Result(last, (("P5", "P8"),), note="level")).outcomes[last].places == (("P5", "P8"),)


def test_a_late_entrant_joins_the_smallest_group():
    event = new_event(Format.GROUPS, 7)
    event = event.record(best_seed_wins(event.open[0])).add(Entrant("P8"))
    assert groups(event.progress.as_field())["A"] == ("P1", "P4", "P5", "P8")
    assert sum("P8" in one.entrants for one in event.fixtures) == 3


def test_groups_have_a_limit_of_matches():
    assert len(new_event(Format.GROUPS, 64, rounds=40).fixtures) == 16 * 6 * 40
    with pytest.raises(ValueError, match=r"^64 times 16 groups are more than 4096 matches$"):
        _ = new_event(Format.GROUPS, 64, rounds=64).progress


def test_groups_are_of_matches_of_two():
    with pytest.raises(ValueError, match=r"^a match has 2 seats, not 4$"):
        _ = new_event(Format.GROUPS, 8, seats=4).progress


# ---- the second implementation


def a_random_event(seed: int) -> Event:
    """Chance plays, corrects, adds, withdraws and postpones."""
    random = Random(f"groups {seed}")
    event = new_event(Format.GROUPS, random.randint(3, 20), rounds=random.choice((0, 0, 0, 2)))
    outcome = by_chance(seed)
    for step in range(random.randint(5, 90)):
        try:
            match random.randrange(14):
                case 0 if event.outcomes:
                    fixture = random.choice([one for one in event.fixtures if one.number in event.outcomes])
                    event = event.correct(Result(fixture.number, outcome(fixture).places, note="corrected"))
                case 1:
                    event = event.add(Entrant(f"P{100 + step}"))
                case 2 if random.random() < 0.4:
                    event = event.withdraw(random.choice(event.entrants).name)
                case 3 if event.open:
                    event = event.postpone(random.choice(event.open).number)
                case _ if event.open:
                    event = event.record(outcome(random.choice(event.open)))
        except ValueError:
            continue
    return event if seed % 3 else played(event, outcome)


def told(event: Event) -> dict[int, tuple[tuple[str, ...], ...]]:
    """The last word of the journal on each match, extra matches aside."""
    found: dict[int, tuple[tuple[str, ...], ...]] = {}
    for entry in event.journal:
        if isinstance(entry, Corrected) or (isinstance(entry, Recorded) and not entry.outcome.extra):
            found[entry.outcome.fixture] = entry.outcome.places
    return found


def group_order(event: Event, names: list[str], letter: str) -> list[list[str]]:
    """A group from scratch, best first, level ones together: points, head to head, wins, Sonneborn-Berger."""
    results: list[tuple[str, str, float, bool]] = []  # two entrants, points of the first, played
    own = {name: [0, 0] for name in names}
    for fixture in (one for one in event.fixtures if one.stage == f"group {letter}"):
        a, b = fixture.entrants
        places, gone = told(event).get(fixture.number), event.withdrawn
        for name in (a, b):
            own[name][0] += 1
            own[name][1] += places is not None
        if places:
            results.append((a, b, 0.5 if len(places) == 1 else float(places[0] == (a,)), True))
        elif a in gone or b in gone:
            results.append((a, b, float(b in gone and a not in gone), False))
            if a in gone and b in gone:  # whoever was still there when the other one left has the point, if anybody
                best = event.outcomes[fixture.number].places
                results[-1] = (a, b, -1.0 if len(best) == 1 else float(best[0] == (a,)), False)
    void = {name for name in names if name in event.withdrawn and own[name][1] * 2 < own[name][0]}
    results = [one for one in results if not {one[0], one[1]} & void]

    def gains(name: str, among: set[str]) -> list[tuple[str, float, bool]]:
        mine = [(b, share, real) for a, b, share, real in results if a == name and b in among]
        mine += [
            (a, -1.0 if share < 0 else 1.0 - share, real) for a, b, share, real in results if b == name and a in among
        ]
        return [(other, max(0.0, share), real) for other, share, real in mine]

    every = {*names}
    points = {name: sum(share for _, share, _ in gains(name, every)) for name in names}

    def direct(group: list[str]) -> dict[str, float]:
        """Head to head as FIDE C.07, 6: the mean against each; with matches missing, who leads whatever they bring."""
        mean: dict[tuple[str, str], float] = {}
        for one, other in combinations(group, 2):
            met = [share for who, share, _ in gains(one, {other})]
            back = [share for who, share, _ in gains(other, {one})]
            if met:
                mean[one, other] = sum(met) / len(met)
                mean[other, one] = sum(back) / len(back)
        total = {name: sum(mean.get((name, other), 0.0) for other in group) for name in group}
        missing = {name: sum(other != name and (name, other) not in mean for other in group) for name in group}
        if not any(missing.values()):
            return total
        value, left = dict.fromkeys(group, 0.0), sorted(group, key=total.__getitem__)
        while left:
            top = left.pop()
            if any(total[top] <= total[other] + missing[other] for other in left):
                break
            value[top] = total[top]
        return value

    def won(group: list[str]) -> dict[str, float]:
        return {name: float(sum(real and share == 1.0 for _, share, real in gains(name, every))) for name in group}

    def sonneborn(group: list[str]) -> dict[str, float]:
        return {name: sum(share * points[other] for other, share, _ in gains(name, every)) for name in group}

    def split(group: list[str], value: dict[str, float]) -> list[list[str]]:
        worth = sorted({round(value[name], 6) for name in group}, reverse=True)
        return [[name for name in group if round(value[name], 6) == one] for one in worth]

    def refine(group: list[str], measure) -> list[list[str]]:
        parts = split(group, measure(group))
        return [group] if len(parts) == 1 else [finer for part in parts for finer in refine(part, measure)]

    order = split(names, points)
    for measure in (direct, won, sonneborn):
        order = [finer for group in order for finer in refine(group, measure)]
    return order


def check(event: Event) -> None:
    """Groups, their tables, the bracket and the final table, each from scratch."""
    early = [one.name for one in event.entrants if one.name not in event.progress.late]
    count = 1
    while 6 * count <= len(early):
        count *= 2
    expected: list[list[str]] = [[] for _ in range(count)]
    for i, name in enumerate(early):
        expected[min(i % (2 * count), 2 * count - 1 - i % (2 * count))].append(name)
    for name in (one.name for one in event.entrants if one.name in event.progress.late):
        sizes = [len(group) for group in expected]
        expected[sizes.index(min(sizes))].append(name)
    found = groups(event.progress.as_field())
    assert [*found.values()] == [tuple(group) for group in expected]
    orders = {letter: group_order(event, [*names], letter) for letter, names in found.items()}
    for letter, order in orders.items():
        rows = event.part_standings[letter]
        assert [row.entrant for row in rows] == [name for level in order for name in level]
        places = [1 + sum(map(len, order[:i])) for i, level in enumerate(order) for _ in level]
        assert [row.place for row in rows] == places
        met = [frozenset(one.entrants) for one in event.fixtures if one.stage == f"group {letter}"]
        times = event.spec.rounds or 1
        assert sorted(map(sorted, met)) == sorted(
            sorted(pair) for pair in combinations(found[letter], 2) for _ in range(times)
        )
    knocked = [one for one in event.progress.fixtures if not one.stage.startswith("group")]
    group_matches = [one for one in event.fixtures if one.stage.startswith("group")]
    assert bool(knocked) == all(one.number in event.outcomes for one in group_matches)
    rounds = [[one for one in knocked if one.round == number] for number in sorted({one.round for one in knocked})]
    for before, after in pairwise(rounds):
        assert len(after) * 2 == len(before)
        for i, fixture in enumerate(after):
            for own in before[2 * i : 2 * i + 2]:
                best = event.outcomes[own.number].places[0]
                assert {*fixture.entrants} & ({*best} if len(best) == 1 else {*own.entrants})
    gone_late = any(name in one.entrants for name in event.withdrawn for one in knocked)
    if rounds and not gone_late:
        ranked = [[name for level in order for name in level] for order in orders.values()]
        first = [sorted(order, key=lambda name: name in event.withdrawn)[:2] for order in ranked]
        if count == 1:
            wanted = [{*first[0]}]
        else:
            wanted = [{first[i][0], first[i + 1][1]} for i in range(0, count, 2)]
            wanted += [{first[i + 1][0], first[i][1]} for i in range(0, count, 2)]
        assert [{*one.entrants} for one in rounds[0]] == wanted
    if event.over:
        assert len(rounds[-1]) == 1
        best = event.outcomes[rounds[-1][0].number].places[0]
        assert [row.entrant for row in event.standings if row.place == 1] == [*best]
        assert len(knocked) == 2 * count - 1


@pytest.mark.parametrize("block", one_in(5, range(10)))
def test_250_random_events_agree_with_a_second_implementation(block):
    for seed in range(25 * block, 25 * block + 25):
        check(a_random_event(seed))
