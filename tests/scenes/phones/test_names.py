"""The names of phones where people look for them, and nowhere else."""

import pytest

from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.awards.ceremony import seat_name
from pigaming_app.scenes.results.initials import Initials, qualifying
from pigaming_app.scenes.results.scene import INPUT_LOCKOUT, Results
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.storage.settings import folders
from pigaming_app.ui.input.events import Button, Device
from tests.scenes.arcade import KEYS, Arcade, setup

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed", "_home")
NAME = "Quetzalina"  # in no other text


def a_match(arcade: Arcade, brains: str = "human human level1 off") -> tuple[MatchScene, list[Device]]:
    """A match of a phone with a name, one without, and an AI."""
    phones = arcade.context.controls.phones
    devices = [Device("phone", phones.connect()) for _ in range(2)]
    phones.names[devices[0].number] = NAME
    arcade.frame()
    return arcade.open(MatchScene(arcade.context, setup(brains), devices)), devices


def test_the_name_of_a_phone_is_on_the_hud_the_headline_and_the_results(arcade: Arcade) -> None:
    match, _ = a_match(arcade)
    assert [*match.runner.view.hud.names][:3] == [NAME, "", ""]  # type: ignore[attr-defined]
    arcade.finish(5, 1)
    assert arcade.shown(WinnersMoment).name == f"{NAME} wins!"
    arcade.skip_moments()
    ended = arcade.shown(Results).ended
    assert [seat_name(arcade.context.words, ended, seat) for seat in (0, 1)] == [NAME, "Player 2"]


def test_the_name_follows_the_driver(arcade: Arcade) -> None:
    match, phones = a_match(arcade)
    match.drivers.assign(0, KEYS[0])
    assert not any(match.names)
    match.drivers.assign(1, phones[0])
    assert [*match.names][:2] == ["", NAME]
    match.drivers.assign(1, None)
    assert not any(match.names)


def test_a_team_is_named_only_if_each_of_it_has_a_name(arcade: Arcade) -> None:
    phones = arcade.context.controls.phones
    devices = [Device("phone", phones.connect()) for _ in range(4)]
    for device, name in zip(devices, ("Ana", "Bea", "Zoë", ""), strict=True):
        phones.names[device.number] = name
    arcade.frame()
    for scores, said in (((5, 5, 0, 0), "Ana + Bea win!"), ((0, 0, 5, 5), "Team 2 wins!")):
        arcade.open(MatchScene(arcade.context, setup("human human human human", teams=(0, 0, 1, 1)), devices))
        arcade.finish(*scores)
        assert arcade.shown(WinnersMoment).name == said


def test_no_file_has_the_name_of_a_phone(arcade: Arcade, caplog: pytest.LogCaptureFixture) -> None:
    """After a match with a record: no log, no replay, no high score, unless its owner enters letters."""
    match, phones = a_match(arcade)
    arcade.finish(5, 1)
    arcade.skip_moments()
    results = arcade.shown(Results)
    results.claims = []
    arcade.wait(INPUT_LOCKOUT + 0.2)
    arcade.press(Button.UP, device=phones[0])
    initials = Initials(
        arcade.context, qualifying(arcade.context, match.match.outcome(), match.setup, phones), lambda fresh: None
    )
    assert all(spelling.taken is None for spelling in initials.spellings.values()), "at the timeout nothing is entered"
    written = [path for folder in (folders().data, folders().config) for path in folder.rglob("*") if path.is_file()]
    assert any("replay" in str(path) for path in written), "the match was saved"
    for path in written:
        assert NAME.encode().lower() not in path.read_bytes().lower(), path
    assert NAME not in caplog.text
