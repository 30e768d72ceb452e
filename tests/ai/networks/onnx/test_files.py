"""Policies from elsewhere: an ONNX model plays like the network with the same numbers, and others are refused."""

import os
import sys
from pathlib import Path

import numpy as np
import pytest

from pigaming_app import ROOT
from pigaming_app.ai.explanations.registry import thoughts_of
from pigaming_app.ai.learning.league import duel
from pigaming_app.ai.networks.onnx import child
from pigaming_app.ai.networks.onnx.files import OnnxPolicy
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.setup import ChoiceError
from pigaming_app.jobs.cli import main
from tests.ai.networks.onnx.tiny_onnx import DOUBLE, endless, field, model, node, tensor, troubled
from tests.matches import finished, match_of, player_of

ENCODING = ENCODINGS["pitanks"]
SIZE, LESS = ENCODING.size, ENCODING.size - 1
MATRIX = np.random.default_rng(1).normal(size=(ENCODING.size, ENCODING.outputs)) / 4
HEADS = np.split(MATRIX, np.cumsum([count for _, count in ENCODING.heads])[:-1], axis=1)


def tensors(**arrays):
    return b"".join(field(5, tensor(name, array)) for name, array in arrays.items())


def looping(rounds):
    once = tensors(rounds=np.array(rounds, "<i8"), yes=np.array(True), zero=np.zeros((1, 1), "<f4"))
    return troubled(MATRIX, endless(), tensors=once)


def large(side):
    """A model that fills a matrix of this side with numbers for each decision: 4 bytes for each."""
    nodes = [
        node("ConstantOfShape", ("shape",), ("zeros",)),
        node("ReduceMax", ("x",), ("most",), keepdims=1),
        node("Add", ("zeros", "most"), ("sums",)),
        node("ReduceMax", ("sums",), ("trouble",), keepdims=1),
    ]
    return troubled(MATRIX, *nodes, tensors=tensors(shape=np.array([side, side], "<i8")))


def elsewhere(place):
    """A model with a number in another file, among its own or in a branch."""
    lies = field(1, 1) + field(1, 1) + field(2, 1) + field(8, b"e") + field(13, field(1, b"location") + field(2, b"w"))
    lies += field(14, 1)
    if place == "own":
        return troubled(MATRIX, node("Identity", ("e",), ("trouble",)), tensors=field(5, lies))
    constant = (
        field(2, b"trouble") + field(4, b"Constant") + field(5, field(1, b"value") + field(5, lies) + field(20, 4))
    )
    inner = node("If", ("yes",), ("trouble",), then_branch=field(1, constant), else_branch=field(1, constant))
    return troubled(MATRIX, inner, tensors=tensors(yes=np.array(True)))


def test_a_missing_extra_is_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("a.onnx").write_bytes(model(MATRIX))
    monkeypatch.setitem(sys.modules, "onnxruntime", None)
    monkeypatch.setattr("pigaming_app.jobs.terminal.refusal.find_spec", lambda name: None)
    for words in (
        ["play", "pitanks", "--seats", "a.onnx,level5", "--headless"],
        ["duel", "pitanks", "level5", "a.onnx"],
    ):
        assert main(words) == 2
        assert "onnxruntime is missing (extra `onnx`)" in capsys.readouterr().err
    with pytest.raises(ChoiceError, match=r"^a\.onnx: onnxruntime is missing"):
        find_brain("pitanks", "a.onnx")


