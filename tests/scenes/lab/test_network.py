"""The robot with a network in the Lab: switch, training in a process, challenge, files, and the ends of the process."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from itertools import count, pairwise
from pathlib import Path

import pytest

from pigaming_app.ai.learning.compiler import Compiler
from pigaming_app.ai.networks.files import TrainedNetwork
from pigaming_app.scenes.lab import saved_robots
from pigaming_app.scenes.lab.background import ExtraFetch, LabBackground
from pigaming_app.scenes.lab.layout import MATCH
from pigaming_app.scenes.lab.network.fetch_page import FetchPage
from pigaming_app.scenes.lab.network.kind_switch import NETWORK, TABLE, kind_rect
from pigaming_app.scenes.lab.network.trainer import DEATHS, NetworkTrainer
from pigaming_app.scenes.lab.pages.challenge import ROBOT, Challenge
from pigaming_app.scenes.lab.pages.compare_page import ComparePage
from pigaming_app.scenes.lab.pages.menu import LabMenu
from pigaming_app.scenes.lab.scene import Lab
from pigaming_app.sim.kernel import can_compile
from pigaming_app.ui.draw.layers import fit_size
from pigaming_app.ui.draw.theme import BODY, TITLE, text_width
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import Arcade
from tests.scenes.lab.test_trainer import runs

needs_numba = pytest.mark.skipif(not can_compile(), reason="numba is not installed")
PLAIN = (sys.executable, "-m", "tests.scenes.lab.plain_process")
NOTHING = (sys.executable, "-c", "")
BROKEN = (sys.executable, "-c", "exit(1)")


@pytest.fixture
def arcade(arcade: Arcade) -> Iterator[Arcade]:
    arcade.context.shared(LabBackground).network_compiler = Compiler(NOTHING)
    lab = Lab(arcade.context, fast=False)
    lab.side.network = NetworkTrainer(5, arcade.context.shared(LabBackground).network_compiler, PLAIN)
    arcade.open(lab)
    arcade.wait(0.5, fps=4)
    yield arcade
    lab.network.end()
    arcade.context.shared(LabBackground).network_compiler.end()


def lab(arcade: Arcade) -> Lab:
    return arcade.shown(Lab)


def wait(arcade: Arcade, condition: Callable[[], bool], timeout: float = 120.0) -> None:
    """Run frames in real time until a condition holds; a fifth of them are drawn, to leave the processor to others."""
    end = time.monotonic() + timeout
    for number in count():
        if condition():
            break
        assert time.monotonic() < end, "timeout"
        arcade.frame(draw=number % 5 == 0)
        time.sleep(0.03)


def switch(arcade: Arcade) -> None:
    lab(arcade).focus.move_to("kind")
    arcade.press(Button.FIRE)


def choose_network(arcade: Arcade) -> NetworkTrainer:
    switch(arcade)
    return lab(arcade).network


def learn(arcade: Arcade, updates: int = 3) -> NetworkTrainer:
    """Have the network learn at full speed."""
    trainer = choose_network(arcade) if lab(arcade).kind == TABLE else lab(arcade).network
    trainer.speed = 2
    wait(arcade, lambda: trainer.trained("").updates >= updates)
    return trainer


def pid_of(trainer: NetworkTrainer) -> int:
    process = trainer._process._process
    assert process
    return process.pid


@needs_numba
def test_the_network_is_chosen_learns_is_measured_played_against_saved_and_opened(arcade: Arcade) -> None:
    here = lab(arcade)
    trainer = choose_network(arcade)
    assert here.kind == NETWORK
    assert here.message == arcade.context.words("lab.network_how")
    arcade.frame()
    assert not any(here.shown.levels), "the table's plan is still shown"
    trainer.speed = 2
    wait(arcade, lambda: len(trainer.progress.measures) >= 2 and trainer.snapshot.matches >= 1)
    assert not trainer.compiling
    assert any(here.shown.levels)
    measures = here.shown.courses[0].measures
    assert [a.matches < b.matches for a, b in pairwise(measures)] == [True] * (len(measures) - 1)
    assert 0 in trainer.checkpoints()

    arcade.press(Button.X)
    fight = arcade.shown(Challenge)
    updates = trainer.trained("").updates
    while fight.inner.match.state.tick < 200:
        fight.inner.match.tick()
    robot, start = fight.inner.match.state.robots[ROBOT], fight.inner.match.arena.starts[ROBOT]
    assert (robot.x, robot.y, robot.heading) != (start.x, start.y, start.heading), "the robot moves"
    arcade.press(Button.BRAIN)
    arcade.shown(Challenge)
    assert fight.inner.runner.brain
    assert fight.inner.runner.brain.seats == [ROBOT]
    fight.inner.stop_requested = True
    arcade.frame()

    here.network.save("NEON")
    saved = saved_robots.load_robot("NEON")
    assert isinstance(saved, TrainedNetwork)
    assert saved.updates == updates, "training is paused"
    here.begin()
    arcade.press(Button.START)
    arcade.shown(LabMenu).focus.move_to("open")
    arcade.press(Button.FIRE)
    here.show_kind(TABLE)
    arcade.wait(0.5)
    arcade.press(Button.FIRE)
    assert (lab(arcade).kind, here.name) == (NETWORK, "NEON")
    assert trainer.trained("").updates == updates
    assert len(trainer.progress.measures) == len(saved.curve.rows) >= 2
    assert here.message == arcade.context.words("lab.opened", name="NEON")
    learn(arcade, updates + 2)


@pytest.mark.long
@needs_numba
def test_a_training_is_steered_paused_compared_killed_and_left(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    """A knob, the mouse on the switch, the table of robots, a process that starts again where it was, and an end."""
    monkeypatch.setattr("pigaming_app.scenes.lab.pages.compare_page.MINUTES", 0.02)
    monkeypatch.setattr("pigaming_app.scenes.lab.pages.compare_page.SLICE", 0.2)
    trainer, here = learn(arcade), lab(arcade)
    here.focus.move_to("still")
    arcade.press(Button.FIRE, Button.LEFT)
    assert trainer.recipe.still == -1.0
    arcade.frame()
    assert trainer._sent[0].recipe.still == -1.0
    arcade.press(Button.BACK)

    experiences = here.table.training.experiences
    box = kind_rect(arcade.context.words)
    arcade.click(box.left + 20, box.centery)
    assert here.kind == TABLE
    assert here.table.recipe.still == 0.0
    arcade.frame()
    updates = trainer.trained("").updates
    wait(arcade, lambda: here.table.training.experiences > experiences + 20)
    assert trainer.trained("").updates == updates, "the network pauses"
    arcade.click(box.right - 20, box.centery)
    assert here.kind == NETWORK
    learn(arcade, updates + 2)

    wait(arcade, lambda: trainer.snapshot.matches >= 1)
    arcade.press(Button.START)
    arcade.shown(LabMenu).focus.move_to("compare")
    arcade.press(Button.FIRE)
    table = arcade.shown(ComparePage)
    assert [player.own for player in table.players] == [True, True, False]
    arcade.until(lambda: not table.pairs, 600.0)
    assert {player.won + player.tied + player.lost for player in table.players} == {4}
    arcade.press(Button.BACK)

    number, updates = pid_of(trainer), trainer.trained("").updates
    os.kill(number, signal.SIGKILL)
    wait(arcade, lambda: pid_of(trainer) != number)
    assert lab(arcade) is here
    assert (here.wrong, here.message) == (True, arcade.context.words("lab.interrupted"))
    assert trainer.trained("").updates >= updates
    learn(arcade, updates + 2)
    assert here.kind == NETWORK

    number = pid_of(trainer)
    arcade.context.idle = Lab.idle + 1.0
    arcade.frame()
    assert arcade.stack.top is arcade.title
    assert not runs(number)
    assert (here.kind, trainer.trained("").updates, trainer.progress.measures) == (TABLE, 0, [])


@needs_numba
@pytest.mark.parametrize("broken", ["process", "compiler"])
def test_where_the_network_cannot_train_only_the_table_is_left(arcade: Arcade, broken: str) -> None:
    here = lab(arcade)
    compiler = Compiler(BROKEN) if broken == "compiler" else arcade.context.shared(LabBackground).network_compiler
    here.side.network = NetworkTrainer(5, compiler, BROKEN)
    choose_network(arcade)
    wait(arcade, lambda: here.kind == TABLE)
    assert (here.wrong, here.message) == (True, arcade.context.words("lab.failed"))
    assert here.network._deaths == DEATHS
    choose_network(arcade)
    assert here.kind == TABLE
    experiences = here.table.training.experiences
    arcade.wait(0.5)
    assert here.table.training.experiences > experiences
    compiler.end()


def test_without_numba_the_switch_fetches_it_and_tells_what_to_do(
    controls: Controls, home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pigaming_app.scenes.lab.network.trainer.can_compile", lambda: False)
    arcade = Arcade(controls, "pt")
    arcade.context.shared(LabBackground).network_fetch = fetching("print('offline')")
    here = arcade.open(Lab(arcade.context, fast=False))
    arcade.wait(0.5)
    switch(arcade)
    assert here.kind == TABLE
    assert here.shown.networks, "not dimmed: it can be chosen"
    page = arcade.shown(FetchPage)
    until(lambda: page.state == "offline")
    arcade.shown(FetchPage)
    arcade.press(Button.BACK)
    assert lab(arcade) is here


def fetching(program: str) -> ExtraFetch:
    """A fetch whose process runs this program instead."""
    return ExtraFetch((sys.executable, "-c", program))


def test_after_a_failure_another_try_fetches_it_and_the_network_half_opens(
    arcade: Arcade, home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is fetched in the background, once: the page may be left, and found again."""
    there, online = tmp_path / "there", tmp_path / "online"
    monkeypatch.setattr("pigaming_app.scenes.lab.network.trainer.can_compile", there.exists)
    program = (
        f"import pathlib, time\nif not pathlib.Path({str(online)!r}).exists(): print('full'); raise SystemExit\n"
        f"print('0.250', flush=True)\nwhile pathlib.Path({str(online)!r}).read_text() != 'go': time.sleep(0.01)\n"
        f"pathlib.Path({str(there)!r}).touch(); print('done')"
    )
    fetch = arcade.context.shared(LabBackground).network_fetch = fetching(program)
    here = arcade.open(Lab(arcade.context, fast=False))
    arcade.wait(0.5)
    switch(arcade)
    page = arcade.shown(FetchPage)
    until(lambda: page.state == "full")
    assert (Button.FIRE, "lab.hint_again") in page.prompts.items
    online.write_text("wait")
    arcade.press(Button.FIRE)
    until(lambda: fetch.share == 0.25)
    assert (Button.FIRE, "lab.hint_again") not in page.prompts.items
    arcade.press(Button.BACK)
    assert here.kind == TABLE
    arcade.wait(0.5)
    switch(arcade)
    page = arcade.shown(FetchPage)
    assert page.fetch is fetch
    online.write_text("go")
    until(lambda: fetch.state == "done")
    arcade.until(lambda: arcade.stack.top is here, 2.0)
    assert here.kind == NETWORK
    assert here.network.available
    here.network.end()


