"""The script of the open day: what it notes and how it drives, on the arcade's own scenes."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from pigaming_app.ai.game_ai import HELPED_POINT, TURN
from pigaming_app.ai.registry import make_person, new_match
from pigaming_app.games.game import Seat, Setup
from pigaming_app.scenes.events.next_page import EventMatch
from pigaming_app.scenes.kiosk.operator.desk import OperatorDesk
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent, StickState
from tests.bench.open_day import audit, ledger
from tests.bench.open_day.arcade import STEP
from tests.bench.open_day.plan import ONLY, plan
from tests.bench.open_day.stage import PATIENCE, Player, Stage
from tests.bench.open_day.visit import FAST, Visit
from tests.bench.open_day.watch import Watch
from tests.scenes.arcade import Arcade, Floor, setup
from tests.scenes.events.drawn import an_event, running, saved

DAY = plan(1.0, 8, 3)


@pytest.fixture
def arcade(controls: Controls) -> Arcade:
    return Arcade(controls)


def stand_in(**parts: object) -> Any:
    """An object with these parts alone."""
    return SimpleNamespace(**parts)


def watch_of(arcade: Arcade, folder: Path) -> Watch:
    desk = OperatorDesk(arcade.context, None, True)
    return Watch(stand_in(stack=arcade.stack, services=[desk]), DAY, ledger.LedgerFile(folder / "ledger"), 1)


def test_a_match_of_an_event_is_noted_with_its_number_and_scores(arcade: Arcade, tmp_path: Path) -> None:
    """The result that the arcade then records is the one that was noted."""
    run, watch = running(an_event()), watch_of(arcade, tmp_path)
    fixture = run.event.open[0]
    chosen = run.setup(fixture)
    assert chosen is not None
    scene = MatchScene(arcade.context, chosen, after=EventMatch(run, fixture))
    arcade.open(scene)
    scene.match.tick()
    watch.look(1.0, None, lambda match: [])
    scene.match.state.robots[1].score, scene.match.state.over = 3, 1
    watch.look(2.0, None, lambda match: [])
    arcade.stack.scenes[-1] = EventMatch(run, fixture)(scene)
    watch.look(3.0, None, lambda match: [])
    seen = ledger.read(tmp_path / "ledger")
    assert [match.settled for match in seen.matches] == [True]
    assert seen.matches[0].scores == {fixture.entrants[0]: 0.0, fixture.entrants[1]: 3.0}
    assert list(audit.journal_agrees(saved(run), seen.matches)) == []


@pytest.mark.parametrize("style", [TURN, HELPED_POINT])
def test_a_visitor_drives_a_race_to_its_finish(style: str) -> None:
    """With the stick alone, looked at as often as on the stage, in both driving styles of a kiosk."""
    seats = Seat("human", 0), Seat("off", 1), Seat("off", 2), Seat("off", 3)
    match = new_match(Setup("race", "classic", seats, 10.0, 1, "standard", 1))
    drivers = stand_in(style_of=lambda device: style)
    scene, stick = stand_in(match=match, devices=[Device("pad", 1)], drivers=drivers), StickState()
    visit = Visit(stand_in(reactions={}))
    match.sit(0, make_person("race", style, lambda: stick, 3))
    while not match.over and match.seconds < 20.0:
        if match.state.tick % 5 == 0:
            x, y, fire, turbo = visit._racing_line(scene, 0)
            stick = StickState(-y, x, fire, turbo)
        match.tick()
    assert match.over


class Bell(Floor):
    """Counts presses of FIRE."""

    rung = 0

    def handle(self, event: InputEvent) -> None:
        self.rung += event.button is Button.FIRE


def test_one_button_twice_is_two_presses(arcade: Arcade, tmp_path: Path) -> None:
    """A release and a press between two looks at a pad would be none."""
    bell, group, taps = Bell(), DAY.groups[0], 0
    app, watch = stand_in(stack=arcade.stack), watch_of(arcade, tmp_path)
    stage = Stage(app, replace(DAY, tasks=()), ledger.Ledger(), watch, 0.0, tmp_path)

    def ring() -> None:
        nonlocal taps
        if stage.ready(stage.players[0], FAST):
            stage.tap(stage.players[0].hands, Button.FIRE)
            taps += 1

    try:
        arcade.open(bell)
        stage.group, stage.players, stage.reactions = group, [Player(group.visitors[0], stage.pads[0])], {Bell: ring}
        for frame in range(50):
            stage.play(STEP * frame)
            arcade.frame(STEP)
    finally:
        stage.close()
    assert taps > 10
    assert bell.rung == taps


class LastMovement:
    """A pad that keeps how it was steered last."""

    device = Device("pad", 1)
    steered: tuple[float, float, bool, bool] | None = None

    def steer(self, x: float, y: float, fire: bool, turbo: bool) -> None:
        self.steered = x, y, fire, turbo


def test_sticks_are_released_after_a_match_and_nobody_waits_for_ever(arcade: Arcade, tmp_path: Path) -> None:
    """A stick that stays held moves the focus of the title, and no button counts that stays down."""
    pictures: list[Path] = []
    canvas, watch, hands = stand_in(screenshot=pictures.append), watch_of(arcade, tmp_path), LastMovement()
    app = stand_in(stack=arcade.stack, context=stand_in(canvas=canvas))
    stage = Stage(app, replace(DAY, tasks=()), ledger.Ledger(), watch, 0.0, tmp_path)
    try:
        stage.group, stage.players = DAY.groups[0], [stand_in(hands=hands)]
        stage.reactions = {MatchScene: lambda: hands.steer(1.0, -1.0, False, True)}
        arcade.open(MatchScene(arcade.context, setup("level1 level1 off off")))
        stage.play(1.0)
        assert hands.steered == (1.0, -1.0, False, True)
        arcade.stack.scenes[-1] = Floor()
        stage.play(2.0)
        assert hands.steered == (0.0, 0.0, False, False)
        watch.played[DAY.groups[0].number] += 1
        stage.play(1000.0)
        stage.play(1000.0 + PATIENCE)
        assert stage.group, "since its last match it has not waited longer than this"
        stage.play(1001.0 + PATIENCE)
        assert stage.group is None
    finally:
        stage.close()
    assert pictures == [tmp_path / f"stuck-{DAY.groups[0].number}.png"]
    assert "is stuck at Floor" in ledger.read(tmp_path / "ledger").troubles[0]


@pytest.mark.parametrize("only", ONLY)
def test_a_part_of_a_day_is_that_part(only: str) -> None:
    groups = plan(1.0, 20, 3, only=only).groups
    assert groups
    assert all(group.event if only == "events" else not group.event for group in groups)
    assert only == "events" or all(visitor.phone for group in groups for visitor in group.visitors)
