"""Naming, saving and opening robots with a pad; every error is one sentence on screen."""

import errno
from dataclasses import replace
from pathlib import Path

import pytest

from pigaming_app.ai.qlearning.table_files import Trained, decode, encode
from pigaming_app.jobs.cli import main
from pigaming_app.scenes.lab import saved_robots as robots
from pigaming_app.scenes.lab.pages.menu import LabMenu, RobotNamePage
from pigaming_app.scenes.lab.pages.open_page import COLUMNS, ROWS, OpenPage
from pigaming_app.scenes.lab.scene import Lab
from pigaming_app.scenes.pages.name_page import LETTERS
from pigaming_app.sim.record import digest
from pigaming_app.ui.input.events import Button
from tests import tags
from tests.scenes.arcade import Arcade
from tests.ui.input.virtual_pad import VirtualPad


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    arcade.open(Lab(arcade.context, fast=False))
    arcade.wait(0.5, fps=4)


def lab(arcade: Arcade) -> Lab:
    return arcade.shown(Lab)


def menu(arcade: Arcade, item: str) -> None:
    arcade.press(Button.START)
    arcade.shown(LabMenu).focus.move_to(item)
    arcade.press(Button.FIRE)
    arcade.wait(0.5, fps=4)


def save(arcade: Arcade, name: str) -> None:
    """Save the robot under a name, entered letter by letter."""
    menu(arcade, "save")
    page = arcade.shown(RobotNamePage)
    spell(page, name)
    arcade.press(Button.START)


def spell(page: RobotNamePage, name: str) -> None:
    page.picker.letters = [LETTERS.index(letter) for letter in name.ljust(robots.LENGTH)]


def test_a_pad_spells_a_name_saves_and_the_robot_comes_back_as_it_was(arcade: Arcade) -> None:
    with VirtualPad() as pad:
        arcade.wait(0.1)
        pad.tap("start")
        arcade.wait(0.1)
        arcade.shown(LabMenu)
        pad.tap("a")
        arcade.wait(0.5)
        page = arcade.shown(RobotNamePage)
        spell(page, "A")
        pad.tap("down")
        arcade.wait(0.1)
        pad.tap("a")
        arcade.wait(0.1)
        pad.tap("up")
        arcade.wait(0.1)
        assert page.name == "B9"
        pad.tap("start")
        arcade.wait(0.1)
    here = lab(arcade)
    assert here.name == "B9"
    assert here.message == arcade.context.words("lab.saved", name="B9", file=robots.file_of("B9"))
    assert robots.names() == ["B9"]
    saved = robots.load_robot("B9")
    assert isinstance(saved, Trained)
    assert saved.rows["experiences"][0] > 0
    here.begin()
    menu(arcade, "open")
    arcade.shown(OpenPage)
    arcade.press(Button.FIRE)
    assert lab(arcade) is here
    assert (here.name, here.table.training.experiences) == ("B9", saved.rows["experiences"][0])
    assert digest(here.table.training.table) == digest(saved.rows[0])
    assert here.table.recipe == saved.recipe


def test_another_robot_of_that_name_is_not_replaced_at_once(arcade: Arcade) -> None:
    save(arcade, "VOLT")
    before = robots.file_of("VOLT").read_bytes()
    lab(arcade).begin()
    arcade.wait(0.5)
    save(arcade, "VOLT")
    page = arcade.shown(RobotNamePage)
    assert page.taken
    assert robots.file_of("VOLT").read_bytes() == before
    arcade.press(Button.START)
    assert lab(arcade).name == "VOLT"
    assert robots.file_of("VOLT").read_bytes() != before


def test_saving_again_under_the_same_name_needs_no_question(arcade: Arcade) -> None:
    save(arcade, "NEON")
    menu(arcade, "save")
    assert arcade.shown(RobotNamePage).name == "NEON"
    arcade.press(Button.START)
    assert lab(arcade).name == "NEON"


def test_an_empty_name_is_invalid(arcade: Arcade) -> None:
    save(arcade, " ")
    arcade.shown(RobotNamePage)
    assert robots.names() == []
    arcade.press(Button.BACK)
    lab(arcade)


def test_a_mouse_spells_too(arcade: Arcade) -> None:
    menu(arcade, "save")
    page = arcade.shown(RobotNamePage)
    spell(page, "AB")
    arcade.click(page.middle(1), 510 + 160)
    assert (page.picker.slot, page.name) == (1, "AC")
    arcade.click(page.middle(0), 510 - 160)
    assert page.name == "C", "the letter before A is a blank"


