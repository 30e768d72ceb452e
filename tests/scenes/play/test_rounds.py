"""Best of three, played to the podium: breaks, pauses, pulled pads, the end, the rematch."""

import pygame
import pytest

from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.play.ending import FREEZE_SECONDS
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.reconnect import Reconnect
from pigaming_app.scenes.play.round_break import margin, round_title
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.podium import Stand, stands
from pigaming_app.scenes.results.podium_page import PodiumPage
from pigaming_app.scenes.results.scene import Results
from pigaming_app.scenes.results.view import ResultsPage
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device
from tests.cases import one_in
from tests.games.test_rounds import played
from tests.scenes.arcade import KEYS, Arcade, setup
from tests.scenes.measuring import faults, lit_boxes, measuring
from tests.ui.input.virtual_pad import VirtualPad

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")

MINUTES = 0.02


def begin(arcade: Arcade, before: int = 0, device: Device = KEYS[0]) -> Rounds:
    """Open a round after so many others, each won by player 1, 5 to 3."""
    rounds = Rounds(3)
    for _ in range(before):
        rounds.add(played({0: 5, 1: 3}))
    scene = MatchScene(arcade.context, setup("human idle off off", MINUTES), [device], rounds=rounds)
    scene.opening.countdown.seconds_left = 0.1
    arcade.open(scene)
    return rounds


def win(arcade: Arcade, seat: int = 0) -> MatchScene:
    """Play the round to its end; this seat wins 5 to 0."""
    scene = arcade.shown(MatchScene)
    scene.opening.countdown.seconds_left = 0.05
    scene.match.state.robots[seat].score = 5
    arcade.until(lambda: scene.match.over)
    arcade.wait(FREEZE_SECONDS + 0.2)
    return scene


def test_two_rounds_won_lead_to_the_podium_and_the_rematch_begins_anew(arcade: Arcade) -> None:
    rounds = begin(arcade)
    first = win(arcade)
    assert first.ending.round_break
    arcade.shown(MatchScene)
    arcade.until(lambda: arcade.stack.top is not first, 10.0)
    second = arcade.shown(MatchScene)
    assert second.rounds is rounds
    assert second.runner.feats is first.runner.feats, "awards are for all rounds"
    assert second.devices[0] == KEYS[0]
    assert second.setup.seed != first.setup.seed
    win(arcade)
    results = arcade.reach(Results, 5.0)
    assert isinstance(results.numbers, PodiumPage)
    assert results.numbers.winners == (0,)
    arcade.wait(4.0, fps=10, draw=True)
    assert "fanfare" in arcade.sounds.heard
    arcade.press(Button.START)
    again = arcade.shown(MatchScene)
    assert again.rounds is not None
    assert (again.rounds.best_of, again.rounds.outcomes) == (3, [])
    assert len(arcade.stack.scenes) == 3


def test_a_break_is_paused_and_continued_like_a_match(arcade: Arcade) -> None:
    begin(arcade)
    scene = win(arcade)
    arcade.press(Button.START)
    arcade.shown(Pause)
    arcade.wait(20.0, fps=2)
    arcade.press(Button.BACK)
    assert arcade.shown(MatchScene) is scene
    arcade.until(lambda: arcade.stack.top is not scene, 10.0)
    arcade.shown(MatchScene)


def menu(arcade: Arcade, item: str) -> None:
    """Choose an item of the pause menu, and confirm it."""
    page = arcade.shown(Pause)
    page.focus.move_to(item)
    arcade.press(Button.FIRE, Button.FIRE)
    arcade.frame()


def test_ending_the_match_in_a_break_shows_the_rounds_so_far(arcade: Arcade) -> None:
    begin(arcade)
    win(arcade)
    arcade.press(Button.START)
    menu(arcade, "end")
    results = arcade.reach(Results, 5.0)
    assert isinstance(results.numbers, PodiumPage)
    assert not results.numbers.finished
    assert results.numbers.winners == ()


def test_ending_the_first_round_shows_that_round(arcade: Arcade) -> None:
    begin(arcade)
    scene = arcade.shown(MatchScene)
    arcade.until(lambda: not scene.opening.countdown.locked)
    arcade.press(Button.START)
    menu(arcade, "end")
    assert isinstance(arcade.reach(Results, 5.0).numbers, ResultsPage)


def test_restarting_in_a_break_begins_with_the_first_round(arcade: Arcade) -> None:
    begin(arcade)
    scene = win(arcade)
    arcade.press(Button.START)
    menu(arcade, "restart")
    again = arcade.shown(MatchScene)
    assert again is not scene
    assert again.rounds is not None
    assert again.rounds.outcomes == []


