"""Printed arenas, as PDFium renders them: put together by their cut marks they are the arena, to scale."""

import tomllib
from math import hypot

import numpy as np
import pytest

pytest.importorskip("cv2")
pytest.importorskip("pypdfium2")

from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.registry import games
from pigaming_app.hardware.calibration.floor_surface import FloorSurface
from pigaming_app.jobs.cli import main
from pigaming_app.jobs.mat.calibrate.floor import chosen_arenas, write
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.scenes.mat.paper.floor_sheet import tiles
from pigaming_app.storage.settings import folders
from pigaming_app.ui.i18n import LANGUAGES, Words
from tests.cases import one_in
from tests.scenes.mat.paper.rendered import found, pictures, sizes, texts

PER_MM = 3.0
SURFACE = FloorSurface(1600.0, 1000.0)
MM = 1600.0 / 1920.0  # of an arena px there: its height would allow more
IDS = 10, 11, 12, 13, 14, 15, 18
CORNERS = (-80.5, -56.5), (1679.5, -56.5), (1679.5, 855.5), (-80.5, 855.5)  # arena px: as the projector shows them
MARKERS = (*CORNERS, (-80.5, 399.5), (799.5, -70.5), (1679.5, 399.5))
EVERY = [(game, name) for game in games() for name in arenas(game)]


def printed(tmp_path, chosen, paper, language="en", surface=SURFACE):
    target = tmp_path / "floor.pdf"
    write(target, surface, chosen_arenas(chosen), paper, language)
    return target.read_bytes()


def middle(dark):
    """The only run of dark px in a line, its middle."""
    at = np.flatnonzero(dark)
    assert len(at)
    assert at[-1] - at[0] < PER_MM
    return round(at.mean() + 0.5)


