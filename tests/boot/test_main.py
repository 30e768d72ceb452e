"""Start from a bare Python: choice of the interpreter, installation of packages, error messages."""

import ast
import errno
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import tomllib
import venv
from pathlib import Path

import pytest

from main import too_old
from pigaming_app.boot import environment as install
from pigaming_app.boot import fetch, interpreter, start

ROOT = Path(__file__).resolve().parents[2]
BARE = sys._base_executable  # type: ignore[attr-defined]  # private; not that of the environment
BOOT = [f"boot/{name}" for name in ("__init__", "start", "interpreter", "environment", "fetch", "version")]
FILES = ("main.py", "pyproject.toml", "constraints.txt", *[f"pigaming_app/{name}.py" for name in ("__init__", *BOOT)])
EVERY = ("pygame_ce-2.5.9", "numpy-2.3.1", "platformdirs-4.3.0", "tomli_w-1.2.0", "msgspec-0.20.0", "networkx-3.6")
JOB = """
import sys

def main(args):
    print(sys.prefix, *args)
    return int(args[-1]) if args and args[-1].isdigit() else 0
"""
PIP = """
import os, sys, time
from pathlib import Path

if "--version" in sys.argv:
    sys.exit()
wanted = [word for word in sys.argv[2:] if not word.startswith("-")]
constrained = any(word.startswith("--constraint=") and os.path.exists(word.partition("=")[2]) for word in sys.argv)
with open(Path(__file__).parent / "calls", "a") as calls:
    print(*wanted, file=calls)
mood = os.environ.get("MOOD", "")
if mood == "endless":
    time.sleep(600)
elif mood == "slow":
    while not os.path.exists(os.environ["MET"]):
        time.sleep(0.02)
elif mood == "outdated" and constrained:
    sys.exit("ERROR: No matching distribution found for numpy==2.4.6")
elif mood and (mood.partition(":")[0] in " ".join(wanted)):
    sys.exit("ERROR: " + mood.partition(":")[2])
"""


@pytest.fixture
def clone(tmp_path):
    """The files needed for a start, with a command line that only prints its environment and arguments."""
    clone = tmp_path / "clone"
    for name in FILES:
        (clone / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, clone / name)
    (clone / "pigaming_app" / "jobs").mkdir()
    (clone / "pigaming_app" / "jobs" / "cli.py").write_text(JOB)
    return clone


@pytest.fixture
def furnished(clone):
    """The clone with an empty .venv and a fake pip."""
    venv.create(clone / ".venv", symlinks=os.name != "nt")
    pip = interpreter.site_packages(clone / ".venv") / "pip"
    pip.mkdir()
    (pip / "__main__.py").write_text(PIP)
    return clone


def surroundings(clone, **extra):
    mine = ("PIP_", "PYTHON", "VIRTUAL_ENV", "PIGAMING")
    clean = {name: value for name, value in os.environ.items() if not name.startswith(mine)}
    return {**clean, "PIGAMING_HOME": str(clone.parent / "home"), **extra}


def started(clone, *arguments, python=BARE, **extra):
    """Run main.py to completion."""
    command = [python, str(clone / "main.py"), *arguments]
    return subprocess.run(
        command, cwd=clone.parent, env=surroundings(clone, **extra), capture_output=True, text=True, timeout=120
    )


def calls(clone):
    """Names of the packages requested in each call of pip."""
    lines = (interpreter.site_packages(clone / ".venv") / "pip" / "calls").read_text().splitlines()
    return [set(re.sub(r"[<>][^ ]*", "", line).split()) for line in lines]


def refused(ended):
    """The last line on standard error of a failed start; asserts that all lines are plain messages."""
    assert (ended.returncode, ended.stdout) == (2, "")
    assert all(line.startswith("PiGaming: ") for line in ended.stderr.splitlines())
    return ended.stderr.splitlines()[-1]


# An old Python


def test_an_old_python_is_refused_with_the_version_needed():
    assert too_old((3, 9)) == "PiGaming needs Python 3.11 or newer; this is 3.9"
    assert too_old((3, 11)) is None
    assert too_old((4, 0)) is None


def test_an_old_python_can_parse_main():
    ast.parse((ROOT / "main.py").read_text(), feature_version=(3, 8))


# Everything is installed


