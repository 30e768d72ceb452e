"""Match setup: arena, minutes, rules."""

import itertools
import tomllib
from pathlib import Path

import pytest

from pigaming_app import ASSETS
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import PAIRS
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow import arena_cache, match_choice
from pigaming_app.scenes.flow.match_choice import change_rules, playable_arenas
from pigaming_app.scenes.lobby import match_setup as setup
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage, row_sizes, rows
from pigaming_app.scenes.lobby.match_setup_view import APART, CHIP, PAD, W, short_boxes
from pigaming_app.scenes.lobby.seats import LobbySeats
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.storage.settings import Choice
from pigaming_app.ui.draw.layers import SMALLEST, fit_lines
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import KEYS, Arcade


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    seats = LobbySeats()
    seats.join(KEYS[0])
    seats.add_ai()
    arcade.open(MatchSetupPage(arcade.context, "pitanks", seats))


def page(arcade: Arcade) -> MatchSetupPage:
    return arcade.shown(MatchSetupPage)


def test_every_arena_comes_by_and_the_first_again(arcade: Arcade) -> None:
    seen = []
    for _ in arenas("pitanks"):
        seen.append(page(arcade).chosen.arena)
        arcade.press(Button.RIGHT)
    assert sorted(seen) == sorted(arenas("pitanks"))
    assert page(arcade).chosen.arena == seen[0]


def test_the_selection_is_played_and_remembered_if_choices_are_kept(arcade: Arcade, home: Path) -> None:
    arcade.context.settings.keep_choices = True
    arcade.press(Button.RIGHT, Button.DOWN, Button.RIGHT, Button.DOWN, Button.DOWN, Button.RIGHT)
    arena, minutes, variant = page(arcade).chosen.arena, page(arcade).chosen.minutes, page(arcade).chosen.variant
    assert (minutes, variant) == (3, list(games()["pitanks"].variants)[1])
    arcade.press(Button.FIRE)
    assert page(arcade).chosen.variant == variant, "hammering on FIRE does not start the match"
    arcade.wait(0.5)
    arcade.press(Button.FIRE)
    match = arcade.shown(MatchScene)
    assert (match.setup.arena, match.setup.minutes, match.setup.variant) == (arena, 3.0, variant)
    assert [seat.brain for seat in match.setup.seats] == ["human", "level3", "off", "off"]
    assert match.devices == [KEYS[0], None, None, None]
    saved = tomllib.loads((home / "config" / "settings.toml").read_text())
    assert tuple(saved["games"]["pitanks"][name] for name in ("arena", "minutes", "variant")) == (arena, 3, variant)


def test_minutes_end_at_the_last_and_the_first(arcade: Arcade) -> None:
    arcade.press(Button.DOWN)
    for button, last in (
        (Button.RIGHT, max(games()["pitanks"].default.minutes)),
        (Button.LEFT, min(games()["pitanks"].default.minutes)),
    ):
        arcade.press(*[button] * 6)
        assert page(arcade).chosen.minutes == last


def test_a_mouse_chooses_minutes_rules_and_the_arena_and_begins(arcade: Arcade) -> None:
    boxes = rows(games()["pitanks"], games()["pitanks"].default)
    row = boxes["minutes"]
    arcade.click(row.x + PAD + 3 * (CHIP + APART) + 20, row.centery)
    assert page(arcade).chosen.minutes == games()["pitanks"].default.minutes[3]
    before = page(arcade).chosen.variant
    arcade.click(boxes["rules"].right - 40, boxes["rules"].centery)
    arcade.click(boxes["rules"].left + 40, boxes["rules"].centery)
    assert page(arcade).chosen.variant == before
    arena = page(arcade).chosen.arena
    arcade.click(*setup.FRAME.center)
    assert page(arcade).chosen.arena != arena
    arcade.click(*boxes["go"].center)
    arcade.shown(MatchScene)


def test_a_seat_without_its_pad_leads_back_to_the_lobby(arcade: Arcade) -> None:
    pad, device = arcade.plug()
    page(arcade).seats.join(device)
    arcade.wait(0.1)
    page(arcade)
    pad.unplug()
    arcade.wait(0.1)
    assert arcade.stack.top is arcade.setup


def test_an_arena_that_is_gone_and_minutes_that_are_not_offered_give_way(arcade: Arcade) -> None:
    arcade.context.settings.games["pitanks"] = Choice("atlantis", 47, "nonsense", 9)
    fresh = MatchSetupPage(arcade.context, "pitanks", LobbySeats())
    rules = games()["pitanks"]
    assert fresh.chosen == Choice("classic", rules.default.default_minutes, rules.default.name, 0)


def test_a_broken_arena_file_is_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "arenas" / "pitanks"
    folder.mkdir(parents=True)
    (folder / "classic.toml").write_text((ASSETS / "arenas" / "pitanks" / "classic.toml").read_text())
    (folder / "broken.toml").write_text("title = 3")
    monkeypatch.setattr("pigaming_app.games.arenas.ASSETS", tmp_path)
    match_choice.shipped_playable.cache_clear()
    arena_cache.load_shipped.cache_clear()
    try:
        assert playable_arenas("pitanks") == ("classic",)
    finally:
        match_choice.shipped_playable.cache_clear()
        arena_cache.load_shipped.cache_clear()


