"""The lobby, operated with pads, keys and a mouse."""

from dataclasses import replace
from pathlib import Path

import pytest

from pigaming_app.ai.brain.effort import AUTO
from pigaming_app.ai.game_ai import LEVELS, ONE_BUTTON, POINT, TURN
from pigaming_app.ai.registry import AIS
from pigaming_app.games.registry import games
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.scenes.flow import match_choice
from pigaming_app.scenes.flow.match_choice import KIOSK_RULES, choose_kiosk_rules, last_choice
from pigaming_app.scenes.lobby import scene as lobby
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.lobby.seat_card import DRIVE_Y, ROW_Y
from pigaming_app.scenes.lobby.seats import AI, EMPTY, HUMAN, LobbySeats
from pigaming_app.scenes.lobby.view import card_rect, level_words
from pigaming_app.scenes.mat.mat import SessionMat
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.title.scene import Title
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.events import Button, Device, InputEvent
from tests.scenes.arcade import KEYS, Arcade


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    arcade.stack.scenes[1:] = []
    arcade.open(Lobby(arcade.context, "pitanks"))


def kinds(arcade: Arcade) -> str:
    return letters(arcade.shown(Lobby).seats)


def brains(match: MatchScene) -> list[str]:
    return [seat.brain for seat in match.setup.seats]


def letters(seats: LobbySeats) -> str:
    """The seats as letters: H, A or a dot."""
    return "".join({HUMAN: "H", AI: "A", EMPTY: "."}[place.kind] for place in seats.places)


def test_two_pads_of_one_make_are_two_players(arcade: Arcade) -> None:
    (one, first), (two, second) = arcade.plug(), arcade.plug()
    two.tap("a")
    arcade.frame()
    one.tap("a")
    arcade.frame()
    seats = arcade.shown(Lobby).seats
    assert seats.devices()[:2] == [second, first]


def test_fire_again_is_ready_and_back_takes_that_back_then_leaves_then_goes_to_the_title(arcade: Arcade) -> None:
    arcade.press(Button.FIRE)
    arcade.press(Button.FIRE, device=KEYS[1])
    arcade.press(Button.FIRE)
    place = arcade.shown(Lobby).seats.places[0]
    assert place.ready
    arcade.press(Button.BACK)
    assert not place.ready
    arcade.press(Button.BACK)
    assert kinds(arcade) == ".H.."
    arcade.press(Button.BACK, Button.BACK, device=KEYS[1])
    assert arcade.stack.top is arcade.title


def test_a_turbo_key_gives_up_the_seat_of_its_own_cluster_only(arcade: Arcade) -> None:
    arcade.press(Button.FIRE)
    arcade.press(Button.FIRE, Button.LEAVE_SEAT, device=KEYS[1])
    assert kinds(arcade) == "H..."
    arcade.press(Button.LEAVE_SEAT, device=KEYS[2])
    assert kinds(arcade) == "H..."


def test_one_person_alone_who_is_ready_gets_three_ais_until_a_second_one_joins(arcade: Arcade) -> None:
    arcade.press(Button.FIRE, Button.FIRE)
    assert kinds(arcade) == "HAAA"
    arcade.wait(lobby.COUNTDOWN_ALONE - 0.3, fps=10, draw=True)
    arcade.press(Button.FIRE, device=KEYS[1])
    arcade.wait(2.0)
    assert kinds(arcade) == "HH.."
    arcade.press(Button.FIRE, device=KEYS[1])
    arcade.wait(lobby.COUNTDOWN + 0.2)
    assert brains(arcade.shown(MatchScene)) == ["human", "human", "off", "off"]


def test_one_press_leaves_one_ai_and_there_is_time_for_it(arcade: Arcade) -> None:
    arcade.press(Button.FIRE, Button.FIRE)
    arcade.wait(lobby.COUNTDOWN_ALONE - 0.3)
    arcade.press(Button.Y)
    assert kinds(arcade) == "HA.."
    arcade.wait(lobby.COUNTDOWN_ALONE - 0.3)
    assert kinds(arcade) == "HA.."
    arcade.wait(0.5)
    human, ai, *others = brains(arcade.shown(MatchScene))
    assert (human, others) == ("human", ["off", "off"])
    assert ai in AUTO


def test_start_opens_match_setup_at_once_and_the_unready_count_as_ready(arcade: Arcade) -> None:
    arcade.press(Button.START)
    assert kinds(arcade) == "H..."
    arcade.press(Button.FIRE, device=KEYS[1])
    arcade.press(Button.START)
    page = arcade.shown(MatchSetupPage)
    assert [seat.brain for seat in page.seats.seats()] == ["human", "human", "off", "off"]


