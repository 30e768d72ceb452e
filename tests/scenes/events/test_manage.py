"""The operator's page of an event, and the reason of a correction, by pad, keyboard and mouse."""

from pathlib import Path

import pytest

from pigaming_app.events import event_files
from pigaming_app.events.spec import Format
from pigaming_app.scenes.events.choice import EventsPage
from pigaming_app.scenes.events.manage.corrections import MAX_NOTE, NOTES, Correction, ResultsList
from pigaming_app.scenes.events.manage.event_page import DELETE, DESK, RENAME, WITHDRAW, EventPage
from pigaming_app.scenes.events.next_page import NextMatch
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.scenes.flow.access import HOLD, HOLD_WITHOUT_PIN
from pigaming_app.scenes.flow.scene import Pop, Scene
from pigaming_app.scenes.pages.text_page import ALPHABET, TextPage
from pigaming_app.storage.safe_files import NotSaved, backup_of
from pigaming_app.ui.input.events import Button, Device
from tests.scenes.arcade import Arcade, Floor
from tests.scenes.events.drawn import an_event, played, running, saved

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")


def managed(arcade: Arcade, run: RunningEvent, row: str) -> EventPage:
    page = arcade.open(EventPage(arcade.context, run.path, run, Pop()))
    page.focus.move_to(row)
    return page


def test_an_event_is_deleted_with_its_backup_by_a_held_button(arcade: Arcade) -> None:
    run = running(an_event())
    run.change(lambda event: played(event, 1))
    assert backup_of(run.path).exists()
    arcade.open(EventsPage(arcade.context))
    arcade.press(Button.DOWN, Button.Y)
    page = arcade.shown(EventPage)
    page.focus.move_to(DELETE)
    arcade.key("SPACE", HOLD / 2)
    assert run.path.exists(), "released too early"
    arcade.key("SPACE", HOLD + 0.2)
    assert [path.name for path in run.path.parent.iterdir()] == []
    assert arcade.shown(EventsPage).saved == []


def test_from_the_table_a_deleted_event_leads_to_the_title(arcade: Arcade) -> None:
    run = running(an_event())
    for page in (NextMatch(arcade.context, run), TablePage(arcade.context, run)):
        arcade.open(page)
    arcade.press(Button.DOWN)
    arcade.shown(EventPage).focus.move_to(DELETE)
    arcade.key("SPACE", HOLD + 0.2)
    assert arcade.stack.scenes == [arcade.title]


def test_a_damaged_event_can_only_be_deleted(arcade: Arcade) -> None:
    run = running(an_event())
    run.path.write_text("{", encoding="utf-8")
    arcade.open(EventsPage(arcade.context))
    arcade.press(Button.DOWN, Button.Y)
    assert arcade.shown(EventPage).rows == (DELETE,)
    arcade.key("SPACE", HOLD + 0.2)
    assert not run.path.exists()


