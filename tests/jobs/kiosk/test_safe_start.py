"""Safe start: real kiosks ended by a second screen, of a setting or of an option; and counting by a simulated clock."""

import sys
from pathlib import Path

import pytest

from pigaming_app.jobs.kiosk.start import SafeStart, supervise
from pigaming_app.jobs.kiosk.supervisor import Limits
from pigaming_app.scenes.kiosk import safe_start
from pigaming_app.storage.plugins import consent
from pigaming_app.storage.restarts import restarts
from pigaming_app.storage.settings import Settings
from tests.jobs.kiosk.test_supervisor import Clock

ROOT = Path(__file__).resolve().parents[3]
QUICK = Limits(poll=0.02, start=120.0, hang=120.0, delays=(0.0,))
KIOSK = """
import os, signal, sys
from pigaming_app.jobs import cli
from pigaming_app.scenes.kiosk.scoreboard import window

def broken(*_):
    if sys.argv[1] == "kill":
        os.kill(os.getpid(), signal.SIGKILL)
    raise TypeError("invalid position argument")

window.ScoreboardWindow = broken
sys.exit(cli.main(sys.argv[2:]))
"""


@pytest.fixture
def config(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    return tmp_path / "config"


def kiosk(how: str, *words: str) -> int:
    """The exit code of a kiosk that closes after three pictures, unless its second screen ends it before."""
    return supervise([sys.executable, "-c", KIOSK, how, *words, "--kiosk", "--frames", "3"], QUICK)


def reports(config: Path) -> str:
    """The crash reports: why there were others than wanted."""
    return "\n".join(path.read_text() for path in sorted((config.parent / "data" / "crashes").glob("*.txt")))


def saved(config: Path) -> Settings:
    return Settings.load(config)[0]


def changed(config: Path, **values: object) -> None:
    settings = saved(config)
    for name, value in values.items():
        settings.choose(name, value)
    settings.save(config)


@pytest.mark.long
@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize("how", ["raise", "kill"])
def test_a_saved_setting_that_ends_every_start_is_taken_back_after_two_restarts(
    config: Path, how: str, capfd: pytest.CaptureFixture[str]
) -> None:
    changed(config, music=3, wifi_key="0123456789abcdef" * 2)
    safe_start.keep(config, safe_start.contents(config))
    changed(config, scoreboard=2, arena_id=77)
    assert kiosk(how) == 0
    assert len(restarts(config.parent / "data")) == 2
    now = saved(config)
    assert (now.scoreboard, now.music, now.arena_id, now.wifi_key) == (0, 3, 77, "0123456789abcdef" * 2)
    assert safe_start.taken_back(config) == ["scoreboard"]
    assert "taken back: scoreboard." in capfd.readouterr().err


@pytest.mark.long
def test_an_option_that_ends_every_start_leads_to_defaults_and_no_setting_is_lost(
    config: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    changed(config, display=1, phones_port=9999, music=3)
    safe_start.keep(config, safe_start.contents(config))
    assert kiosk("raise", "--scoreboard", "2") == 0
    assert len(restarts(config.parent / "data")) == 5, reports(config)
    now = saved(config)
    assert (now.display, now.phones_port, now.music) == (1, 9999, 3)
    assert safe_start.taken_back(config) == []
    assert "until the kiosk is closed" in capfd.readouterr().err


# ---- counting


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def kiosk_start(config: Path, clock: Clock) -> SafeStart:
    changed(config, music=3)
    safe_start.keep(config, safe_start.contents(config))
    return SafeStart(config, config.parent / "data", clock)


def runs(safe: SafeStart, clock: Clock, seconds: float, beats: int = 1) -> None:
    """An arcade that has drawn `beats` pictures runs for so long."""
    for _ in range(round(seconds)):
        safe.watch(beats)
        clock.now += 1.0
    safe.watch(beats)


def crash(safe: SafeStart, clock: Clock, times: int = 1, seconds: float = 5.0, beats: int = 1) -> None:
    for _ in range(times):
        safe.start()
        runs(safe, clock, seconds, beats)
        safe.restart()


def test_a_change_in_a_running_arcade_is_taken_back_alone(kiosk_start: SafeStart, clock: Clock, config: Path) -> None:
    kiosk_start.start()
    changed(config, sounds=1, quiet_from="22:00")
    runs(kiosk_start, clock, 3600)
    changed(config, scoreboard=2, language="pt")
    runs(kiosk_start, clock, 50)
    kiosk_start.restart()
    assert saved(config).scoreboard == 2
    crash(kiosk_start, clock)
    now = saved(config)
    assert (now.scoreboard, now.language, now.sounds, now.quiet_from, now.music) == (0, "en", 1, "22:00", 3)
    assert safe_start.taken_back(config) == ["language", "scoreboard"]
    assert not kiosk_start.safe


def test_one_that_ran_for_a_minute_is_not_taken_back(kiosk_start: SafeStart, clock: Clock, config: Path) -> None:
    kiosk_start.start()
    changed(config, scoreboard=2)
    runs(kiosk_start, clock, 61)
    kiosk_start.restart()
    crash(kiosk_start, clock, 4)
    assert saved(config).scoreboard == 2
    assert not kiosk_start.safe
    crash(kiosk_start, clock)
    assert kiosk_start.safe


def test_crashes_after_a_minute_never_count_and_a_start_without_a_picture_always(
    kiosk_start: SafeStart, clock: Clock, config: Path
) -> None:
    crash(kiosk_start, clock, 20, 61.0)
    assert kiosk_start.restarts == 0
    changed(config, scoreboard=2)
    crash(kiosk_start, clock, 2, 90.0, beats=0)
    assert saved(config).scoreboard == 0
    crash(kiosk_start, clock, 3, 90.0, beats=0)
    assert kiosk_start.safe


def test_a_plug_in_that_was_switched_on_is_taken_back(kiosk_start: SafeStart, clock: Clock, config: Path) -> None:
    consent.switch("chess", False)
    crash(kiosk_start, clock, 1, 61.0)
    consent.switch("tag", True)
    crash(kiosk_start, clock, 2)
    assert (config / consent.FILE).read_bytes() == (config / "tried" / consent.FILE).read_bytes()
    assert b"tag" not in (config / consent.FILE).read_bytes()
    assert safe_start.taken_back(config) == ["plugins"]


def test_choices_of_games_are_settings_too(kiosk_start: SafeStart, clock: Clock, config: Path) -> None:
    settings = saved(config)
    settings.choice("race").arena = "kidney"
    settings.save(config)
    crash(kiosk_start, clock, 2)
    assert saved(config).choice("race").arena == ""
    assert safe_start.taken_back(config) == ["games.race.arena"]


def test_the_first_kiosk_takes_back_what_has_just_been_changed_only(config: Path, clock: Clock) -> None:
    changed(config, scoreboard=2, music=3)
    crash(SafeStart(config, config.parent / "data", clock), clock, 2)
    assert (saved(config).scoreboard, saved(config).music) == (0, 3)


def test_without_any_settings_five_crashes_lead_to_safe_mode(config: Path, clock: Clock) -> None:
    safe = SafeStart(config, config.parent / "data", clock)
    crash(safe, clock, 4)
    assert not safe.safe
    crash(safe, clock)
    assert safe.safe


def test_a_folder_that_cannot_be_written_is_no_failure(kiosk_start: SafeStart, clock: Clock, config: Path) -> None:
    changed(config, scoreboard=2)
    (config / "tried" / safe_start.NOTE).mkdir()
    crash(kiosk_start, clock, 5)
    assert kiosk_start.safe
