"""Names and composed sentences: what differs is called differently, in every language and game; winners, limits."""

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import chain
from typing import Any

import pytest

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.registry import AIS
from pigaming_app.events.spec import Format
from pigaming_app.games.arenas import load, shipped_arenas
from pigaming_app.games.game import FREE, Outcome, Row, Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.match_choice import arena_title
from pigaming_app.scenes.flow.match_words import limits_line, rule_numbers, tagline
from pigaming_app.scenes.howto.scene import HowTo, taught
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.lobby.view import level_words
from pigaming_app.scenes.options.page import SECTIONS, options_of
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.headline import EndedMatch, headline, winning_color
from pigaming_app.scenes.title.scene import Title
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.world import DT
from pigaming_app.ui.draw import PLAYERS
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.labels import LEVELS as BRIGHTNESSES
from pigaming_app.ui.widgets.player_card import ask_bar
from tests.matches import setup_of
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.measuring import measuring
from tests.scenes.screens import seats

WITH_PICKUPS = ("pickups", "party")  # see the table in docs/games.md


def arena_names(game: str, language: str) -> list[str]:
    return [arena_title(load(game, name), language) for name in shipped_arenas(game)]


def rule_names(game: str, words: Words) -> list[str]:
    return [words(f"setup.{game}_{name}") for name in games()[game].variants]


def twice(names: Iterable[str]) -> list[str]:
    """The names that are there more than once."""
    return [name for name, count in Counter(name.casefold() for name in names).items() if count > 1]


@pytest.mark.parametrize("language", LANGUAGES)
def test_arenas_of_all_games_and_their_rule_sets_have_names_of_their_own(language: str) -> None:
    """The pages of events list the arenas of all games; a set-up has the kind of arena before its name."""
    words = Words(language)
    arenas = list(chain.from_iterable(arena_names(game, language) for game in games()))
    assert twice(arenas) == []
    rules = {name for game in games() for name in rule_names(game, words)}
    kinds = {words(f"setup.arena_{game}") for game in games()}
    assert twice([*arenas, *rules, *kinds, *(words(f"games.{game}") for game in games())]) == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_choices_of_one_page_have_names_of_their_own(language: str) -> None:
    words = Words(language)
    for name, game in games().items():
        assert twice(rule_names(name, words)) == []
        rows = [f"arena_{name}", "minutes", "rounds", "rules", "go", *([game.goal] if game.goal else [])]
        assert twice(words(f"setup.{row}") for row in rows) == []
        assert twice(words(f"lobby.drive_{style}") for style in AIS[name].driving) == []
        assert twice(" ".join(level_words(words, brain)) for brain in (*LEVELS, *AIS[name].rivals[len(LEVELS) :])) == []
    for section in ("", *SECTIONS):
        assert twice(words(f"options.{row}") for row in options_of(section)) == []
    assert twice(words(f"events.{form.value}") for form in Format) == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_how_to_play_calls_its_pages_as_the_set_up_does(
    controls: Controls, monkeypatch: pytest.MonkeyPatch, language: str
) -> None:
    """The page of a rule set shows its name, and what it teaches is in those rules."""
    arcade = Arcade(controls, language)
    page = HowTo(arcade.context, taught()[0])
    with measuring(monkeypatch) as screen:
        for game in taught():
            for number in range(SCREENS[game].page_count):
                screen.marks.clear()
                page.draw(screen)
                if names := SCREENS[game].lesson_pages:
                    assert len(names) == SCREENS[game].page_count
                    assert arcade.context.words(f"setup.{game}_{names[number]}") in [mark.text for mark in screen.texts]
                    assert "pickups" not in dict(page.lessons()) or names[number] in WITH_PICKUPS
                page.handle(InputEvent(Button.RIGHT, KEYS[0]))


AI_SIGNS = {"en": ["AI"], "de": ["KI"], "es": ["IA"], "fr": ["IA"], "pt": ["Computador"]}
ALONE, PAIRS = (0, 1, 2, 3), (0, 1, 0, 1)


def ended(game: str, brains: str, teams: tuple[int, ...], winners: tuple[int, ...]) -> tuple[Outcome, Setup]:
    """The outcome of a match of two minutes."""
    setup = setup_of(game, brains, "classic", 2.0, teams=teams)
    there = [i for i, seat in enumerate(setup.seats) if seat.brain != "off"]
    rows = tuple(Row(i, teams[i], 1, 3, {}, {}, ()) for i in there)
    return Outcome(rows, winners, ((), (), (), ()), 120.0), setup


