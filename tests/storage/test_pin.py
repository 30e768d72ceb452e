"""The PIN: its hash by OpenSSL, delays against a second account of them, restarts, clocks, damage, a full disk."""

import json
import random
import shutil
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from pigaming_app.storage import pin as module
from pigaming_app.storage.pin import FILE, RESET, PinFile, is_easy
from pigaming_app.storage.safe_files import NotSaved
from tests.jobs.kiosk.test_supervisor import Clock

PIN = "274918"


@pytest.fixture
def clock() -> Clock:
    found = Clock()
    found.now = 1_800_000_000.0
    return found


@pytest.fixture
def file(tmp_path: Path, clock: Clock) -> PinFile:
    made = PinFile(tmp_path, clock)
    made.set(PIN)
    return made


def test_the_right_pin_and_no_other(file: PinFile, tmp_path: Path) -> None:
    assert file.is_set
    assert PinFile(tmp_path).check(PIN)
    assert not any(file.check(wrong, wrong) for wrong in ("", "274917", "2749180", " 274918", "٢٧٤٩١٨", PIN[:-1]))
    file.set("0000")
    assert PinFile(tmp_path).check("0000")
    assert not PinFile(tmp_path).check(PIN)


@pytest.mark.skipif(not shutil.which("openssl"), reason="apt-get install openssl")
def test_the_file_has_the_scrypt_hash_that_openssl_finds(file: PinFile) -> None:
    record = json.loads(file.path.read_text())
    options = [f"pass:{PIN}", f"hexsalt:{record['salt']}", "n:16384", "r:8", "p:1"]
    words = ["openssl", "kdf", "-keylen", "32", *(word for one in options for word in ("-kdfopt", one)), "SCRYPT"]
    found = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    assert found.strip().replace(":", "").lower() == record["hash"]
    assert PIN not in file.path.read_text()


@pytest.mark.skipif(sys.platform == "win32", reason="rights of POSIX")
def test_only_the_owner_reads_the_file(file: PinFile) -> None:
    assert stat.S_IMODE(file.path.stat().st_mode) == 0o600
    file.check("1")
    assert stat.S_IMODE(file.path.stat().st_mode) == 0o600


@pytest.mark.parametrize("bad", ["", "123", "1" * 13, "12a4", "12 34", "１２３４", "-123"])
def test_what_is_no_pin_is_refused(file: PinFile, bad: str) -> None:
    with pytest.raises(ValueError, match="4 to 12 digits"):
        file.set(bad)
    assert file.check(PIN)


def test_easy_ones_are_known() -> None:
    assert all(map(is_easy, ("0000", "1234", "987654", "7890")))
    assert not any(map(is_easy, ("1324", "1112", PIN)))


def test_delays_double_up_to_five_minutes_and_hold_over_a_restart(file: PinFile, clock: Clock, tmp_path: Path) -> None:
    waits = []
    for _ in range(12):
        clock.now += file.wait()
        assert not file.check("0")
        waits.append(PinFile(tmp_path, clock).wait())
    assert waits == [0, 0, 5, 10, 20, 40, 80, 160, 300, 300, 300, 300]
    assert not PinFile(tmp_path, clock).check(PIN)
    clock.now += 300.1
    assert PinFile(tmp_path, clock).check(PIN)
    assert file.wait() == 0
    assert json.loads(file.path.read_text())["failures"] == {}


def test_sources_wait_apart(file: PinFile, clock: Clock) -> None:
    for _ in range(8):
        clock.now += file.wait("192.0.2.7")
        file.check("0", "192.0.2.7")
    assert file.wait("192.0.2.7") > 0
    assert file.wait("192.0.2.8") == 0
    assert file.wait() == 0
    assert file.check(PIN)


@pytest.fixture
def cheap(monkeypatch: pytest.MonkeyPatch) -> None:
    """A hash that costs next to nothing."""
    monkeypatch.setitem(module.COST, "n", 2)


@pytest.mark.usefixtures("cheap")
def test_many_sources_share_one_delay_and_one_file(tmp_path: Path, clock: Clock) -> None:
    file = PinFile(tmp_path, clock)
    file.set(PIN)
    for i in range(500):
        file.check("0", f"source {i}")
    assert file.wait("one more") > 0
    assert len(json.loads(file.path.read_text())["failures"]) == module.MAX_SOURCES + 1
    assert file.check(PIN, "source 3")


def test_a_clock_set_back_neither_locks_nor_opens(file: PinFile, clock: Clock) -> None:
    for _ in range(6):
        clock.now += file.wait()
        file.check("0")
    clock.now -= 3600.0
    assert file.wait() == 0
    assert not file.check("0")
    assert file.wait() > 5
    assert not file.check(PIN)


@pytest.mark.usefixtures("cheap")
@pytest.mark.parametrize("seed", range(20))
def test_random_attempts_agree_with_a_second_account(tmp_path: Path, seed: int) -> None:
    """The rule again: by a list of the times of wrong attempts since the last right one."""
    rng, clock = random.Random(seed), Clock()
    clock.now = 1e9
    file = PinFile(tmp_path, clock)
    file.set(PIN)
    wrong: dict[str, list[float]] = {"a": [], "b": []}
    for _ in range(60):
        clock.now += rng.choice((0.5, 3.0, 9.0, 70.0, 400.0, 90_000.0))
        name, right = rng.choice("ab"), rng.random() < 0.1
        times = wrong[name]
        if times and clock.now - times[-1] >= 86_400:
            times.clear()
        blocked = len(times) >= 3 and clock.now < times[-1] + min(300, 5 * 2 ** (len(times) - 3))
        assert file.check(PIN if right else "1", name) == (right and not blocked)
        if not blocked:
            times[:] = [] if right else [*times, clock.now]


@pytest.mark.parametrize("text", ["", "{}", "[]", '{"salt": 1, "hash": 2}', '{"salt": "zz", "hash": ""}', "\0" * 999])
def test_a_damaged_file_opens_nothing_until_its_owner_resets_it(file: PinFile, text: str) -> None:
    file.path.write_text(text)
    assert file.is_set
    assert not file.check(PIN)
    assert not file.check("")
    (file.folder / RESET).touch()
    assert not file.is_set
    assert not (file.folder / RESET).exists()
    assert not file.path.exists()


def test_a_full_disk_does_not_give_more_attempts(file: PinFile, clock: Clock, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise NotSaved("disk full")

    monkeypatch.setattr(module, "write_atomic", full)
    for _ in range(3):
        assert not file.check("0")
    assert file.wait() == 5
    assert not file.check(PIN)
    clock.now += 6
    assert file.check(PIN)


def test_no_file_no_pin(tmp_path: Path) -> None:
    file = PinFile(tmp_path)
    assert not file.is_set
    assert not file.check("")
    assert file.wait() == 0
    file.set(PIN)
    file.remove()
    assert not file.is_set
    assert list(tmp_path.glob(FILE)) == []
