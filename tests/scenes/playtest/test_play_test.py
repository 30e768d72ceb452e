"""A play test from the question to the file: who has agreed is in it, and without everybody's consent there is none."""

import json
from dataclasses import replace

import pytest

from pigaming_app.games import replay as replays
from pigaming_app.games.replay import ReplayError
from pigaming_app.scenes.features.replays import decode, pack, verify
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.playtest import kept
from pigaming_app.scenes.playtest.consent import ConsentPage
from pigaming_app.scenes.playtest.page import PlayTestPage
from pigaming_app.scenes.playtest.replays import AGES, Participant, PlayTestReplay
from pigaming_app.scenes.playtest.watch import PlayTestWatch
from pigaming_app.scenes.recordings import store
from pigaming_app.ui.input.events import Button, Device
from tests.matches import setup_of
from tests.scenes.arcade import KEYS, Arcade

SHORT = setup_of("pitanks", "human human level1 level1", "classic", 0.05, 1, "classic")
TURNS = [Participant(0, "keys", "7-9", "turn"), Participant(1, "keys", "adult", "turn")]


def consent(arcade: Arcade) -> ConsentPage:
    """The page with two people who have agreed and gone on: one of 7 to 9 years, one adult."""
    page = arcade.open(ConsentPage(arcade.context, "pitanks"))
    arcade.press(Button.FIRE, Button.RIGHT, Button.RIGHT, Button.FIRE)
    arcade.press(Button.FIRE, Button.LEFT, Button.FIRE, Button.FIRE, device=KEYS[1])
    return page


def played(arcade: Arcade, during=lambda scene: None) -> list[Participant]:
    """Those whom the replay names that is kept of a match of two keyboards, if one is."""
    watch = PlayTestWatch(arcade.context)
    scene = arcade.open(MatchScene(arcade.context, SHORT, [*KEYS[:2], None, None]))
    during(scene)
    while not scene.match.over:
        watch.update(0.02, arcade.stack)
        scene.match.tick()
    watch.update(0.02, arcade.stack)
    watch.update(0.02, arcade.stack)
    found = kept.paths()
    replay = store.load(found[0]) if found else None
    assert len(found) <= 1
    assert replay is None or verify(replay)
    return list(replay.participants) if isinstance(replay, PlayTestReplay) else []


def test_people_agree_and_go_on_to_the_match(arcade: Arcade) -> None:
    page = consent(arcade)
    assert isinstance(arcade.stack.top, MatchSetupPage)
    assert page.agreed == {KEYS[0]: "7-9", KEYS[1]: "adult"}
    assert [seat.brain == "human" for seat in page.seats.seats()] == [True, True, False, False]


def test_nobody_agrees_without_an_age_or_for_others(arcade: Arcade) -> None:
    page = arcade.open(ConsentPage(arcade.context, "pitanks"))
    arcade.press(Button.FIRE, Button.FIRE, Button.FIRE)
    assert page.seats.waiting == [0]
    arcade.press(Button.FIRE, Button.RIGHT, Button.FIRE, Button.FIRE, device=KEYS[1])
    assert arcade.stack.top is page
    assert not page.agreed
    arcade.press(Button.RIGHT, Button.FIRE, Button.BACK)
    assert page.seats.waiting == [0]


def test_a_match_is_kept_with_devices_and_age_bands_and_nothing_else_of_its_people(arcade: Arcade) -> None:
    consent(arcade)
    assert played(arcade) == TURNS
    head = json.loads(kept.paths()[0].read_bytes().partition(b"\n")[0])
    assert head["participants"] == [vars(one) for one in TURNS]
    assert not store.paths()  # it does not count as an ordinary replay


def test_a_match_outside_a_play_test_is_not_kept(arcade: Arcade) -> None:
    assert played(arcade) == []


@pytest.mark.parametrize(
    "during",
    [
        lambda scene: scene.drivers.devices.__setitem__(2, KEYS[2]),
        lambda scene: scene.drivers.devices.__setitem__(1, Device("pad", 7)),
        lambda scene: scene.drivers.assisted.add(0),
        lambda scene: scene.context.driving.chosen.__setitem__(KEYS[1], "one_button"),
    ],
    ids=["somebody joined", "another took a seat", "an AI drove", "an AI drives"],
)
def test_a_match_is_not_kept_unless_all_who_drove_have_agreed(arcade: Arcade, during) -> None:
    consent(arcade)
    assert played(arcade, during=during) == []
    assert arcade.context.notices.waiting[0] == arcade.context.words("playtest.not_kept")


def test_consent_is_for_one_match(arcade: Arcade) -> None:
    """In a rematch another person may hold the device."""
    consent(arcade)
    played(arcade)
    first = kept.paths()
    played(arcade)
    assert kept.paths() == first
    assert len(first) == 1


def test_consent_ends_with_the_page(arcade: Arcade) -> None:
    page = consent(arcade)
    arcade.stack.scenes.remove(page)
    assert played(arcade) == []


def test_the_last_or_all_are_deleted_by_holding_fire(arcade: Arcade) -> None:
    replay = replays.recorded(arcade.open(MatchScene(arcade.context, SHORT, KEYS)).match)
    for _ in range(3):
        kept.keep(replay, tuple(TURNS))
    page = arcade.open(PlayTestPage(arcade.context))
    for row, left in (("last", 2), ("all", 0)):
        page.focus.move_to(row)
        page.held()
        assert (len(kept.paths()), page.count) == (left, left)


@pytest.mark.parametrize(("field", "value"), [("age", "Anna"), ("age", "12"), ("device", "camera"), ("driving", "")])
def test_a_file_with_other_words_is_refused(arcade: Arcade, field, value) -> None:
    replay = replays.recorded(arcade.open(MatchScene(arcade.context, SHORT, KEYS)).match)
    wrong = PlayTestReplay(**vars(replay), participants=(replace(TURNS[0], **{field: value}),))
    with pytest.raises(ReplayError, match="participants"):
        decode(pack(wrong), "a")


def test_every_age_band_has_its_words(arcade: Arcade) -> None:
    page = arcade.open(ConsentPage(arcade.context, "pitanks"))
    arcade.press(Button.FIRE)
    for _ in AGES:
        arcade.press(Button.RIGHT)
        arcade.frame(draw=True)
    assert page.ages[KEYS[0]] == len(AGES) - 1
