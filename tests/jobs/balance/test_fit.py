"""`people fit` from files: whose traits it prints, of whom it does not, and what it says where play is too short."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from pigaming_app.ai.people.models import PEOPLE as MODELS
from pigaming_app.games.replay import Replay, recorded
from pigaming_app.jobs.cli import main
from pigaming_app.scenes.features.replays import pack
from pigaming_app.scenes.playtest.replays import Participant, PlayTestReplay
from tests.matches import match_of

PEOPLE = ("beginner", "level1", "human", "level1")


@pytest.fixture(scope="module")
def replay() -> Replay:
    """Two thirds of a minute of a beginner against two AIs and somebody who does nothing."""
    match = match_of("pitanks", PEOPLE, minutes=0.65, seed=4)
    while not match.over:
        match.tick()
    return recorded(match)


def fit(capsys: pytest.CaptureFixture[str], *words: object) -> Any:
    """What `people fit` prints as JSON."""
    code = main(["people", "fit", *map(str, words), "--json"])
    found = json.loads(capsys.readouterr().out)
    assert code == int(not any("traits" in person for person in found["people"]))
    return found


@pytest.mark.long
def test_people_and_models_are_fitted_and_ais_are_not(tmp_path: Path, replay: Replay, capsys) -> None:
    (tmp_path / "a.replay").write_bytes(pack(replay))
    found = fit(capsys, tmp_path / "a.replay")
    assert [one["seat"] for one in found["people"]] == [1, 3]
    first, idle = found["people"]
    assert first["nearest"] in MODELS
    assert first["traits"]["decisions"]["value"] == pytest.approx(3.6, rel=0.15)  # HZ / hands.period of this person
    assert first["traits"]["aim"] is None  # 40 seconds do not tell it
    assert idle["fault"] == "not enough play"
    assert found["groups"] == []


@pytest.mark.long
def test_people_of_a_play_test_make_groups(tmp_path: Path, replay: Replay, capsys) -> None:
    told = (Participant(0, "keys", "7-9", "turn"), Participant(2, "keys", "adult", "turn"))
    for name in "ab":
        (tmp_path / name).write_bytes(pack(PlayTestReplay(**vars(replay), participants=told)))
    found = fit(capsys, tmp_path / "a", tmp_path / "b")
    assert [(group["device"], group["age"], group["people"]) for group in found["groups"]] == [
        ("keys", "7-9", 2),
    ]  # fmt: skip
    first = found["people"][0]
    assert (first["device"], first["age"], first["files"]) == ("keys", "7-9", ["a"])


@pytest.mark.long
def test_together_the_same_seat_is_the_same_person(tmp_path: Path, replay: Replay, capsys) -> None:
    for name in "ab":
        (tmp_path / name).write_bytes(pack(replay))
    apart, together = (fit(capsys, tmp_path / "a", tmp_path / "b", *more) for more in ((), ("--together",)))
    assert [len(found["people"]) for found in (apart, together)] == [4, 2]
    assert together["people"][0]["minutes"] == pytest.approx(2 * apart["people"][0]["minutes"])


def test_a_match_that_plays_out_differently_is_not_fitted(tmp_path: Path, replay: Replay, capsys) -> None:
    (tmp_path / "a").write_bytes(pack(replace(replay, digest="0" * 64)))
    found = fit(capsys, tmp_path / "a")
    assert {one["fault"] for one in found["people"]} == {"plays out differently in this version"}


def test_of_too_short_play_nothing_is_told(tmp_path: Path, capsys) -> None:
    match = match_of("pitanks", PEOPLE, minutes=0.1, seed=4)
    while not match.over:
        match.tick()
    (tmp_path / "a").write_bytes(pack(recorded(match)))
    assert {one["fault"] for one in fit(capsys, tmp_path / "a")["people"]} == {"not enough play"}


def test_a_file_without_people_is_refused(tmp_path: Path, replay: Replay, capsys) -> None:
    one, two, three, four = (replace(seat, brain="level1") for seat in replay.setup.seats)
    (tmp_path / "a").write_bytes(pack(replace(replay, setup=replace(replay.setup, seats=(one, two, three, four)))))
    assert main(["people", "fit", str(tmp_path / "a")]) == 2
    assert "no people on its seats" in capsys.readouterr().err


@pytest.mark.long
def test_the_text_names_units_and_what_is_missing(tmp_path: Path, replay: Replay, capsys) -> None:
    (tmp_path / "a").write_bytes(pack(replay))
    assert main(["people", "fit", str(tmp_path / "a")]) == 0
    text = capsys.readouterr().out
    assert "a, seat 1\n  0.7 minutes of pitanks, nearest to " in text
    assert "a second" in text
    assert "aim        not enough play" in text
