"""Nothing that was drawn is lost: undo, drafts, full disks, damaged files; and the arenas of the gallery."""

import signal
import subprocess
import sys
import time
from pathlib import Path
from random import Random

import pygame
import pytest

from pigaming_app.games.arenas import load, own_arenas, shipped_arenas
from pigaming_app.games.drawing.values import Drawing, drawing_of
from pigaming_app.games.registry import games
from pigaming_app.scenes.editor import store
from pigaming_app.scenes.editor.checker import Checker, CheckResult
from pigaming_app.scenes.editor.gallery.drawing_page import DrawingPage
from pigaming_app.scenes.editor.gallery.page import Gallery
from pigaming_app.scenes.editor.model.edits import placed, removed, replaced
from pigaming_app.scenes.editor.model.history import History
from pigaming_app.scenes.editor.model.symmetry import Symmetry
from pigaming_app.scenes.editor.naming import ArenaNamePage
from pigaming_app.scenes.editor.play_test import PlayTest
from pigaming_app.scenes.editor.registry import EDITORS
from pigaming_app.scenes.editor.scene import Editor
from pigaming_app.scenes.lobby.match_setup import PICTURE, MatchSetupPage, start_positions
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from tests.cases import one_in
from tests.disks import room_for
from tests.scenes.arcade import Arcade
from tests.scenes.editor.artist import Mouse, checked, wait_for
from tests.scenes.screens import seats

pytestmark = pytest.mark.usefixtures("home")


@pytest.fixture
def mouse(controls: Controls) -> Mouse:
    return Mouse(Arcade(controls))


def empty(game: str) -> Drawing:
    tools = EDITORS[game]
    return store.titled(tools.empty or drawing_of(load(game, tools.template).source), "NEW")


def verdict_on(game: str, drawing: Drawing) -> CheckResult:
    """The whole verdict, in this thread."""
    checker = Checker(EDITORS[game], "new-1")
    checker._asked, checker._planner.give = drawing, checker._plan  # type: ignore[method-assign]
    checker._find((drawing, True))
    assert checker.verdict
    return checker.verdict


def random_edit(game: str, drawing: Drawing, random: Random) -> Drawing:
    """Another part, one less, or one that is moved, dragged at a grip, or turned."""
    tools, symmetry = EDITORS[game], random.choice(list(Symmetry))
    a, b = ((random.uniform(-50, 1650), random.uniform(-50, 950)) for _ in range(2))
    kind = random.randrange(5)
    if kind == 0:
        return placed(tools, drawing, random.choice(tools.palette), a, b, symmetry)[0]
    item = random.choice(tools.items(drawing))
    shape, part = tools.shapes[item.kind], tools.part(drawing, item)
    if kind == 1:
        return removed(tools, drawing, item, symmetry) or drawing
    if kind == 2:
        part = shape.moved(part, random.uniform(-300, 300), random.uniform(-300, 300))
    elif kind == 3:
        part = shape.pulled(part, random.randrange(len(shape.grips(part))), *b)
    elif dials := shape.dials(part):
        part = random.choice(list(dials)).turned(part)
    return replaced(tools, drawing, item, part, symmetry)[0]


@pytest.mark.parametrize("game", EDITORS)
def test_every_edit_can_be_undone_and_redone_and_written(game: str) -> None:
    """Any edits leave drawings that are files, and that all checks bear."""
    random = Random(game)
    history = History(empty(game))
    drawings = [history.now]
    for _ in range(120):
        if history.push(random_edit(game, history.now, random)):
            drawings.append(history.now)
            assert drawing_of(history.now.text()) == history.now
    assert len(drawings) > 60
    for drawing in reversed(drawings[:-1]):
        assert history.undo()
        assert history.now == drawing
    assert not history.undo()
    for drawing in drawings[1:]:
        assert history.redo()
        assert history.now == drawing
    assert not history.redo()
    for drawing in drawings[::20]:
        assert verdict_on(game, drawing).done


DAMAGED = (
    "",
    "\0",
    "wall = 3",
    "title = {en = \"a\\u0007\"}\n[[wall]]\nfrom = 'x'\nthick = 1e300\nhealth = -9\n",
    "[[start]]\nat = [1e300, nan]\nheading = inf\n" * 9,
    "[track]\nlines = [nan, 9, 'x', 0]\n[[corner]]\nat = [1, 1]\nwidth = 1e300\nradius = nan\n",
    "[[corner]]\nat = [800, 450]\n" * 5,
    "[aisle]\nsize = [1e300, -1]\n[[machine]]\nflow = 3\n[[warehouse]]\nteam = 'x'\n[[thing]]\noutline = [[1], 2]\n",
    "[[wall]]\nfrom = [1, 1]\nto = [9, 9]\n" * 2000,
)
WRITER = """
import sys
from pathlib import Path
from pigaming_app.games.drawing.values import Drawing, Part
from pigaming_app.scenes.editor.store import Autosave
autosave = Autosave(Path(sys.argv[1]))
for k in range(10 ** 6):
    autosave.write(Drawing(tuple(Part("wall", (("from", (i, k)),)) for i in range(400))))
    autosave.finish()
"""


