"""Faults of a plug-in in commands without a window: one line with file and reason, exit code 1, after a stated time.

Each in a process of its own, as a user starts it, but with shorter times.
"""

from pathlib import Path

import pytest

from pigaming_app.jobs.new_game import write
from pigaming_app.storage.plugins.consent import switch
from pigaming_app.storage.plugins.found import user_folder
from tests.plugins.packages import changed, write_tag
from tests.processes import Ended, python

COMMAND = """
import sys
from pigaming_app.ai.learning import league
from pigaming_app.storage.plugins import endless
endless.LIMIT, endless.GRACE, league.MIN_COMPILED_MATCHES = 0.6, 0.3, {compiled}
from pigaming_app.jobs.cli import main
sys.exit(main(sys.argv[1:]))
"""
PLAY = "play tag --headless --speed max --minutes 0.1 --seats level5,level1"
DUEL = "duel tag level5 idle --matches 2 --minutes 0.3"
LEAGUE = "league tag level5 idle --matches 2 --minutes 0.1"
BENCH = "bench tag"
TRAIN = "train ppo tag --updates 1 --set matches=16 --out tag.npz"
OTHER = "duel pitanks level1 idle --matches 2 --minutes 0.05"
TICK, LOOP = "    match.tick += 1\n", "    while True: pass\n"
SURPRISE = "GAME = Game(\n    surprise=lambda seed: [0 for _ in iter(int, 1)],"


@pytest.fixture
def tag(home: Path) -> Path:
    folder = user_folder() / "tag"
    write(folder, "tag")
    switch("tag", True)
    return folder


def run(words: str, folder: Path, compiled: bool = False) -> Ended:
    return python(COMMAND.format(compiled=0 if compiled else 1 << 62), *words.split(), cwd=folder)


def refused(ended: Ended, folder: Path) -> str:
    """The reason, if the command has ended as it should."""
    assert ended.returncode == 1, (ended.stdout, ended.stderr)
    *before, line = ended.stderr.splitlines()
    assert before in ([], ["compiling the training, once; it takes a minute"]), ended.stderr
    begin = f"PiGaming: The game tag in {folder} is left out: "
    assert line.startswith(begin), line
    return line.removeprefix(begin)


@pytest.mark.parametrize(
    ("words", "old", "new", "reason"),
    [
        (PLAY, TICK, TICK + LOOP, "rules.py, line {n}: it did not end."),
        (LEAGUE, "    drop_coin(match)\n\n", f"    drop_coin(match)\n{LOOP}\n", "rules.py, line {n}: it did not end."),
        (BENCH, TICK, TICK + LOOP, "rules.py, line {n}: it did not end."),
        (TRAIN, TICK, TICK + LOOP, "rules.py, line {n}: it did not end."),
        (PLAY, TICK, TICK + "    __import__('time').sleep(99)\n", "rules.py, line {n}: it did not end."),
        (PLAY, "        match.over = 1", "        pass", "its match is not over 10 s after its time."),
        (DUEL, "        match.over = 1", "        pass", "its match is not over 10 s after its time."),
        (DUEL, "robot.score += 1", "robot.score += 0.5", ", no whole number."),
        (DUEL, TICK, f"{TICK}    raise KeyboardInterrupt\n", "rules.py, line {n}: KeyboardInterrupt."),
    ],
)
def test_a_fault_in_a_match_is_one_line(tag: Path, words: str, old: str, new: str, reason: str) -> None:
    if words == TRAIN:
        write_tag(tag)
    n = changed(tag / "rules.py", old, new)
    assert reason.format(n=n) in refused(run(words, tag), tag)


def test_an_arena_that_is_never_done(tag: Path) -> None:
    changed(tag / "__init__.py", "GAME = Game(", SURPRISE)
    assert "it did not end" in refused(run(f"{PLAY} --arena surprise-7", tag), tag)


def test_an_unusable_result_is_one_line(tag: Path) -> None:
    changed(tag / "__init__.py", "GAME = Game(", "GAME = Game(\n    ranking_key=lambda match, seat: None,")
    assert "TypeError: " in refused(run(DUEL, tag), tag)


@pytest.mark.parametrize(
    ("words", "old", "new", "reason"),
    [
        (DUEL, "        match.over = 1", "        pass", "its match is not over 10 s after its time."),
        (DUEL, "robot.score += 1", "robot.score += 0.5", ", no whole number."),
        (DUEL, "steer(match, k, 1.0)", "steer(match, k, 1e999 * 0)", " is nan, no number."),
    ],
)
def test_compiled_matches_refuse_the_same(tag: Path, words: str, old: str, new: str, reason: str) -> None:
    """They are rehearsed plain: compiled, half a point would be cut off."""
    changed(tag / "rules.py", old, new)
    assert reason in refused(run(words, tag, compiled=True), tag)


