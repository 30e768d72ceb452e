"""Fidelity plots, and the message without matplotlib."""

import sys

import pytest

from pigaming_app.hardware.recordings import Recording
from pigaming_app.hardware.sysid.evaluate import measure
from pigaming_app.hardware.sysid.plots import PlotsUnavailable, draw
from pigaming_app.sim.drivetrain import MM
from tests.hardware.sentences import refused
from tests.hardware.sysid.test_evaluate import danced


@pytest.fixture(scope="module")
def run():
    return Recording(MM, {1: danced(24.0, noise=1.0).courses[1]})


@pytest.mark.long
def test_two_pictures_are_drawn(run, tmp_path):
    pytest.importorskip("matplotlib")
    made = draw(run, measure(run), tmp_path / "plots")
    assert [path.name for path in made] == ["horizon.png", "paths.png"]
    assert all(path.read_bytes()[:4] == b"\x89PNG" for path in made)


def test_without_matplotlib_there_is_one_sentence(run, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with refused(PlotsUnavailable, "matplotlib"):
        draw(run, [], tmp_path)
