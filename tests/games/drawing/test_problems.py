"""Problems of drawings: none in arenas that can be played, and each with its place."""

from math import hypot
from time import process_time

import pytest

from pigaming_app.games.arenas import load, parse, shipped_arenas
from pigaming_app.games.drawing.values import Drawing, Part, drawing_of
from pigaming_app.games.race.circuit import examined
from pigaming_app.games.registry import games
from pigaming_app.scenes.editor.model.problems import Problem
from pigaming_app.scenes.editor.model.problems import problems as problems_of
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.world import HEIGHT, WIDTH
from tests.hostile import VALUES

GAMES = tuple(games())
SHIPPED = [(game, name) for game in GAMES for name in shipped_arenas(game)]
LIMIT = 0.05  # s of processor time
FLAT = '[title]\nen = "a"\npt = "a"\n' + "".join(
    f"[[start]]\nat = [{x}, {y}]\n" for x in (100, 1500) for y in (100, 800)
)


def problems(game: str, drawing: Drawing) -> list[Problem]:
    return problems_of(games()[game], drawing)


def drawn(game: str, name: str) -> Drawing:
    return drawing_of(load(game, name).source)


def with_entry(drawing: Drawing, kind: str, k: int, key: str, value: object) -> Drawing:
    return drawing.changed(kind, k, drawing.of(kind)[k].changed(key, value))  # type: ignore[arg-type]


def wall(a: tuple[int, int], b: tuple[int, int], thick: int = 30) -> Part:
    return Part("wall", (("from", a), ("to", b), ("thick", thick)))


def is_playable(game: str, drawing: Drawing) -> bool:
    try:
        parse(game, drawing.text(), "a.toml")
    except ArenaError:
        return False
    return True


@pytest.mark.parametrize(("game", "name"), SHIPPED)
def test_shipped_arenas_have_none(game: str, name: str) -> None:
    assert not [problem for problem in problems(game, drawn(game, name)) if problem.blocks]


@pytest.mark.parametrize(("game", "name"), SHIPPED)
def test_they_are_found_while_somebody_draws(game: str, name: str) -> None:
    drawing = drawn(game, name)

    def seconds() -> float:
        examined.cache_clear()
        begin = process_time()
        problems(game, drawing)
        return process_time() - begin

    assert any(seconds() < LIMIT for _ in range(5))


@pytest.mark.parametrize(
    ("game", "name", "kind", "k", "key", "value", "expected", "at"),
    [
        ("pitanks", "classic", "start", 1, "at", (110, 110), "start[2]", (110, 110)),
        ("pitanks", "classic", "wall", 3, "thick", 500, "wall[4].thick", None),
        ("pitanks", "classic", "wall", 3, "from", (-5, 80), "wall[4].from", None),
        ("pitanks", "classic", "title", 0, "en", "", "title.en", (800, 450)),
        ("race", "classic", "corner", 0, "at", (20, 20), "corner", None),
        ("race", "classic", "corner", 4, "at", (800, 130), "corner", None),
        ("race", "classic", "corner", 2, "width", 100, "corner[3].width", (1484, 786)),
        ("race", "classic", "corner", 2, "radius", 900, "corner[3].radius", (1484, 786)),
        ("race", "classic", "track", 0, "lines", (0.3, 0.1, 0.5, 0.8), "track.lines", None),
        ("race", "classic", "track", 0, "lines", (0.3, 0.31, 0.5, 0.8), "track.lines[1]", None),
        ("factory", "hall", "worker", 0, "at", (520, 216), "worker[1].at", (520, 216)),
        ("factory", "hall", "shared", 0, "at", (520, 216), "shared[1]", (520, 216)),
        ("factory", "hall", "machine", 1, "at", (30, 216), "machine[2].at", (30, 216)),
        ("factory", "hall", "machine", 1, "at", (520, 300), "machine[2]", (520, 174)),
        ("factory", "hall", "start", 0, "at", (520, 216), "start[1]", (520, 216)),
        ("football", "classic", "start", 0, "at", (60, 60), "start[1]", (60, 60)),
        ("football", "classic", "goal", 0, "width", 600, "goal.width", (800, 450)),
        ("football", "classic", "drop", 3, "at", (800, 5), "drop[4].at", (800, 5)),
        ("football", "classic", "drop", 0, "at", (790, 450), "drop", (800, 450)),
        ("football", "bumpers", "wall", 4, "to", (540, 1000), "wall[5].to", (540, 635)),
    ],
)
def test_each_is_where_it_arises(
    game: str, name: str, kind: str, k: int, key: str, value: object, expected: str, at: tuple[float, float] | None
) -> None:
    drawing = with_entry(drawn(game, name), kind, k, key, value)
    found = problems(game, drawing)
    assert not is_playable(game, drawing)
    assert any(problem.key.startswith(expected) and problem.blocks for problem in found)
    assert all(0 <= problem.x <= WIDTH and 0 <= problem.y <= HEIGHT and problem.extent > 0 for problem in found)
    if at:
        assert any(hypot(problem.x - at[0], problem.y - at[1]) < 5 for problem in found if problem.key == expected)


