"""Awards: everybody has one, all different, true and kind."""

import re
from collections.abc import Mapping
from dataclasses import replace
from math import hypot, tau
from random import Random, random
from types import SimpleNamespace
from typing import Any

import pygame
import pytest

from pigaming_app.games.game import Outcome, Row
from pigaming_app.games.registry import games
from pigaming_app.scenes.results.awards.award import FREE, GENERAL, Award, Player, awarded, own_awards
from pigaming_app.scenes.results.awards.ceremony import ICON_X, Ceremony, award_text
from pigaming_app.scenes.results.awards.feats import EVERY, FeatRecorder
from pigaming_app.scenes.results.awards.praise import last_seats, places, praises
from pigaming_app.scenes.results.headline import EndedMatch
from pigaming_app.scenes.results.scene import IDLE, Results
from pigaming_app.scenes.results.view import score_cell
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.world import DT, HZ
from pigaming_app.ui.draw.icons import ICONS
from pigaming_app.ui.draw.layers import LEFT
from pigaming_app.ui.i18n import LANGUAGES, Words, texts
from pigaming_app.ui.input.events import Button
from tests.matches import match_of, setup_of
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.screens import ENDINGS, Ending

PITANKS = own_awards(SCREENS["pitanks"].awards)
UNKIND = {
    "en": "worst bad poor lost loser last slow lazy weak never fail wrong lame boring clumsy few least taken",
    "de": "schlecht verlier verlor letzt langsam faul schwach nie versag falsch lahm öde tollpatsch wenig",
    "es": "peor mal malo mala perd último última lent vago vaga débil nunca fracas torpe menos pocos",
    "fr": "pire mauvais nul nulle perd dernier dernière lent lente paresseu faible jamais raté maladroit moins peu",
    "pt": "pior mau má perd último última lent pregui frac nunca falh desajeitad menos poucos",
}  # words, and beginnings of words of five letters or fewer stand for all forms


def players(*figures: Mapping[str, float], people: str = "1111") -> list[Player]:
    return [Player(seat, people[seat] == "1", seat + 1, found) for seat, found in enumerate(figures)]


def keys(found: Mapping[int, Award]) -> list[str]:
    return [found[seat].key for seat in sorted(found)]


def test_each_player_gets_the_award_at_which_it_stands_out() -> None:
    found = awarded(
        players(
            {"hits": 12, "aim": 0.3, "distance": 5000, "turning": 60, "escape": 9},
            {"hits": 6, "aim": 0.9, "distance": 5200, "turning": 61, "escape": 8},
            {"hits": 5, "aim": 0.2, "distance": 5100, "turning": 62, "escape": 55},
            {"hits": 4, "aim": 0.2, "distance": 9000, "turning": 63, "escape": 7},
        ),
        PITANKS,
    )
    assert keys(found) == ["hits", "aim", "escape", "distance"]


def test_an_idle_robot_is_the_calmest() -> None:
    found = awarded(players({"hits": 3, "turning": 50.0, "distance": 900.0}, {"hits": 0, "turning": 0.0}), PITANKS)
    assert keys(found) == ["hits", "calm"]


@pytest.mark.parametrize("seed", range(4))
def test_robots_that_did_nothing_at_all_get_four_kinds_of_award(seed: int) -> None:
    nothing = {"hits": 0.0, "turning": 0.0, "distance": 0.0, "rest": 60.0, "near": 0.0}
    assert len(set(keys(awarded(players(*[nothing] * 4), PITANKS, seed)))) == 4


def test_the_least_counts_where_less_is_better() -> None:
    factory = own_awards(SCREENS["factory"].awards)
    assert [(award.key, award.least) for award in factory if award.figure == "bumps"] == [("bumps", True)]
    found = awarded(players({"bumps": 9, "delivered": 5}, {"bumps": 1, "delivered": 2}), factory)
    assert keys(found) == ["delivered", "bumps"]


def test_people_go_first_where_one_has_earned_what_is_short() -> None:
    alike = {"hits": 3.0}
    only = (Award("hits", "shoot", "hits"),)
    for people in ("01", "10"):
        for seed in range(6):
            found = awarded([replace(p, figures=alike) for p in players({}, {}, people=people)], only, seed)
            assert found[people.index("1")].key == "hits"