WHO_WINS = [
    ("pitanks", "human human level5 off", ALONE, (1,), "Player 2 wins!", "Jogador 2 ganha!"),
    ("pitanks", "human human level5 off", ALONE, (2,), "AI 3 ★★★★★ wins!", "Computador 3 ★★★★★ ganha!"),
    ("pitanks", "human q2 off off", ALONE, (1,), "AI 2 (self-taught 2) wins!", "Computador 2 (autodidata 2) ganha!"),
    (
        "pitanks",
        "human fsm off off",
        ALONE,
        (1,),
        "AI 2 (the cautious robot) wins!",
        "Computador 2 (o robô cauteloso) ganha!",
    ),
    ("pitanks", "human human human level1", PAIRS, (0, 2), "Team 1 wins!", "Equipa 1 ganha!"),
    ("pitanks", "human human human human", (0, 1, 1, 1), (1, 2, 3), "Team 2 wins!", "Equipa 2 ganha!"),
    ("factory", "human level3 human level5", PAIRS, (0, 2), "Ice wins!", "Gelo ganha!"),
    ("factory", "human human level5 level3", PAIRS, (1, 3), "Fire wins!", "Fogo ganha!"),
    ("factory", "human level5 off off", PAIRS, (1,), "Fire wins!", "Fogo ganha!"),
    ("race", "human level2 off off", ALONE, (1,), "AI 2 ★★ wins!", "Computador 2 ★★ ganha!"),
    ("race", "human human off off", ALONE, (), "It's a tie!", "Empate!"),
]


@pytest.mark.parametrize(("game", "brains", "teams", "winners", "english", "portuguese"), WHO_WINS)
def test_a_winner_is_called_what_it_is(
    game: str, brains: str, teams: tuple[int, ...], winners: tuple[int, ...], english: str, portuguese: str
) -> None:
    match = after(ended(game, brains, teams, winners))
    assert headline(Words("en"), match) == english
    assert headline(Words("pt"), match) == portuguese


def after(played: tuple[Outcome, Setup], away: Sequence[int] = (), **more: Any) -> EndedMatch:
    """The match after its end: with people on all seats of people but those in `away`."""
    outcome, setup = played
    there = [seat.brain == "human" and i not in away for i, seat in enumerate(setup.seats)]
    return EndedMatch(setup, outcome, [KEYS[i] if here else None for i, here in enumerate(there)], **more)


def test_an_ai_that_drove_on_for_somebody_is_called_one() -> None:
    played = ended("race", "human human off off", ALONE, (1,))
    assert headline(Words("en"), after(played, [1])) == "The AI for player 2 wins!"
    assert headline(Words("en"), after(played, [0])) == "Player 2 wins!"


def test_a_person_who_took_over_from_an_ai_is_called_a_person() -> None:
    outcome, setup = ended("race", "human level5 off off", ALONE, (1,))
    match = EndedMatch(setup, outcome, (KEYS[0], KEYS[1], None, None))
    assert headline(Words("en"), match) == "Player 2 wins!"
    assert (match.humans, match.absent, match.brain(1)) == ([0, 1], [], "")


NAMES = ("ANNA", "BEN")


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("game", [game for game in games() if games()[game].default.team_mode == FREE])
def test_no_ai_is_announced_as_a_person_in_any_language(game: str, language: str) -> None:
    """Whoever drives on the winner's seat, and however it came to that, the line of an AI is no person's."""
    words = Words(language)
    for seat in (0, 1):
        for names in ((), NAMES):
            people = {
                headline(words, after(ended(game, brains, ALONE, (seat,)), names=names))
                for brains in ("human human off off", "human human human human")
            }
            for brain in AIS[game].brains:
                line = headline(words, after(ended(game, f"{brain} {brain} off off", ALONE, (seat,)), names=names))
                assert line not in people
                assert any(sign in line for sign in AI_SIGNS[language]), line
            away = ended(game, "human human off off", ALONE, (seat,))
            stood_in = ended(game, "level3 level3 off off", ALONE, (seat,))
            for line in (
                headline(words, after(away, [0, 1], names=names)),
                headline(words, after(stood_in, names=names, stood_in=[0, 1])),
            ):
                assert line not in people
                assert any(sign in line for sign in AI_SIGNS[language]), line


def test_the_line_of_a_team_has_the_teams_colour() -> None:
    fire = winning_color(*ended("factory", "human human level5 level3", PAIRS, (1, 3)))
    assert fire[0] > fire[2], "fire is warm"
    ice = winning_color(*ended("factory", "human human level5 level3", PAIRS, (0, 2)))
    assert ice[2] > ice[0], "ice is cold"
    assert winning_color(*ended("race", "human human off off", ALONE, (1,))) == PLAYERS[1]


