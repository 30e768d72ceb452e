"""The job `calibrate`: unattended calibration, the marker sheet, and refusals in one line."""

import json
from pathlib import Path

import pytest

pytest.importorskip("cv2")

from pigaming_app.jobs.cli import main


@pytest.fixture
def calibrate(capsys):
    """A function that runs the job and returns its exit code, the object that it prints and its errors."""

    def run(*words):
        code = main(["calibrate", "--json", *words])
        told = capsys.readouterr()
        return code, json.loads(told.out), told.err

    return run


@pytest.mark.long
def test_on_the_emulated_arena_the_wizard_matches_ground_truth(tmp_path, calibrate):
    code, result, errors = calibrate("--emulate", "5")
    assert (code, errors) == (0, "")
    assert result["saved"]
    assert Path(result["file"]).parent == tmp_path / "home" / "config"
    assert result["calibration_mean_mm"] <= 1.5
    assert result["calibration_max_mm"] <= 3.0
    assert result["true_mean_mm"] <= 1.5
    assert result["true_max_mm"] <= 3.0
    assert result["lids_max_mm"] <= 4.0


@pytest.mark.long
@pytest.mark.parametrize(
    ("view", "code", "exposure", "enough"),
    [
        ("dim", 0, (16.0, 16.7), True),
        ("defocused", 1, (5.9, 6.1), False),
        ("dark", 1, None, None),
        pytest.param("long", 0, (16.0, 16.7), True, marks=pytest.mark.again),
        pytest.param("silent", 0, None, True, marks=pytest.mark.again),
        pytest.param("stubborn", 1, (33.0, 33.4), False, marks=pytest.mark.again),  # --anyway: below
        pytest.param("tilted", 1, (5.9, 6.1), False, marks=pytest.mark.again),
    ],
)
def test_a_camera_that_misses_markers_fails(calibrate, view, code, exposure, enough):
    ended, result, _ = calibrate("--emulate", "3", "--view", view)
    assert (ended, result["saved"]) == (code, not code)
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
def test_it_is_saved_anyway_if_asked_for(calibrate):
    code, result, _ = calibrate("--emulate", "3", "--view", "stubborn", "--anyway")
    assert (code, result["saved"], result["sufficient"]) == (0, True, False)
    assert "anyway = true" in Path(result["file"]).read_text()


@pytest.mark.long
def test_a_folder_that_cannot_be_written_is_reported_as_a_failure(home, calibrate):
    home.mkdir()
    (home / "config").write_text("a file in the way")
    code, result, errors = calibrate("--emulate")
    assert (code, result["saved"]) == (1, False)
    assert "Traceback" not in errors
    assert result["file"] in result["trouble"]


def test_the_sheet_is_written_where_it_was_asked_for(tmp_path):
    assert main(["calibrate", "--sheet", str(tmp_path / "sheet.pdf")]) == 0
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
        (("--camera", "99"), "a number from 0 to 63"),
        (("--camera", "http://kid:p@ss:w/rd@host"), "write @ as %40"),
        (("--size", "1x1"), "--size goes with --print"),
        (("--arena", "classic"), "--arena goes with --print"),
        (("--sheet", "x.pdf", "--paper", "mat"), "--paper goes with --print"),
        (("--print", "x.pdf", "--edge", "50"), "--edge goes with --sheet"),
        (("--print", "x.pdf", "--sheet", "y.pdf"), "not allowed with"),
    ],
)
def test_what_cannot_be_done_is_one_line(refused, arguments, part):
    line = refused("calibrate", *arguments)
    assert part in line
    assert "p@ss" not in line
