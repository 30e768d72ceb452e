"""File readers accept any content or reject it with a one-line error; nothing else happens."""

import json
import os
import random
import tomllib
import zipfile
import zlib
from collections.abc import Callable
from dataclasses import asdict
from datetime import UTC, datetime
from functools import partial
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest

from pigaming_app import ASSETS
from pigaming_app.ai.brain.archive import check_sum
from pigaming_app.ai.networks.files import NetworkError
from pigaming_app.ai.qlearning.table_files import TableError
from pigaming_app.ai.registry import new_match
from pigaming_app.events import climb_files, league_files
from pigaming_app.events.ladder import Climb
from pigaming_app.games import arenas, replay
from pigaming_app.games.arenas import load as load_arena
from pigaming_app.games.registry import games
from pigaming_app.games.replay import ReplayError
from pigaming_app.games.setup import make_setup
from pigaming_app.hardware import recordings as runs
from pigaming_app.hardware.calibration import ground_plane as ground
from pigaming_app.hardware.calibration.ground_plane import CalibrationError
from pigaming_app.hardware.recordings import RecordingError
from pigaming_app.hardware.run_writer import FORMAT
from pigaming_app.hardware.session.store import load as load_calibration
from pigaming_app.hardware.session.store import load_robots
from pigaming_app.hardware.sysid.evaluate import RecordingTooShort, measure
from pigaming_app.hardware.sysid.evaluate import replay as replay_run
from pigaming_app.scenes.files import load_network, load_replay, load_table, save_replay
from pigaming_app.scenes.views.race import ghost as ghosts
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.drivetrain import NOMINAL, DrivetrainError, parse, to_toml
from pigaming_app.storage.parsing import MESSAGE_LENGTH
from tests.hardware.mat import nominal
from tests.hostile import HUGE, mutated, toml

BYTES = (
    b"", b"\0" * 1000, b"\xff\xfe\x00", b"\xef\xbb\xbf", b"[" * 5000, b'{"a":' * 5000, b"a." * 5000 + b"a = 1",
    b"a = " + b"9" * 5000, b'{"a": ' + b"9" * 5000 + b"}", b"1" * 400, b"null", b"\n" * 1000,
    b"PK\x03\x04" + b"\0" * 50,
)  # fmt: skip


def refused_or_used(read, errors):
    """True if a file was accepted; otherwise it was rejected with one of these errors, in one line."""
    try:
        read()
    except errors as error:
        line = str(error)
    else:
        return True
    assert line.isprintable()
    assert 0 < len(line) <= 2 * MESSAGE_LENGTH
    return False


def accepted(read, trees, errors):
    """How many of these trees are accepted by a reader, which rejects the others with one of these errors."""
    return sum(refused_or_used(partial(read, tree), errors) for tree in trees)


def some(trees, share):
    """A share of these trees, by chance."""
    every = list(trees)
    return random.Random(1).sample(every, int(share * len(every)))


SEARCHED = pytest.mark.parametrize("share", [0.25, pytest.param(1.0, marks=pytest.mark.long)])


@SEARCHED
@pytest.mark.parametrize("game", games())
def test_arenas(game, share):
    name = arenas.arenas(game)[0]
    tree = tomllib.loads(load_arena(game, name).source)
    found = some(mutated(tree), 0.08 * share)
    used = accepted(lambda one: arenas.parse(game, toml(one), "a.toml"), found, ArenaError)
    assert int(share) <= used < len(found) / 2


def test_climbs_and_ratings():
    """Whatever is accepted can be played and drawn."""
    now = datetime(2026, 11, 22, 10, tzinfo=UTC)
    climbs = [
        climb_files.SavedClimb(4, now, Climb("race", rung=3, wins=1)),
        climb_files.SavedClimb(5, now, Climb("all")),
    ]

    def climb(tree):
        assert all(saved.climb.at_top or saved.climb.setup(1).arena for saved in climb_files.parse(toml(tree)))

    assert accepted(climb, mutated(tomllib.loads(climb_files.to_text(climbs))), ValueError) > 20
    standings = [{"brain": name, "rating": 7.5, "rating95": [1, 9.5]} for name in ("level1", "q2")]
    tree = {"game": "pitanks", "variant": "party", "matches": 40, "standings": standings}
    assert accepted(lambda one: league_files.parse(json.dumps(one).encode(), "pitanks"), mutated(tree), ValueError) > 4