def test_between_equals_no_seat_is_preferred() -> None:
    alike = [Player(seat, True, 1, {"hits": 3.0}) for seat in range(4)]
    lucky = {next(s for s, a in awarded(alike, PITANKS, seed).items() if a.key == "hits") for seed in range(40)}
    assert lucky == {0, 1, 2, 3}


def random_players(chance: Random) -> list[Player]:
    names = {award.figure for award in (*PITANKS, *GENERAL)}
    scale = {name: chance.choice((0, 1, 3, 50)) for name in sorted(names)}
    count = chance.randint(1, 4)
    return [
        Player(seat, chance.random() < 0.5, chance.randint(1, count), drawn)
        for seat in range(count)
        for drawn in ({name: float(chance.randint(0, top)) for name, top in scale.items() if chance.random() < 0.9},)
    ]


def test_everybody_has_a_different_and_true_award_whatever_the_statistics() -> None:
    chance = Random(random())
    for _ in range(60):
        present = random_players(chance)
        found = awarded(present, PITANKS, chance.randrange(99))
        assert sorted(found) == [player.seat for player in present]
        assert len(set(keys(found))) == len(present)
        for player in present:
            if name := found[player.seat].figure:
                known = [other.figures[name] for other in present if name in other.figures]
                assert player.figures[name] == (min if found[player.seat].least else max)(known)


def test_a_robot_gets_the_same_award_on_any_seat() -> None:
    chance = Random(random())
    for _ in range(20):
        figures = [{name: chance.random() * 99 for name in ("hits", "aim", "distance", "turning")} for _ in range(4)]
        seats = chance.sample(range(4), 4)
        here = awarded([Player(i, True, 1, figures[i]) for i in range(4)], PITANKS)
        there = awarded([Player(seats[i], True, 1, figures[i]) for i in range(4)], PITANKS)
        assert [here[i].figure and here[i] for i in range(4)] == [there[k].figure and there[k] for k in seats]


def every_award() -> list[tuple[str, Award]]:
    return [(game, award) for game in games() for award in (*own_awards(SCREENS[game].awards), *GENERAL, *FREE)]


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_text_of_an_award_is_unkind(language: str) -> None:
    said = {key: text for key, text in texts(language).items() if key.startswith("awards.")}
    unkind = "|".join(word if len(word) > 4 else rf"{word}\b" for word in UNKIND[language].split())
    assert not {key: text for key, text in said.items() if re.search(rf"\b({unkind})", text, re.IGNORECASE)}
    assert re.search(rf"\b({unkind})", UNKIND[language].split()[0])


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_award_has_a_name_and_an_icon_and_no_two_are_alike(language: str) -> None:
    words = Words(language)
    for game in games():
        named = [award_text(words, game, award) for shown, award in every_award() if shown == game]
        assert len(set(named)) == len(named)
    assert {award.icon for _, award in every_award()} <= ICONS.keys()
    assert len(words("results.hits_taken", count=3).split()) <= 3 + (language == "fr")  # the colon stands apart


# ---- what robots did


def recorded(game: str, brains: str, ticks: int, seed: int = 1) -> tuple[Any, FeatRecorder, dict[str, float]]:
    """A match with its feats, and those of seat 0 measured tick by tick from its poses."""
    match, recorder = match_of(game, brains, minutes=1.0, seed=seed), FeatRecorder()
    me, way, turns = match.state.robots[0], 0.0, 0.0
    for _ in range(ticks):
        x, y, heading = me.x, me.y, me.heading
        match.tick()
        recorder.watch(match)
        way += hypot(me.x - x, me.y - y)
        turns += abs((me.heading - heading + tau / 2) % tau - tau / 2)
    return match, recorder, {"distance": way, "turning": turns}


@pytest.mark.parametrize("game", ["pitanks", "factory"])
def test_ways_and_turns_are_those_of_the_poses(game: str) -> None:
    """Sampled ten times a second, and by what the wheels do: a robot that pushes against a wall goes nowhere."""
    _, recorder, truth = recorded(game, "level3 level3", 20 * HZ)
    found = recorder.feats(0)
    assert found["distance"] == pytest.approx(truth["distance"], rel=0.2)
    assert found["turning"] == pytest.approx(truth["turning"], rel=0.2)


