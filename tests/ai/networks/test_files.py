"""Files of networks: what was written is read, and everything else is refused in one line."""

import json
import random
from dataclasses import replace

import numpy as np
import pytest

from pigaming_app.ai.brain.archive import check_sum
from pigaming_app.ai.networks import files
from pigaming_app.ai.networks.files import NetworkError, decode, encode
from pigaming_app.ai.networks.policy import Handicap
from tests.ai.networks.random_network import random_network
from tests.hostile import mutated

TRAINED = random_network(handicap=Handicap(0.1, 0.05, 0.5))
RAW = encode(TRAINED)


def repacked(tmp_path, head=lambda head: head, check=True, **changes):
    """The file with a changed head and changed arrays; `check`: the check sum is made to fit."""
    path = tmp_path / "whole.npz"
    path.write_bytes(RAW)
    with np.load(path) as file:
        arrays = {name: file[name] for name in file.files}
    known = head(json.loads(str(arrays.pop("head"))))
    arrays = {name: changes.get(name, lambda array: array)(array) for name, array in arrays.items()}
    if check and isinstance(known, dict):
        known["check"] = check_sum(known, arrays)
    np.savez_compressed(path, head=np.array(json.dumps(known)), **arrays)
    return path.read_bytes()


def test_what_was_written_is_read():
    assert len(RAW) < 25_000
    read = decode(RAW, "mine.npz")
    for part in ("matrices", "biases"):
        for ours, theirs in zip(getattr(TRAINED, part), getattr(read, part), strict=True):
            assert theirs.dtype == np.int16
            assert (ours == theirs).all()
    scalars = {key: value for key, value in vars(TRAINED).items() if key not in ("matrices", "biases")}
    assert {key: getattr(read, key) for key in scalars} == scalars
    assert not read.other_engine
    assert encode(read) == RAW


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"second": lambda array: array + np.int16(1), "check": False}, "changed after it was saved"),
        ({"head": lambda head: {**head, "seed": 7}, "check": False}, "changed after it was saved"),
        ({"head": lambda head: {**head, "format": "pigaming-network-2"}}, "not a network of this version"),
        ({"head": lambda head: {**head, "game": "chess"}}, "another game"),
        ({"head": lambda head: []}, "not a network of this version"),
        ({"first": lambda array: array[:-1]}, "another shape"),
        ({"last": lambda array: array.T}, "another shape"),
        ({"last_bias": lambda array: array.astype(float)}, "whole numbers"),
        ({"first": lambda array: array * 0 + np.int16(32767)}, "too large"),
        ({"first": lambda array: np.zeros(1_000_000)}, "too big"),
        ({"head": lambda head: {**head, "recipe": {"a": float("nan")}}}, r"its head: recipe\[...\]"),
        (
            {"head": lambda head: {**head, "handicap": {**head["handicap"], "delay": 9.0}}},
            r"its head: handicap\.delay: expected a number <= 1",
        ),
        (
            {"head": lambda head: {**head, "curve": {"columns": ["a"], "rows": [[1, 2]]}}},
            "its head: curve: rows and columns do not fit",
        ),
    ],
)
def test_an_edited_file_is_refused_in_one_line(tmp_path, changes, reason):
    with pytest.raises(NetworkError, match=rf"^mine\.npz: .*{reason}"):
        decode(repacked(tmp_path, **changes), "mine.npz")


def test_hostile_heads_truncated_files_and_bit_rot(tmp_path):
    def refused(raw):
        try:
            decode(raw, "mine.npz")
        except NetworkError as error:
            return str(error).isprintable()
        return False

    head = json.loads(json.dumps(vars(TRAINED), default=lambda value: None))
    head = {key: value for key, value in head.items() if key not in ("matrices", "biases")}
    heads = [{"format": files.FORMAT, **one} for one in mutated(head)]
    kept = sum(not refused(repacked(tmp_path, lambda _, one=one: one)) for one in random.Random(1).sample(heads, 40))
    assert kept < 20
    assert all(refused(RAW[: int(share * len(RAW))]) for share in (0.0, 0.1, 0.5, 0.999))
    assert refused(RAW + bytes(files.MAX_BYTES))
    for at in range(0, len(RAW), 997):
        rotten = RAW[:at] + bytes([RAW[at] ^ 0x10]) + RAW[at + 1 :]
        assert refused(rotten) or encode(decode(rotten, "a")) == RAW  # some bytes of a zip have no effect


def test_what_could_not_be_read_is_not_written():
    for wrong in (
        replace(TRAINED, matrices=[matrix * 1.0 for matrix in TRAINED.matrices]),
        replace(TRAINED, game="chess"),
        replace(TRAINED, recipe={"a": {"b": 1}}),
        replace(TRAINED, licence="a" * 5000),
    ):
        with pytest.raises(NetworkError, match=r"^mine: "):
            encode(wrong)
