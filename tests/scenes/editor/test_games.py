"""What can be drawn in each game, by each device, and what is said about it."""

from dataclasses import replace
from typing import Any

import pytest

from pigaming_app.games.arenas import load, shipped_arenas
from pigaming_app.games.drawing.values import drawing_of
from pigaming_app.games.factory.layout import PALLET
from pigaming_app.games.race.circuit import read_course
from pigaming_app.scenes.editor.checker import CheckResult
from pigaming_app.scenes.editor.games.factory import _slots
from pigaming_app.scenes.editor.model.shapes import Item
from pigaming_app.scenes.editor.model.symmetry import Symmetry
from pigaming_app.scenes.editor.parts.things import RADII
from pigaming_app.scenes.editor.play_test import PlayTest
from pigaming_app.scenes.editor.registry import EDITORS
from pigaming_app.scenes.editor.scene import Editor
from pigaming_app.scenes.editor.store import titled
from pigaming_app.sim.toml_table import TomlTable
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.input.events import Button
from tests.cases import one_in
from tests.scenes.editor.artist import Artist, Mouse, checked, verdict_of, wait_for
from tests.scenes.editor.test_keeping import empty

pytestmark = pytest.mark.usefixtures("home")


def opened(artist: Artist, game: str, arena: str = "") -> Editor:
    """The editor with an arena of ours, or an empty one."""
    drawing = drawing_of(load(game, arena).source) if arena else EDITORS[game].empty
    assert drawing
    artist.arcade.open(Editor(artist.arcade.context, game, "new-1", titled(drawing, "NEW")))
    return artist.editor


@pytest.mark.parametrize("artist", one_in(3, ["mouse", "keys", "pad"]), indirect=True)
def test_pitanks(artist: Artist) -> None:
    """Walls are drawn by two taps too, and have dials."""
    editor = opened(artist, "pitanks")
    bench = editor.bench
    artist.choose("mirror")
    artist.choose("mirror")
    assert bench.symmetry is Symmetry.TURN
    artist.click((500, 300))
    artist.click((500, 450))
    assert [wall.get("to") for wall in bench.history.now.of("wall")] == [(500, 450), (1100, 450)]
    for tile, key, value in (("dial 1", "thick", 40), ("dial 2", "health", 4), ("dial 0", "to", (481, 447))):
        artist.choose(tile)
        assert bench.history.now.of("wall")[0].get(key) == value
    one, other = bench.history.now.of("wall")
    assert other.get("to") == (1119, 453)
    assert (other.get("thick"), other.get("health")) == (40, 4)
    artist.choose("copy")
    assert len(bench.history.now.of("wall")) == 4
    artist.choose("delete")
    assert bench.history.now.of("wall") == (one, other)
    artist.choose("tool 1")
    artist.click((800, 200))
    artist.choose("tool 2")
    artist.click((800, 100))
    assert [part.get("solid") for part in bench.history.now.of("wall")[2:]] == [True, True]
    assert len(bench.history.now.of("thing")) == 2
    assert not verdict_of(artist).blocked


@pytest.mark.parametrize("artist", one_in(3, ["pad", "keys", "mouse"]), indirect=True)
def test_factory(artist: Artist) -> None:
    """A machine is moved and turned, and its image with it."""
    editor = opened(artist, "factory", "hall")
    bench = editor.bench
    artist.choose("mirror")
    artist.drag((525, 225), (525, 300))
    machines = bench.history.now.of("machine")
    assert [machine.get("at") for machine in machines] == [(525, 300), (1075, 300), (520, 684), (1080, 684)]
    artist.choose("dial 0")
    machines = bench.history.now.of("machine")
    assert [(one.get("flow"), one.get("worker")) for one in machines[:2]] == [("left", "down"), ("right", "down")]
    artist.choose("undo")
    artist.choose("undo")
    assert bench.history.now.of("machine") == drawing_of(load("factory", "hall").source).of("machine")
    artist.drag((75, 200), (150, 200))
    assert [one.get("at") for one in bench.history.now.of("warehouse")[::2]] == [(150, 100), (1450, 100)]
    artist.choose("undo")
    verdict = verdict_of(artist)
    assert not verdict.problems
    assert len(verdict.routes) == 6


@pytest.mark.parametrize("artist", one_in(3, ["keys", "pad", "mouse"]), indirect=True)
def test_race(artist: Artist) -> None:
    """Control points are added, dragged and deleted; arcs are as wide as they can be; lines stay on the road."""
    editor = opened(artist, "race")
    bench = editor.bench
    artist.click((900, 150))
    assert [one.get("at") for one in bench.history.now.of("corner")][1] == (900, 150)
    artist.drag((900, 150), (900, 300))
    corners: Any = bench.history.now.of("corner")
    assert corners[1].get("at") == (900, 300)
    assert all(one.get("radius") >= 90 for one in corners)
    read_course(TomlTable(bench.history.now.document()))
    artist.tap("x") if not isinstance(artist, Mouse) else artist.choose("delete")
    assert len(bench.history.now.of("corner")) == 4
    artist.choose("tool 1")
    artist.click((900, 150))
    assert [one.get("use") for one in bench.history.now.of("thing")] == ["mud"]
    verdict = verdict_of(artist)
    assert not verdict.problems
    assert len(verdict.routes[0]) > 300


