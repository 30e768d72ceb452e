"""Formats on the screens: a Grand Prix of single players and teams, and a knock-out match that is tied."""

from dataclasses import replace

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Entrant, EventSpec, Format
from pigaming_app.scenes.events.choice import EventsPage
from pigaming_app.scenes.events.manage.corrections import Correction, ResultsList
from pigaming_app.scenes.events.next_page import ALL_READY, INPUT_LOCKOUT, NextMatch
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
from tests.events.examples import level
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.events.drawn import an_event, played, result_of, running, saved

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")


def new_event(arcade: Arcade, *teams: str) -> RunningEvent:
    """Three people set up a Grand Prix on the screens; `teams`: of each of them."""
    draft = Draft()
    draft.choose("format", Format.GRAND_PRIX)
    draft.entrants += [Entrant(name) for name in ("ANA", "BEA", "EVA")]
    page = arcade.open(EntrantsPage(arcade.context, draft, EventsPage(arcade.context).begin))
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
        arcade.press(Button.FIRE, device=device)
    arcade.press(Button.START)
    arcade.until(lambda: isinstance(arcade.stack.top, MatchScene))
    scene = arcade.finish(*scores)
    arcade.skip_moments()
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
    restarted.press(Button.DOWN, Button.FIRE)
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


SEED = 2


def begun(arcade: Arcade, run: RunningEvent) -> None:
    """Begin the first match, with two people on the keyboard."""
    arcade.open(NextMatch(arcade.context, run))
    arcade.wait(INPUT_LOCKOUT + 0.1)
    for device in KEYS[:2]:
        arcade.press(Button.FIRE, device=device)
    arcade.wait(ALL_READY + 0.2)


def end_level(arcade: Arcade) -> None:
    """End the match on top without any point; the moments after it are skipped."""
    arcade.finish()
    arcade.skip_moments()


def test_a_tie_leads_to_an_extra_match_of_the_same_people_that_the_next_point_ends(arcade: Arcade) -> None:
    run, words = running(an_event(Format.KNOCKOUT)), arcade.context.words
    begun(arcade, run)
    names = run.event.fixtures[0].entrants
    end_level(arcade)
    page = arcade.shown(NextMatch)
    assert (page.message, page.seats.claims) == (words("events.tied"), dict(enumerate(KEYS[:2])))
    assert (saved(run).outcomes, len(saved(run).played[1])) == ({}, 1)
    extra = arcade.reach(MatchScene)
    assert (extra.setup.sudden_death, extra.names, extra.devices[:2]) == (True, names, KEYS[:2])
    extra.opening.countdown.seconds_left = 0.05
    arcade.until(lambda: not extra.opening.countdown.locked)
    arcade.wait(1.0)
    assert not extra.match.over
    extra.match.state.robots[1].score = 1
    assert arcade.reach(WinnersMoment).name == words("results.name_wins", name=names[1])
    assert saved(run).outcomes[1].places == ((names[1],), (names[0],))
    arcade.skip_moments()
    assert arcade.shown(NextMatch).fixture == run.event.fixtures[1]


def test_an_extra_match_that_is_left_or_killed_is_played_again(arcade: Arcade) -> None:
    run = running(an_event(Format.KNOCKOUT))
    begun(arcade, run)
    end_level(arcade)
    arcade.until(lambda: isinstance(arcade.stack.top, MatchScene))
    again = NextMatch(arcade.context, RunningEvent(run.path, saved(run)))  # as after a kill: only the file is left
    assert (again.fixture, again.seats.claims) == (run.event.open[0], {})
    assert again.fixture
    assert again.fixture.extra == 1
    arcade.shown(MatchScene).stop()
    page = arcade.reach(NextMatch)
    assert (page.fixture, page.message) == (again.fixture, arcade.context.words("events.unplayed"))


def test_lots_are_announced_even_after_the_last_match(arcade: Arcade) -> None:
    """The final is level four times; the seed is one with which the unbeaten draws the better lot."""
    event = Event(replace(an_event(Format.KNOCKOUT, 3).spec, seed=SEED))
    while event.open[0].stage != "final":
        event = event.record(result_of(event.open[0]))
    unbeaten, number = event.standings[0].entrant, event.open[0].number
    for _ in range(3):
        event = event.record(level(event.open[0]))
    run, words = running(event), arcade.context.words
    begun(arcade, run)
    end_level(arcade)
    assert run.event.outcomes[number].places[0] == (unbeaten,)
    assert run.event.over
    assert arcade.shown(NextMatch).message == words("events.lots", name=unbeaten)
    arcade.until(lambda: isinstance(arcade.stack.top, EventPodiumPage), 5.0)


def test_a_tie_is_corrected_while_its_extra_match_is_open(arcade: Arcade) -> None:
    event = an_event(Format.KNOCKOUT)
    run = running(event.record(level(event.open[0])))
    arcade.open(ResultsList(arcade.context, run))
    arcade.press(Button.FIRE)
    page = arcade.shown(Correction)
    assert set(page.places.values()) == {1}
    arcade.press(Button.RIGHT, Button.START)
    arcade.shown(ResultsList)
    assert saved(run).outcomes[1].places == ((page.names[1],), (page.names[0],))
    assert saved(run).open[0].number == 2
