"""The job `calibrate`: unattended calibration, the marker sheet, and refusals in one line."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("cv2")

from pigaming_app.jobs.cli import main

ROOT = Path(__file__).resolve().parents[3]


def calibrate(home, *arguments):
    """Run the job; returns its output and exit code."""
    environment = {**os.environ, "PIGAMING_HOME": str(home)}
    code = "import sys; from pigaming_app.jobs.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-W", "error", "-c", code, "calibrate", *map(str, arguments)]
    return subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=300)


@pytest.mark.long
def test_on_the_emulated_arena_the_wizard_matches_ground_truth(tmp_path):
    ran = calibrate(tmp_path, "--emulate", 5, "--json")
    assert (ran.returncode, ran.stderr) == (0, "")
    result = json.loads(ran.stdout)
    assert result["saved"]
    assert Path(result["file"]).parent == tmp_path / "config"
    assert result["calibration_mean_mm"] <= 1.5
    assert result["calibration_max_mm"] <= 3.0
    assert result["true_mean_mm"] <= 1.5
    assert result["true_max_mm"] <= 3.0
    assert result["lids_max_mm"] <= 4.0


@pytest.mark.long
@pytest.mark.parametrize(
    ("view", "code", "exposure", "enough"),
    [
        ("long", 0, (16.0, 16.7), True),
        ("silent", 0, None, True),
        ("dim", 0, (16.0, 16.7), True),
        ("stubborn", 1, (33.0, 33.4), False),
        ("defocused", 1, (5.9, 6.1), False),
        ("tilted", 1, (5.9, 6.1), False),
        ("dark", 1, None, None),
    ],
)
def test_a_camera_that_misses_markers_fails(tmp_path, view, code, exposure, enough):
    ran = calibrate(tmp_path, "--emulate", 3, "--json", "--view", view)
    result = json.loads(ran.stdout)
    assert (ran.returncode, result["saved"]) == (code, not code)
    if enough is None:
        assert result["trouble"] == "Too dark for a short exposure: add even light."
        return
    assert result["exposure_ms"] is exposure or exposure[0] <= result["exposure_ms"] <= exposure[1]
    assert (result["predicted_detection"] >= 0.95) == result["sufficient"] == enough
    assert enough or "% of the markers would be found" in result["trouble"]
    assert (result["marker_edge_px"] < 20.0) == (view == "tilted")
    assert (result["blur_px"] > 2.0) == (view == "defocused")
    assert (result["gain"] > 0.0) == (view == "dim")


@pytest.mark.long
def test_it_is_saved_anyway_if_asked_for(tmp_path):
    ran = calibrate(tmp_path, "--emulate", 3, "--json", "--view", "stubborn", "--anyway")
    result = json.loads(ran.stdout)
    assert (ran.returncode, result["saved"], result["sufficient"]) == (0, True, False)
    assert "anyway = true" in Path(result["file"]).read_text()


@pytest.mark.long
def test_a_folder_that_cannot_be_written_is_reported_as_a_failure(tmp_path):
    (tmp_path / "config").write_text("a file in the way")
    ran = calibrate(tmp_path, "--emulate", "--json")
    assert ran.returncode == 1
    assert "Traceback" not in ran.stderr
    result = json.loads(ran.stdout)
    assert not result["saved"]
    assert result["file"] in result["trouble"]


def test_the_sheet_is_written_where_it_was_asked_for(tmp_path):
    ran = calibrate(tmp_path, "--sheet", tmp_path / "sheet.pdf")
    assert ran.returncode == 0
    assert (tmp_path / "sheet.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (("--json",), "--emulate"),
        (("--sheet", "/nowhere/at/all.pdf"), "/nowhere/at/all.pdf"),
        (("--sheet", "x.pdf", "--edge", "90"), "90 mm"),
        (("--sheet", "x.png"), ".pdf"),
        (("--emulate", "much"), "much"),
        (("--camera", "first"), "first"),
    ],
)
def test_what_cannot_be_done_is_one_line(tmp_path, monkeypatch, capsys, arguments, part):
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    assert main(["calibrate", *arguments]) == 2
    out, err = capsys.readouterr()
    assert part in err
    assert err.count("\n") == 1
    assert out == ""
