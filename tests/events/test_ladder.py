"""The Ladder: best of three on each rung, weaker robots after clear losses, the worth of a climb, and its file."""

from dataclasses import replace
from datetime import datetime, timedelta
from random import Random

import pytest

from pigaming_app.ai.registry import BRAINS
from pigaming_app.events import climb_files, ladder
from pigaming_app.events.climb_files import FILE, KEPT, MOST
from pigaming_app.events.ladder import ALL, LEVELS, Climb, climbed_games, stars_and_losses, worth
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import ALLIES, LadderMatches, Outcome, Row, Variant
from pigaming_app.games.registry import games
from pigaming_app.games.setup import check_teams


def ended(own: int, other: int, totals: tuple[float, float] = (60.0, 60.0)) -> Outcome:
    """A match of seat 0 against seat 1."""
    winners = () if own == other else (0,) if own > other else (1,)
    points = {0: own, 1: other}
    order = sorted(points, key=lambda seat: -points[seat])
    rows = tuple(Row(seat, seat, 1, points[seat], {"total": totals[seat]}, {}, ()) for seat in order)
    return Outcome(rows, winners, (), 60.0)


WON, LOST, CLEARLY_LOST, TIED = ended(3, 2), ended(2, 3), ended(-4, 4), ended(1, 1)


def test_two_wins_of_three_lead_up_and_two_losses_begin_the_rung_anew():
    climb = Climb("pitanks")
    for outcome, rung, wins, losses in (
        (WON, 1, 1, 0),
        (LOST, 1, 1, 1),
        (TIED, 1, 1, 1),
        (WON, 2, 0, 0),
        (LOST, 2, 0, 1),
        (WON, 2, 1, 1),
        (LOST, 2, 0, 0),
    ):
        climb = climb.after(outcome)
        assert (climb.rung, climb.wins, climb.losses) == (rung, wins, losses)
    assert (climb.beaten, climb.lost) == (1, 3)


def test_ten_wins_lead_to_the_top():
    climb = Climb("race")
    for match in range(2 * LEVELS):
        assert not climb.at_top
        assert climb.setup(1).seats[1].brain == f"level{1 + match // 2}"
        climb = climb.after(WON)
    assert (climb.at_top, climb.beaten, climb.lost) == (True, 5, 0)


def test_weaker_robots_are_offered_after_two_clear_losses_in_a_row_and_count_for_less():
    climb = Climb("pitanks", rung=3, beaten=2)
    assert not climb.after(CLEARLY_LOST).offers_easier
    assert not climb.after(LOST).after(LOST).offers_easier, "these were close"
    assert not climb.after(CLEARLY_LOST).after(WON).after(CLEARLY_LOST).offers_easier, "not in a row"
    twice = climb.after(CLEARLY_LOST).after(CLEARLY_LOST)
    assert twice.offers_easier
    assert not twice.kept_hard().offers_easier
    easier = twice.made_easier()
    assert [easier.level_on(rung) for rung in range(1, 6)] == [1, 2, 2, 3, 4], "below as they were"
    for _ in range(6):
        easier = easier.after(WON)
    assert (easier.at_top, easier.beaten) == (True, 4)
    assert replace(twice, rung=1).offers_easier is False, "nobody is weaker than level 1"


@pytest.mark.parametrize(("totals", "clear"), [((0.0, 40.0), 1), ((46.0, 40.0), 1), ((44.0, 40.0), 0)])
def test_a_race_is_lost_clearly_by_five_seconds_or_by_not_arriving(totals, clear):
    assert Climb("race").after(ended(2, 3, totals)).clear == clear


def test_in_a_climb_through_all_games_these_take_turns():
    """Ten wins play each game at least twice; with any losses, no game follows itself."""
    assert set(climbed_games()) == set(games()), "of a clone"
    climb, played = Climb(ALL), []
    while not climb.at_top:
        played.append(climb.next_game)
        climb = climb.after(WON)
    assert min(played.count(game) for game in games()) >= 2
    draw = Random(1)
    for _ in range(50):
        climb, before = Climb(ALL), ""
        while not climb.at_top and climb.lost < 50:
            assert climb.next_game != before
            before, climb = climb.next_game, climb.after(draw.choice((WON, LOST, CLEARLY_LOST)))
            climb = climb.made_easier() if climb.offers_easier and draw.random() < 0.5 else climb


