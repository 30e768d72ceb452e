"""A closed course: a centre line with a width, and where along it something is.

The line is a ring of points, equally far apart. For each node of the grid (see `grid`) the course knows which of its
points is nearest, and which point of another stretch of it is near as well, so that asking where a robot is takes a few
steps whatever it did before: nothing is remembered, and nothing can slip.
"""

from typing import Annotated

from pigaming_app.sim.record import record
from pigaming_app.sim.world import NODES_KEPT

POINTS = 320


@record
class Course:
    """A ring of `count` points `step` px apart; from the last it is one step to the first."""

    count: int
    step: float
    length: float  # px, once round
    xs: Annotated[list[float], POINTS]
    ys: Annotated[list[float], POINTS]
    half: Annotated[list[float], POINTS]  # px from the line to either edge
    near: Annotated[list[int], NODES_KEPT, "h"]  # for each node of the grid its nearest point
    other: Annotated[list[int], NODES_KEPT, "h"]  # the nearest point of another stretch, -1 if none is near


@record
class Place:
    """Where something is along a course."""

    along: float  # px from the first point, in [0, length)
    aside: float  # px from the line, positive on the right hand of the way
    half: float  # px from the line to the edge there
    on: int  # 1: its centre is on the course
    tangent_x: float  # the way of the course there, of length 1
    tangent_y: float