ENDLESS = """
import numba, numpy
from pathlib import Path
from pigaming_app.storage.plugins import endless
from pigaming_app.storage.plugins.found import Plugin
endless.LIMIT, endless.GRACE = 0.5, 0.2
@numba.njit(nogil=True)
def loop(numbers):
    while numbers[0] >= 0:
        numbers[0] = (numbers[0] + 3) % 7
numbers = numpy.ones(1, numpy.int64)
endless.overseer.oversee([Plugin("tag", "tag", Path("/tag"))])
endless.overseer.run("tag", lambda: 5, loop, numbers)
"""


def test_compiled_code_that_makes_no_tick_is_ended() -> None:
    ended = python(ENDLESS)
    assert ended.returncode == 1
    assert ended.stderr == "PiGaming: The game tag in /tag is left out: its compiled code made no tick.\n"


@pytest.mark.parametrize(
    ("file", "line", "reason"),
    [
        ("__init__.py", "raise KeyboardInterrupt", "__init__.py, line 1: KeyboardInterrupt."),
        ("rules.py", "import sys; sys.exit()", "rules.py, line 1: SystemExit."),
        ("ai.py", "raise BaseException('no')", "ai.py, line 1: BaseException: no."),
        ("rules.py", "import os; os._exit(0)", "__init__.py: its import ends the process with exit code 0."),
        ("screens.py", "import os; os.abort()", "screens.py: its import ends the process by signal 6."),
    ],
)
def test_what_ends_a_process_at_import_ends_no_other_job(tag: Path, file: str, line: str, reason: str) -> None:
    source = tag / file
    source.write_text(f"{line}\n{source.read_text()}")
    ended = run(OTHER, tag)
    assert (ended.returncode, ended.stderr) == (0, f"PiGaming: The game tag in {tag} is left out: {reason}\n")
    if line.startswith("raise Key"):
        assert reason == refused(run(PLAY, tag), tag)


def test_a_plug_in_is_tried_again_only_after_a_change(tag: Path) -> None:
    trace = tag / "trace"
    changed(tag / "rules.py", "REACH = ", f"print(file=open({str(trace)!r}, 'a'))\nREACH = ")
    for tried in (2, 3):  # imports: the trial, and each command
        assert run(PLAY, tag).returncode == 0
        assert len(trace.read_text()) == tried
    changed(tag / "rules.py", "REACH = 60.0", "REACH = 61.0")
    assert run(PLAY, tag).returncode == 0
    assert len(trace.read_text()) == 5


MATCH = """
from pigaming_app.games.game import Seat, Setup
from pigaming_app.scenes.app import App
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.start import opened
from pigaming_app.scenes.views.registry import shown_games

seats = tuple(Seat("level5", seat) for seat in range(4))
match = lambda context: MatchScene(context, Setup("tag", "classic", seats, 1.0, 3, "standard"), [None] * 4)
print(*shown_games())
with opened(Options(first_scene=match, headless=True, step=1 / 30, frames=240)) as app:
    said = []
    app.notices.add = said.append
    assert app.loop() == 0
    print(*shown_games())
    print(*[type(scene).__name__ for scene in app.stack.scenes], *app.stack.top.tiles.names)
    print(*said)
"""
FAULTS = {
    "rules.py": ("    match.tick += 1\n", "    match.tick += 1\n    match.tick //= int(match.tick < 9)\n"),
    "ai.py": ("    if match.tick % PERIOD", "    match.nothing.x = 1\n    if match.tick % PERIOD"),
    "screens.py": ("        put(under, coin()", "        self.nothing.draw()\n        put(under, coin()"),
}
HANGS = (*FAULTS["rules.py"][:1], "    match.tick += 1\n    while match.tick > 9:\n        pass\n")


@pytest.mark.parametrize(
    ("file", "before", "after"), [*((file, *fault) for file, fault in FAULTS.items()), ("rules.py", *HANGS)]
)
def test_the_title_returns_without_a_game_that_fails_or_hangs_in_a_match(
    tag: Path, file: str, before: str, after: str
) -> None:
    changed(tag / file, before, after)
    ended = python(MATCH, timeout=600.0)
    assert ended.returncode == 0, ended.stderr[-2000:]
    *_, at_first, later, stack, notice = ended.stdout.splitlines()
    assert at_first.split() == [*later.split(), "tag"]
    assert stack.split() == ["Title", *later.split()]
    assert notice == "Tag failed. It is left out until the next start."
    (line,) = [line for line in ended.stderr.splitlines() if "left out" in line]
    assert line.startswith(f"PiGaming: The game tag in {tag} is left out: {file}, line ")
