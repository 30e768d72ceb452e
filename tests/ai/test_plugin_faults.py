"""Failures that are due to a plug-in though they arise in our code."""

from collections.abc import Callable
from pathlib import Path

import pytest

from pigaming_app.ai import plugin_faults
from pigaming_app.ai.plugin_faults import blame, suspect, wrong_numbers
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.storage.plugins import parts
from pigaming_app.storage.plugins.found import Plugin

TAG = Plugin("tag", "tag", Path("/nowhere/tag"))
SEATS = (Seat("idle", 0), Seat("idle", 1), Seat("off", 2), Seat("off", 3))


@pytest.fixture(autouse=True)
def stopped(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The reasons for which Tag, the only plug-in, is left out."""
    reasons: list[str] = []

    def stop(plugin: Plugin, reason: str) -> Plugin:
        reasons.append(reason)
        return plugin

    monkeypatch.setattr(parts, "plugins", lambda: (TAG,))
    monkeypatch.setattr(parts, "stop", stop)
    plugin_faults._failures.clear()
    return reasons


def error_of(function: Callable[[], object]) -> Exception:
    with pytest.raises(Exception) as caught:  # noqa: PT011
        function()
    return caught.value


def show(game: str) -> None:
    raise TypeError(f"no {game[:0]}words")


class Shown:
    """A scene with a setup."""

    def __init__(self, game: str) -> None:
        self.setup = Setup(game, "classic", SEATS, 1.0, 1, "standard")

    def draw(self) -> None:
        raise TypeError("no words")


@pytest.mark.parametrize("failing", [lambda: show("tag"), lambda: Shown("tag").draw()])
def test_a_game_with_which_our_code_fails_twice_is_left_out(stopped: list[str], failing: Callable[[], None]) -> None:
    assert blame(error_of(failing)) is None
    assert suspect(error_of(failing)) is None
    assert suspect(error_of(failing)) is TAG
    (reason,) = stopped
    assert reason.startswith("TypeError: no words (test_plugin_faults.py, line ")


def test_failures_with_our_games_are_nobody_elses(stopped: list[str]) -> None:
    for _ in range(3):
        assert suspect(error_of(lambda: show("race"))) is None
        assert suspect(error_of(lambda: Shown("pitanks").draw())) is None
    assert stopped == []


def test_numbers_that_are_none_are_named() -> None:
    match = Match(Setup("pitanks", "classic", SEATS, 1.0, 1, "standard"))
    assert list(wrong_numbers(match.state)) == []
    match.state.robots[1].score = 0.5
    match.state.robots[2].x = float("inf")
    match.state.robots[3].score = 10**21
    assert list(wrong_numbers(match.state)) == [
        "PiTanks.robots[1].score is 0.5, no whole number",
        "PiTanks.robots[2].x is inf, no number",
        "PiTanks.robots[3].score is 1e+21, beyond 64 bits",
    ]


def test_an_error_while_a_match_is_made_is_no_other_error() -> None:
    error = error_of(lambda: Match(Setup("pitanks", "nowhere", SEATS, 1.0, 1, "standard")))
    assert blame(error) is None