def test_the_race_says_how_many_laps_it_has(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    assert tagline(Words("en"), "race", 3) == "3 laps. Go!"
    assert tagline(Words("en"), "race", 1) == "1 lap. Go!"
    assert tagline(Words("pt"), "race", 5) == "5 voltas. Partida!"
    assert tagline(Words("pt"), "race", 1) == "1 volta. Partida!"
    arcade.context.settings.choice("race").goal = 7
    setup = setup_of("race", ["human"] * 4, "classic", 10.0, goal=7)
    for scene in (Title(arcade.context), MatchScene(arcade.context, setup, KEYS)):
        with measuring(monkeypatch) as screen:
            scene.draw(screen)
            assert "7 laps. Go!" in " ".join(mark.text for mark in screen.texts)


def test_the_numbers_of_the_rules_are_those_of_the_game() -> None:
    assert rule_numbers("pitanks", 2, "plain") == {
        "minutes": "2", "protection": "0.75", "patience": "0", "magazine": "0", "loading": "1.6", "turbo": "2",
        "refill": "4",
    }  # fmt: skip
    assert rule_numbers("race", 10, "standard")["patience"] == "30"
    for game in games():
        drain = 1.0 / (float(rule_numbers(game, 5, games()[game].default.name)["turbo"]) / DT)
        assert drain == pytest.approx(0.01), "of the meter, per tick"


def test_the_lessons_say_what_limits_a_match() -> None:
    english, portuguese = Words("en"), Words("pt")
    assert "0.75 s of protection" in limits_line(english, "pitanks", 2, "pickups")
    assert "0,75 s" in limits_line(portuguese, "pitanks", 2, "pickups")
    assert "After a hit: 2 s of protection" in limits_line(english, "pitanks", 2, "party")
    assert limits_line(english, "pitanks", 2, "pickups").startswith("5 shots, then one every 1.6 s.  After")
    assert limits_line(portuguese, "pitanks", 2, "party").startswith("5 tiros, depois um a cada 1,6 s.  Após")
    assert limits_line(english, "pitanks", 2, "original").startswith("After a hit")
    assert "Time limit: 5 min." in limits_line(english, "factory", 5, "standard")
    assert "Time limit: 10 min, 30 s after the winner." in limits_line(english, "race", 10, "standard")
    assert "10 min; 30 s" in limits_line(portuguese, "race", 10, "standard")
    for game in games():
        assert "Turbo lasts 2 s and refills in 4 s." in limits_line(english, game, 5, games()[game].default.name)
        assert "O turbo dura 2 s e enche em 4 s." in limits_line(portuguese, game, 5, games()[game].default.name)


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_sentences_about_the_rules_are_not_cut_off(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    words = arcade.context.words
    offered = [(game, variant) for game, rules in games().items() for variant in rules.variants]
    with measuring(monkeypatch) as screen:
        for game, variant in offered:
            if len(games()[game].variants) == 1:
                continue
            arcade.context.settings.choice(game).variant = variant
            screen.marks.clear()
            MatchSetupPage(arcade.context, game, seats(game)).draw(screen)
            assert words(f"rules.{game}_{variant}") in " ".join(mark.text for mark in screen.texts)


def test_the_button_follows_the_question(monkeypatch: pytest.MonkeyPatch, arcade: Arcade) -> None:
    with measuring(monkeypatch) as screen:
        ask_bar("SPACE", arcade.context.words("lobby.if_ready"), BRIGHTNESSES).draw(screen, 200, 200)
        ready, space = sorted(screen.texts, key=lambda mark: mark.box[0])
    assert (ready.text, space.text) == ("Ready?", "SPACE")


SENTENCES = {
    "results.high_score": ("New record!", "Novo recorde!"),
    "results.hits": ("Hits", "Acertos"),
    "results.taken": ("Taken", "Sofridos"),
    "match.back_in": ("An AI is driving. Press FIRE to return", "O computador conduz. FOGO retoma o lugar"),
    "lobby.hint_add": ("Add AI", "Pôr computador"),
    "pause.hint_ai": ("Let an AI drive", "Pôr computador"),
}


@pytest.mark.parametrize("key", SENTENCES)
def test_composed_sentences_in_both_languages(key: str) -> None:
    assert (Words("en")(key), Words("pt")(key)) == SENTENCES[key]
