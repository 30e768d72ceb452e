"""Formats whose matches are called by those who play: a ladder and tries, from the names to the podium."""

from datetime import date, timedelta

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Entrant, EventSpec, Format, Result
from pigaming_app.scenes.events.arrange_page import ArrangePage
from pigaming_app.scenes.events.choice import EventsPage, page_of
from pigaming_app.scenes.events.manage.corrections import Correction
from pigaming_app.scenes.events.manage.event_page import EventPage
from pigaming_app.scenes.events.next_page import ALL_READY, INPUT_LOCKOUT, NextMatch
from pigaming_app.scenes.events.podium_page import EventPodiumPage
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.events.setup.draft import Draft
from pigaming_app.scenes.events.setup.entrants_page import EntrantsPage
from pigaming_app.scenes.events.setup.letters_page import LettersPage
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.scenes.flow.access import HOLD
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.ui.input.events import Button
from tests.events.examples import ranked
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.events.drawn import running, saved

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")


def begun(arcade: Arcade, form: Format, game: str, names: tuple[str, ...] = ("ANA", "BEA", "EVA")) -> RunningEvent:
    """An event that people set up on the screens."""
    draft = Draft()
    draft.choose("format", form)
    draft.choose("game", game)
    draft.entrants += [Entrant(name) for name in names]
    arcade.open(EntrantsPage(arcade.context, draft, EventsPage(arcade.context).begin))
    arcade.press(Button.START)
    return arcade.shown(ArrangePage).running


def drive(arcade: Arcade, people: int) -> MatchScene:
    """Take the seats of the next match, which begins."""
    arcade.shown(NextMatch)
    arcade.wait(INPUT_LOCKOUT + 0.1)
    for device in KEYS[:people]:
        arcade.press(Button.FIRE, device=device)
    arcade.wait(ALL_READY + 0.2)
    arcade.until(lambda: isinstance(arcade.stack.top, MatchScene))
    return arcade.shown(MatchScene)


def call(arcade: Arcade, name: str) -> None:
    page = arcade.shown(ArrangePage)
    page.focus.move_to(str([row.entrant for row in page.rows].index(name)))
    arcade.press(Button.FIRE)


def test_a_challenge_from_two_names_to_another_ladder(arcade: Arcade) -> None:
    run = begun(arcade, Format.CHALLENGE, "pitanks")
    assert saved(run).spec.start == date.today().isoformat()
    call(arcade, "EVA")
    page = arcade.shown(ArrangePage)
    assert (page.called, page.rows[int(page.focus.name)].entrant) == (["EVA"], "BEA"), "the nearest is in focus"
    call(arcade, "ANA")
    scene = drive(arcade, 2)
    assert {*scene.names[:2]} == {"ANA", "EVA"}
    arcade.finish(*(9 if name == "EVA" else 0 for name in scene.names[:2]))
    arcade.skip_moments()
    arcade.until(lambda: isinstance(arcade.stack.top, ArrangePage))
    assert [row.entrant for row in arcade.shown(ArrangePage).rows] == ["EVA", "ANA", "BEA"]
    assert [row.entrant for row in saved(run).standings] == ["EVA", "ANA", "BEA"]


def test_the_first_of_the_ladder_has_nobody_to_challenge_and_a_call_is_taken_back(arcade: Arcade) -> None:
    begun(arcade, Format.CHALLENGE, "pitanks")
    call(arcade, "ANA")
    page = arcade.shown(ArrangePage)
    assert page.message == arcade.context.words("events.no_call", name="ANA")
    call(arcade, "BEA")
    assert page.called == ["BEA"]
    arcade.press(Button.BACK)
    assert arcade.shown(ArrangePage).called == []


def test_an_open_challenge_comes_first_after_a_restart(arcade: Arcade) -> None:
    run = begun(arcade, Format.CHALLENGE, "pitanks")
    call(arcade, "EVA")
    call(arcade, "BEA")
    arcade.shown(NextMatch)
    again = Arcade(arcade.context.controls)
    again.open(page_of(again.context, RunningEvent(run.path, saved(run))))
    again.wait(0.1)
    assert again.shown(NextMatch).fixture == saved(run).open[0]
    again.wait(INPUT_LOCKOUT + 0.1)
    again.press(Button.BACK)
    again.wait(0.1)
    page = again.shown(ArrangePage)
    assert not page._can("BEA")
    again.press(Button.START)
    again.shown(NextMatch)