@pytest.mark.parametrize("artist", one_in(3, ["mouse", "pad", "keys"]), indirect=True)
def test_football(artist: Artist) -> None:
    """Corners are cut, bumpers and drop points are set on all quarters, and a post takes all others with it."""
    editor = opened(artist, "football")
    bench = editor.bench
    for _ in range(3):
        artist.choose("mirror")
    assert editor.bench.symmetry is Symmetry.FOUR
    artist.choose("tool 2")
    artist.click((100, 50))
    ends: list[Any] = [{wall.get("from"), wall.get("to")} for wall in bench.history.now.of("wall")]
    assert ends[0] == {(0, 130), (130, 0)}
    for turn in (lambda x, y: (1600 - x, y), lambda x, y: (x, 900 - y), lambda x, y: (1600 - x, 900 - y)):
        assert {turn(*end) for end in ends[0]} in ends[1:]
    artist.choose("tool 1")
    artist.click((600, 300))
    assert len(bench.history.now.of("wall")) == 8
    artist.choose("tool 3")
    artist.click((600, 150))
    assert len(bench.history.now.of("drop")) == 12, "of thirteen"
    artist.choose("undo")
    artist.click((550, 450))
    assert {drop.get("at") for drop in bench.history.now.of("drop")[9:]} == {(550, 450), (1050, 450)}
    artist.choose("mirror")
    assert bench.symmetry is Symmetry.OFF
    artist.click((0, 400))
    artist.drag((0, 350), (0, 300))
    assert bench.history.now.of("goal")[0].get("width") == 300
    artist.choose("dial 0")
    assert bench.history.now.of("goal")[0].get("width") == 320
    for _ in range(6):
        artist.choose("undo")
    assert bench.history.now == empty("football")
    verdict = verdict_of(artist)
    assert not verdict.problems
    assert len(verdict.routes) == 6


def test_the_middle_and_the_last_six_drop_points_stay(mouse: Mouse) -> None:
    """Goals too: each is needed, and none is moved."""
    bench = opened(mouse, "football").bench
    assert Item("drop", 0) not in EDITORS["football"].items(bench.history.now)
    for at in ((400, 450), (1200, 450), (400, 200), (400, 700), (1200, 200), (0, 450)):
        mouse.click(at)
        mouse.choose("delete")
    drops, goals = (bench.history.now.of(kind) for kind in ("drop", "goal"))
    assert (drops[0].get("at"), len(drops), len(goals)) == ((800, 450), 6, 1)
    mouse.drag((10, 450), (400, 200))
    assert bench.history.now.of("goal") == goals


def test_a_line_follows_the_pointer_along_the_road(mouse: Mouse) -> None:
    bench = opened(mouse, "race").bench
    tools = EDITORS["race"]
    line = next(item for item in tools.items(bench.history.now) if item.kind == "line")
    at: Any = tools.part(bench.history.now, line).get("at")
    mouse.drag(at, (900, 60))
    at = tools.part(bench.history.now, line).get("at")
    x, y = at
    assert (abs(x - 900) < 12, abs(y - 150) < 2) == (True, True)


def test_problems_are_shown_where_they_are_and_block_the_match(mouse: Mouse) -> None:
    editor = opened(mouse, "pitanks")
    mouse.drag((100, 50), (200, 150))
    verdict = verdict_of(mouse)
    worst = verdict.problems[0]
    assert (worst.key, worst.x, worst.y, worst.blocks) == ("start[1]", 100, 100, True)
    assert editor.line[0] == editor.context.words("editor.problem_start")
    assert not editor.tiles["play"].live
    mouse.choose("play")
    assert mouse.arcade.stack.top is editor
    mouse.choose("undo")
    mouse.drag((500, 300), (700, 300))
    mouse.drag((500, 375), (700, 375))
    verdict = verdict_of(mouse)
    assert [(one.key, one.blocks) for one in verdict.problems] == [("wall[2]", False)]
    assert verdict.arena


def test_problems_are_found_while_a_part_is_in_hand(mouse: Mouse) -> None:
    bench = opened(mouse, "race").bench
    checked(mouse)
    mouse.go((150, 150))
    mouse.press("fire")
    mouse.arcade.frame()
    mouse.go((25, 25))
    wait_for(mouse.arcade, lambda: bool(bench.verdict and bench.verdict.blocked))
    assert bench.hand
    mouse.arcade.press(Button.BACK)
    assert not verdict_of(mouse).blocked