def scripted(scores: list[list[int]], taken: list[list[int]] | None = None) -> FeatRecorder:
    """The feats of a match in which these are scores and hits taken of each seat after each second."""
    robots = [SimpleNamespace(**dict.fromkeys(("x", "y", "linear", "angular", "boosting"), 0.0)) for _ in range(4)]
    for seat, robot in enumerate(robots):
        robot.present, robot.team, robot.score = seat < len(scores[0]), seat, 0
    state = SimpleNamespace(tick=0, robots=robots, taken=[0, 0, 0, 0])
    game = SimpleNamespace(
        stats=lambda state, seat: {"taken": state.taken[seat]} if taken else {},
        ranking_key=lambda state, seat: float(state.robots[seat].score),
    )
    match, recorder = SimpleNamespace(state=state, game=game, series=[[(0.0, 0)] for _ in range(4)]), FeatRecorder()
    for second, line in enumerate(scores):
        for _ in range(HZ):
            state.tick += 1
            recorder.watch(match)  # type: ignore[arg-type]
        for seat, score in enumerate(line):
            robots[seat].score = score
            match.series[seat].append((second + 1.0, score))
        if taken:
            state.taken[: len(line)] = taken[second]
    return recorder


def test_a_comeback_is_the_gap_at_half_time_of_one_who_has_gained_a_place() -> None:
    recorder = scripted([[0, 0, 0], [6, 1, 2], [6, 1, 2], [6, 1, 2], [6, 7, 2], [6, 9, 2]])
    found = [recorder.feats(seat) for seat in range(3)]
    assert [feats["comeback"] for feats in found] == [0.0, 5.0, 0.0]
    assert [feats["half"] for feats in found] == [1.0, 3.0, 2.0]
    assert [feats["first"] for feats in found] == [2.0, 2.0, 2.0]


def test_the_longest_escape_lies_between_two_hits() -> None:
    taken = [[1, 0], [1, 0], [1, 0], [2, 0], [2, 1], [2, 1]]
    recorder = scripted([[0, 0]] * 6, taken)
    assert recorder.feats(0)["escape"] == pytest.approx(3.0, abs=EVERY * DT)
    assert recorder.feats(1)["escape"] == pytest.approx(5.0, abs=EVERY * DT)
    assert "escape" not in scripted([[0, 0]] * 6).feats(0), "a game without hits"


def test_the_recorder_changes_nothing_and_works_once_in_five_ticks() -> None:
    match, recorder, _ = recorded("pitanks", "level3 level1", 4 * HZ)
    assert recorder.samples == 4 * HZ // EVERY
    other = match_of("pitanks", "level3 level1", minutes=1.0)
    for _ in range(4 * HZ):
        other.tick()
    assert [(r.x, r.y, r.score) for r in match.state.robots] == [(r.x, r.y, r.score) for r in other.state.robots]


# ---- a kind word


def ended_match(name: str = "alone", **changes: Any) -> EndedMatch:
    ending = replace(ENDINGS[name], **changes)
    setup = setup_of(ending.game, ending.brains, "", 5.0, 1, ending.variant, teams=ending.teams)
    return EndedMatch(setup, ending.outcome(), [None] * 4)


def spoken(ended: EndedMatch, feats: Mapping[int, Mapping[str, float]] | None = None, **named: str) -> dict[int, str]:
    every = {seat: Award(named.get(f"seat{seat}", "aim"), "target", "aim") for seat in range(4)}
    return praises(Words("en"), ended, every, feats or {})


def test_the_last_place_is_told_how_close_it_was() -> None:
    assert spoken(ended_match(scores=(9, 8, 7, 5), winners=(0,))) == {3: "So close: just 2 behind!"}


def test_or_that_it_has_led_or_what_it_was_best_at() -> None:
    far = ended_match(scores=(90, 80, 70, 5), winners=(0,))
    assert spoken(far, {3: {"half": 1.0}}) == {3: "In the lead at half time!"}
    assert spoken(far, {3: {"half": 4.0}}) == {3: "Nobody aimed better!"}
    assert spoken(far, seat3="something_of_a_plug_in") == {3: "Nobody did that better!"}