def cut(page):
    """Left, top, right and bottom of a page between its cut marks, px: lines that cross its rim 6 to 9 mm within."""
    high, wide = page.shape
    rim = slice(round(6.0 * PER_MM), round(9.0 * PER_MM))
    upright, level = (page[rim] < 230).all(axis=0), (page[:, rim] < 230).all(axis=1)
    left, top = middle(upright[: wide // 2]), middle(level[: high // 2])
    return left, top, wide // 2 + middle(upright[wide // 2 :]), high // 2 + middle(level[high // 2 :])


def put_together(pages, columns):
    """Pages laid row by row: each lies on the tabs of those before, and its own tabs are below the next."""
    rows = []
    for begin in range(0, len(pages), columns):
        boxes = [(page, cut(page)) for page in pages[begin : begin + columns]]
        rows.append(np.hstack([page[top:bottom, left:right] for page, (left, top, right, bottom) in boxes]))
    return np.vstack(rows)


def markers_of(picture, per_mm=PER_MM):
    """Middles of the markers, mm, (7, 2)."""
    marks = found(picture, per_mm)
    assert set(marks) == set(IDS)
    return np.array([marks[number].mean(axis=0) for number in IDS])


@pytest.mark.parametrize("paper", ["A4", "A3"])
def test_put_together_by_their_cut_marks_the_pages_are_the_arena(tmp_path, paper):
    pdf = printed(tmp_path, "pitanks/classic", paper)
    names = [tile.name for tile in tiles(SURFACE, paper)[1]]
    columns = sum(name.startswith("A") for name in names)
    pages = list(pictures(pdf, PER_MM))[1:]
    assert len(pages) == len(names)
    floor = put_together(pages, columns)

    seen, true = markers_of(floor), np.array(MARKERS) * MM
    shift = (seen - true).mean(axis=0)  # where the arena's corner lies
    assert np.abs(seen - true - shift).max() < 0.5

    walls = tomllib.loads(load("pitanks", "classic").source)["wall"]
    assert len(walls) == 10
    for wall in walls:
        a, b = np.array(wall["from"]) * MM, np.array(wall["to"]) * MM
        along, half = (b - a) / hypot(*(b - a)), wall.get("thick", 30) / 2 * MM
        across = np.array((-along[1], along[0]))
        for share in (0.1, 0.37, 0.5, 0.9):
            for side in (-1.0, 1.0):
                steps = np.arange(0.0, half + 4.0, 0.05)
                line = shift + a + share * (b - a) + side * steps[:, None] * across
                x, y = np.floor(line * PER_MM).astype(int).T
                inked = steps[floor[y, x] < 200]
                assert inked.max() == pytest.approx(half, abs=0.5)
    rim = np.array([(800.0, 0.0), (1600.0, 450.0), (800.0, 900.0), (0.0, 450.0)]) * MM + shift
    for x, y in (rim * PER_MM).astype(int):
        assert floor[y, x] < 100


def inks(picture, origin, points, per_mm, reach=1):
    """The darkest px within `reach` around each point, arena px."""
    at = np.floor((np.array(points) * MM + origin) * per_mm).astype(int)
    return np.array([picture[y - reach : y + reach + 1, x - reach : x + reach + 1].min() for x, y in at])


def outlines(arena):
    """Points on what must be printed of an arena, arena px: walls, edges of a track, warehouses."""
    yield from (((wall.ax + wall.bx) / 2, (wall.ay + wall.by) / 2) for wall in arena.walls)
    table = tomllib.loads(arena.source)
    if course := getattr(arena.plan, "course", None):
        for k in range(0, course.count, 8):
            x, y, after = course.xs[k], course.ys[k], (k + 1) % course.count
            ahead = np.array((course.xs[after] - course.xs[k - 1], course.ys[after] - course.ys[k - 1]))
            out = np.array((-ahead[1], ahead[0])) / hypot(*ahead) * course.half[k]
            yield from ((x + side * out[0], y + side * out[1]) for side in (-1, 1))
    for entry in table.get("warehouse", ()):
        yield from ((entry["at"][0] + side, entry["at"][1] + 60.0) for side in (-54.0, 54.0))
    if "goal" in table:
        yield from ((x, 450.0 + side * table["goal"]["width"] / 2) for x in (0.0, 1600.0) for side in (-1, 1))


@pytest.mark.parametrize(("game", "name"), one_in(3, EVERY))
def test_every_arena_is_a_poster_with_little_ink_and_the_markers_in_the_corners(game, name, tmp_path):
    pdf, per_mm = printed(tmp_path, f"{game}/{name}", "mat"), 1.5
    assert sizes(pdf) == [pytest.approx((1600.0, 1000.0), abs=0.05)]
    (picture,) = pictures(pdf, per_mm)
    seen, true = markers_of(picture, per_mm), np.array(MARKERS) * MM
    origin = np.array(((1600.0 - 1920.0 * MM) / 2 + 160.5 * MM, (1000.0 - 1080.0 * MM) / 2 + 140.5 * MM))
    assert np.abs(seen - true - origin).max() < 0.5
    points = list(outlines(load(game, name)))
    assert len(points) >= 4
    assert inks(picture, origin, points, per_mm).max() < 240
    assert (1.0 - picture / 255.0).mean() < 0.10
    rim = np.concatenate([picture[:, :4].ravel(), picture[:, -4:].ravel(), picture[:4].ravel()])
    assert rim.min() == 255
    (text,) = texts(pdf)
    assert load(game, name).title["en"] in text
    assert "print at 100 %" in text


def test_a_bar_is_ten_centimetres_on_every_page(tmp_path):
    for page in pictures(printed(tmp_path, "race/kidney", "A4"), 6.0):
        lines = np.flatnonzero([longest(row < 160) > 500 for row in page[round(page.shape[0] * 0.94) :]])
        assert len(lines)
        row = page[round(page.shape[0] * 0.94) + lines[0]]
        assert longest(row < 160) / 6.0 == pytest.approx(100.0, abs=0.4)


def longest(dark):
    """The length of the longest run, px."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], dark.astype(int), [0]])))
    return int((edges[1::2] - edges[::2]).max(initial=0))


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_first_page_names_all_pages_and_says_in_each_language_what_to_do(language, tmp_path):
    first, *pages = texts(printed(tmp_path, "factory/hall", "A3", language))
    names = [tile.name for tile in tiles(SURFACE, "A3")[1]]
    assert [name for name, page in zip(names, pages, strict=True) if name not in page] == []
    assert all(name in first for name in names)
    words, plain = Words(language), " ".join(first.split())
    for key in ("floor_print", "floor_cut", "floor_join", "floor_lay", "floor_measure", "bar"):
        assert " ".join(words(f"sheet.{key}", width=1333, height=750).split()) in plain


@pytest.mark.usefixtures("home")
def test_a_drawing_of_the_user_is_printed_as_well(tmp_path):
    folder = folders().data / "arenas" / "pitanks"
    folder.mkdir(parents=True)
    (folder / "mine.toml").write_text(load("pitanks", "islands").source, encoding="utf-8")
    assert texts(printed(tmp_path, "mine", "mat"))[0].startswith("PiTanks: Islands")
    assert len(texts(printed(tmp_path, None, "mat"))) == len(EVERY) + 1


def test_a_surface_too_small_for_the_robots_is_refused_with_the_smallest(capsys, tmp_path):
    job = ["calibrate", "--print", str(tmp_path / "a.pdf"), "--arena", "islands"]
    assert main([*job, "--size", "0.93x0.6"]) == 2
    assert "0.93x0.6 m is too small for robots of 95 mm: the smallest is 0.95x0.53" in capsys.readouterr().err
    assert main([*job, "--size", "0.95x0.54"]) == 0
    assert f"the field {0.95 / 1.2 * 1000:.0f} x" in capsys.readouterr().out


@pytest.mark.parametrize("size", ["1.5x0.9", "0,9X1,5"])
def test_arenas_that_are_too_tight_for_the_robots_are_left_out_and_named(capsys, tmp_path, size):
    """A 3pi is 61 px in radius on a field of 1250 mm; classic takes 59, labyrinth less."""
    assert main(["calibrate", "--print", str(tmp_path / "a.pdf"), "--size", size]) == 0
    pdf = (tmp_path / "a.pdf").read_bytes()
    titles = [page.partition("\r")[0] for page in texts(pdf)]
    assert {title for title in titles if title.startswith("PiTanks")} == {"PiTanks: Islands", "PiTanks: Trenches"}
    assert {(round(wide), round(high)) for wide, high in sizes(pdf)} == {(1500, 900)}, "lying, however it is named"
    (left_out,) = (line for line in capsys.readouterr().out.splitlines() if line.startswith("left out"))
    named = left_out.partition(": ")[2].split(", ")
    assert {"pitanks/classic", "pitanks/labyrinth"} <= {*named}
    assert len(named) + len(titles) == len(EVERY)


@pytest.mark.parametrize(
    ("chosen", "paper", "reason"),
    [("classic", "mat", "several games"), ("nowhere", "mat", "no arena 'nowhere'"), (None, "A4", "on A4 one arena")],
)
def test_what_cannot_be_printed_is_refused(chosen, paper, reason, tmp_path):
    with pytest.raises(Refusal, match=reason):
        printed(tmp_path, chosen, paper)
