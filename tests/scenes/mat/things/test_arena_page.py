"""Build your arena on the emulated mat; matches among things; things that are moved or in the way."""

from collections.abc import Callable
from dataclasses import replace
from math import dist, hypot, pi

import numpy as np
import pytest

from pigaming_app.games.arenas import load
from pigaming_app.hardware.emulator.robots import RADIUS
from pigaming_app.hardware.emulator.things.prism import TAPE, Prism, box
from pigaming_app.hardware.proof.things import distances
from pigaming_app.hardware.scan.things import Outline, Thing, ThingKind, ThingLayout
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.hardware.session.things_on_mat import load_layout, save_layout, things_in_play
from pigaming_app.scenes.features.replays import decode, pack, replay_of, verify
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.mat.before_match import UnplayablePage
from pigaming_app.scenes.mat.mat import SessionMat
from pigaming_app.scenes.mat.robots.fault_page import FaultPage
from pigaming_app.scenes.mat.robots.match_scene import RealMatch
from pigaming_app.scenes.mat.session import session_of
from pigaming_app.scenes.mat.things import playable
from pigaming_app.scenes.mat.things.arena_page import ArenaPage
from pigaming_app.scenes.mat.things.moved_page import MovedPage
from pigaming_app.scenes.mat.things.playable import PlayableArenas
from pigaming_app.scenes.mat.things.sweep_page import SweepPage
from pigaming_app.scenes.play.scene import match_of
from pigaming_app.sim.things.spec import ThingSpec, Use
from pigaming_app.ui.draw.pixels import pixels_of
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import Arcade
from tests.scenes.mat.robots.test_real_match import FPS, match_for, opened
from tests.scenes.mat.robots.test_recording import MatSession

pytest.importorskip("cv2")
PUSHED = 60.0  # mm
FREE = 150.0  # px between a robot and a thing that is pushed, so that it is not pushed onto the robot
NOTICED = 6.0  # s
EXPLAINED = 2.0  # s from a fault to its cause
BOXES = {
    "pitanks": ((20.0, -450.0), (-300.0, -150.0), (450.0, 250.0)),
    "factory": ((-200.0, -450.0), (0.0, 0.0)),
    "race": ((0.0, 0.0),),
}  # mm


def thing(kind: ThingKind, x: float, y: float, wide: float, high: float) -> Thing:
    return Thing(kind, ((x, y), (x + wide, y), (x + wide, y + high), (x, y + high)), 80.0, 3.0)


def frames(arcade: Arcade, mat: EmulatedSession, done: Callable[[Scene], bool], timeout: float) -> float:
    """Run lit frames until `done` is true of the top scene; returns the seconds."""
    for frame in range(round(timeout * FPS)):
        if done(arcade.stack.top):
            return frame / FPS
        arcade.frame(1 / FPS, draw=True)
        mat.show(lambda: pixels_of(arcade.screen))
    raise AssertionError(f"{type(arcade.stack.top).__name__} is on top after {timeout} s")


def scanned(arcade: Arcade, mat: EmulatedSession, things: list[Prism]) -> ThingLayout:
    """Scan these things by the page."""
    mat.arena.furnish(things)
    page = arcade.open(ArenaPage(arcade.context))
    arcade.press(Button.FIRE)
    assert isinstance(arcade.stack.top, SweepPage)
    frames(arcade, mat, lambda top: top is page, 60.0)
    assert page.fault is None
    arcade.press(Button.BACK)
    return page.layout


@pytest.fixture
def cleared(mat: EmulatedSession):
    """The arena, whose things are taken away afterwards."""
    yield mat
    mat.arena.furnish(())
    mat.expected = None


@pytest.fixture
def simulated(controls: Controls) -> Arcade:
    """An arcade with a simulated mat, for what needs no camera."""
    arcade = Arcade(controls)
    arcade.context.mat = SessionMat(arcade.context, MatSession())
    return arcade


def keep(arcade: Arcade, *things: Thing) -> None:
    assert session_of(arcade.context) is not None
    save_layout(session_of(arcade.context), ThingLayout(things))


def test_things_are_changed_on_screen_and_kept(simulated: Arcade) -> None:
    crate, tape = thing(ThingKind.TALL, 700.0, 300.0, 90.0, 60.0), thing(ThingKind.FLAT, 1100.0, 300.0, 200.0, 20.0)
    keep(simulated, crate, tape)
    page = simulated.open(ArenaPage(simulated.context))
    assert page.selected == crate
    simulated.press(Button.Y)  # no mud of a box
    simulated.press(Button.RIGHT)
    simulated.press(Button.Y)
    simulated.press(Button.LEFT)
    simulated.press(Button.X)
    simulated.shown(ArenaPage)
    simulated.press(Button.BACK)
    assert simulated.stack.top is simulated.setup
    assert [spec.use for spec in things_in_play(session_of(simulated.context))] == [Use.MUD]


