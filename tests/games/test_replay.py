"""Replays: a saved match plays out again bit by bit; any other file is refused in one line."""

import hashlib
import json
import random
import zlib
from dataclasses import replace
from typing import Any

import pytest

from pigaming_app.games.match import Match
from pigaming_app.games.replay import BYTES_PER_TICK, ReplayError, decode, encode, to_match, verify
from pigaming_app.sim.record import digest
from tests.matches import finished, match_of, run

BRAINS = ("hand3", "random", "fsm", "random")


def played(minutes, brains=BRAINS):
    return finished(match_of("pitanks", brains, "classic", minutes, 42, "pickups"))


def read(path):
    return decode(path.read_bytes(), path.name)


@pytest.fixture(scope="module")
def match():
    return played(0.2)


@pytest.fixture
def path(match, tmp_path):
    (tmp_path / "match.replay").write_bytes(encode(match))
    return tmp_path / "match.replay"


def refused(path, raw):
    """The error of one line with which these bytes are refused."""
    path.write_bytes(raw)
    with pytest.raises(ReplayError) as caught:
        read(path)
    line = str(caught.value)
    assert line.startswith(path.name + ": ")
    assert "\n" not in line
    assert len(line) < 300
    return line


def forged(path, packed=None, **changes):
    """The bytes of the file with a changed head and a matching check, as forged on purpose."""
    line, _, rest = path.read_bytes().partition(b"\n")
    head = {**json.loads(line), **changes}
    head = {key: value for key, value in head.items() if key != "check" and value is not None}
    rest = rest if packed is None else packed
    head["check"] = hashlib.sha256(json.dumps(head, sort_keys=True).encode() + rest).hexdigest()
    return json.dumps(head).encode() + b"\n" + rest


def test_what_is_saved_comes_back_and_plays_out_to_the_last_bit(match, path):
    replay = read(path)
    assert replay.setup == match.setup
    assert replay.ticks == bytes(match.log.ticks)
    assert verify(replay)
    again = finished(to_match(replay))
    assert digest(again.state) == digest(match.state)
    assert again.outcome() == match.outcome()


def test_a_replay_of_a_replay_is_the_same_file(path, tmp_path):
    again = finished(to_match(read(path)))
    (tmp_path / "again").write_bytes(encode(again))
    assert (tmp_path / "again").read_bytes() == path.read_bytes()


def test_a_match_is_saved_as_far_as_it_has_been_played(tmp_path):
    match = Match(played(0.05).setup)
    (tmp_path / "none").write_bytes(encode(match))
    assert verify(read(tmp_path / "none"))
    run(match, 10)
    (tmp_path / "ten").write_bytes(encode(match))
    assert len(read(tmp_path / "ten").ticks) == 120
    assert verify(read(tmp_path / "ten"))


def test_a_minute_takes_less_than_10_kb(tmp_path):
    for brains in (("hand3",) * 4, ("random",) * 4):
        (tmp_path / "minute").write_bytes(encode(played(1.0, brains)))
        assert (tmp_path / "minute").stat().st_size < 10_000


def test_another_action_plays_out_differently(path):
    replay = read(path)
    ticks = bytearray(replay.ticks)
    at = len(ticks) - 20 * BYTES_PER_TICK  # since a wall may bring two robots to the same place
    ticks[at] = 128 - ticks[at] if ticks[at] != 64 else 128
    assert not verify(replace(replay, ticks=bytes(ticks)))


def test_a_file_cut_short_anywhere_is_refused(path):
    raw = path.read_bytes()
    for length in [*range(0, len(raw), 100), len(raw) - 1]:
        refused(path, raw[:length])


def test_any_flipped_byte_is_refused(path):
    raw = path.read_bytes()
    for place in range(0, len(raw), 37):
        for flip in (0x01, 0x80, 0xFF):
            edited = bytearray(raw)
            edited[place] ^= flip
            refused(path, bytes(edited))


def test_something_added_at_the_end_is_refused(path):
    assert "damaged" in refused(path, path.read_bytes() + b"\0")


FOREIGN = {
    "empty": b"",
    "noise": random.Random(1).randbytes(5000),
    "text": b"Dear diary,\nit rained.",
    "picture": b"\x89PNG\r\n\x1a\n" + bytes(100),
    "json": b'{"a": 1}\nrest',
    "list": b"[1, 2]\nrest",
    "number": b"7\nrest",
    "null format": b'{"format": null}\n',
    "deep": b"[" * 90_000 + b"\n",
    "deep tables": b'{"format":' * 9_000 + b"\n",
    "long number": b"9" * 50_000 + b"\n",
}


@pytest.mark.parametrize("name", FOREIGN)
def test_a_foreign_file_is_refused(name, tmp_path):
    assert "not a PiGaming replay" in refused(tmp_path / "foreign", FOREIGN[name])


def test_another_format_says_so(path):
    line = refused(path, forged(path, format="pigaming-replay-2"))
    assert "pigaming-replay-2" in line
    assert "pigaming-replay-1" in line


def test_a_replay_of_another_engine_is_read_and_says_so(path):
    assert not read(path).other_engine
    path.write_bytes(forged(path, engine="0" * 64))
    assert read(path).other_engine
    assert verify(read(path))


def head_of(path):
    return json.loads(path.read_bytes().partition(b"\n")[0])


NONSENSE: dict[str, dict[str, Any]] = {
    "no setup": {"setup": None},
    "setup is a text": {"setup": "classic"},
    "setup is a list": {"setup": [1]},
    "no ticks": {"ticks": None},
    "fewer ticks": {"ticks": 1},
    "ticks below zero": {"ticks": -1},
    "ticks are a text": {"ticks": "many"},
    "ticks for ever": {"ticks": float("inf")},
    "too many ticks": {"ticks": 10**9},
    "no arena": {"arena": None},
    "arena is no arena": {"arena": "[[wall]]"},
}


@pytest.mark.parametrize("name", NONSENSE)
def test_a_forged_head_is_refused(name, path):
    refused(path, forged(path, **NONSENSE[name]))


SETUPS: dict[str, dict[str, Any]] = {
    "another game": {"game": "chess"},
    "another variant": {"variant": "blitz"},
    "no time": {"minutes": 0},
    "nan minutes": {"minutes": float("nan")},
    "endless": {"minutes": 10**400},
    "seed is a text": {"seed": "lucky"},
    "three seats": {"seats": [{"brain": "random", "team": i} for i in range(3)]},
    "seats are numbers": {"seats": [1, 2, 3, 4]},
    "team is nothing": {"seats": [{"brain": "random", "team": None}] * 4},
    "team beyond all numbers": {"seats": [{"brain": "random", "team": i * 10**30} for i in range(4)]},
    "all in one team": {"seats": [{"brain": "random", "team": 1}] * 4},
    "nobody": {"seats": [{"brain": "off", "team": i} for i in range(4)]},
    "a goal that the game has not": {"goal": 3},
    "goal is a text": {"goal": "all"},
}


@pytest.mark.parametrize("name", SETUPS)
def test_a_forged_setup_is_refused(name, path):
    refused(path, forged(path, setup={**head_of(path)["setup"], **SETUPS[name]}))


def test_forged_ticks_are_refused(path):
    refused(path, forged(path, packed=b"no zlib at all"))
    refused(path, forged(path, packed=zlib.compress(b"\0" * 11)))
    refused(path, forged(path, packed=zlib.compress(bytes(10_000_000), 9)))