def test_robots():
    accepted(
        lambda one: parse(toml(one), "robots.toml"),
        mutated(tomllib.loads(to_toml([NOMINAL, NOMINAL]))),
        DrivetrainError,
    )


@SEARCHED
@pytest.mark.filterwarnings("error")
def test_calibrations(tmp_path, share):
    tree = tomllib.loads(ground.to_toml(nominal()))
    tree.pop("check")
    path = tmp_path / "calibration.toml"

    def calibration(one):
        kept = tomllib.loads(toml(one))
        path.write_text(toml({**one, "check": ground._check(kept)}), encoding="utf-8")
        with np.errstate(all="raise", under="ignore"):
            load_calibration(path).fixes([], 0.0)

    assert accepted(calibration, some(mutated(tree), share), CalibrationError) > 50 * share


def run_lines(count):
    """A run with this many commands to one robot and sightings of it."""
    lines: list[dict[str, object]] = [{"kind": "head", "format": FORMAT, "mm": 1.3, "emulated": True}]
    chance = random.Random(3)
    for i in range(count):
        wheels = [chance.uniform(-0.3, 0.3), chance.uniform(-0.3, 0.3)]
        lines.append({"kind": "sent", "time": 0.0625 * i, "seq": i + 1, "wheels": [wheels, None, None, None]})
        fixes = [[0, 300.0 + i % 200, 200.0 + i % 50, 0.01 * i]]
        lines.append({"kind": "seen", "captured": 0.0625 * i, "time": 0.0625 * i + 0.05, "fixes": fixes})
        lines.append({"kind": "pose", "time": 0.0625 * i, "poses": [[300.0, 200.0, 0.0]] * 4})
    return lines


def test_runs(tmp_path):
    lines, path = run_lines(50), tmp_path / "run.jsonl"
    packed = [json.dumps(line) for line in lines]
    used = 0
    for number in (0, 1, 2, 3):
        for one in random.Random(number).sample(list(mutated(lines[number])), 80):
            changed = [*packed[:number], json.dumps(one), *packed[number + 1 :]]
            path.write_text("\n".join(changed))
            used += refused_or_used(lambda: runs.load(path), RecordingError)
    assert used > 20


@pytest.mark.parametrize(
    "line",
    [
        {"kind": "sent", "time": 1.0, "seq": 1, "wheels": []},
        {"kind": "sent", "time": 1.0, "seq": 1, "wheels": [[], [], [], []]},
        {"kind": "seen", "captured": 1.0, "time": 1.0, "fixes": [[-1, 1.0, 1.0, 1.0]]},
        {"kind": "seen", "captured": 1.0, "time": 1.0, "fixes": [[4, 1.0, 1.0, 1.0]]},
        {"kind": "seen", "captured": 1.0, "time": 1.0, "fixes": [[True, 1.0, 1.0, 1.0]]},
        {"kind": "seen", "captured": HUGE, "time": 1.0, "fixes": [[0, 1.0, 1.0, 1.0]]},
        {"kind": "seen", "captured": 1e9, "time": 1.0, "fixes": [[0, 1.0, 1.0, 1.0]]},
    ],
    ids=str,
)
def test_a_run_with_a_line_that_no_robot_drives_is_refused(tmp_path, line):
    path = tmp_path / "run.jsonl"
    path.write_text("\n".join(json.dumps(one) for one in (*run_lines(50), line, run_lines(1)[1])))
    with pytest.raises(RecordingError):
        runs.load(path)


@pytest.mark.parametrize("tail", [b"[" + b"[]," * 4_000 + b"1]", b'{"kind":"pose"}\n' * 31, b"\n" * 2_000])
def test_a_run_takes_little_memory(tmp_path, monkeypatch, tail):
    monkeypatch.setattr(runs, "MAX_LINES", 180)
    path = tmp_path / "run.jsonl"
    path.write_bytes("".join(f"{json.dumps(one)}\n" for one in run_lines(50)).encode() + tail)
    with pytest.raises(RecordingError):
        runs.load(path)
    monkeypatch.setattr(runs, "MAX_FIXES", 49)
    path.write_text("".join(f"{json.dumps(one)}\n" for one in run_lines(55)))
    with pytest.raises(RecordingError, match="poses"):
        runs.load(path)