def test_ais_come_one_by_one_and_go_all_at_once(arcade: Arcade) -> None:
    arcade.press(Button.FIRE)
    for expected in ("HA..", "HAA.", "HAAA", "HA.."):
        arcade.press(Button.Y)
        assert kinds(arcade) == expected
    arcade.press(Button.FIRE, device=KEYS[1])
    for expected in ("HAHA", "H.H.", "HAH."):
        arcade.press(Button.Y)
        assert kinds(arcade) == expected


def test_directions_make_the_ais_stronger_and_that_is_remembered(arcade: Arcade) -> None:
    arcade.press(Button.Y)
    assert arcade.shown(Lobby).seats.places[0].strength == "auto"
    arcade.press(Button.RIGHT)
    assert arcade.shown(Lobby).seats.places[0].strength == "level1"
    assert arcade.context.settings.strength == "level1"
    assert Lobby(arcade.context, "pitanks").seats.strength == "level1"


def test_the_other_ais_follow_the_strongest_one_and_play(arcade: Arcade) -> None:
    arcade.press(Button.FIRE, Button.Y, Button.DOWN)
    for wanted in (*LEVELS, "q1", "q2", "fsm", "classic", "classic"):
        arcade.press(Button.RIGHT)
        assert arcade.shown(Lobby).seats.places[1].strength == wanted
        arcade.frame(draw=True)
    assert arcade.context.settings.strength == "level5"
    arcade.press(Button.START, Button.START)
    assert [seat.brain for seat in arcade.shown(MatchSetupPage).seats.seats()] == ["human", "classic", "off", "off"]


def test_left_and_right_choose_the_team_and_a_match_needs_two_teams(arcade: Arcade) -> None:
    arcade.press(Button.FIRE)
    arcade.press(Button.FIRE, device=KEYS[1])
    arcade.press(Button.X)
    arcade.press(Button.LEFT, device=KEYS[1])
    seats = arcade.shown(Lobby).seats
    assert [place.team for place in seats.places[:2]] == [0, 0]
    arcade.press(Button.START)
    assert arcade.sounds.heard[-1] == "error"
    assert arcade.shown(Lobby).now.message == arcade.context.words("lobby.teams_need")
    arcade.press(Button.RIGHT, device=KEYS[1])
    arcade.press(Button.START)
    assert [seat.team for seat in arcade.shown(MatchSetupPage).seats.seats()][:2] == [0, 1]


def test_a_pad_that_is_pulled_out_leaves_its_seat_with_a_word(arcade: Arcade) -> None:
    pad, _ = arcade.plug()
    pad.tap("a")
    arcade.frame()
    assert kinds(arcade) == "H..."
    pad.unplug()
    arcade.wait(0.1)
    assert kinds(arcade) == "...."
    assert arcade.shown(Lobby).now.message == arcade.context.words("lobby.unplugged", player=1)


def test_a_mouse_alone_can_have_ais_play(arcade: Arcade) -> None:
    for seat in (0, 2):
        arcade.click(*card_rect(seat).center)
    assert kinds(arcade) == "A.A."
    x, y = card_rect(0).topleft
    arcade.click(x + 414 - 60, y + 538)
    assert arcade.shown(Lobby).seats.places[0].strength == "level1"
    assert arcade.shown(Lobby).seats.places[2].strength == "auto"
    arcade.click(*card_rect(2).center)
    assert kinds(arcade) == "A..."
    arcade.click(*card_rect(2).center)
    arcade.stack.apply(arcade.stack.top.handle(InputEvent(Button.START, Device("mouse"))))
    assert [seat.brain for seat in arcade.shown(MatchSetupPage).seats.seats()] == ["level1", "off", "level1", "off"]


def test_when_nobody_is_there_the_title_comes_back(arcade: Arcade) -> None:
    arcade.press(Button.FIRE)
    arcade.context.idle = lobby.IDLE + 1.0
    arcade.frame()
    assert arcade.stack.top is arcade.title


def test_returning_from_match_setup_resets_readiness(arcade: Arcade) -> None:
    arcade.press(Button.FIRE, Button.START, Button.BACK)
    assert not arcade.shown(Lobby).seats.places[0].ready
    arcade.wait(3.0)
    arcade.shown(Lobby)