def test_a_killed_program_leaves_a_whole_draft(home: Path) -> None:
    path = store.draft_file("pitanks", "new-1")
    with subprocess.Popen([sys.executable, "-c", WRITER, str(path)]) as writer:
        end = time.monotonic() + 30.0
        while not path.exists():
            assert time.monotonic() < end
            time.sleep(0.01)
        time.sleep(0.05)
        writer.send_signal(signal.SIGKILL)
    found = store.opened("pitanks", "new-1")
    assert found
    assert len(found.of("wall")) == 400
    assert len({str(wall.get("from")[1]) for wall in found.of("wall")}) == 1


def test_a_draft_is_there_again_after_the_program_has_ended(mouse: Mouse) -> None:
    mouse.arcade.open(Editor(mouse.arcade.context, "pitanks", "new-1", empty("pitanks")))
    mouse.drag((500, 300), (700, 300))
    editor = checked(mouse)
    assert store.opened("pitanks", "new-1") == editor.bench.history.now
    gallery = Gallery(mouse.arcade.context, "pitanks")
    assert [card.sign for card in gallery.cards if card.own] == ["pencil"]


def test_a_full_disk_is_one_sentence_and_the_drawing_stays(mouse: Mouse) -> None:
    mouse.arcade.open(Editor(mouse.arcade.context, "pitanks", "new-1", empty("pitanks")))
    editor = mouse.editor
    with room_for(10):
        for y in (200, 400, 600):
            mouse.drag((500, y), (700, y))
            checked(mouse)
            mouse.arcade.frame()
        assert mouse.arcade.sounds.heard.count("error") == 1
        assert editor.message == editor.context.words("editor.disk")
        assert store.opened("pitanks", "new-1") is None
        editor.save_as("MINE")
        assert editor.bench.name == "new-1"
        assert own_arenas("pitanks") == []
    assert len(editor.bench.history.now.of("wall")) == 3
    mouse.drag((1000, 200), (1200, 200))
    checked(mouse)
    assert store.opened("pitanks", "new-1") == editor.bench.history.now
    editor.save_as("MINE")
    assert own_arenas("pitanks") == ["mine"]


@pytest.mark.parametrize("game", one_in(3, EDITORS))
def test_a_damaged_draft_is_left_out_or_can_be_mended(mouse: Mouse, game: str) -> None:
    store.drafts_folder(game).mkdir(parents=True)
    for i, text in enumerate(DAMAGED):
        store.draft_file(game, f"odd-{i}").write_text(text)
    gallery = Gallery(mouse.arcade.context, game)
    mouse.arcade.open(gallery)
    gallery.draw(mouse.arcade.screen)
    odd = [card for card in gallery.cards if card.own]
    assert len(odd) == len(DAMAGED) - 2, "no TOML, no tables"
    for card in odd:
        mouse.arcade.stack.apply(card.open())
        mouse.arcade.shown(DrawingPage)
        mouse.arcade.press(Button.FIRE)
        editor = checked(mouse)
        assert editor.bench.verdict.blocked
        mouse.arcade.press(Button.START)
        assert mouse.arcade.stack.top is editor
        mouse.arcade.press(Button.BACK)
        mouse.arcade.press(Button.BACK)


@pytest.mark.parametrize("game", EDITORS)
def test_a_surprise_draws_itself(mouse: Mouse, game: str) -> None:
    mouse.arcade.open(Gallery(mouse.arcade.context, game))
    mouse.arcade.press(Button.RIGHT)
    mouse.arcade.press(Button.FIRE)
    wait_for(mouse.arcade, lambda: isinstance(mouse.arcade.stack.top, Editor))
    editor = mouse.editor
    shown = []
    for _ in range(4):
        shown.append(editor.reveal)
        mouse.arcade.wait(0.5)
        editor.draw(mouse.arcade.screen)
    assert shown[0] > shown[1] > shown[2] > 0.0
    assert not checked(mouse).bench.verdict.blocked
    assert store.is_draft(game, "new-1"), "it could not be made again"