@SEARCHED
def test_what_is_accepted_as_a_run_is_measured_and_replayed(tmp_path, share):
    path, chance = tmp_path / "run.jsonl", random.Random(5)
    lines = run_lines(400)
    extremes = ([0, -1e5, 1e5, 1e5], [0, 1e5, -1e5, -1e5], [3, 0, 0, 0])
    for _ in range(round(3 * share)):
        for number in chance.sample(range(len(lines)), 30):
            if lines[number]["kind"] == "seen":
                lines[number]["fixes"] = [chance.choice(extremes)]
            elif lines[number]["kind"] == "sent":
                lines[number]["wheels"] = [[2, -2], [0, -0.0], None, None]
                lines[number]["time"] = chance.uniform(-100.0, 100.0)
        path.write_text("\n".join(map(json.dumps, lines)))
        run = runs.load(path)
        refused_or_used(lambda run=run: measure(run), RecordingTooShort)
        replay_run(run, [NOMINAL] * 4)


def test_ghosts(tmp_path, caplog):
    arena = load_arena("race", arenas.arenas("race")[0])
    ghost = ghosts.Ghost(0, 1.5, (0.0, 0.3, 0.6, 0.9), ((1.0, 2.0, 3.0),) * 16)
    tree = json.loads(json.dumps({"engine": "x", **asdict(ghost)}))
    used = 0
    for one in mutated(tree):
        text = json.dumps(one)
        if refused_or_used(lambda text=text: ghosts._parsed(text), ValueError):
            _, found = ghosts._parsed(text)
            assert all(found.pose(0, 0.1 * i) for i in range(15))
            assert 0.0 < found.since(1, 2) < found.seconds
            used += 1
    assert used > 10
    path = ghosts.file_of(tmp_path, arena)
    path.parent.mkdir()
    for raw in BYTES:
        path.write_bytes(raw)
        assert ghosts.load_ghost(tmp_path, arena) == (None, "lost")


def packed_replay(path):
    match = new_match(make_setup("pitanks", ["fsm", "level1"], "classic", 0.05, 1, None, None, ["fsm", "level1"]))
    while not match.over:
        match.tick()
    save_replay(match, path)
    line, _, packed = path.read_bytes().partition(b"\n")
    return json.loads(line), packed


def forged(head, packed):
    """An edited replay with a valid checksum."""
    head = json.loads(json.dumps(head))
    known = dict(head, check=replay._check(head, packed)) if isinstance(head, dict) else head
    return json.dumps(known).encode() + b"\n" + packed


@SEARCHED
def test_replays(tmp_path, share):
    path = tmp_path / "a.replay"
    head, packed = packed_replay(path)

    def read(one):
        path.write_bytes(forged(one, packed))
        load_replay(path)

    assert accepted(read, some(mutated(head), share), ReplayError) > 20 * share


def test_a_forged_replay_plays_to_its_end(tmp_path):
    path, chance = tmp_path / "a.replay", random.Random(6)
    head, packed = packed_replay(path)
    for _ in range(4):
        noise = zlib.compress(chance.randbytes(len(zlib.decompress(packed))))
        path.write_bytes(forged(head, noise))
        assert replay.verify(load_replay(path)) is False


def test_a_bomb_of_ticks_is_refused(tmp_path):
    path = tmp_path / "a.replay"
    head, _ = packed_replay(path)
    path.write_bytes(forged(head, zlib.compress(bytes(100_000_000), 9)))
    assert not refused_or_used(lambda: load_replay(path), ReplayError)


def forged_table(head, q, n, check=True):
    packed = BytesIO()
    known = {**head, "check": check_sum(head, {"q": q, "n": n})} if check and isinstance(head, dict) else head
    np.savez_compressed(packed, head=np.array(json.dumps(known)), q=q, n=n)
    return packed.getvalue()


