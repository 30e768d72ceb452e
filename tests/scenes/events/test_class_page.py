"""A class on the page of entrants: from a spreadsheet that is dropped there to teams, in an order by lot."""

from pathlib import Path

import pytest

from pigaming_app.events.spec import Format
from pigaming_app.scenes.events.setup.draft import Draft
from pigaming_app.scenes.events.setup.entrants_page import BEGIN, EntrantsPage
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import Arcade

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")

LIST = Path(__file__).parents[2] / "data" / "lists" / "class_de.ods"


@pytest.fixture
def page(arcade: Arcade) -> EntrantsPage:
    page = arcade.open(EntrantsPage(arcade.context, Draft(Format.SWISS), lambda draft: "no"))
    arcade.context.dropped.append(LIST)
    arcade.wait(0.1)
    return page


def entered(page: EntrantsPage) -> list[tuple[str, str]]:
    return [(one.name, one.team) for one in page.draft.entrants]


def test_a_spreadsheet_is_dropped_and_says_what_became_of_it(page: EntrantsPage) -> None:
    assert [name for name, _ in entered(page)] == ["Jürgen Mü.", "Änne", "Jürgen Mö.", "Emre"]
    assert "Jürgen Mü., Jürgen Mö." in page.message
    assert "Bemerkung" in page.message
    assert {team for _, team in entered(page)} == {""}


def test_classes_become_teams_and_are_given_up_again(arcade: Arcade, page: EntrantsPage) -> None:
    page.focus.move_to(BEGIN)
    assert (Button.Y, "events.hint_classes") in page.hints
    arcade.press(Button.Y)
    assert [team for _, team in entered(page)] == ["5a", "5a", "5b", "5b"]
    spec = page.draft.spec("T", 1)
    assert {entrant.team for entrant in spec.entrants} == {"5a", "5b"}
    arcade.press(Button.Y)
    assert {team for _, team in entered(page)} == {""}


def test_the_order_is_drawn_by_lot(arcade: Arcade, page: EntrantsPage) -> None:
    page.focus.move_to(BEGIN)
    before, orders = entered(page), set()
    for _ in range(30):
        arcade.press(Button.X)
        orders.add(tuple(entered(page)))
    assert {frozenset(order) for order in orders} == {frozenset(before)}
    assert len(orders) > 5
    assert page.message == arcade.context.words("events.shuffled")


def test_x_on_a_name_still_removes_it(arcade: Arcade, page: EntrantsPage) -> None:
    page.focus.move_to("1")
    arcade.press(Button.X)
    assert [name for name, _ in entered(page)] == ["Jürgen Mü.", "Jürgen Mö.", "Emre"]
