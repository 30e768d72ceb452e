"""Seat rules of the lobby, without the scene."""

from typing import Any

import pytest

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.games.game import ALLIES, ALONE, FREE, PAIRS, Seat
from pigaming_app.scenes.lobby.seats import AI, DRIVE, EMPTY, HUMAN, REAL, RIVALS, TEAM, LobbySeats
from pigaming_app.ui.input.events import Device

ANA, BEN, CARLA, DAVID, EVA = (Device("pad", number) for number in range(5))


def seated(*devices: Device, **rules: Any) -> LobbySeats:
    """Seats that these devices have joined."""
    seats = LobbySeats(**rules)
    for device in devices:
        seats.join(device)
    return seats


def test_the_first_to_join_is_player_1() -> None:
    seats = LobbySeats()
    assert [seats.join(device) for device in (BEN, ANA)] == [0, 1]
    assert seats.devices() == [BEN, ANA, None, None]
    assert seats.seats() == (Seat("human", 0), Seat("human", 1), Seat("off", 2), Seat("off", 3))


def test_a_seat_that_was_left_is_the_next_to_be_taken() -> None:
    seats = seated(ANA, BEN, CARLA)
    seats.leave(1)
    assert seats.join(DAVID) == 1


def test_an_ai_makes_room_for_a_person_and_four_people_for_nobody() -> None:
    seats = seated(ANA)
    assert [seats.add_ai() for _ in range(4)] == [1, 2, 3, None]
    assert seats.join(BEN) == 3
    assert seats.join(CARLA) == 2
    assert seats.join(DAVID) == 1
    assert seats.join(EVA) is None
    assert seats.of_kind(HUMAN) == [0, 1, 2, 3]


@pytest.mark.parametrize("teams", [False, True])
def test_one_person_alone_gets_ais_on_all_seats_in_even_teams(teams: bool) -> None:
    seats = seated(ANA, teams=teams)
    assert seats.add_opponents() == [1, 2, 3]
    assert [place.team for place in seats.places].count(0) == 2
    assert seats.add_opponents() == []
    assert not seats.one_team


def test_two_people_play_alone_unless_they_ask_for_ais() -> None:
    seats = seated(ANA)
    seats.add_opponents()
    assert seats.join(BEN) == 1
    assert seats.of_kind(AI) == [], "nobody has asked for them"
    assert seats.add_opponents() == []
    seats.add_ai()
    assert seats.join(CARLA) == 3
    assert seats.of_kind(AI) == [2], "asked for"


def test_ais_that_nobody_asked_for_leave_with_the_last_person() -> None:
    seats = seated(ANA)
    seats.add_opponents()
    seats.leave(0)
    assert seats.robots == 0
    seats.join(ANA)
    seats.add_ai()
    seats.leave(0)
    assert seats.of_kind(AI) == [1]


def test_a_person_alone_keeps_one_opponent_when_the_others_go() -> None:
    seats = seated(ANA, team_mode=PAIRS)
    seats.change_team(0)
    seats.add_opponents()
    assert seats.remove_ais() == 1
    assert not seats.one_team
    assert seats.add_opponents() == [], "it was a choice"


def test_the_rows_of_a_card_are_those_that_can_be_changed() -> None:
    seats = seated(ANA, teams=True, mat=True)
    assert seats.rows(0) == [REAL, TEAM, DRIVE]
    assert seats.row(0) == TEAM
    seats.add_ai()
    assert [seats.step_row(0, 1) for _ in range(3)] == [True, True, False]
    assert seats.row(0) == RIVALS
    seats.remove_ais()
    seats.teams = False
    seats.places[1].kind = HUMAN
    assert seats.row(0) == DRIVE, "a row that is gone is no longer selected"
    assert [seats.step_row(0, -1), seats.row(0)] == [True, REAL]
    assert not seats.step_row(0, -1)


def test_a_new_player_joins_the_smaller_team() -> None:
    seats = seated(ANA, BEN, CARLA, teams=True)
    seats.places[1].team = 0
    assert [place.team for place in seats.places[:3]] == [0, 0, 0]
    assert seats.one_team
    seats.join(DAVID)
    assert seats.places[3].team == 1
    assert not seats.one_team


@pytest.mark.parametrize(("steps", "strength"), [(1, "level4"), (3, "level5"), (-1, "level2"), (-3, "level1")])
def test_all_ais_become_stronger_or_weaker_up_to_an_end(steps: int, strength: str) -> None:
    seats = LobbySeats()
    seats.add_ai()
    seats.add_ai()
    for _ in range(abs(steps)):
        seats.change_strength(1 if steps > 0 else -1)
    assert {seats.places[i].strength for i in seats.of_kind(AI)} == {strength}
    seats.add_ai()
    assert seats.places[2].strength == strength