def test_a_second_start_goes_straight_into_the_environment_even_if_the_clone_was_moved(furnished):
    assert started(furnished).returncode == 0
    again = started(furnished, "play", "--seed", "3")
    assert again.stdout == f"{furnished / '.venv'} play --seed 3\n"
    assert again.stderr == ""
    assert calls(furnished) == [{"pygame-ce", "numpy", "platformdirs", "tomli-w", "msgspec", "networkx"}]
    assert started(furnished, "fail", "7").returncode == 7, "the exit code of the job"
    moved = furnished.rename(furnished.with_name("elsewhere"))
    assert started(moved).stdout == f"{moved / '.venv'}\n"
    assert len(calls(moved)) == 1


def add(packages, *names):
    """Distributions that seem to be installed in a folder; returns its path."""
    for name in names:
        (packages / f"{name}.dist-info").mkdir(parents=True)
    return str(packages)


def test_a_python_that_has_every_package_is_used_as_it_is(clone, tmp_path):
    packages = add(tmp_path / "site-packages", *EVERY)
    assert started(clone, PYTHONPATH=packages).stdout == f"{Path(BARE).resolve().parent.parent}\n"
    assert not (clone / ".venv").exists()


def test_a_python_with_both_pygames_is_not_used(furnished, tmp_path):
    packages = add(tmp_path / "site-packages", "pygame-2.6.1", *EVERY)
    ended = started(furnished, PYTHONPATH=packages)
    assert ended.stdout == f"{furnished / '.venv'}\n"
    assert "both pygame and pygame-ce" in ended.stderr


def test_an_environment_with_both_pygames_is_named(furnished):
    started(furnished)
    add(interpreter.site_packages(furnished / ".venv"), "pygame-2.6.1", "pygame_ce-2.5.9")
    assert f"{furnished / '.venv'} holds both pygame and pygame-ce" in started(furnished).stderr


# Packages of a job


def test_the_tests_fetch_their_tools_and_the_compiler(furnished):
    started(furnished, "test")
    assert calls(furnished)[-1] >= {"pygame-ce", "pytest", "hypothesis", "ruff", "mypy", "numba"}
    started(furnished, "duel")
    assert len(calls(furnished)) == 2  # the tools, then with the compiler: a duel needs nothing more


def test_a_duel_goes_on_without_the_compiler(furnished):
    ended = started(furnished, "duel", "pitanks", MOOD="numba:No matching distribution found for numba")
    assert ended.stdout == f"{furnished / '.venv'} duel pitanks\n"
    assert "Going on without numba." in ended.stderr


def test_robots_go_on_without_a_keyring_where_there_is_none_for_this_machine(furnished):
    """It needs `cryptography` on Linux, which some machines have no wheel of."""
    ended = started(furnished, "robots", MOOD="keyring:No matching distribution found for keyring")
    assert ended.stdout == f"{furnished / '.venv'} robots\n"
    assert re.findall(r"Going on without .*", ended.stderr) == ["Going on without keyring."]
    assert interpreter.installed_groups(furnished / ".venv") == {"arcade", "hardware"}


@pytest.mark.parametrize("words", [["play", "--real=1,3"], ["--emulate", "3"], ["bench", "robots"]], ids=" ".join)
def test_words_for_real_robots_install_opencv(furnished, words):
    started(furnished, *words)
    assert "opencv-python-headless" in calls(furnished)[-1]


def test_help_on_a_duel_installs_no_compiler(furnished):
    started(furnished, "duel", "--help")
    assert "numba" not in calls(furnished)[-1]


def test_other_requirements_are_installed_when_the_list_has_changed(furnished):
    started(furnished)
    project = furnished / "pyproject.toml"
    project.write_text(project.read_text().replace('"numpy>=', '"tqdm>=4", "numpy>='))
    started(furnished)
    assert "tqdm" in calls(furnished)[-1]


# Versions


def test_versions_that_cannot_be_installed_give_way_to_the_ranges_with_one_line(furnished):
    ended = started(furnished, MOOD="outdated")
    assert ended.stdout == f"{furnished / '.venv'}\n"
    assert ended.stderr.count(install.UNCONSTRAINED) == 1
    first, second = calls(furnished)
    assert first == second


def test_offline_the_versions_are_tried_once(furnished):
    refused(started(furnished, MOOD="numpy:WARNING: Retrying after connection broken"))
    assert len(calls(furnished)) == 1


def test_each_package_that_a_job_installs_has_a_version_within_its_range():
    lines = [line for line in install.CONSTRAINTS.read_text().splitlines() if not line.startswith("#")]
    for requirement in interpreter.requirements([interpreter.ARCADE, *extras()]):
        name = re.split("[<>]", requirement)[0]
        versions = [line.partition("==")[2].split(" ;")[0] for line in lines if line.startswith(f"{name}==")]
        assert versions, name
        assert not any(interpreter.is_missing({name: version}, requirement) for version in versions)


# The first start