def test_where_there_is_a_mat_everyone_chooses_a_real_robot_for_ones_own_seat(arcade: Arcade) -> None:
    arcade.context.mat = SessionMat(arcade.context, EmulatedSession(live=False))
    arcade.context.settings.real = [2]
    arcade.open(Lobby(arcade.context, "pitanks"))
    arcade.press(Button.FIRE)
    arcade.press(Button.FIRE, device=KEYS[1])
    page = arcade.shown(Lobby)
    assert page.seats.real() == [1]
    for device in KEYS[:2]:
        arcade.press(Button.UP, device=device)
    arcade.press(Button.RIGHT)
    arcade.press(Button.LEFT, device=KEYS[1])
    assert page.seats.real() == [0]
    assert arcade.context.settings.real == [1]
    arcade.click(card_rect(1).centerx, card_rect(1).top + ROW_Y)
    assert page.seats.real() == [0, 1]
    arcade.press(Button.X)
    arcade.shown(Lobby)
    arcade.press(Button.BACK)
    assert page.seats.real() == [1]


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_robot_on_a_cable_cannot_be_chosen_and_it_says_why(arcade: Arcade, home: Path) -> None:
    arcade.context.mat = SessionMat(arcade.context, EmulatedSession(live=False))
    arcade.context.settings.radio, arcade.context.settings.real = "stock", [1]
    arcade.open(Lobby(arcade.context, "pitanks"))
    arcade.press(Button.FIRE, Button.UP, Button.RIGHT)
    page = arcade.shown(Lobby)
    assert page.seats.real() == []
    assert "deadman" in page.now.message.lower()


def test_without_a_mat_nobody_has_a_real_robot(arcade: Arcade) -> None:
    arcade.context.settings.real = [1, 2, 3, 4]
    arcade.open(Lobby(arcade.context, "race"))
    arcade.press(Button.FIRE, Button.UP, Button.RIGHT)
    assert arcade.shown(Lobby).seats.real() == []
    assert arcade.context.settings.real == [1, 2, 3, 4]


def test_everyone_chooses_a_driving_style_on_the_own_card_with_pad_keys_or_mouse(arcade: Arcade) -> None:
    def styles() -> list[str]:
        devices = arcade.shown(Lobby).seats.devices()
        return [arcade.context.driving.of(device, "pitanks") for device in devices if device]

    pad, _ = arcade.plug()
    arcade.press(Button.FIRE)
    pad.tap("a")
    arcade.frame()
    assert styles() == [TURN, POINT], "by the rules of party, pads point"
    arcade.press(Button.RIGHT)
    assert styles() == [POINT, POINT]
    pad.tap("left")
    arcade.frame()
    assert styles() == [POINT, TURN]
    pad.tap("right")
    arcade.frame()
    assert styles() == [POINT, POINT]
    arcade.click(card_rect(1).centerx, card_rect(1).top + DRIVE_Y)
    assert styles() == [POINT, ONE_BUTTON]
    arcade.click(card_rect(1).centerx, card_rect(1).top + DRIVE_Y)
    assert styles() == [POINT, TURN]
    arcade.press(Button.X, Button.LEFT)
    assert arcade.shown(Lobby).seats.places[0].team == 1
    arcade.press(Button.DOWN, Button.LEFT)
    assert styles() == [TURN, TURN]


def test_in_a_kiosk_one_button_ends_on_the_title(arcade: Arcade) -> None:
    driving, device = arcade.context.driving, KEYS[0]
    for kiosk in (False, True):
        driving.chosen[device] = ONE_BUTTON
        arcade.context.kiosk = kiosk
        Title(arcade.context).on_enter()
        assert (device in driving.chosen) == (not kiosk)


def test_a_kiosk_offers_party_rules_unless_the_operator_has_chosen_others(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    rules = games()["pitanks"]
    variants = {**rules.variants, KIOSK_RULES: replace(rules.default, name=KIOSK_RULES)}
    monkeypatch.setattr(match_choice, "games", lambda: {**games(), "pitanks": replace(rules, variants=variants)})
    settings = arcade.context.settings
    choose_kiosk_rules(settings)
    assert last_choice(arcade.context, "pitanks").variant == KIOSK_RULES
    settings.choice("pitanks").variant = "plain"
    choose_kiosk_rules(settings)
    assert last_choice(arcade.context, "pitanks").variant == "plain"


def test_levels_have_stars_and_the_other_ais_none() -> None:
    words = Words("en")
    rows = [level_words(words, level) for level in LEVELS]
    assert rows[0] == ("Level 1", "★☆☆☆☆")
    assert rows[4] == ("Level 5", "★★★★★")
    assert [stars.count("★") for _, stars in rows] == [1, 2, 3, 4, 5]
    assert {level_words(words, rival)[1] for rival in AIS["pitanks"].rivals if rival not in LEVELS} == {""}
