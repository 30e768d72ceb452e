"""The probe reports every device, also missing ones and failing checks."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from pigaming_app.ui import probe
from tests.ui.input.virtual_pad import VirtualPad

ROOT = Path(__file__).resolve().parents[2]


def test_every_check_prints_one_line():
    command = [sys.executable, "-m", "pigaming_app.ui.probe"]
    said = subprocess.run(command, cwd=ROOT, capture_output=True, timeout=60, check=True).stdout
    looks = {name: (found, wrong) for name, found, wrong in map(json.loads, said.decode().splitlines())}
    assert list(looks) == ["pygame", "displays", "sound", "pads", "fonts"]
    assert looks["pygame"][0].startswith("pygame-ce 2.")
    assert looks["displays"] == ("", "SDL_VIDEODRIVER asks for dummy")
    assert looks["fonts"] == ("all there", "")


def test_a_failing_check_does_not_stop_the_others(monkeypatch, capsys):
    def crash():
        raise RuntimeError("the driver is confused")

    monkeypatch.setitem(probe.CHECKS, "sound", crash)
    probe.main()
    assert '["sound", "", "the driver is confused"]' in capsys.readouterr().out.splitlines()


@pytest.mark.usefixtures("controls")
def test_pads_are_listed_and_those_without_a_mapping_are_a_problem():
    with VirtualPad("Xbox 360 Controller"):
        names, wrong = probe.pads()
        assert (names != "", wrong) == (True, "")
        with VirtualPad("Odd Stick", plain=True):
            assert probe.pads()[1] == "not known to SDL: Odd Stick"
    assert probe.pads() == ("", "")