def test_one_ai_goes_round_and_leaves_the_others_as_they_are() -> None:
    seats = LobbySeats()
    seats.add_ai()
    seats.add_ai()
    for _ in range(3):
        seats.change_strength(1, 0)
    assert [seats.places[i].strength for i in (0, 1)] == ["level1", "level3"]
    assert not LobbySeats().change_strength(1)


def test_sending_the_ais_away_leaves_the_people() -> None:
    seats = seated(ANA, BEN)
    seats.add_ai()
    assert seats.remove_ais() is None
    assert (seats.of_kind(HUMAN), seats.of_kind(AI), seats.of_kind(EMPTY)) == ([0, 1], [], [2, 3])


def team_of(seats: LobbySeats) -> list[int]:
    return [place.team for place in seats.places if place.kind != EMPTY]


def test_in_a_game_of_pairs_people_come_to_both_sides_and_nobody_is_alone() -> None:
    seats = LobbySeats(team_mode=PAIRS)
    assert [seats.join(ANA), seats.join(BEN)] == [0, 1]
    assert team_of(seats) == [0, 1]
    assert not seats.add_opponents(), "one against one is a match too"
    seats.change_team(1)
    assert seats.one_team
    assert seats.add_opponents() == [2, 3], "a pair gets two opponents"
    assert team_of(seats) == [0, 0, 1, 1]
    assert [seat.team for seat in seats.seats()] == [0, 0, 1, 1]


def test_one_person_alone_gets_a_mate_and_two_rivals() -> None:
    seats = seated(ANA, team_mode=PAIRS)
    assert seats.add_opponents() == [1, 2, 3]
    assert sorted(team_of(seats)) == [0, 0, 1, 1]


def test_a_side_never_holds_three_robots_and_the_ai_changes_sides() -> None:
    seats = seated(ANA, BEN, team_mode=PAIRS)
    seats.add_ai()
    seats.add_ai()
    assert team_of(seats) == [0, 1, 0, 1]
    seats.change_team(1)
    assert team_of(seats) == [0, 0, 1, 1], "Ben changed sides, the AI left"


def test_in_a_race_everyone_drives_alone_against_three() -> None:
    seats = seated(ANA, team_mode=ALONE, teams=True)
    assert seats.add_opponents() == [1, 2, 3]
    assert [seat.team for seat in seats.seats()] == [0, 1, 2, 3]
    assert not seats.one_team


def test_a_game_with_more_rivals_offers_them_after_the_strongest() -> None:
    seats = LobbySeats(rivals=(*LEVELS, "q1", "q2"))
    seats.add_ai()
    for wanted in ("level4", "level5", "q1", "q2", "q2"):
        seats.change_strength(1)
        assert seats.seats()[0] == Seat(wanted, 0)
    seats.change_strength(1, 0)
    assert seats.places[0].strength == "level1"


def test_among_allies_all_are_in_one_team_and_a_person_alone_gets_mates() -> None:
    seats = seated(ANA, team_mode=ALLIES)
    assert not seats.one_team, "no opponents are missing"
    assert seats.add_opponents() == [1, 2, 3]
    assert [seat.team for seat in seats.seats()] == [0, 0, 0, 0]
    assert not seats.teams
    assert not seated(ANA, BEN, team_mode=ALLIES).add_opponents(), "two allies need nobody else"


def test_with_the_rule_set_the_seats_change_from_pairs_to_allies_and_back() -> None:
    seats = seated(ANA, BEN, team_mode=PAIRS)
    seats.change_mode(ALLIES)
    assert [seat.team for seat in seats.seats()[:2]] == [0, 0]
    assert seats.robots == 2, "allies need no opponents"
    seats.change_mode(PAIRS)
    assert (team_of(seats), seats.robots) == ([0, 1], 2)


def test_allies_who_become_pairs_are_two_on_each_side() -> None:
    seats = seated(ANA, team_mode=ALLIES)
    seats.add_opponents()
    for place in seats.places:
        place.team = 0
    seats.change_mode(PAIRS)
    assert sorted(team_of(seats)) == [0, 0, 1, 1]
    assert not seats.one_team


def test_one_ally_alone_gets_opponents_with_another_rule_set() -> None:
    seats = seated(ANA, team_mode=ALLIES)
    seats.change_mode(PAIRS)
    assert seats.robots == 4
    assert sorted(team_of(seats)) == [0, 0, 1, 1]


def test_the_same_team_mode_changes_nothing() -> None:
    seats = seated(ANA, team_mode=FREE, teams=True)
    seats.change_mode(FREE)
    assert seats.teams
    assert seats.robots == 1