def test_an_arena_is_played_renamed_shared_and_deleted(mouse: Mouse, home: Path) -> None:
    arcade = mouse.arcade
    store.save("race", "mine", store.titled(drawing_of(load("race", "classic").source), "MINE"), "new-1")
    arcade.open(Gallery(arcade.context, "race"))
    for _ in range(2):
        arcade.press(Button.RIGHT)
    arcade.press(Button.FIRE)
    page = arcade.shown(DrawingPage)
    arcade.press(Button.DOWN)
    arcade.press(Button.FIRE)
    assert arcade.shown(PlayTest).match.arena.name == "mine"
    arcade.press(Button.START)
    arcade.press(Button.DOWN)
    arcade.press(Button.FIRE)
    naming = arcade.shown(ArenaNamePage)
    arcade.wait(0.5)
    arcade.press(Button.UP)
    arcade.press(Button.START)
    assert arcade.stack.top is page
    assert page.name == store.file_name(naming.name) != "mine"
    assert own_arenas("race") == [page.name]
    arcade.press(Button.DOWN)
    arcade.press(Button.FIRE)
    (shared,) = (home / "data" / "shared").glob("*.toml")
    assert shared.read_text() == load("race", page.name).source
    assert str(shared) in page.message
    arcade.press(Button.DOWN)
    arcade.press(Button.FIRE)
    assert own_arenas("race")
    arcade.press(Button.FIRE)
    assert own_arenas("race") == []
    assert len(arcade.shown(Gallery).cards) == 2 + len(shipped_arenas("race"))


def test_in_a_kiosk_nothing_is_deleted_or_replaced(mouse: Mouse) -> None:
    mouse.arcade.context.kiosk = True
    store.save("race", "mine", store.titled(drawing_of(load("race", "classic").source), "MINE"), "new-1")
    assert [spot.name for spot in DrawingPage(mouse.arcade.context, "race", "mine").focus.spots] == ["edit", "play"]
    naming = ArenaNamePage(mouse.arcade.context, "race", "new-1", "MINE", lambda name: None)
    assert not naming.is_possible("MINE")
    assert naming.is_possible("OURS")
    mouse.arcade.context.kiosk = False
    assert naming.is_possible("MINE"), "a second press replaces it"


@pytest.mark.parametrize("name", ["CLASSIC", "NEW 3", "CON"])
def test_a_name_that_cannot_be_used_is_one_sentence_until_it_is_changed(mouse: Mouse, name: str) -> None:
    naming = ArenaNamePage(mouse.arcade.context, "pitanks", "new-1", name, lambda name: None)
    mouse.arcade.open(naming)
    mouse.arcade.wait(0.5)
    mouse.arcade.press(Button.START)
    assert mouse.arcade.shown(ArenaNamePage) is naming
    assert naming._hint()[0] == mouse.arcade.context.words("lab.unusable")
    mouse.arcade.press(Button.UP)
    assert naming._hint()[0] == mouse.arcade.context.words("lab.name_how")


def test_a_new_name_never_mixes_two_drawings(mouse: Mouse) -> None:
    one, other = empty("pitanks"), drawing_of(load("pitanks", "islands").source)
    store.save("pitanks", "one", store.titled(one, "ONE"), "new-1")
    store.save("pitanks", "other", store.titled(other, "OTHER"), "new-1")
    store.Autosave(store.draft_file("pitanks", "other")).write(other)
    wait_for(mouse.arcade, lambda: store.is_draft("pitanks", "other"))
    assert store.rename("pitanks", "one", "OTHER") == "other"
    assert store.own_names("pitanks") == ["other"]
    assert store.opened("pitanks", "other") == store.titled(one, "OTHER")


@pytest.mark.parametrize("game", EDITORS)
def test_plans_of_ais_take_less_than_two_seconds_and_a_frame_never_waits(game: str) -> None:
    """Processor time, on an arena that no cache knows."""
    drawing = drawing_of(games()[game].surprise(987_654))
    begin = time.thread_time()
    assert verdict_on(game, drawing).routes
    assert time.thread_time() - begin < 2.0
    checker = Checker(EDITORS[game], "new-1")
    begin = time.thread_time()
    checker.check(drawing)
    assert time.thread_time() - begin < 0.01
    checker.end()


def test_the_lobby_shows_an_arena_as_it_was_saved_last(mouse: Mouse) -> None:
    store.save("pitanks", "mine", store.titled(empty("pitanks"), "MINE"), "new-1")
    mouse.arcade.context.settings.choice("pitanks").arena = "mine"
    page, screen = MatchSetupPage(mouse.arcade.context, "pitanks", seats("pitanks")), mouse.arcade.screen
    pictures, starts = [], []
    for name in ("islands", "labyrinth"):
        store.save("pitanks", "mine", store.titled(drawing_of(load("pitanks", name).source), "MINE"), "mine")
        mouse.arcade.stack.scenes.append(page)
        page.on_enter()
        page.draw(screen)
        pictures.append(pygame.image.tobytes(screen.subsurface(PICTURE), "RGB"))
        starts.append(start_positions(page._setup()))
    assert pictures[0] != pictures[1]
    assert starts[0] != starts[1]
