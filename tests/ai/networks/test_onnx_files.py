"""Policies from elsewhere: an ONNX model plays like the network with the same numbers, and others are refused."""

import sys
from pathlib import Path

import numpy as np
import pytest

from pigaming_app import ROOT
from pigaming_app.ai.brain.kind import BrainPlayer
from pigaming_app.ai.experiments.league import duel
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.ai.registry import find_brain, new_match
from pigaming_app.cli import main
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.setup import ChoiceError
from tests.ai.networks.tiny_onnx import DOUBLE, model

ENCODING = ENCODINGS["pitanks"]
SIZE, LESS = ENCODING.size, ENCODING.size - 1
MATRIX = np.random.default_rng(1).normal(size=(ENCODING.size, ENCODING.outputs)) / 4
HEADS = np.split(MATRIX, np.cumsum([count for _, count in ENCODING.heads])[:-1], axis=1)


def test_a_missing_extra_is_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("a.onnx").write_bytes(model(MATRIX))
    monkeypatch.setitem(sys.modules, "onnxruntime", None)
    monkeypatch.setattr("pigaming_app.jobs.terminal.refusal.find_spec", lambda name: None)
    for words in (["play", "pitanks", "--seats", "a.onnx,hard", "--headless"], ["duel", "pitanks", "hard", "a.onnx"]):
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
        seats = Seat("my net.onnx", 0), Seat("hard", 1), Seat("off", 2), Seat("off", 3)
        match = new_match(Setup("pitanks", "classic", seats, 0.1, 1, "pickups"))
        while not match.over:
            match.tick()
        assert isinstance(match.brains[0], BrainPlayer)
        told = match.brains[0].explain(match.state, 0)
        assert told.heads.keys() == {"drive", "turn", "shoot", "turbo"}
        assert max(told.utilities.values()) > 0.0

    def test_a_duel_with_a_model_is_not_compiled(self):
        Path("a.onnx").write_bytes(model(MATRIX))
        assert duel("pitanks", "a.onnx", "idle", 2, 1, minutes=0.05, fast=True).matches == 2

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