def test_a_pad_pulled_in_a_break_is_asked_for_and_an_ai_plays_the_next_round(arcade: Arcade) -> None:
    with VirtualPad() as pad:
        arcade.frame()
        device = Device("pad", pad.number)
        begin(arcade, device=device)
        scene = win(arcade)
    arcade.frame()
    arcade.shown(Reconnect)
    arcade.until(lambda: arcade.stack.top is scene, 20.0)
    arcade.until(lambda: arcade.stack.top is not scene, 10.0)
    second = arcade.shown(MatchScene)
    assert second.devices[0] is None
    assert second.drivers.people == [0]
    assert second.drivers.assisted == {0}
    second.opening.countdown.seconds_left = 0.05
    arcade.until(lambda: not second.opening.countdown.locked)
    arcade.press(Button.FIRE, device=KEYS[1])
    assert second.devices[0] == KEYS[1], "a free device takes the seat back"


def test_every_round_is_a_record_of_one_minute(arcade: Arcade) -> None:
    begin(arcade)
    scene = arcade.shown(MatchScene)
    assert scene.rounds is not None
    win(arcade)
    arcade.until(lambda: arcade.stack.top is not scene, 10.0)
    second = arcade.shown(MatchScene)
    second.drivers.assisted.add(0)
    win(arcade)
    outcome = scene.rounds.outcome()
    assert outcome.rows[0].records == {"points": 5}
    assert scene.rounds.assisted == [frozenset(), {0}]


def test_the_margin_shows_the_round_and_the_rounds_won(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    begin(arcade, before=1)
    with measuring(monkeypatch) as screen:
        arcade.stack.top.draw(screen)
        assert {"Round", "2/3"} <= {mark.text for mark in screen.texts if mark.box[2] <= 160}


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_margin_keeps_clear_of_arena_and_corner_markers(controls: Controls, language: str) -> None:
    pygame.font.init()
    sheet = margin(Words(language)("rounds.round"), "3/3", tuple((seat, 1) for seat in range(4)), 2)
    boxes = lit_boxes(sheet.image)
    box = boxes[0].unionall(boxes).move(sheet.at)
    assert pygame.Rect(4, 150, 150, 770).contains(box)


@pytest.mark.parametrize("language", one_in(2, LANGUAGES))
def test_texts_of_break_and_podium_keep_off_each_other(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    with measuring(monkeypatch) as screen:
        begin(arcade, before=1)
        scene = arcade.shown(MatchScene)
        win(arcade, seat=1)
        scene.draw(screen)
        assert faults(screen) == []
        arcade.until(lambda: arcade.stack.top is not scene, 10.0)
        win(arcade, seat=1)
        arcade.until(lambda: isinstance(arcade.stack.top, Results), 5.0)
        arcade.wait(4.0, fps=5)
        arcade.stack.top.draw(screen)
        assert faults(screen) == []


def test_the_title_of_a_break_names_winner_team_or_tie() -> None:
    words, people, three = Words("en"), ("human",) * 4, ("human", "human", "human", "level3")
    assert round_title(words, played({0: 1, 3: 2}), 1, people) == "Player 4 wins round 1!"
    assert round_title(words, played({0: 1, 3: 2}), 1, three) == "AI 4 wins round 1!"
    in_teams = played({0: 1, 1: 2, 2: 3, 3: 0}, {0: 0, 1: 1, 2: 0, 3: 1})
    assert round_title(words, in_teams, 2, people) == "Team 1 wins round 2!"
    assert round_title(words, played({0: 1, 1: 1}), 1, people) == "Round 1: a tie"


@pytest.mark.parametrize(
    ("places", "steps"),
    [
        ([(1, 0, 0), (2, 1, 1), (3, 2, 2), (4, 3, 3)], [Stand(1, (0,)), Stand(2, (1,)), Stand(3, (2,))]),
        ([(1, 1, 1), (1, 1, 3), (3, 0, 0), (3, 0, 2)], [Stand(1, (1, 3)), Stand(2, (0, 2))]),
        ([(1, 0, 0), (1, 1, 1), (3, 2, 2)], [Stand(1, (0, 1)), Stand(3, (2,))]),
        ([(1, 0, 0), (1, 1, 1), (1, 2, 2), (1, 3, 3)], [Stand(1, (0, 1, 2, 3))]),
    ],
)
def test_teams_and_equal_places_share_a_step(places: list[tuple[int, int, int]], steps: list[Stand]) -> None:
    assert stands(places) == steps
