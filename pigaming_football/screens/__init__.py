"""How Robot Football appears on the screens."""

from collections.abc import Callable

from pigaming_app.api.look import STYLE, Actor, GameScreens, GlowCanvas, Lesson, dim, regular_polygon, robot
from pigaming_app.api.rules import HEIGHT, WIDTH, Arena

from ..state import Football
from .sprites import draw_ball, draw_goal, draw_lines
from .view import FootballView

Points = list[tuple[float, float]]
Placed = Callable[[Points], Points]


def tile(ink: GlowCanvas, x: float, y: float) -> None:
    """The picture on the title: a shot at the goal."""
    draw_goal(ink, 1, x + 458, y + 132, 96, 1.15)
    for i in range(6):
        ink.line(
            [(x + 242 + 14 * i, y + 158 - 2.4 * i), (x + 332, y + 142)],
            dim(STYLE.mist, 0.10 + 0.08 * i),
            STYLE.thin + 2 * i,
        )
    draw_ball(ink.set_transform(x + 346, y + 140, 0.0, 1.3), 0.6, False)
    ink.set_transform(0, 0)
    robot(ink, 0, x + 130, y + 178, -0.17, 1.15, STYLE.teams[0])
    robot(ink, 3, x + 454, y + 206, -2.2, 1.0, STYLE.teams[1])


def plan(ink: GlowCanvas, arena: Arena, left: float, top: float, k: float) -> None:
    """Lines and goals of a pitch."""
    half = k * arena.plan.mouth
    draw_lines(ink, left, top, k * WIDTH, k * HEIGHT, half, 0.6)
    for side in (0, 1):
        draw_goal(ink, side, left + side * k * WIDTH, top + k * HEIGHT / 2, half, 0.7 * k, inside=True)


def footballs(ink: GlowCanvas, placed: Placed, size: float, shape: int, color: tuple[int, int, int]) -> None:
    """Confetti: a small ball of five corners."""
    whole = placed(regular_polygon(12, size))
    ink.solid(whole).line(whole, STYLE.ice, 2, True).fill(placed(regular_polygon(5, 0.55 * size)), color)


def _kick_off(x: float, y: float, worth: int = 1) -> Callable[[Football], None]:
    """A lesson that begins with the ball at rest at (x, y); `worth`: goals for which it counts."""

    def prepare(state: Football) -> None:
        ball = state.ball
        ball.x, ball.y, ball.out, ball.worth = x, y, 0, worth
        ball.vx = ball.vy = 0.0

    return prepare


GOAL = 1480.0, 450.0  # px, middle of the pictures

LESSONS = {
    "football_push": Lesson((Actor(1330, 450, 0, "wait 0.4, go 1540 450"),), 3.2, GOAL, _kick_off(1450.0, 450.0)),
    "football_shoot": Lesson(
        (Actor(1320, 570, 0, "wait 0.3, fire go 1390 570, fire turn 1600 450, fire wait 0.6"),),
        4.0,
        GOAL,
        _kick_off(1430.0, 570.0),
    ),
    "football_pass": Lesson(
        (
            Actor(1326, 584, -45, "wait 0.4, fire wait 0.3, fire turn 1410 310"),
            Actor(1470, 540, 180),
            Actor(1410, 310, 107, "fire wait 2, fire turn 1600 450, fire wait 0.3"),
        ),
        5.0,
        GOAL,
        _kick_off(1370.0, 540.0),
    ),
    "football_golden": Lesson(
        (Actor(1330, 450, 0, "wait 0.4, go 1540 450"),), 3.2, GOAL, _kick_off(1450.0, 450.0, 2), "party"
    ),
}

SIGNS = {
    "football_chase": "faster",
    "football_keep": "shield",
    "football_support": "ahead",
    "football_aim": "shoot",
    "ball": "circle",
    "goal": "square",
    "mate": "plus",
    "feet": "shoot",
    "kick": "shoot",
}

SCREENS = GameScreens(
    FootballView,
    tile,
    fire="hint_kick",
    plan=plan,
    confetti=footballs,
    team_colors=True,
    lessons=LESSONS,
    signs=SIGNS,
    awards={"goals": "ball", "assists": "pass", "shots": "shoot"},
)