def test_a_start_behind_walls_is_out_of_reach() -> None:
    drawing = drawing_of(FLAT)
    shut = drawing.added(wall((300, 0), (300, 300))).added(wall((300, 300), (0, 300)))
    assert not problems("pitanks", drawing)
    assert {problem.key for problem in problems("pitanks", shut)} == {"start[2]", "start[3]", "start[4]"}


def test_several_faults_of_a_course_are_all_shown() -> None:
    drawing = drawn("race", "classic")
    drawing = with_entry(with_entry(drawing, "corner", 0, "at", (20, 20)), "corner", 2, "at", (1590, 890))
    found = problems("race", drawing)
    assert any(problem.x < 400 for problem in found)
    assert any(problem.x > 1200 for problem in found)


def test_a_floor_may_have_walls_and_one_across_the_hall_cuts_the_teams_off() -> None:
    drawing = drawn("factory", "hall")
    beside = drawing.added(wall((300, 430), (300, 470)))
    across = drawing.added(wall((0, 450), (1600, 450)))
    assert not problems("factory", beside)
    assert is_playable("factory", beside)
    assert {problem.key for problem in problems("factory", across)} >= {"start[3]", "start[4]"}


def test_gaps_are_marked_and_do_not_block() -> None:
    drawing = drawing_of(FLAT)
    near = drawing.added(wall((700, 300), (700, 600))).added(wall((780, 450), (1000, 450)))
    (gap,) = problems("pitanks", near)
    assert (gap.key, gap.x, gap.y, gap.blocks) == ("wall[2]", 740.0, 450.0, False)
    assert gap.extent == pytest.approx(50.0)
    assert is_playable("pitanks", near)
    apart = drawing.added(wall((700, 300), (700, 600))).added(wall((803, 450), (1000, 450)))
    assert not problems("pitanks", apart)
    joined = drawing.added(wall((700, 300), (700, 600))).added(wall((700, 450), (1000, 450)))
    assert not problems("pitanks", joined)
    assert [problem.y for problem in problems("pitanks", drawing.added(wall((700, 85), (900, 85))))] == [35.0]


@pytest.mark.parametrize("game", GAMES)
def test_hostile_values_end_in_problems_too(game: str) -> None:
    drawing = drawn(game, shipped_arenas(game)[0])
    plain = [value for value in VALUES if isinstance(value, str | bool | int | float)]
    for kind in {part.kind for part in drawing.parts}:
        part = drawing.of(kind)[0]
        for key, _ in part.entries:
            for value in [*plain, (), (plain[6], 1.0), (float("nan"), float("inf"))]:
                changed = with_entry(drawing, kind, 0, key, value)
                for problem in problems(game, changed):
                    assert 0 <= problem.x <= WIDTH
                    assert 0 <= problem.y <= HEIGHT
                    assert problem.reason.isprintable()