@pytest.mark.long
def test_offline_the_remedy_is_reported_and_nothing_is_lost(clone):
    offline = {"PIP_NO_INDEX": "1", "PIP_CONFIG_FILE": os.devnull, "PIP_NO_CACHE_DIR": "1"}
    assert "was found: if this machine is online" in refused(started(clone, "doctor", **offline))
    again = started(clone, "doctor", **offline)
    assert "first start" not in again.stderr  # the environment itself is there already


def test_without_the_venv_module_its_package_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(interpreter.StartError, match="apt install python3-venv"):
        install.create(tmp_path / "venv")


def test_a_full_disk_is_reported(furnished):
    full = "numpy:Could not install packages due to an OSError: [Errno 28] No space left on device"
    assert refused(started(furnished, MOOD=full)) == f"PiGaming: {install.NO_ROOM}"


def test_a_network_failure_is_reported(furnished):
    down = "numpy:WARNING: Retrying (Retry(total=4)) after connection broken: Temporary failure in name resolution"
    assert "connect this machine to the internet" in refused(started(furnished, MOOD=down))
    started(furnished)
    without = refused(started(furnished, "bundle", MOOD=down.replace("numpy", "pyinstaller")))
    assert "pyinstaller could not be fetched: connect this machine" in without


def test_stopped_while_installing_it_goes_on_next_time(furnished):
    command = [BARE, str(furnished / "main.py")]
    running = subprocess.Popen(
        command,
        env=surroundings(furnished, MOOD="endless"),
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # in the background, shells ignore it
    )
    until(lambda: (interpreter.site_packages(furnished / ".venv") / "pip" / "calls").exists())
    os.killpg(running.pid, signal.SIGINT)
    errors = running.communicate(timeout=120)[1]
    assert running.returncode == 130
    assert errors.splitlines()[-1] == "PiGaming: stopped. Start it again, and it goes on from there."
    assert "Traceback" not in errors
    assert started(furnished).returncode == 0


def test_of_two_starts_at_once_one_installs_and_the_other_waits(furnished):
    met, errors = furnished / "met", [furnished / "one", furnished / "other"]
    command, environment = [BARE, str(furnished / "main.py")], surroundings(furnished, MOOD="slow", MET=str(met))
    with errors[0].open("w") as one, errors[1].open("w") as other:
        both = [
            subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=file, text=True)
            for file in (one, other)
        ]
    until(lambda: any("waiting for it" in file.read_text() for file in errors))
    met.touch()
    assert [process.communicate(timeout=120)[0] for process in both] == [f"{furnished / '.venv'}\n"] * 2
    assert sum("waiting for it" in file.read_text() for file in errors) == 1
    assert len(calls(furnished)) == 1


def test_a_lock_of_a_dead_process_does_not_block(furnished):
    (furnished / ".venv.lock").write_text("")
    assert "waiting" not in started(furnished).stderr


def test_a_disk_that_fills_up_under_the_stamp_leaves_the_groups_uninstalled(furnished, monkeypatch):
    place = furnished / ".venv"
    monkeypatch.setattr(interpreter, "PROJECT", furnished / "pyproject.toml")
    install.install(place, {interpreter.ARCADE})
    assert interpreter.installed_groups(place) == {interpreter.ARCADE}

    def full(descriptor):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(interpreter.StartError, match="the disk is full"):
        install.install(place, {interpreter.ARCADE, "train"})
    assert interpreter.installed_groups(place) == set()


def test_an_environment_whose_python_has_gone_does_not_work(furnished):
    place = furnished / ".venv"
    started(furnished)
    assert install.is_usable(place)
    interpreter.python_of(place).unlink()
    interpreter.python_of(place).symlink_to("/nowhere/python3.11")
    assert not install.is_usable(place)
    assert interpreter.installed_groups(place) == set()


def test_an_environment_left_half_made_does_not_work(tmp_path):
    venv.create(tmp_path, symlinks=os.name != "nt")
    shutil.rmtree(tmp_path / "lib")
    assert not install.is_usable(tmp_path)


def test_another_base_python_of_an_environment_is_detected(furnished):
    started(furnished)
    stamp = furnished / ".venv" / "ready"
    stamp.write_text(stamp.read_text().replace("python3", "python2"))
    started(furnished)
    assert len(calls(furnished)) == 2