@pytest.mark.parametrize("game", [game for game in games() if games()[game].default.goals])
def test_a_game_with_a_goal_asks_for_it_and_keeps_what_each_game_chose(arcade: Arcade, game: str) -> None:
    rules = games()[game]
    seats = LobbySeats(team_mode=rules.default.team_mode)
    seats.join(KEYS[0])
    seats.add_opponents()
    arcade.open(MatchSetupPage(arcade.context, game, seats))
    arcade.press(Button.DOWN)
    for button, last in ((Button.RIGHT, max(rules.default.goals)), (Button.LEFT, min(rules.default.goals))):
        for _ in rules.default.goals:
            arcade.press(button)
        assert page(arcade).chosen.goal == last
    arcade.wait(0.5, draw=True)
    arcade.press(Button.FIRE)
    match = arcade.shown(MatchScene)
    assert match.setup.goal == min(rules.default.goals)
    assert arcade.context.settings.choice("pitanks") == Choice()
    assert arcade.context.settings.choice(game).goal == min(rules.default.goals)


def test_only_what_can_be_chosen_is_a_row() -> None:
    for rules in games().values():
        boxes = rows(rules, rules.default)
        assert ("goal" in boxes) == bool(rules.default.goals)
        assert ("minutes" in boxes) == (len(rules.default.minutes) > 1)
        assert ("rules" in boxes) == (len(rules.variants) > 1)
        assert ("rounds" in boxes) == (len(rules.rounds) > 1), "best of three"
        heights = sorted((box.top, box.bottom) for box in boxes.values())
        assert all(one[1] < other[0] for one, other in itertools.pairwise(heights))


def test_the_seats_follow_the_team_mode_of_the_chosen_rules(arcade: Arcade) -> None:
    seats = LobbySeats(team_mode=PAIRS)
    seats.join(KEYS[0])
    seats.add_opponents()
    arcade.open(MatchSetupPage(arcade.context, "factory", seats))
    while page(arcade).focus.name != "rules":
        arcade.press(Button.DOWN)
    teams = {page(arcade).chosen.variant: [seat.team for seat in seats.seats()]}
    for _ in range(3):
        arcade.press(Button.RIGHT)
        arcade.wait(0.1, draw=True)
        teams[page(arcade).chosen.variant] = [seat.team for seat in seats.seats()]
    assert list(teams) == ["standard", "party", "together"]
    assert teams["together"] == [0, 0, 0, 0]
    assert sorted(teams["party"]) == sorted(teams["standard"]) == [0, 0, 1, 1]
    arcade.press(Button.LEFT)
    assert page(arcade).chosen.variant == "together"
    arcade.wait(0.5)
    arcade.press(Button.FIRE)
    match = arcade.shown(MatchScene)
    assert (match.setup.variant, {seat.team for seat in match.setup.seats}) == ("together", {0})


def test_best_of_three_plays_rounds_of_one_minute_and_is_remembered(arcade: Arcade) -> None:
    here = page(arcade)
    here.focus.move_to("rounds")
    arcade.press(Button.RIGHT, Button.UP)
    assert here.focus.name == "minutes"
    minutes = here.chosen.minutes
    arcade.press(Button.RIGHT)
    page(arcade)
    assert here.chosen.minutes == minutes, "a round always lasts one minute"
    arcade.wait(0.5)
    arcade.press(Button.FIRE)
    match = arcade.shown(MatchScene)
    assert match.setup.minutes == 1.0
    assert match.rounds is not None
    assert match.rounds.best_of == 3
    assert match_choice.last_choice(arcade.context, "pitanks").rounds == 3
    assert "Best of 3" in match_choice.choice_summary(arcade.context, "pitanks")


def test_a_click_chooses_the_rounds(arcade: Arcade) -> None:
    here = page(arcade)
    box = here.rows["rounds"]
    one, three = short_boxes(("1", arcade.context.words("setup.rounds_3")))
    arcade.click(box.left + three.centerx, box.centery)
    assert here.chosen.rounds == 3
    arcade.click(box.left + one.centerx, box.centery)
    assert here.chosen.rounds == 1
    arcade.click(box.left + 5, box.centery)
    assert here.chosen.rounds == 1


def test_other_rules_bring_their_own_length_and_the_same_length_stays() -> None:
    for game, before, after in (("race", (10, 4), (10, 5)), ("factory", (5, 4), (3, 0)), ("pitanks", (5, 0), (5, 0))):
        rules = games()[game]
        choice = Choice(minutes=before[0], variant=next(iter(rules.variants)), goal=before[1])
        change_rules(rules, choice, "party")
        assert (choice.variant, choice.minutes, choice.goal) == ("party", *after)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("game", list(games()))
def test_the_sentence_of_every_rule_set_fits_its_row(game: str, language: str) -> None:
    for variant in games()[game].variants.values():
        sentence = Words(language)(f"rules.{game}_{variant.name}")
        sizes = range(row_sizes(games()[game], variant).small, SMALLEST, -2)
        assert len(fit_lines(sentence, W - 2 * PAD, 2, sizes)[1]) <= 2, sentence