class TestWithTheExtra:
    """Models run by onnxruntime."""

    @pytest.fixture(autouse=True)
    def folder(self, tmp_path, monkeypatch):
        pytest.importorskip("onnxruntime")
        monkeypatch.chdir(tmp_path)

    @pytest.mark.parametrize("whole", [model(MATRIX), model(*HEADS), model(MATRIX, batch="N")])
    def test_a_model_chooses_by_its_logits(self, whole):
        Path("my net.onnx").write_bytes(whole)
        kind = find_brain("pitanks", "my net.onnx")
        inputs = np.random.default_rng(2).integers(-256, 257, ENCODING.size).astype(float)
        logits = kind.weights(False)[0].logits(inputs.tolist())
        assert np.array(logits) / 65536.0 == pytest.approx(inputs / 256.0 @ MATRIX, rel=1e-4, abs=1e-4)
        match = finished(match_of("pitanks", ["my net.onnx", "level5"], minutes=0.1, variant="pickups"))
        told = thoughts_of(match, 0)
        assert told is not None
        assert told.heads.keys() == {"drive", "turn", "shoot", "turbo"}
        assert max(told.utilities.values()) > 0.0

    def test_a_duel_with_a_model_is_not_compiled(self):
        Path("a.onnx").write_bytes(model(MATRIX))
        assert duel("pitanks", "a.onnx", "idle", 2, 1, minutes=0.05, fast=True).matches == 2

    def test_a_short_loop_is_no_trouble(self):
        Path("a.onnx").write_bytes(looping(3))
        assert len(find_brain("pitanks", "a.onnx").weights(False)[0].logits([0.0] * SIZE)) == ENCODING.outputs

    @pytest.mark.parametrize(
        ("raw", "reason"),
        [
            (looping(10**12), "a decision takes longer than 20 ms"),
            (looping(100_000), "a decision takes longer than 20 ms"),
            (large(20_000), "it needs more than 256 MB of memory"),
            (elsewhere("own"), "its weights lie in another file; export it as one file"),
            (elsewhere("branch"), "its weights lie in another file; export it as one file"),
        ],
    )
    def test_a_model_beyond_its_limits_is_one_line(self, raw, reason, capsys):
        Path("a.onnx").write_bytes(raw)
        assert main(["play", "pitanks", "--headless", "--minutes", "0.1", "--seats", "a.onnx,level5"]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert line.startswith(f"PiGaming: a.onnx: {reason}")

    @pytest.mark.parametrize(
        ("raw", "reason"),
        [
            (looping(10**12), "a decision takes longer than 20 ms"),
            (large(20_000), "it needs more than 256 MB of memory"),
        ],
    )
    def test_one_that_fails_in_a_match_leaves_its_seat_idle(self, raw, reason, monkeypatch, capsys):
        """As one whose trouble depends on its input."""
        failures: list[str] = []
        monkeypatch.setattr(OnnxPolicy, "_try", lambda policy: None)
        monkeypatch.setattr("pigaming_app.ai.networks.onnx.files.failed", failures)
        Path("a.onnx").write_bytes(raw)
        match = match_of("pitanks", "a.onnx level5", minutes=0.1, variant="pickups")
        while not match.over:
            match.tick()
            action = match.state.actions[0]
            assert (action.linear, action.angular, action.fire, action.turbo) == (0, 0, 0, 0)
        assert capsys.readouterr().err == f"PiGaming: a.onnx: {reason}; its seat idles from here on\n"
        assert failures == ["a.onnx"]
        process = player_of(match).weights._process._process
        assert (process.returncode == child.TOO_LONG) == (raw == looping(10**12))
        assert not os.path.exists(f"/proc/{process.pid}")

    @pytest.mark.parametrize(
        ("game", "raw", "reason"),
        [
            ("pitanks", b"hello", "not an ONNX model"),
            ("pitanks", b"", "not an ONNX model"),
            ("pitanks", model(MATRIX)[:-500], "not an ONNX model"),
            (
                "pitanks",
                model(MATRIX[:-1]),
                rf"its input is tensor\(float\) \(1, {LESS}\); pitanks needs float \(1, {SIZE}\)",
            ),
            ("pitanks", model(MATRIX[:, :-1]), r"its output is .*\(1, 13\); pitanks needs float \(1, 14\)"),
            ("pitanks", model(*HEADS[::-1]), "its output is "),
            ("pitanks", model(MATRIX, batch=4), "its input is "),
            ("pitanks", model(MATRIX, kind=DOUBLE), "its input is tensor.double"),
            ("factory", model(MATRIX), r"its input is .*; factory needs float \(1, 140\)"),
        ],
    )
    def test_another_file_is_refused_in_one_line(self, game, raw, reason):
        Path("a.onnx").write_bytes(raw)
        with pytest.raises(ChoiceError, match=rf"^a\.onnx: .*{reason}"):
            find_brain(game, "a.onnx")


def test_the_contract_names_the_shapes():
    text = (ROOT / "docs" / "networks.md").read_text(encoding="utf-8")
    assert f"float32, (1, {ENCODING.size})" in text
    assert f"one output (1, {ENCODING.outputs})" in text
    flat = " ".join(text.split())
    for group, length in ENCODING.groups:
        assert f"{group} {length}" in flat or group in ("first", "second", "third")