def test_a_bundle_without_it_fetches_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    fetch = fetching("print('done')")
    fetch.start()
    assert fetch.state == "built"


def until(done: Callable[[], bool]) -> None:
    end = time.monotonic() + 30.0
    while not done():
        assert time.monotonic() < end
        time.sleep(0.01)


def test_in_another_language_the_switch_has_another_width(arcade: Arcade) -> None:
    here = lab(arcade)
    before = here.focus.rect("kind")
    arcade.context.words.switch("pt")
    here.on_enter()
    lab(arcade)
    assert here.focus.rect("kind") == kind_rect(arcade.context.words) != before


CRASHING = f"""
import time
from pigaming_app.ai.learning.compiler import Compiler
from pigaming_app.scenes.lab.background import ExtraFetch
from pigaming_app.scenes.lab.background import LabBackground
from pigaming_app.scenes.lab.network.trainer import NetworkTrainer
trainer = NetworkTrainer(1, Compiler({NOTHING!r}), {PLAIN!r})
trainer.speed = 2
while not trainer.trained("").updates:
    trainer.feed(1 / 60)
    time.sleep(1 / 60)
print(trainer._process._process.pid, flush=True)
while True:
    trainer.feed(1 / 60)
    time.sleep(1 / 60)
"""


@needs_numba
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="/proc says whether a process is there")
def test_when_the_arcade_is_killed_the_training_ends_by_itself() -> None:
    arcade = subprocess.Popen([sys.executable, "-c", CRASHING], stdout=subprocess.PIPE, text=True)
    assert arcade.stdout
    with arcade, arcade.stdout:
        training = int(arcade.stdout.readline())
        assert runs(training)
        os.kill(arcade.pid, signal.SIGKILL)
    end = time.monotonic() + 20.0
    while runs(training):
        assert time.monotonic() < end, "the process is still running"
        time.sleep(0.05)


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_switch_leaves_room_for_the_title(language: str) -> None:
    words = Words(language)
    box = kind_rect(words)
    room = box.left - 20 - MATCH.left
    size = fit_size(words("lab.title"), TITLE, room)
    assert size >= 80
    assert text_width(words("lab.title"), size) <= room
    for key in ("table_how", "network_how", "no_network", "failed", "interrupted"):
        assert text_width(words(f"lab.{key}"), BODY, "body") < 1600
