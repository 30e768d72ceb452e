"""Nothing that was drawn is lost: undo, drafts, full disks, damaged files; the arenas of the gallery, and names."""

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
from pigaming_app.scenes.editor.toolbar import NAMES, RIGHT_COLUMN, W, box
from pigaming_app.scenes.lobby.dealt import start_positions
from pigaming_app.scenes.lobby.match_setup import PICTURE, MatchSetupPage
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.ui.i18n import LANGUAGES, texts
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent
from tests.cases import one_in
from tests.disks import room_for
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.editor.artist import Mouse, checked, verdict_of, wait_for
from tests.scenes.measuring import SAFE, measuring
from tests.scenes.screens import seats

pytestmark = pytest.mark.usefixtures("home")


def empty(game: str) -> Drawing:
    tools = EDITORS[game]
    return store.titled(tools.empty or drawing_of(load(game, tools.template).source), "NEW")


def verdict_on(game: str, drawing: Drawing) -> CheckResult:
    """The whole verdict, in this thread."""
    checker = Checker(EDITORS[game], "new-1")
    checker._asked, checker._planner.give = drawing, checker._plan  # type: ignore[assignment, method-assign]
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
    assert len({str(wall.get("from")).split(", ")[1] for wall in found.of("wall")}) == 1


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


@pytest.mark.parametrize("game", one_in(4, EDITORS))
def test_a_damaged_draft_is_left_out_or_can_be_mended(mouse: Mouse, game: str) -> None:
    store.drafts_folder(game).mkdir(parents=True)
    for i, text in enumerate(DAMAGED):
        store.draft_file(game, f"odd-{i}").write_text(text)
    gallery = mouse.arcade.open(Gallery(mouse.arcade.context, game))
    gallery.draw(mouse.arcade.screen)
    odd = [card for card in gallery.cards if card.own]
    assert len(odd) == len(DAMAGED) - 2, "no TOML, no tables"
    for card in odd:
        mouse.arcade.stack.apply(card.open())
        mouse.arcade.shown(DrawingPage)
        mouse.arcade.press(Button.FIRE)
        editor = checked(mouse)
        assert verdict_of(mouse).blocked
        mouse.arcade.press(Button.START)
        assert mouse.arcade.stack.top is editor
        mouse.arcade.press(Button.BACK, Button.BACK)


@pytest.mark.parametrize("game", one_in(2, EDITORS))
def test_a_surprise_draws_itself(mouse: Mouse, game: str) -> None:
    mouse.arcade.open(Gallery(mouse.arcade.context, game))
    mouse.arcade.press(Button.RIGHT, Button.FIRE)
    wait_for(mouse.arcade, lambda: isinstance(mouse.arcade.stack.top, Editor))
    editor = mouse.editor
    shown = []
    for _ in range(4):
        shown.append(editor.reveal)
        mouse.arcade.wait(0.5)
        editor.draw(mouse.arcade.screen)
    assert shown[0] > shown[1] > shown[2] > 0.0
    assert not verdict_of(mouse).blocked
    assert store.is_draft(game, "new-1"), "it could not be made again"


def test_an_arena_is_played_renamed_shared_and_deleted(mouse: Mouse, home: Path) -> None:
    arcade = mouse.arcade
    store.save("race", "mine", store.titled(drawing_of(load("race", "classic").source), "MINE"), "new-1")
    arcade.open(Gallery(arcade.context, "race"))
    arcade.press(Button.RIGHT, Button.RIGHT, Button.FIRE)
    page = arcade.shown(DrawingPage)
    arcade.press(Button.DOWN, Button.FIRE)
    assert arcade.shown(PlayTest).match.arena.name == "mine"
    arcade.press(Button.START, Button.DOWN, Button.FIRE)
    naming = arcade.shown(ArenaNamePage)
    arcade.wait(0.5)
    arcade.press(Button.UP, Button.START)
    assert arcade.stack.top is page
    assert page.name == store.file_name(naming.name) != "mine"
    assert own_arenas("race") == [page.name]
    arcade.press(Button.DOWN, Button.FIRE)
    (shared,) = (home / "data" / "shared").glob("*.toml")
    assert shared.read_text() == load("race", page.name).source
    assert str(shared) in page.message
    arcade.press(Button.DOWN, Button.FIRE)
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
    naming = mouse.arcade.open(ArenaNamePage(mouse.arcade.context, "pitanks", "new-1", name, lambda name: None))
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
    drawing = drawing_of(games()[game].surprise(987_654))  # type: ignore[misc]
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


OWN = ("pitanks", "race", "factory")


@pytest.mark.parametrize("game", OWN)
def test_every_tile_is_named_with_the_focus_and_under_the_mouse(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, game: str
) -> None:
    drawing = drawing_of(load(game, shipped_arenas(game)[0]).source)
    scene = Editor(arcade.context, game, "new-1", drawing)
    scene.bench.close()
    seen: dict[str, str] = {}
    with measuring(monkeypatch) as screen:

        def beside(tile: pygame.Rect) -> list[str]:
            """The texts at the height of a tile, right of the bar."""
            screen.marks.clear()
            scene.draw(screen)
            marks = [mark for mark in screen.texts if mark.box[0] > RIGHT_COLUMN + W and SAFE.right > mark.box[2]]
            return [mark.text for mark in marks if abs(mark.box[1] + mark.box[3] - 2 * tile.centery) < 6]

        for item in scene.tools.items(drawing):
            scene.bench.selected = item
            for name, tile in scene.tiles.items():
                if tile.icon in seen:
                    continue
                at = box(NAMES.index(name))
                assert beside(at) == []
                scene.handle(InputEvent(Button.POINT, Device("mouse"), at=at.center))
                (seen[tile.icon],) = beside(at)
                scene.handle(InputEvent(Button.FOUND, KEYS[0]))
                assert beside(at) == []
                scene.bar.open = True
                scene.bar.focus.move_to(name)
                assert beside(at) == [seen[tile.icon]]
                scene.bar.open = False
    assert len(seen) > 10
    assert len({*seen.values()}) == len(seen)
    assert all({f"editor.tool_{icon}" for icon in seen} <= texts(language).keys() for language in LANGUAGES)


@pytest.mark.parametrize("language", ["fr", "de"])
@pytest.mark.parametrize("game", list(EDITORS))
def test_an_empty_name_proposes_a_free_one(
    controls: Controls, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, game: str, language: str
) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    arcade, entered = Arcade(controls, language), list[str]()
    drawing = drawing_of(load(game, shipped_arenas(game)[0]).source)
    for number in (1, 2):
        page = arcade.open(ArenaNamePage(arcade.context, game, f"new-{number}", "", entered.append))
        arcade.wait(0.5)
        proposed = page.name
        assert proposed.endswith(f" {number}")
        assert page.is_possible(proposed)
        page.spell("")
        arcade.press(Button.START)
        assert (page.name, entered, page.unusable) == (proposed, entered[: number - 1], False)
        arcade.press(Button.START)
        assert entered[number - 1] == proposed
        write_atomic(store.draft_file(game, store.file_name(proposed)), drawing.text().encode())
    assert len({*entered}) == 2


def test_a_title_that_letters_cannot_spell_gets_a_proposal(controls: Controls) -> None:
    context = Arcade(controls).context
    assert ArenaNamePage(context, "race", "x", "Circuit", lambda name: None).name == "CIRCUIT"
    assert ArenaNamePage(context, "race", "x", "Überhang", lambda name: None).name == "TRACK 1"
