"""The package: built, installed without extras, and run from a folder outside the clone."""

import json
import os
import subprocess
import sys
import tarfile
import venv
import zipfile
from email import message_from_bytes
from importlib import metadata
from pathlib import Path

import pytest
from trove_classifiers import classifiers

import pigaming_app
from pigaming_app.boot.interpreter import ARCADE, python_of, requirements, site_packages
from pigaming_app.jobs.new_game import write

pytestmark = pytest.mark.long

ROOT = Path(__file__).resolve().parents[1]
BUILD = "import sys\nfrom hatchling import build\nprint(getattr(build, f'build_{sys.argv[1]}')(sys.argv[2]))"
SHEET = ("calibrate", "--sheet", "a.pdf")


def built(kind, tree, folder):
    """The sdist or wheel that the build backend creates from a project folder."""
    command = [sys.executable, "-c", BUILD, kind, str(folder)]
    said = subprocess.run(command, cwd=tree, capture_output=True, text=True, check=True).stdout
    return folder / said.split()[-1]


def names(archive):
    """The files of an sdist, below its one folder, or of a wheel."""
    if archive.suffix == ".whl":
        with zipfile.ZipFile(archive) as file:
            return {name for name in file.namelist() if not name.endswith("/")}
    with tarfile.open(archive) as file:
        return {member.name.partition("/")[2] for member in file if member.isfile()}


def names_below(folder):
    return {path.relative_to(ROOT).as_posix() for path in (ROOT / folder).rglob("*") if path.is_file()}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("package")


@pytest.fixture(scope="module")
def sdist(folder):
    return built("sdist", ROOT, folder)


@pytest.fixture(scope="module")
def wheel(folder):
    return built("wheel", ROOT, folder)


@pytest.fixture(scope="module")
def environment(folder, wheel):
    """An environment with the wheel and the packages that it requires without any extra."""
    place, required = folder / "environment", folder / "required" / "site-packages"
    venv.create(place, symlinks=os.name != "nt")
    required.mkdir(parents=True)
    for one in requirements([ARCADE]):
        distribution = metadata.distribution(one.partition(">")[0])
        assert distribution.files
        for name in {file.parts[0] for file in distribution.files} - {"..", "__pycache__"}:
            (required / name).symlink_to(str(distribution.locate_file(name)))
    (site_packages(place) / "required.pth").write_text(f"{required}\n")
    command = [
        sys.executable,
        "-m",
        "pip",
        "--python",
        python_of(place),
        "install",
        "-q",
        "--no-deps",
        "--no-index",
        wheel,
    ]
    subprocess.run(command, env=surroundings(folder), check=True)
    return place


def surroundings(folder, **extra):
    mine = ("PIP_", "PYTHON", "VIRTUAL_ENV", "PIGAMING")
    clean = {name: value for name, value in os.environ.items() if not name.startswith(mine)}
    return {**clean, "PIGAMING_HOME": str(folder / "home"), **extra}


@pytest.fixture
def run(folder, environment, tmp_path):
    """Run a program of the environment in another folder; afterwards no `.venv` has been created."""

    def ended(program, *arguments, **extra):
        command = [python_of(environment).with_name(program), *arguments]
        return subprocess.run(
            command, cwd=tmp_path, env=surroundings(folder, **extra), capture_output=True, text=True, timeout=120
        )

    yield ended
    for place in (tmp_path, folder):
        assert not list(place.rglob(".venv*"))
    assert not list((folder / "home").rglob("venv-*"))


def refused(ended):
    assert (ended.returncode, ended.stdout, ended.stderr.count("\n")) == (2, "", 1)
    return ended.stderr


def test_the_wheel_has_the_package_and_the_assets_and_no_tests(wheel):
    inside = {name for name in names(wheel) if ".dist-info/" not in name}
    packages = {*names_below("pigaming_app"), *names_below("pigaming_football")}
    package = {name for name in packages if "__pycache__" not in name}
    assets = {name for name in names_below("assets") if "__pycache__" not in name}
    shipped = {name for name in assets if not name.startswith("assets/pictures/")}  # those are for README
    assert inside == package | {f"pigaming_app/{name}" for name in shipped} | {"pigaming_app/commit.txt"}
    for kind in ("fonts", "text", "arenas", "brains", "sounds"):
        assert any(name.startswith(f"pigaming_app/assets/{kind}/") for name in inside)


def test_the_metadata_of_the_wheel_are_complete(wheel):
    with zipfile.ZipFile(wheel) as file:
        (name,) = (name for name in file.namelist() if name.endswith(".dist-info/METADATA"))
        data = message_from_bytes(file.read(name))
    assert data["Author"] == "The PiGaming developers"
    assert data["License-Expression"] == "MIT"
    named = data.get_all("Classifier", [])
    assert {*named} <= classifiers
    spoken = {line.rpartition(" :: ")[2] for line in named if line.startswith("Natural")}
    assert spoken == {"English", "Portuguese", "Spanish", "French", "German"}
    assert data["Keywords"]


