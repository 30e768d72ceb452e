"""The engine hash changes with the code of the engine, not with its wording, formatting or module paths."""

import shutil

import pytest

from pigaming_app.games import engine_hash as source_hash
from pigaming_app.games.engine_hash import engine_hash, syntax_hash
from pigaming_app.sim.kernel import PACKAGE

SOURCE = '''"""About robots."""

from math import cos

from pigaming_app.sim.robot import RADIUS

SPEED: float = 260.0  # px/s


def drive(robot, dt):
    """Roll on."""
    robot.x += dt * SPEED * cos(robot.heading)
    return f"{robot.x:.1f} of {RADIUS!r}" if not robot.over else -1
'''


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("About robots.", "Robots: their wheels.\n\nAnd more."),
        ('"""Roll on."""', '"""Drive."""\n    ...'),
        ("  # px/s", ""),
        ("dt * SPEED * cos(robot.heading)", "(\n        dt * SPEED\n        * cos( robot.heading )  # ahead\n    )"),
        ("pigaming_app.sim.robot", "pigaming_app.games.race.robot"),
        ("from pigaming_app.sim.robot import RADIUS\n", ""),
        ("260.0", "2.6e2"),
        ('f"{', "f'{"),
    ],
)
def test_wording_formatting_and_module_paths_do_not_change_it(old, new):
    assert old in SOURCE
    edited = SOURCE.replace(old, new)
    edited = edited.replace('!r}"', "!r}'") if "f'" in new else edited
    assert syntax_hash(edited.encode()) == syntax_hash(SOURCE.encode())


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("260.0", "260.1"),
        ("260.0", "260"),
        ("SPEED: float", "SPEED: int"),
        ("SPEED", "PACE"),
        ("+=", "-="),
        ("not robot.over", "robot.over"),
        ("from math import cos", "from math import sin as cos"),
        ("(robot, dt)", "(dt, robot)"),
        (":.1f", ":.2f"),
        ("robot.x +=", "robot.y +="),
    ],
)
def test_a_name_a_number_or_an_operator_changes_it(old, new):
    assert old in SOURCE
    assert syntax_hash(SOURCE.replace(old, new).encode()) != syntax_hash(SOURCE.encode())


def test_it_is_the_same_on_every_python():
    """The digest of SOURCE, as computed by Python 3.11, 3.12 and 3.13."""
    assert syntax_hash(SOURCE.encode()) == DIGEST


DIGEST = "10dcfbc0b4afaabad31d23bfb24f9f10fa8173fe4d6f2d2442641733ecb66744"


def test_a_moved_module_leaves_it_and_a_changed_one_does_not(tmp_path, monkeypatch):
    package = tmp_path / "package"
    for folder in source_hash.ENGINE:
        shutil.copytree(PACKAGE / folder, package / folder)
    monkeypatch.setattr(source_hash, "PACKAGE", package)
    assert source_hash._hash.__wrapped__(()) == engine_hash()
    (package / "games" / "race" / "course.py").rename(package / "sim" / "track.py")
    assert source_hash._hash.__wrapped__(()) == engine_hash()
    robot = package / "sim" / "world.py"
    robot.write_text(robot.read_text(encoding="utf-8").replace("RADIUS = 36.0", "RADIUS = 36.5"), encoding="utf-8")
    assert source_hash._hash.__wrapped__(()) != engine_hash()