@pytest.mark.parametrize(
    ("number", "key"),
    [(errno.ENOSPC, "lab.disk_full"), (errno.EACCES, "lab.no_writing"), (errno.EIO, "lab.no_writing")],
)
def test_a_full_disk_is_one_sentence_and_the_training_goes_on(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, number: int, key: str
) -> None:
    def fail(*_: object) -> None:
        raise OSError(number, "no")

    monkeypatch.setattr("pigaming_app.scenes.lab.saved_robots.save_table", fail)
    experiences = lab(arcade).table.training.experiences
    save(arcade, "ROBI")
    here = lab(arcade)
    assert (here.wrong, here.message) == (True, arcade.context.words(key))
    assert here.table.training.experiences >= experiences > 0
    assert here.name == ""


def test_a_folder_that_cannot_be_made_is_one_sentence(arcade: Arcade, home: Path) -> None:
    home.mkdir(exist_ok=True)
    (home / "data").write_text("in the way")
    save(arcade, "ROBI")
    assert lab(arcade).message == arcade.context.words("lab.no_writing")
    assert robots.names() == []


def test_a_damaged_file_is_one_sentence_and_the_robot_of_the_moment_stays(arcade: Arcade) -> None:
    save(arcade, "PIXI")
    path = robots.file_of("PIXI")
    path.write_bytes(path.read_bytes()[:200])
    before = lab(arcade).table.training
    menu(arcade, "open")
    arcade.press(Button.FIRE)
    here = lab(arcade)
    assert (here.wrong, here.message) == (True, arcade.context.words("lab.broken"))
    assert here.table.training is before


def test_a_robot_of_another_engine_is_opened_and_that_is_said(arcade: Arcade) -> None:
    trained = decode((tags.FOLDER / "2.0.0" / "ROBI.npz").read_bytes(), "")
    robots.folder().mkdir(parents=True)
    robots.file_of("ROBI").write_bytes(encode(replace(trained, engine="another")))
    menu(arcade, "open")
    arcade.press(Button.FIRE)
    here = lab(arcade)
    assert (here.wrong, here.message) == (False, arcade.context.words("lab.opened_other", name="ROBI"))
    assert here.table.training.matches >= 2


def test_an_empty_shelf_leads_back(arcade: Arcade) -> None:
    menu(arcade, "open")
    arcade.shown(OpenPage)
    arcade.press(Button.FIRE)
    lab(arcade)


def test_many_robots_fill_more_than_one_page(arcade: Arcade) -> None:
    robots.folder().mkdir(parents=True)
    for i in range(COLUMNS * ROWS + 2):
        robots.file_of(f"R{i}").write_bytes(b"")
    (robots.folder() / "not a name.npz").write_bytes(b"")
    menu(arcade, "open")
    page = arcade.shown(OpenPage)
    assert (len(page.names), page.pages) == (COLUMNS * ROWS + 2, 2)
    arcade.press(Button.Y)
    assert len(arcade.shown(OpenPage).focus.spots) == 2
    arcade.press(Button.BACK)
    lab(arcade)


def test_a_proposal_is_a_name_that_nobody_has(arcade: Arcade) -> None:
    first = robots.proposal()
    save(arcade, first)
    assert robots.is_name(robots.proposal())
    assert robots.proposal() != first


@pytest.mark.parametrize("kind", ["table", "network"])
def test_duel_takes_the_file_that_the_page_names(arcade: Arcade, kind: str, capsys: pytest.CaptureFixture[str]) -> None:
    here = lab(arcade)
    here.kind = kind
    here.reward_by("10*hit - (1 if distance > 500 else 0) - 0.01*turned")
    save(arcade, "EXPORT")
    file = here.message.rpartition(" ")[2]
    assert file.endswith("EXPORT.npz")
    assert main(["duel", "pitanks", file, "idle", "--matches", "2", "--minutes", "0.2"]) == 0
    assert "EXPORT" in capsys.readouterr().out
    robot, line = robots.load_robot("EXPORT"), here.trainer.line
    here.reward_by("hit")
    here.open(robot, "EXPORT")
    assert here.trainer.line == line == "10*hit - (1 if distance > 500 else 0) - 0.01*turned"