def test_the_sdist_is_complete(sdist):
    inside = names(sdist)
    assert inside >= {"main.py", "pyproject.toml", "LICENSE", "README.md", "CHANGELOG.md", ".ci/run"}
    for kind in ("pigaming_app", "pigaming_football", "assets", "tests"):
        assert inside >= {name for name in names_below(kind) if "__pycache__" not in name}
    assert not [name for name in inside if name.startswith((".venv", ".git/", ".mypy_cache", "build/"))]


def test_the_wheel_of_the_sdist_is_that_of_the_tree(sdist, wheel, tmp_path):
    with tarfile.open(sdist) as file:
        file.extractall(tmp_path, filter="data")
    (tree,) = tmp_path.iterdir()
    again = built("wheel", tree, tmp_path)
    assert again.name == wheel.name
    assert names(again) == names(wheel)


def test_the_wheel_declares_version_extras_and_program(environment):
    (installed,) = metadata.distributions(name="pigaming-app", path=[str(site_packages(environment))])
    assert installed.version == pigaming_app.__version__
    extras = {"train", "bench", "hardware", "gym", "onnx", "ray", "plots", "sounds", "pictures", "test"}
    extras |= {"bundle", "events", "phones", "keyring"}
    assert set(installed.metadata.get_all("Provides-Extra", [])) == extras
    assert {(point.group, point.name, point.value) for point in installed.entry_points} == {
        ("console_scripts", "pigaming", "pigaming_app.jobs.cli:main"),
        ("pigaming.games", "football", "pigaming_football"),
    }


def test_it_names_its_version_and_the_commit_that_it_was_made_from(run):
    head = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for word in ("-V", "--version"):
        ended = run("pigaming", word)
        assert ended.stdout == f"PiGaming {pigaming_app.__version__}, commit {head[:8]}\n"


def test_a_match_is_played_from_elsewhere(run):
    seats = ("--seats", "level3,level5", "--minutes", "0.2")
    ended = run("pigaming", "play", "pitanks", "--headless", "--speed", "max", *seats)
    assert (ended.returncode, ended.stderr) == (0, "")
    assert {line.split()[2] for line in ended.stdout.splitlines()} == {"level3", "level5"}


def test_the_arcade_opens_and_can_be_measured(run):
    code = "from pigaming_app.jobs.bench import figures, memory\nprint(figures.start(), memory.measured_alone('title'))"
    ended = run("python", "-c", code)
    assert (ended.returncode, ended.stderr) == (0, "")
    seconds, megabytes = ended.stdout.split()[-2:]
    assert float(seconds) > 0.0
    assert megabytes == "None" or float(megabytes) > 10.0


def test_the_doctor_finds_packages_and_assets_and_names_the_extras(run, environment):
    ended = run("python", "-m", "pigaming_app", "doctor", "--json")
    report = json.loads(ended.stdout)
    assert ended.returncode == 0
    assert report["ok"]
    lines = {line["what"]: line for line in report["lines"]}
    assert str(environment) in lines["Python"]["found"]
    assert {lines[what]["state"] for what in ("numpy", "pygame", "arenas", "texts", "sounds", "fonts", "engine")} == {
        "ok"
    }
    assert lines["numba"]["state"] == "note"
    assert "pip install '.[train]'" in lines["numba"]["advice"]
    assert "pip install '.[hardware]'" in lines["opencv-python-headless"]["advice"]
    assert "main.py" not in ended.stdout


def test_a_missing_extra_is_one_line_and_with_it_the_job_works(run, tmp_path):
    assert "pip install '.[hardware]'" in refused(run("pigaming", *SHEET))
    everything = os.pathsep.join(folder for folder in sys.path if folder.endswith("-packages"))
    assert run("pigaming", *SHEET, PYTHONPATH=everything).returncode == 0
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")


def test_a_new_game_is_checked_against_the_types_of_the_wheel(environment, tmp_path):
    write(tmp_path / "tag", "tag")
    command = [sys.executable, "-m", "mypy", "--strict", "--python-executable", str(python_of(environment)), "tag"]
    ended = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stdout
    rules = tmp_path / "tag" / "rules.py"
    rules.write_text(
        rules.read_text().replace("match.coin_x, match.coin_y = random", "match.coin, match.coin_y = random")
    )
    assert "[attr-defined]" in subprocess.run(command, cwd=tmp_path, capture_output=True, text=True).stdout


def test_the_tests_are_not_part_of_it(run):
    assert "clone" in refused(run("pigaming", "test"))