@pytest.mark.parametrize("button", [Button.BACK, Button.FIRE])
def test_a_match_that_is_awaited_is_shown_and_can_be_called_off(mouse: Mouse, button: Button) -> None:
    """The plan of a track takes a second."""
    editor = opened(mouse, "race")
    editor.bench.checker.end()
    checks = CheckResult(editor.bench.history.now, (), load("race", "classic"))
    editor.bench.checker.verdict = checks
    mouse.arcade.press(Button.START)
    mouse.arcade.frame()
    assert (editor.tiles["play"].on, editor.tiles["save"].on) == (True, False)
    mouse.arcade.press(button)
    assert not editor.tiles["play"].on
    editor.bench.checker.verdict = replace(checks, done=True)
    mouse.arcade.frame()
    assert mouse.arcade.stack.top is editor
    if button is Button.BACK:
        mouse.arcade.press(Button.START)
        assert isinstance(mouse.arcade.stack.top, PlayTest)


def test_a_course_over_itself_is_marked_at_the_crossing(mouse: Mouse) -> None:
    opened(mouse, "race")
    mouse.click((900, 150))
    mouse.drag((900, 150), (900, 750))
    problems = verdict_of(mouse).problems
    assert problems
    assert all(one.key == "corner" and 300 < one.y < 900 and one.blocks for one in problems)


@pytest.mark.parametrize("game", EDITORS)
def test_whole_parts_stay_in_the_arena(game: str) -> None:
    """Slots, people and robots too, wherever a part is moved, when it is turned there, and as an image."""
    tools = EDITORS[game]
    drawing = tools.empty or drawing_of(load(game, tools.template).source)
    for item in tools.items(drawing):
        shape, part = tools.shapes[item.kind], tools.part(drawing, item)
        for dx, dy in ((-WIDTH, -HEIGHT), (WIDTH, -HEIGHT), (-WIDTH, HEIGHT), (WIDTH, HEIGHT)):
            moved = shape.moved(part, dx, dy)
            for turned in (moved, *(dial.turned(moved) for dial in shape.dials(moved))):
                for one in (turned, *(shape.image(turned, image) for image in Symmetry.FOUR.images)):
                    assert all(0 <= x <= WIDTH and 0 <= y <= HEIGHT for x, y in shape.reach(one))


def test_a_machine_in_a_corner_can_be_played(mouse: Mouse) -> None:
    """Its slots are then not at the rim, neither after a turn."""
    bench = opened(mouse, "factory", "yard").bench
    at: Any = bench.history.now.of("machine")[0].get("at")
    mouse.drag(at, (at[0], 0))
    for _ in range(4):
        mouse.choose("dial 0")
        slots = _slots(bench.history.now.of("machine")[0])
        assert all(PALLET <= slot.x <= WIDTH - PALLET and PALLET <= slot.y <= HEIGHT - PALLET for slot in slots)
    assert not verdict_of(mouse).blocked


def test_a_tool_without_room_for_more_is_dim(mouse: Mouse) -> None:
    editor = opened(mouse, "factory", "hall")
    shared = editor.bench.history.now.of("shared")
    assert not editor.tiles["tool 1"].live
    mouse.choose("tool 1")
    assert editor.bench.tool == 0
    at: Any = shared[0].get("at")
    mouse.click(at)
    mouse.choose("delete")
    mouse.choose("tool 1")
    mouse.click((300, 450))
    assert editor.bench.history.now.of("shared") == (*shared[1:], shared[0].changed("at", (300, 450)))
    assert not editor.tiles["tool 1"].live


def test_mud_has_a_largest_size(mouse: Mouse) -> None:
    bench = opened(mouse, "race").bench
    mouse.choose("tool 1")
    mouse.drag((800, 450), (1400, 450))
    outline: Any = bench.history.now.of("thing")[0].get("outline")
    assert max(x for x, _ in outline) == 800 + RADII[-1]


@pytest.mark.parametrize("game", EDITORS)
def test_our_arenas_can_be_opened_and_are_as_they_were(game: str) -> None:
    """Every part of them is an item that can be pointed at, and its own image's image."""
    tools = EDITORS[game]
    for name in shipped_arenas(game):
        drawing = drawing_of(load(game, name).source)
        items = tools.items(drawing)
        kinds = {part.kind for part in drawing.parts} - {"title", "track", "floor"}
        assert kinds <= {item.kind for item in items}
        assert tools.settled(drawing, drawing) == drawing
        for item in items:
            shape, part = tools.shapes[item.kind], tools.part(drawing, item)
            assert item.kind == "line" or shape.moved(part, 0.0, 0.0) == part
            for symmetry in Symmetry:
                for image in symmetry.images:
                    assert shape.same(shape.image(shape.image(part, image), image), part)