def test_an_added_game_that_only_asks_for_a_ladder_has_one(monkeypatch):
    """By its first rules that set two robots against each other, short, on its arenas in turn."""
    mild, rough = Variant("mild", (2, 4), 4, team_mode=ALLIES, teams=(0, 0, 0, 0)), Variant("rough", (5, 3), 5, (7,), 7)
    added = replace(games()["football"], ladder=LadderMatches(), variants=Variant.by_name(mild, rough))
    monkeypatch.setattr(ladder, "games", lambda: {**games(), "football": added})
    setups = [Climb("football", rung=rung).setup(3) for rung in (1, 2, 5)]
    assert [setup.arena for setup in setups] == ["classic", "bumpers", "bumpers"]
    assert {(setup.variant, setup.minutes, setup.goal) for setup in setups} == {("rough", 3, 7)}
    for own, other, clear in ((4, 9, True), (5, 9, False), (0, 1, True)):
        assert Climb("football").after(ended(own, other)).clear == clear
    assert "football" in climbed_games()
    added = replace(added, ladder=None)
    assert "football" not in climbed_games()


@pytest.mark.parametrize("game", climbed_games())
@pytest.mark.parametrize("rung", range(1, LEVELS + 1))
def test_every_rung_can_be_played(game, rung):
    setup = Climb(game, rung=rung).setup(7)
    rules, variant = games()[game], games()[game].variants[setup.variant]
    assert setup.arena in arenas(game)
    assert setup.seats[1].brain in BRAINS[game]
    assert setup.minutes in variant.minutes
    assert not variant.goals or setup.goal in variant.goals
    check_teams(rules, variant, [seat.team for seat in setup.seats[:2]])


def test_a_stronger_robot_is_worth_more_than_any_number_of_losses():
    climbs = [Climb(ALL, beaten=5, lost=0), Climb(ALL, beaten=5, lost=40), Climb(ALL, beaten=4), Climb(ALL, lost=1)]
    assert [worth(climb) for climb in climbs] == sorted((worth(climb) for climb in climbs), reverse=True)
    assert [stars_and_losses(worth(climb)) for climb in climbs[:3]] == [(5, 0), (5, 40), (4, 0)]
    assert stars_and_losses(worth(Climb(ALL, beaten=1, lost=5000))) == (1, 999)
    assert worth(climbs[3]) == 0, "without stars no place"


def test_climbs_of_several_copies_are_kept_side_by_side(tmp_path):
    for number in range(1, MOST + 4):
        climb_files.save(tmp_path, number, Climb("pitanks", rung=2))
    climb_files.save(tmp_path, 9, Climb("race", rung=5, eased=(2, 4), wins=1, beaten=3, lost=7))
    climb_files.delete(tmp_path, 10)
    found, problems = climb_files.saved_climbs(tmp_path)
    assert problems == []
    assert found[0].climb == Climb("race", rung=5, eased=(2, 4), wins=1, beaten=3, lost=7)
    assert len(found) == MOST - 1
    later = datetime.now().astimezone() + KEPT + timedelta(minutes=1)
    assert climb_files.saved_climbs(tmp_path, later) == ([], [])


def test_wrong_entries_are_ignored(tmp_path):
    climb_files.save(tmp_path, 1, Climb("race", rung=2, beaten=1))
    climb_files.save(tmp_path, 2, Climb("race", rung=3, beaten=2))
    whole = (tmp_path / FILE).read_text(encoding="utf-8")
    for wrong in ("rung = 9", "rung = true", 'rung = "3"', "rung = 1e9"):
        (tmp_path / FILE).write_text(whole.replace("rung = 3", wrong), encoding="utf-8")
        assert [saved.number for saved in climb_files.saved_climbs(tmp_path)[0]] == [1]
    for eased in ("[1]", "[4]", "[3, 2]", "[2, 2]", "[2, 3, 3, 3]", "[true]", "2"):
        (tmp_path / FILE).write_text(whole.replace("eased = []", f"eased = {eased}"), encoding="utf-8")
        assert climb_files.saved_climbs(tmp_path) == ([], [])
    (tmp_path / FILE).write_text(whole.replace("eased = []", "eased = [2]"), encoding="utf-8")
    assert [saved.climb.level for saved in climb_files.saved_climbs(tmp_path)[0]] == [2, 1]