def test_a_try_alone_against_the_clock(arcade: Arcade) -> None:
    run = begun(arcade, Format.TIME_TRIAL, "race")
    call(arcade, "BEA")
    scene = drive(arcade, 1)
    assert [seat.brain for seat in scene.setup.seats] == ["human", "off", "off", "off"]
    scene.match.state.racers[0].best_lap = 50 * 12.34
    arcade.finish(1)
    arcade.skip_moments()
    arcade.until(lambda: isinstance(arcade.stack.top, ArrangePage))
    assert saved(run).outcomes[1].scores == {"BEA": 12.34}
    assert saved(run).standings[0].entrant == "BEA"


def test_two_share_a_match_for_a_high_score_with_ais_beside_them(arcade: Arcade) -> None:
    run = begun(arcade, Format.HIGH_SCORE, "pitanks")
    call(arcade, "BEA")
    call(arcade, "EVA")
    arcade.press(Button.START)
    scene = drive(arcade, 2)
    assert [seat.brain for seat in scene.setup.seats] == ["human", "human", "level3", "level3"]
    arcade.finish(*(9 if name == "EVA" else 4 for name in scene.names[:2]), 20, 20)
    arcade.skip_moments()
    arcade.until(lambda: isinstance(arcade.stack.top, ArrangePage))
    assert {row.entrant: row.tie_breaks["best"] for row in saved(run).standings} == {"EVA": 9.0, "BEA": 4.0, "ANA": 0.0}


def test_somebody_comes_late_and_the_table_is_a_press_away(arcade: Arcade) -> None:
    run = begun(arcade, Format.TIME_TRIAL, "race")
    arcade.press(Button.Y)
    assert arcade.shown(LettersPage).enter("ZOE") == ""
    arcade.wait(0.4)
    arcade.press(Button.BACK)
    arcade.wait(0.1)
    assert "ZOE" in [row.entrant for row in arcade.shown(ArrangePage).rows]
    assert saved(run).entrants[-1].name == "ZOE"
    arcade.press(Button.X)
    arcade.shown(TablePage)


def test_the_operator_ends_the_day_and_the_podium_follows(arcade: Arcade) -> None:
    run = begun(arcade, Format.TIME_TRIAL, "race")
    arcade.press(Button.X)
    arcade.press(Button.DOWN)
    arcade.shown(EventPage).focus.move_to("close_day")
    arcade.key("SPACE", HOLD / 2)
    assert not saved(run).over
    arcade.key("SPACE", HOLD + 0.2)
    assert saved(run).over
    arcade.press(Button.BACK, Button.BACK)
    arcade.until(lambda: isinstance(arcade.stack.top, EventPodiumPage))


def test_weeks_that_have_passed_are_closed_when_the_page_opens(arcade: Arcade) -> None:
    start = date.today() - timedelta(days=15)
    spec = EventSpec("L", Format.CHALLENGE, ("pitanks",), tuple(map(Entrant, "ABC")), start=start.isoformat())
    run = running(Event(spec).arrange("C", "A"))
    arcade.open(page_of(arcade.context, run))
    assert saved(run).progress.closed == 2
    assert saved(run).open == ()


def test_a_try_that_does_not_count(arcade: Arcade) -> None:
    spec = EventSpec("T", Format.TIME_TRIAL, ("race",), tuple(map(Entrant, "ABC")), seats=1)
    event = Event(spec).arrange("B")
    run = running(event.record(Result(1, (("B",),), {"B": 12.3})))
    arcade.open(Correction(arcade.context, run, run.event.fixtures[0]))
    page = arcade.shown(Correction)
    assert page.value("B").options == ("12.30", "does not count")
    arcade.press(Button.RIGHT, Button.START)
    assert saved(run).outcomes[1].scores == {}
    assert saved(run).standings[0].tie_breaks["best"] == 0.0


def test_ais_alone_play_their_tries_and_weeks_without_a_press(arcade: Arcade) -> None:
    spec = EventSpec("A", Format.CHALLENGE, ("pitanks",), tuple(Entrant(name, "idle") for name in "ABC"), rounds=1)
    run = running(Event(spec))
    arcade.open(page_of(arcade.context, run))
    arcade.until(lambda: bool(saved(run).open))
    page = arcade.shown(NextMatch)
    assert page.show
    while saved(run).open:
        run.change(lambda event: event.record(ranked(event.open[0], *event.open[0].entrants)))
    arcade.until(lambda: isinstance(arcade.stack.top, EventPodiumPage), 10.0)