def test_an_arena_that_things_block_is_built_again_or_played_without_them(simulated: Arcade) -> None:
    bar = thing(ThingKind.TALL, 760.0, -20.0, 30.0, 940.0)
    keep(simulated, bar)
    simulated.open(match_of(simulated.context, match_for("pitanks", "level1 level1 off off", 2.0), [], (0, 1)))
    page = simulated.shown(UnplayablePage)
    simulated.press(Button.FIRE)
    simulated.press(Button.X)  # removes the bar
    simulated.press(Button.BACK)
    simulated.frame()
    assert simulated.shown(RealMatch).robots.things == ()
    keep(simulated, bar, thing(ThingKind.TALL, 700.0, 300.0, 90.0, 60.0))
    without = page.without()
    assert isinstance(without, RealMatch)
    assert without.robots.things == ()


def test_results_among_things_are_no_records_and_a_rematch_keeps_the_things(simulated: Arcade) -> None:
    keep(simulated, thing(ThingKind.TALL, 700.0, 300.0, 90.0, 60.0))
    match = opened(simulated, "pitanks", "level1 level1 off off", 2.0)
    assert match.sequel.without_records == range(4)
    keep(simulated)
    again = match.sequel.rematch(simulated.context, match.setup, [])
    assert isinstance(again, RealMatch)
    assert again.robots.things == match.robots.things != ()


@pytest.mark.again
@pytest.mark.long(first=True)
@pytest.mark.parametrize(("game", "seconds"), [("pitanks", 5.0), *((game, 60.0) for game in BOXES)])
def test_a_match_among_scanned_things_has_no_false_alarm_and_stops_when_one_is_pushed(
    arcade: Arcade, cleared: EmulatedSession, game: str, seconds: float
) -> None:
    mat = cleared
    things = [box(x, y, 90.0, 70.0, 90.0, 0.3, 0.45, "printed", i) for i, (x, y) in enumerate(BOXES[game])]
    layout = scanned(arcade, mat, [*things, box(300.0, -250.0, 200.0, 25.0, TAPE, 0.5, 0.1, seed=9)])
    assert [one.kind for one in layout.things].count(ThingKind.TALL) == len(things)
    brains = "level1 level1 level1 level1" if game == "factory" else "level5 level5 level5 off"
    real = (0, 1, 2, 3) if game == "factory" else (0, 1, 2)
    match = opened(arcade, game, brains, 5.0, real)
    frames(arcade, mat, lambda _: match.gathering is None, 60.0)
    began = match.match.seconds
    frames(arcade, mat, lambda top: isinstance(top, MovedPage) or match.match.seconds > began + seconds, 120.0)
    assert not isinstance(arcade.stack.top, MovedPage)

    moved = mat.arena.things[len(things) - 1]
    pushed = replace(moved, outline=tuple((x + PUSHED, y + PUSHED) for x, y in moved.outline))
    there = mat.arena.outline(pushed)
    x, y = there.mean(axis=0).tolist()
    robots = [match.match.state.robots[seat] for seat in real]
    frames(arcade, mat, lambda _: all(hypot(one.x - x, one.y - y) > FREE for one in robots), 60.0)
    mat.arena.furnish([pushed if one is moved else one for one in mat.arena.things])
    frames(arcade, mat, lambda top: isinstance(top, MovedPage), NOTICED)
    arcade.press(Button.FIRE)
    frames(arcade, mat, lambda top: isinstance(top, RealMatch), 60.0)
    frames(arcade, mat, lambda _: bool(match.match.state.shifts), 10.0)
    assert any(same(np.array(one.outline), there) for one in match.plant.shown_things or ())
    assert any(same(one.points, there) for one in load_layout(mat).things)


def same(one: Outline, other: Outline) -> bool:
    """True if no point of either outline is farther than 10 px from the other."""
    return bool(max(distances(one, other, 1.0).max(), distances(other, one, 1.0).max()) < 10.0)


def cage(x: float, y: float) -> list[Prism]:
    """Four boxes round a robot, mm on the mat, which leave it no room to drive."""
    away = RADIUS + 3.0 + 20.0
    sides = ((away, 0.0, 0.0), (-away, 0.0, 0.0), (0.0, away, 0.5 * pi), (0.0, -away, 0.5 * pi))
    return [box(x + dx, y + dy, 40.0, 130.0, 60.0, turn, 0.45, "printed", 20) for dx, dy, turn in sides]


