"""Awards: everybody has one, all different, true and kind."""

import re
from collections.abc import Mapping
from dataclasses import replace
from math import inf, nan
from random import Random, random

import pytest

from pigaming_app.games.game import Row
from pigaming_app.games.registry import games
from pigaming_app.scenes.results.awards.award import FREE, GENERAL, Award, Player, awarded, own_awards
from pigaming_app.scenes.results.awards.ceremony import award_text, figures
from pigaming_app.scenes.views.registry import SCREENS, text_keys
from pigaming_app.ui.draw.icons import ICONS
from pigaming_app.ui.i18n import LANGUAGES, Words, texts

PITANKS = own_awards(SCREENS["pitanks"].awards)
UNKIND = {
    "en": "worst bad poor lost loser last slow lazy weak never fail wrong lame boring clumsy few least taken",
    "de": "schlecht verlier verlor letzt langsam faul schwach nie versag falsch lahm öde tollpatsch wenig",
    "es": "peor mal malo mala perd último última lent vago vaga débil nunca fracas torpe menos pocos",
    "fr": "pire mauvais nul nulle perd dernier dernière lent lente paresseu faible jamais raté maladroit moins peu",
    "pt": "pior mau má perd último última lent pregui frac nunca falh desajeitad menos poucos",
}  # words of up to four letters, and beginnings of longer ones


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


def test_the_only_one_who_scored_was_the_first() -> None:
    found = awarded(players({"first": 9.0, "distance": 900.0}, {"distance": 800.0}))
    assert found[0].key == "first"


def test_the_most_of_nothing_is_no_award() -> None:
    found = awarded(players({"hits": 0.0, "aim": 0.0}, {"hits": 0.0, "aim": 0.0}), PITANKS)
    assert not {"hits", "aim"} & {award.key for award in found.values()}


@pytest.mark.parametrize("wrong", [nan, inf])
def test_a_statistic_of_a_plug_in_that_is_no_number_counts_for_nothing(wrong: float) -> None:
    rows = [Row(0, 0, 1, 3, {"passed": wrong, "caught": 2}, {}, ())]
    assert figures(rows) == {"caught": 2}


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


def test_the_texts_of_its_awards_are_asked_of_a_plug_in() -> None:
    named = replace(SCREENS["football"], awards={"-own_goals": "heart", "goals": "ball"})
    asked = set(text_keys("football", named))
    assert {"awards.own_goals", "awards.goals", "awards.goals_praise"} <= asked
    assert "awards.own_goals_praise" not in asked, "it may be left out"


def test_a_plug_in_has_its_own_awards_beside_those_of_every_game() -> None:
    """Robot Football imports the public face alone."""
    own = own_awards(SCREENS["football"].awards)
    found = awarded(players({"goals": 2, "turning": 90.0}, {"assists": 3, "turning": 80.0}, {"turning": 5.0}), own)
    words = Words("de")
    assert [award_text(words, "football", found[seat]) for seat in range(3)] == [
        "Meiste Tore",
        "Beste Pässe",
        "Ruhigste Hand",
    ]
    assert award_text(words, "football", GENERAL[0]) == "Erstes Tor"
