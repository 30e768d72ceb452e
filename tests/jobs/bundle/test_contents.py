"""The bundle without building it: its icons, its files, and what it never replaces."""

import io
import runpy
import struct
import sys
import tomllib
from importlib.util import cache_from_source
from pathlib import Path

import pygame
import pytest

from pigaming_app import ROOT
from pigaming_app.boot import bundled
from pigaming_app.jobs import cli
from pigaming_app.jobs.bundle import build, contents
from pigaming_app.jobs.terminal import command, refusal


def size_of(png: bytes) -> tuple[int, int]:
    return pygame.image.load(io.BytesIO(png)).get_size()


def test_the_icon_fills_its_square_and_leaves_its_corners_open() -> None:
    icon = pygame.image.load(io.BytesIO(build.png(64)))
    assert icon.get_at((0, 0))[3] == 0
    assert icon.get_at((32, 5))[3] == 255
    assert max(icon.get_at((x, 30))[0] for x in range(64)) > 200


def test_the_icon_of_windows_lists_pictures_at_their_places() -> None:
    data = build.ico()
    assert struct.unpack_from("<HHH", data) == (0, 1, len(build.ICO))
    for index, size in enumerate(build.ICO):
        w, h, _, _, _, depth, length, begin = struct.unpack_from("<BBBBHHII", data, 6 + 16 * index)
        assert (w or 256, h or 256, depth) == (size, size, 32)
        assert size_of(data[begin : begin + length]) == (size, size)


def test_the_icon_of_macos_is_a_chain_of_pictures() -> None:
    data = build.icns()
    assert struct.unpack_from(">4sI", data) == (b"icns", len(data))
    at, found = 8, []
    while at < len(data):
        kind, length = struct.unpack_from(">4sI", data, at)
        found.append((kind, size_of(data[at + 8 : at + length])[0]))
        at += length
    assert dict(found) == build.ICNS


def test_modules_files_and_assets_are_in_it() -> None:
    modules = contents.modules()
    assert {"pigaming_app", "pigaming_app.jobs.cli", "pigaming_app.jobs.arcade", "pigaming_app.ui.probe"} < set(modules)
    assert not [name for name in modules if "micropython" in name]
    copied = {f"{folder}/{Path(path).name}" for path, folder in contents.files()}
    for name in ("assets/text/en.toml", "assets/rude.toml", "./pyproject.toml", "assets/arenas/pitanks/classic.toml"):
        assert name in copied
    assert "pigaming_app/hardware/firmware/micropython/robot.py" in copied
    wheel = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["hatch"]["build"]["targets"]["wheel"]
    shipped = {Path(name) for name in wheel["force-include"]}
    places = {Path(folder) / Path(path).name for path, folder in contents.files()}
    assert all(any(place.is_relative_to(name) for place in places) for name in shipped)
    assert not [name for name in copied if "pictures" in name or "__pycache__" in name]
    assert {"numpy", "pygame-ce"} <= set(contents.distributions())


def test_the_bytecode_goes_along_and_is_valid_whatever_the_dates(tmp_path: Path) -> None:
    made = contents.bytecode(tmp_path)
    assert len(made) == len(contents.modules())
    path, folder = next(one for one in made if Path(one[0]).name.startswith("kernel."))
    assert folder == "pigaming_app/sim/__pycache__"
    assert Path(path).name == Path(cache_from_source("kernel.py")).name
    assert int.from_bytes(Path(path).read_bytes()[4:8], "little") == 0b01, "PEP 552: by hash, unchecked"


def test_the_desktop_entry_starts_the_program_beside_it() -> None:
    (line,) = [line for line in build.DESKTOP.splitlines() if line.startswith("Exec=")]
    assert line == r'Exec=sh -c "exec \\"\\$(dirname \\"\\$1\\")/pigaming\\"" sh %k'


def test_a_bundle_starts_itself_and_its_own_modules_only(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(command, "FROZEN", True)
    assert command.own_command(["--kiosk"]) == [sys.executable, "--kiosk"]
    ran = []
    monkeypatch.setattr(runpy, "run_module", lambda name, **_: ran.append((name, list(sys.argv))))
    monkeypatch.setattr(sys, "argv", ["pigaming"])
    assert bundled.run_module(["-m", "pigaming_app.ui.probe", "x"])
    assert ran == [("pigaming_app.ui.probe", ["pigaming_app.ui.probe", "x"])]
    for words in ([], ["-m"], ["-m", "os"], ["--kiosk"], ["play", "-m", "pigaming_app.jobs.cli"]):
        assert not bundled.run_module(words)


@pytest.mark.parametrize(("job", "package"), [("test", "bench"), ("bundle", "bundle")])
def test_what_needs_a_clone_is_refused_in_a_bundle(
    job: str, package: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(f"pigaming_app.jobs.{package}.{job}.FROZEN", True)
    assert cli.main([job]) == 2
    assert "clone" in capsys.readouterr().err
    monkeypatch.setattr(refusal, "FROZEN", True)
    assert "pip" not in refusal.remedy("ray")


def test_the_clone_has_a_file_for_a_double_click_on_each_system() -> None:
    batch = (ROOT / "PiGaming.bat").read_bytes()
    assert batch.count(b"\n") == batch.count(b"\r\n") > 0
    assert (ROOT / "PiGaming.command").stat().st_mode & 0o111