def test_in_a_read_only_folder_the_environment_goes_to_the_user_and_if_that_is_one_too_both_are_named(
    tmp_path, monkeypatch
):
    beside, own = tmp_path / "clone" / ".venv", tmp_path / "home" / "venv"
    monkeypatch.setattr(install, "environment_folders", lambda: [beside, own])
    monkeypatch.setattr(install, "open", no_writing_below(tmp_path / "clone"), raising=False)
    place, lock = install._claimed()
    lock.close()
    assert place == own
    monkeypatch.setattr(install, "open", no_writing_below(tmp_path), raising=False)
    with pytest.raises(interpreter.StartError, match=r"neither .*clone nor .*home can be written"):
        install._claimed()


def test_a_missing_project_file_is_reported_in_one_line(clone):
    (clone / "pyproject.toml").unlink()
    assert "pyproject.toml cannot be read" in refused(started(clone))


# Details


@pytest.mark.parametrize(
    ("requirement", "version", "lacking"),
    [
        ("numpy>=2.2,<3", "2.2.0", False),
        ("numpy>=2.2,<3", "2.10", False),
        ("numpy>=2.2,<3", "2.1.9", True),
        ("numpy>=2.2,<3", "3.0.0", True),
        ("numpy>=2.2,<3", "2.5.8.dev1", False),
        ("numpy", "0.1", False),
        ("numba>=0.61", "2.2", True),
    ],
)
def test_a_version_fits_or_not(requirement, version, lacking):
    assert interpreter.is_missing({"numpy": version}, requirement) is lacking


def extras():
    return {*tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]}


def test_the_project_file_has_only_requirements_that_boot_supports():
    for one in interpreter.requirements([interpreter.ARCADE, *extras()]):
        assert re.fullmatch(r"[a-z0-9-]+>=[\d.]+,<[\d.]+", one)
    named = {name for groups in (start.NEEDED, start.OPTIONAL) for names in groups.values() for name in names}
    assert named | {*start.EXTRA_OF_WORD.values(), *start.EXTRA_OF_FILE.values()} <= extras()


def test_no_registry_is_named():
    for name in FILES:
        assert not re.search(r"https?://|pypi|index-url", (ROOT / name).read_text())


# Fetched by a running arcade


def fetched(clone, python="", **more):
    """The last word of the process that fetches an extra into the clone's environment."""
    command = [python or str(interpreter.python_of(clone / ".venv")), "-m", "pigaming_app.boot.fetch", "train"]
    environment = surroundings(clone, **more)
    done = subprocess.run(command, cwd=clone, env=environment, capture_output=True, text=True, timeout=120)
    return done.stdout.split()[-1]


def groups_of(clone):
    return set((clone / ".venv" / "ready").read_text().splitlines()[1:])


def test_a_running_arcade_adds_an_extra_that_the_next_start_keeps(furnished):
    started(furnished)
    assert groups_of(furnished) == {"arcade"}
    assert fetched(furnished) == "done"
    assert "numba" in calls(furnished)[-1]
    assert groups_of(furnished) == {"arcade", "train"}
    before = len(calls(furnished))
    started(furnished, "duel")
    assert len(calls(furnished)) == before, "nothing is missing"


@pytest.mark.parametrize(
    ("mood", "reason"),
    [
        ("numba:Retrying after connection broken", "offline"),
        ("numba:OSError: [Errno 28] No space left on device", "full"),
        ("numba:something else", "failed"),
    ],
)
def test_an_extra_that_cannot_be_fetched_leaves_the_environment_ready(furnished, mood, reason):
    started(furnished)
    assert fetched(furnished, MOOD=mood) == reason
    assert groups_of(furnished) == {"arcade"}
    assert started(furnished).stdout == f"{furnished / '.venv'}\n"


def test_the_bar_is_not_full_after_a_small_file_with_a_large_one_to_come(tmp_path):
    with fetch.FetchProgress(tmp_path) as progress:
        for name, size, least, most in (("numba", 3.8, 0.05, 0.07), ("llvmlite", 56.0, 0.94, fetch.LAST)):
            before = progress.most
            progress.announce(name, "1.0", f"{size} MB")
            with (tmp_path / name).open("wb") as file:
                file.truncate(int(size * 1e6))
            while progress.most == before:
                time.sleep(0.01)
            assert least <= progress.most <= most


def test_an_environment_of_somebody_else_is_left_alone(furnished):
    assert fetched(furnished, BARE) == "foreign"
    assert not (furnished / ".venv" / "ready").exists()


def no_writing_below(folder):
    def opened(path, *how, **more):
        if folder in Path(path).parents:
            raise OSError(errno.EROFS, "Read-only file system", str(path))
        return open(path, *how, **more)

    return opened


def until(done, seconds=120.0):
    end = time.monotonic() + seconds
    while not done():
        assert time.monotonic() < end
        time.sleep(0.02)
