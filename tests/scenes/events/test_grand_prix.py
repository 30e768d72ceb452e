"""A Grand Prix on the screens: single players and teams, AIs on the seats that stay empty, and a restart in between."""

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Entrant, EventSpec, Format
from pigaming_app.scenes.events.choice import EventsPage
from pigaming_app.scenes.events.next_page import INPUT_LOCKOUT, NextMatch
from pigaming_app.scenes.events.overview import TEAMS
from pigaming_app.scenes.events.podium_page import EventPodiumPage
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.events.setup.draft import Draft
from pigaming_app.scenes.events.setup.entrants_page import EntrantsPage
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.events.drawn import played, running, saved

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")


def new_event(arcade: Arcade, *teams: str) -> RunningEvent:
    """Three people set up a Grand Prix on the screens; `teams`: of each of them."""
    draft = Draft()
    draft.choose("format", Format.GRAND_PRIX)
    draft.entrants += [Entrant(name) for name in ("ANA", "BEA", "EVA")]
    page = EntrantsPage(arcade.context, draft, EventsPage(arcade.context).begin)
    arcade.open(page)
    for i, team in enumerate(teams):
        page.focus.move_to(str(i))
        while page.draft.entrants[i].team != team:
            arcade.press(Button.Y)
    arcade.press(Button.START)
    return arcade.shown(NextMatch).running


def play(arcade: Arcade, scores: tuple[int, ...]) -> MatchScene:
    """Three people take their seats and play the next match to its end with these scores."""
    arcade.wait(INPUT_LOCKOUT + 0.1)
    for device in KEYS[:3]:
        arcade.press(Button.FIRE, device)
    arcade.press(Button.START)
    arcade.until(lambda: isinstance(arcade.stack.top, MatchScene))
    scene = arcade.shown(MatchScene)
    scene.opening.countdown.seconds_left = 0.05
    arcade.until(lambda: not scene.opening.countdown.locked)
    for robot, score in zip(scene.match.state.robots, scores, strict=False):
        robot.score = score
    scene.match.state.rules.ticks = scene.match.state.tick + 1
    arcade.until(lambda: isinstance(arcade.stack.top, WinnersMoment))
    arcade.until(lambda: not isinstance(arcade.stack.top, WinnersMoment))
    return scene


def test_single_players_get_points_by_place_and_an_ai_fills_the_fourth_seat(arcade: Arcade) -> None:
    run = new_event(arcade)
    scene = play(arcade, (5, 3, 1, 9))
    assert [seat.brain for seat in scene.setup.seats] == ["human", "human", "human", "level3"]
    first = saved(run).open and saved(run).fixtures[0]
    assert first
    points = {row.entrant: row.points for row in saved(run).standings}
    assert [points[name] for name in first.entrants] == [10.0, 6.0, 3.0], "the AI has no place"


def test_a_grand_prix_goes_on_after_a_restart_to_its_podium(arcade: Arcade, controls: Controls) -> None:
    run = new_event(arcade)
    play(arcade, (5, 3, 1, 9))
    before = saved(run)
    restarted = Arcade(controls)
    restarted.open(EventsPage(restarted.context))
    restarted.press(Button.DOWN)
    restarted.press(Button.FIRE)
    page = restarted.shown(NextMatch)
    assert page.running.event == before
    assert page.fixture
    assert page.fixture.game == "factory", "the second game"
    page.running.change(lambda event: played(event))
    restarted.until(lambda: isinstance(restarted.stack.top, EventPodiumPage))
    assert [fixture.game for fixture in saved(run).fixtures] == shown_games()
    assert saved(run).outcomes[1] == before.outcomes[1]


def test_teams_play_together_and_have_a_table_and_a_podium(arcade: Arcade) -> None:
    run = new_event(arcade, "A", "A", "B")
    entrants = {one.name: one.team for one in saved(run).entrants}
    assert entrants == {"ANA": "A", "BEA": "A", "EVA": "B"}
    scene = play(arcade, (5, 3, 1))
    names = saved(run).fixtures[0].entrants
    sides = {name: scene.setup.seats[i].team for i, name in enumerate(names)}
    assert sides["ANA"] == sides["BEA"] != sides["EVA"]
    event = saved(run)
    points = {row.entrant: row.points for row in event.standings}
    assert {row.entrant: row.points for row in event.team_standings} == {
        "A": points["ANA"] + points["BEA"], "B": points["EVA"]
    }  # fmt: skip
    table = TablePage(arcade.context, run)
    assert (TEAMS, 0) in table.overview.pages
    run.change(lambda event: played(event))
    assert {row.entrant for row in EventPodiumPage(arcade.context, run).best} == {"A", "B"}


def test_nobody_fills_the_seats_if_that_is_switched_off(arcade: Arcade) -> None:
    entrants = tuple(Entrant(name) for name in ("ANA", "BEA", "EVA"))
    arcade.open(
        NextMatch(arcade.context, running(Event(EventSpec("Cup", Format.GRAND_PRIX, ("pitanks",), entrants, 1, 4))))
    )
    scene = play(arcade, (5, 3, 1))
    assert scene.setup.seats[3].brain == "off"