def test_the_two_of_a_team_are_told_different_things() -> None:
    said = spoken(ended_match("in teams", scores=(5, 5, 5, 4), winners=(0, 2)))
    assert said == {1: "So close: just 1 behind!", 3: "Nobody aimed better!"}


def test_nobody_is_last_where_all_are_level_or_alone() -> None:
    assert last_seats(ended_match("tie").outcome) == []
    assert places(ended_match("in teams").outcome) == {0: 1, 2: 1, 1: 2, 3: 2}


def test_drivers_are_told_the_seconds() -> None:
    rows = tuple(Row(seat, seat, seat + 1, 2, {}, {}, (10.0, 11.0 + 0.8 * seat)) for seat in range(2))
    race = EndedMatch(setup_of("race", "human human", goal=2), Outcome(rows, (0,), ((),) * 4, 30.0), [None] * 4)
    assert spoken(race) == {1: "So close: just 0.8 s behind!"}


# ---- the page


def opened(arcade: Arcade, ending: Ending) -> Results:
    results = ending.results(arcade)
    results.claims = []
    return arcade.open(results)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", ["alone", "in teams"])
def test_names_and_awards_leave_a_gap(monkeypatch: pytest.MonkeyPatch, arcade: Arcade, name: str) -> None:
    """With the longest names, the longest award of the language, and the longest kind word."""
    words = arcade.context.words
    longest = max((award for _, award in every_award()), key=lambda award: len(words(f"awards.{award.key}")))
    monkeypatch.setattr(
        "pigaming_app.scenes.results.awards.ceremony.awards_of", lambda *_: dict.fromkeys(range(4), longest)
    )
    said = max((text for key, text in texts(words.language).items() if key.startswith("awards.")), key=len)
    monkeypatch.setattr("pigaming_app.scenes.results.awards.ceremony.praises", lambda *_: dict.fromkeys(range(4), said))
    ended = replace(ended_match(name), names=("W" * 12, "M" * 12, "Wolfgang-Maria", "Ångström"))
    page = Ceremony(arcade.context, ended, True, {})
    page.draw(arcade.screen, 9.0)
    gap = arcade.screen.subsurface((LEFT + ICON_X - 72, 226, 20, 580))
    lit = pygame.mask.from_threshold(gap, (255, 255, 255), (150, 150, 150)).count()
    assert lit < 200, "the panels' lines cross it, no text does"
    right = arcade.screen.subsurface((1800, 226, 14, 580))
    assert pygame.mask.from_threshold(right, (255, 255, 255), (150, 150, 150)).count() < 200


def test_left_and_right_change_between_awards_and_numbers(arcade: Arcade) -> None:
    results = opened(arcade, ENDINGS["alone"])
    arcade.frame(draw=True)
    awards = arcade.screen.copy()
    arcade.press(Button.RIGHT)
    assert results.page is results.numbers
    arcade.frame(draw=True)
    assert pygame.image.tobytes(arcade.screen, "RGB") != pygame.image.tobytes(awards, "RGB")
    arcade.press(Button.LEFT)
    assert results.page is results.ceremony
    arcade.until(lambda: arcade.stack.top is arcade.title, IDLE + 1.0)


def test_the_prompt_of_the_other_view_can_be_clicked(arcade: Arcade) -> None:
    results = opened(arcade, ENDINGS["alone"])
    for page, key in ((results.ceremony, "results.numbers"), (results.numbers, "results.awards")):
        assert results.page is page
        assert (Button.RIGHT, key) in results.prompts.items
        arcade.press(Button.RIGHT, device=KEYS[0])


@pytest.mark.parametrize("language", LANGUAGES)
def test_in_party_a_score_below_zero_is_shown_as_hits_taken(language: str) -> None:
    words, row = Words(language), Row(0, 0, 1, -3, {"taken": 7, "hits": 4}, {}, ())
    party, pickups = (setup_of("pitanks", "human human", variant=variant) for variant in ("party", "pickups"))
    assert score_cell(words, party, row)[0] == words("results.hits_taken", count=7)
    assert score_cell(words, pickups, row)[0] == "−3"
    assert score_cell(words, party, replace(row, score=0))[0] == "0"
