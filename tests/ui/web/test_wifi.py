"""The Wi-Fi's password, with the real library `keyring`: GNOME's keyring, keyrings of these tests, and none."""

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from pigaming_app import ROOT
from pigaming_app.storage.settings import FILE, Settings, folders
from pigaming_app.ui.web import wifi

pytest.importorskip("keyring", reason="the extra `keyring` is not installed")

Choose = Callable[[str], None]


def forget() -> None:
    """As a process that has just begun."""
    wifi._keyring.cache_clear()
    wifi._found.clear()
    wifi._asked.clear()


@pytest.fixture
def choose(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Choose]:
    """Chooses the keyring of the system; the settings have a folder of their own."""

    def chosen(name: str) -> None:
        monkeypatch.setenv("PYTHON_KEYRING_BACKEND", name if "." in name else f"tests.ui.web.keyrings.{name}")
        forget()

    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    monkeypatch.setenv("KEYRING_DRAWER", str(tmp_path / "drawer"))
    yield chosen
    forget()


def typed(name: str, password: str) -> Settings:
    """Settings in which somebody has typed a Wi-Fi."""
    settings = Settings.load(folders().config)[0]
    wifi.rename(settings, name)
    wifi.keep(settings, password)
    wifi.save(settings)
    return settings


def on_disk(word: str) -> list[str]:
    """The files of the settings that hold a word."""
    return [path.name for path in sorted(folders().config.iterdir()) if word in path.read_text()]


def test_a_keyring_keeps_the_password_and_the_settings_do_not(choose: Choose) -> None:
    choose("Drawer")
    assert wifi.password(typed("Schule", "geheim")) == "geheim"
    forget()
    assert wifi.password(Settings.load(folders().config)[0]) == "geheim"
    assert on_disk("Schule") == [FILE]
    assert on_disk("geheim") == []


@pytest.mark.parametrize("name", ["NotRecommended", "keyring.backends.fail.Keyring", "keyring.backends.null.Keyring"])
def test_without_a_keyring_it_is_a_setting(choose: Choose, name: str) -> None:
    choose(name)
    assert not wifi.has_keyring()
    settings = typed("Schule", "geheim")
    assert (wifi.password(settings), settings.phones_wifi_key) == ("geheim", "geheim")
    assert wifi.password(Settings.load(folders().config)[0]) == "geheim"


def test_without_the_library_there_is_no_keyring(choose: Choose, monkeypatch: pytest.MonkeyPatch) -> None:
    choose("Drawer")
    monkeypatch.setattr(wifi, "find_spec", lambda name: None)
    assert not wifi.has_keyring()
    assert typed("Schule", "geheim").phones_wifi_key == "geheim"


def test_a_password_that_goes_into_a_keyring_leaves_the_settings_and_their_backup(choose: Choose) -> None:
    choose("keyring.backends.fail.Keyring")
    typed("Schule", "geheim")
    choose("Drawer")
    settings = Settings.load(folders().config)[0]
    assert wifi.password(settings) == "geheim"
    assert wifi.keep(settings, "geheim")
    wifi.save(settings)
    assert on_disk("geheim") == []


def test_a_name_that_is_corrected_keeps_the_password_and_a_known_one_has_its_own(choose: Choose) -> None:
    choose("Drawer")
    settings = typed("Schuel", "geheim")
    wifi.rename(settings, "Schule")
    assert wifi.password(settings) == "geheim"
    wifi.keep(settings, "anders")
    wifi.rename(settings, "Schuel")
    assert wifi.password(settings) == "geheim"
    wifi.rename(settings, "")
    assert (wifi.password(settings), settings.phones_wifi_key) == ("", "")


def test_a_password_that_was_typed_before_the_name_goes_into_the_keyring_with_it(choose: Choose) -> None:
    choose("Drawer")
    settings = Settings()
    assert not wifi.keep(settings, "geheim")
    wifi.rename(settings, "Schule")
    assert (wifi.password(settings), settings.phones_wifi_key) == ("geheim", "")


def test_an_empty_password_is_forgotten(choose: Choose) -> None:
    choose("Drawer")
    settings = typed("Schule", "geheim")
    assert wifi.keep(settings, "")
    forget()
    assert wifi.password(settings) == ""
    assert wifi.keep(settings, "")


def test_a_locked_keyring_counts_as_none(choose: Choose) -> None:
    choose("Locked")
    settings = Settings(phones_wifi="Schule")
    assert wifi.password(settings) == ""
    assert not wifi.keep(settings, "geheim")
    assert wifi.password(settings) == settings.phones_wifi_key == "geheim"


def test_a_page_waits_briefly_for_a_keyring_and_only_once(choose: Choose, monkeypatch: pytest.MonkeyPatch) -> None:
    choose("Silent")
    monkeypatch.setattr(wifi, "BRIEF", 0.2)
    monkeypatch.setattr(wifi, "PATIENT", 0.2)
    settings, began = Settings(phones_wifi="Stumm"), time.monotonic()
    assert [wifi.password(settings) for _ in range(100)] == [""] * 100
    assert not wifi.keep(settings, "geheim")
    assert 0.4 <= time.monotonic() - began < 1.5


GNOME = f"""
set -e
printf 'of the session\\n' | gnome-keyring-daemon --unlock --components=secrets >/dev/null
for turn in 1 2; do {sys.executable} -c '
import sys
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.web import wifi
settings = Settings(phones_wifi="Schule")
print(wifi.has_keyring(), wifi.password(settings), sys.argv[1] == "2" or wifi.keep(settings, "geheim"))
' $turn; done
grep -rlc geheim "$HOME" || true
"""


@pytest.mark.long
def test_the_keyring_of_gnome_keeps_it_from_one_process_to_the_next(tmp_path: Path) -> None:
    if not (shutil.which("dbus-run-session") and shutil.which("gnome-keyring-daemon")):
        pytest.skip("dbus-run-session and gnome-keyring-daemon are not installed")
    surroundings = {key: value for key, value in os.environ.items() if key != "PYTHON_KEYRING_BACKEND"}
    own = dict.fromkeys(
        ("HOME", "XDG_RUNTIME_DIR", "XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME"), str(tmp_path)
    )
    done = subprocess.run(
        ["dbus-run-session", "--", "sh", "-c", GNOME], cwd=ROOT, env={**surroundings, **own}, capture_output=True,
        text=True, timeout=60, check=False,
    )  # fmt: skip
    assert done.stdout.splitlines() == ["True  True", "True geheim True"], done.stderr