def test_a_file_that_stays_is_said(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    def kept(path: Path) -> None:
        raise NotSaved("it stays")

    monkeypatch.setattr(event_files, "delete", kept)
    page = managed(arcade, running(an_event()), DELETE)
    arcade.key("SPACE", HOLD + 0.2)
    assert page.message == arcade.context.words("events.undeleted")
    arcade.shown(EventPage)


def test_whoever_withdraws_is_chosen_and_the_opponent_wins(arcade: Arcade) -> None:
    run = running(an_event(Format.ROUND_ROBIN))
    page = managed(arcade, run, WITHDRAW)
    second = page.present[1]
    arcade.press(Button.RIGHT, Button.FIRE)
    arcade.frame()
    assert run.event.withdrawn == frozenset(), "only by holding"
    arcade.key("SPACE", HOLD + 0.2)
    assert saved(run).withdrawn == {second}
    assert all(second not in fixture.entrants for fixture in run.event.open)
    assert second not in page.present
    run.change(lambda event: event.withdraw(page.present[0]))
    run.change(lambda event: event.withdraw(page.present[0]))
    arcade.frame()
    assert page.rows == (RENAME, DESK, DELETE), "nobody is left to play"


def test_a_withdrawal_by_pad_and_by_mouse(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    run = running(an_event(Format.SWISS, 6))
    page = managed(arcade, run, WITHDRAW)
    box = page.focus.rect(WITHDRAW)
    monkeypatch.setattr(arcade.context.controls, "holds", lambda device, button: True)
    arcade.press(Button.FIRE, device=arcade.plug()[1])
    arcade.wait(HOLD + 0.1)
    assert len(saved(run).withdrawn) == 1
    chosen = page.chosen
    arcade.click(box.right - 54, box.centery)
    assert page.chosen == chosen + 1, "an arrow"
    name = page.present[page.chosen]
    arcade.click(box.x + 760, box.centery)
    arcade.wait(HOLD + 0.1)
    assert name in saved(run).withdrawn


def test_seats_are_free_again_after_somebody_has_withdrawn(arcade: Arcade) -> None:
    run = running(an_event(Format.SWISS, 6))
    page = arcade.open(NextMatch(arcade.context, run))
    page.seats.claims = {0: Device("keys", 0)}
    run.change(lambda event: event.withdraw(event.open[0].entrants[0]))
    page.on_enter()
    assert page.seats.claims == {}


def test_a_title_is_typed(arcade: Arcade) -> None:
    run = running(played(an_event(), 1))
    managed(arcade, run, RENAME)
    arcade.press(Button.FIRE)
    page = arcade.shown(TextPage)
    arcade.wait(TextPage.lockout + 0.1)
    for _ in range(len("Open day")):
        arcade.key("BACKSPACE", letter="\b")
    assert page.text == ""
    arcade.press(Button.START)
    assert page.refusal == arcade.context.words("events.no_title")
    for letter in "Wasd":
        arcade.key(letter.lower(), letter=letter)
    arcade.key("SPACE", letter=" ")
    arcade.key("x", letter="é")
    assert page.text == "Wasd é", "keys of players are letters here"
    arcade.key("RETURN", letter="\r")
    arcade.shown(EventPage)
    assert (saved(run).spec.title, len(saved(run).outcomes)) == ("Wasd é", 1)
    assert arcade.context.controls.typist is None
    arcade.key("s", letter="s")
    assert arcade.shown(EventPage).focus.name == WITHDRAW


def test_a_title_is_written_with_a_stick_or_the_mouse(arcade: Arcade) -> None:
    page = arcade.open(TextPage(arcade.context, "Title", "", 3, lambda text: ""))
    arcade.wait(TextPage.lockout + 0.1)
    arcade.press(Button.FIRE, Button.DOWN, Button.RIGHT)
    arcade.click(960, 790)  # below the letter
    arcade.click(960, 600)
    assert page.text == "ABC"
    arcade.press(Button.FIRE)
    assert page.text == "ABC", "full"
    arcade.press(Button.X, Button.UP)
    assert page.text == "AB"
    assert page.picker.spelled == ALPHABET[1]
    arcade.press(Button.BACK)
    assert arcade.stack.top is arcade.setup


def test_a_correction_has_a_reason_in_own_words(arcade: Arcade) -> None:
    run = running(played(an_event(Format.ROUND_ROBIN), 1))
    page = arcade.open(Correction(arcade.context, run, run.event.fixtures[0]))
    arcade.press(Button.X)
    text = arcade.shown(TextPage)
    assert text.most == MAX_NOTE
    arcade.wait(TextPage.lockout + 0.1)
    for wrong in ("", "walkover"):
        text.text = wrong
        arcade.press(Button.START)
        assert text.refusal
    text.text = "Cable torn"
    arcade.press(Button.START)
    arcade.shown(Correction)
    assert page.outcome.note == "Cable torn"
    page.focus.move_to(" note")
    arcade.press(Button.RIGHT)
    assert page.outcome.note == arcade.context.words(f"events.{NOTES[0]}")
    arcade.press(Button.LEFT, Button.START)
    assert saved(run).outcomes[1].note == "Cable torn"


def test_in_a_kiosk_visitors_read_the_results_but_do_not_change_them(arcade: Arcade) -> None:
    arcade.context.kiosk = True
    run = running(played(an_event(), 2))
    arcade.open(ResultsList(arcade.context, run))
    arcade.key("SPACE", HOLD_WITHOUT_PIN - 0.5)
    assert arcade.shown(ResultsList).message == arcade.context.words("events.hold")
    arcade.key("SPACE", HOLD_WITHOUT_PIN + 0.2)
    assert arcade.shown(Correction).fixture == run.event.fixtures[1]


@pytest.mark.parametrize(("row", "then"), [(RENAME, TextPage), (DELETE, Floor)])
def test_in_a_kiosk_visitors_neither_change_the_title_nor_delete_an_event(
    arcade: Arcade, row: str, then: type[Scene]
) -> None:
    arcade.context.kiosk = True
    run = running(an_event())
    managed(arcade, run, row)
    arcade.key("SPACE", HOLD_WITHOUT_PIN - 0.5)
    arcade.shown(EventPage)
    assert run.path.exists()
    arcade.key("SPACE", HOLD_WITHOUT_PIN + 0.2)
    arcade.shown(then)
    assert run.path.exists() is (row == RENAME)