@pytest.mark.again
@pytest.mark.long
def test_things_pushed_against_a_robot_explain_that_it_does_not_follow_its_commands(
    arcade: Arcade, cleared: EmulatedSession
) -> None:
    mat = cleared
    things = [box(x, y, 90.0, 70.0, 90.0, 0.3, 0.45, "printed", i) for i, (x, y) in enumerate(BOXES["pitanks"])]
    scanned(arcade, mat, things)
    match = opened(arcade, "pitanks", "level5 level5 off off", 5.0)
    frames(arcade, mat, lambda _: match.gathering is None, 60.0)
    frames(arcade, mat, lambda _: match.match.seconds > 1.0, 20.0)

    mat.arena.faults.switch("pinned", True, 0)  # nothing has moved: the fault stays unexplained
    frames(arcade, mat, lambda top: isinstance(top, FaultPage), 6.0)
    page, viewers = arcade.stack.top, match.plant.rig.viewers
    frames(arcade, mat, lambda _: bool(viewers), 1.0)
    frames(arcade, mat, lambda _: match.watch.ended, 2.0)
    assert arcade.stack.top is page
    assert not viewers
    mat.arena.faults.switch("pinned", False, 0)
    arcade.press(Button.Y)
    frames(arcade, mat, lambda top: isinstance(top, RealMatch), 5.0)
    frames(arcade, mat, lambda _, at=match.match.seconds: match.match.seconds > at + 1.0, 10.0)  # type: ignore[misc]

    robot, pose = mat.arena.robots[0], mat.arena.poses()[0]
    mat.arena.furnish([*things, *cage(robot.x, robot.y)])
    frames(arcade, mat, lambda top: isinstance(top, FaultPage), NOTICED)
    frames(arcade, mat, lambda top: isinstance(top, MovedPage), EXPLAINED)
    moved = arcade.shown(MovedPage)
    assert any(dist(place, pose[:2]) < 100.0 for place in moved.places)
    assert not match.plant.safety.latched
    mat.arena.furnish(things)
    arcade.press(Button.FIRE)
    frames(arcade, mat, lambda top: isinstance(top, RealMatch), 60.0)
    frames(arcade, mat, lambda _, at=match.match.seconds: match.match.seconds > at + 1.0, 10.0)  # type: ignore[misc]


@pytest.mark.again
@pytest.mark.long
@pytest.mark.parametrize("game", ["pitanks", "race"])
def test_a_block_that_is_moved_by_hand_is_a_wall_where_it_is_and_in_the_replay(
    arcade: Arcade, cleared: EmulatedSession, game: str
) -> None:
    mat, arcade.context.settings.blocks = cleared, True
    mat.arena.furnish([box(-100.0, -100.0, 160.0, 70.0, 50.0, 0.3, 0.5, marker=32)])
    match = opened(arcade, game, "level5 level5 level5 level5", 5.0)
    frames(arcade, mat, lambda _: match.gathering is None, 40.0)
    frames(arcade, mat, lambda _: match.match.seconds > 1.0, 20.0)
    block = mat.arena.things[0]
    for step in range(1, 11):
        moved = replace(block, outline=tuple((x + 6.0 * step, y) for x, y in block.outline))
        mat.arena.furnish([moved])
        frames(arcade, mat, lambda _, at=match.match.seconds: match.match.seconds > at + 0.05, 5.0)  # type: ignore[misc]
    frames(arcade, mat, lambda _, at=match.match.seconds: match.match.seconds > at + 1.0, 5.0)  # type: ignore[misc]
    shown = (match.plant.shown_things or ())[0].middle
    assert shown == pytest.approx(tuple(mat.arena.outline(moved).mean(axis=0).tolist()), abs=3.0)
    assert match.sequel.without_records == range(4)
    replay = replay_of(match.match)
    assert replay is not None
    assert verify(decode(pack(replay), "match"))


def crate(x: float, y: float, wide: float = 60.0, high: float = 60.0) -> ThingSpec:
    return ThingSpec(Use.WALL, ((x, y), (x + wide, y), (x + wide, y + high), (x, y + high)), 3.0)


def slot_of_hall() -> ThingSpec:
    slot = load("factory", "hall").plan.slots[0]
    return crate(slot.x - 30.0, slot.y - 30.0)


@pytest.mark.parametrize(
    ("game", "name", "things", "culprits"),
    [
        ("factory", "hall", [crate(760.0, 300.0), slot_of_hall(), crate(800.0, 500.0)], {1}),
        ("pitanks", "classic", [crate(760.0, -20.0, 30.0, 500.0), crate(760.0, 440.0, 30.0, 480.0)], {0, 1}),
        ("pitanks", "classic", [crate(760.0, 300.0)], set()),
    ],
    ids=["one covers a slot", "two close the way together", "none"],
)
def test_things_in_the_way_are_found(
    monkeypatch: pytest.MonkeyPatch, game: str, name: str, things: list[ThingSpec], culprits: set[int]
) -> None:
    monkeypatch.setattr(playable, "games", lambda: [game])
    monkeypatch.setattr(playable, "playable_arenas", lambda _: [name])
    arenas = PlayableArenas(things)
    arenas._thread.join(10.0)
    assert arenas.done
    assert arenas.blocked == ({game: [name]} if culprits else {})
    assert arenas.culprits == culprits
