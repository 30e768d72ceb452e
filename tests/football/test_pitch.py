"""What makes a pitch unplayable or bad, as matches on it and a picture of it show."""

from math import cos, hypot, radians, sin, tan, tau
from random import Random
from typing import Any

import numpy as np
import pytest

from pigaming_app.games.arenas import load, parse
from pigaming_app.games.drawing.values import Drawing, Part, drawing_of
from pigaming_app.games.registry import games
from pigaming_app.scenes.editor.model.problems import Problem
from pigaming_app.scenes.editor.model.problems import problems as problems_of
from pigaming_app.sim.arena import ArenaError
from tests.football.pitch import BALL
from tests.matches import match_of

CLASSIC = drawing_of(load("football", "classic").source)
BARE = Drawing(tuple(part for part in CLASSIC.parts if part.kind != "wall"))


def wall(a: tuple[float, float], b: tuple[float, float], thick: int = 30) -> Part:
    return Part("wall", (("from", (round(a[0]), round(a[1]))), ("to", (round(b[0]), round(b[1]))), ("thick", thick)))


def problems(drawing: Drawing) -> list[Problem]:
    return problems_of(games()["football"], drawing)


def kinds(drawing: Drawing) -> set[tuple[str, bool]]:
    return {(problem.kind, problem.blocks) for problem in problems(drawing)}


def is_playable(drawing: Drawing) -> bool:
    try:
        parse("football", drawing.text(), "a.toml")
    except ArenaError:
        return False
    return True


def wedge(degrees: float) -> Drawing:
    """A wall that leaves the upper touchline at an angle."""
    a = radians(degrees)
    return BARE.added(wall((450, 0), (450 + 300 * cos(a), 300 * sin(a))))


def is_freed(drawing: Drawing, x: float, y: float, seed: int) -> bool:
    """True if robots of level 5 get a ball that rests at (x, y) away from there before it is dropped anew."""
    match = match_of("football", ["hand3"] * 4, parse("football", drawing.text(), "a.toml"), 2.0, seed, "standard")
    ball = match.state.ball
    ball.out, ball.x, ball.y, ball.vx, ball.vy, ball.anchor_x, ball.anchor_y = 0, x, y, 0.0, 0.0, x, y
    while not ball.out and hypot(ball.x - x, ball.y - y) < 150.0:
        match.tick()
    return not ball.out


@pytest.mark.parametrize(
    ("degrees", "holds"), [(15, True), (20, True), (25, True), (30, False), (40, False), (60, False)]
)
def test_a_wedge_is_marked_if_robots_get_no_ball_out_of_it(degrees: float, holds: bool) -> None:
    """The ball touches both sides: 22 px from the rim, and from a wall 15 px thick on either side."""
    x = 450 + 15 / sin(radians(degrees)) + BALL / tan(radians(degrees) / 2)
    drawing = wedge(degrees)
    freed = [is_freed(drawing, x + 2, BALL + 2, seed) for seed in range(3)]
    assert freed == [not holds] * 3
    marks = [problem for problem in problems(drawing) if problem.kind == "ball"]
    assert [(abs(mark.x - x) < 1, mark.y, mark.blocks) for mark in marks] == [(True, BALL, False)] * holds
    assert is_playable(drawing)


def test_a_slot_for_the_ball_alone_is_marked() -> None:
    """60 px wide: the ball rolls in, robots do not."""
    slot = BARE.added(wall((600, 0), (600, 200))).added(wall((690, 0), (690, 200)))
    (mark,) = [problem for problem in problems(slot) if problem.kind == "ball"]
    assert (round(mark.x), mark.blocks) == (645, False)
    assert mark.y < 160
    assert not is_freed(slot, 645, 40, 1)


@pytest.mark.parametrize("side", [0, 1])
def test_a_goal_behind_walls_blocks(side: int) -> None:
    x = 1600 * side
    front = 200 - 400 * side + x
    shut = (
        BARE.added(wall((front, 250), (front, 650)))
        .added(wall((front, 250), (x, 250)))
        .added(wall((front, 650), (x, 650)))
    )
    found = [(one.kind, one.x, one.y, one.blocks) for one in problems(shut) if one.kind == "goal"]
    assert found == [("goal", x, 450.0, True)]
    assert not is_playable(shut)
    ajar = shut.changed("wall", 2, wall((front, 650), (x + (80 - 160 * side), 650)))
    assert ("goal", True) not in kinds(ajar), "a ball fits beside it, a robot would not"


def test_bumpers_on_starts_and_drop_points_block() -> None:
    for at, kind in (((300, 290), "start"), ((400, 450), "drop"), ((800, 450), "drop")):
        drawing = BARE.added(wall(at, at, 64))
        assert kinds(drawing) == {(kind, True)}
        assert not is_playable(drawing)


@pytest.mark.parametrize(("gap", "blocks"), [(0, True), (60, True), (90, False)])
def test_a_drop_point_in_a_box_blocks_unless_robots_get_in(gap: int, blocks: bool) -> None:
    """The ball fits through 60 px, but nobody can fetch it."""
    box = BARE.added(wall((200, 350), (200, 550), 20)).added(wall((200, 350), (600, 350), 20))
    box = box.added(wall((600, 350), (600, 550), 20)).added(wall((200, 550), (580 - gap, 550), 20))
    assert (("drop", True) in kinds(box)) == blocks
    assert is_playable(box) != blocks


def test_a_goal_is_out_of_reach_where_a_picture_of_the_pitch_has_no_way_to_it() -> None:
    """Random walls before the left goal, and the areas of pictures of 4 px: of a ball 4 px wider, and 4 px narrower."""
    cv2 = pytest.importorskip("cv2")
    draw, told = Random(5), list[bool]()
    while len(told) < 30:
        drawing = BARE
        for _ in range(draw.randint(2, 6)):
            a, x, y = draw.uniform(0, tau), draw.uniform(20, 350), draw.uniform(150, 750)
            far = x + 400 * cos(a), y + 400 * sin(a)
            drawing = drawing.added(wall((x, y), (min(max(far[0], 0), 1600), min(max(far[1], 0), 900))))
        found = problems(drawing)
        if any(one.key == "drop[1].at" for one in found):
            continue
        narrow, wide = (cv2.connectedComponents(free(drawing, BALL + by).astype("uint8"))[1] for by in (-4, 4))
        told.append(any(one.kind == "goal" for one in found))
        assert not told[-1] or wide[112, 200] not in wide[83:143, 0]
        assert told[-1] or narrow[112, 200] in narrow[83:143, 0]
    assert 5 <= sum(told) < 25


def free(drawing: Drawing, radius: float) -> Any:
    """Where the middle of a disc may be, by point of 4 px; up to the lines of the goals of 240 px."""
    y, x = np.mgrid[0:901:4, 0:1601:4].astype(float)
    mouth = abs(y - 450) < 120
    out = (y >= radius) & (y <= 900 - radius) & (mouth | ((x >= radius) & (x <= 1600 - radius)))
    posts = [((u, v), (u, v), 0.0) for u in (0.0, 1600.0) for v in (330.0, 570.0)]
    walls: Any = [(one.get("from"), one.get("to"), one.get("thick") / 2) for one in drawing.of("wall")]  # type: ignore[operator]
    for (ax, ay), (bx, by), half in [*walls, *posts]:
        ex, ey = bx - ax, by - ay
        t = np.clip(((x - ax) * ex + (y - ay) * ey) / max(ex * ex + ey * ey, 1e-9), 0, 1)
        out &= np.hypot(x - ax - t * ex, y - ay - t * ey) >= half + radius
    out[112, 200] = True
    return out