@SEARCHED
def test_tables(tmp_path, share):
    shipped, path = ASSETS / "brains" / "q1.npz", tmp_path / "a.npz"
    with np.load(shipped) as file:
        head, q, n = json.loads(str(file["head"])), file["q"], file["n"]
    used = 0
    values: list[object] = [None, True, -1, HUGE, 2**63, 1e308, float("nan"), "", "\n" * 300, [], {}]
    for one in some(mutated(head, values), 0.1 * share):
        path.write_bytes(forged_table(json.loads(json.dumps(one)), q, n))
        used += refused_or_used(lambda: load_table(path), TableError)
    assert share < used < 30 * share
    for wrong in (q * np.nan, q[:5], q.astype("<f4"), q.reshape(2, -1), q.astype(object)):
        packed = BytesIO()
        np.savez_compressed(packed, head=np.array(json.dumps(head)), q=wrong, n=n)
        path.write_bytes(packed.getvalue())
        assert not refused_or_used(lambda: load_table(path), TableError)


NPY = (
    "{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000,), }",
    "{'descr': '<f8', 'fortran_order': False, 'shape': (-1,), }",
    "{'descr': '|O', 'fortran_order': False, 'shape': (10,), }",
    "{'descr': '<f8', 'fortran_order': False, 'shape': (10L,), }",
    "{'descr': [('', '<f8')], 'fortran_order': False, 'shape': (10,), }",
    "(" * 5000,
    "{'descr': '<f8', 'fortran_order': False, 'shape': (" + "9" * 5000 + ",), }",
)


@pytest.mark.parametrize("header", NPY, ids=lambda header: header[:60])
def test_a_table_with_a_hostile_header_is_refused(tmp_path, header):
    raw = header.encode().ljust(len(header) + 63 - (len(header) + 10) % 64) + b"\n"
    array = b"\x93NUMPY\x01\x00" + len(raw).to_bytes(2, "little") + raw + bytes(80)
    with zipfile.ZipFile(tmp_path / "a.npz", "w") as archive:
        for part in ("head", "q", "n"):
            archive.writestr(f"{part}.npy", array)
    assert not refused_or_used(lambda: load_table(tmp_path / "a.npz"), TableError)


READERS: dict[str, tuple[Callable[[Path], object], type[Exception]]] = {
    "arena.toml": (lambda path: load_arena("pitanks", str(path)), ArenaError),
    "robots.toml": (load_robots, DrivetrainError),
    "calibration.toml": (load_calibration, CalibrationError),
    "run.jsonl": (runs.load, RecordingError),
    "a.replay": (load_replay, ReplayError),
    "a.npz": (load_table, TableError),
    "b.npz": (load_network, NetworkError),
}


@pytest.mark.parametrize("name", READERS)
def test_bytes_that_are_no_such_file_are_refused(tmp_path, name):
    read, error = READERS[name]
    for raw in BYTES:
        (tmp_path / name).write_bytes(raw)
        assert not refused_or_used(lambda: read(tmp_path / name), error)


@pytest.mark.parametrize("name", ["arena.toml", "calibration.toml", "run.jsonl", "a.replay", "a.npz", "b.npz"])
def test_a_missing_file_is_refused(tmp_path, name):
    read, error = READERS[name]
    assert not refused_or_used(lambda: read(tmp_path / name), error)


@pytest.mark.skipif(os.name != "posix", reason="devices and pipes are files on POSIX only")
@pytest.mark.parametrize("name", READERS)
@pytest.mark.parametrize("kind", ["endless", "pipe", "folder", "loop", "huge"])
def test_what_is_no_regular_file_is_refused_at_once(tmp_path, name, kind):
    read, error = READERS[name]
    path = tmp_path / name
    match kind:
        case "endless":
            path.symlink_to("/dev/zero")
        case "pipe":
            os.mkfifo(path)
        case "folder":
            path.mkdir()
        case "loop":
            path.symlink_to(path)
        case "huge":
            path.touch()
            os.truncate(path, 10**12)  # sparse
    assert not refused_or_used(lambda: read(path), error)
