"""Angle arithmetic. Angles in rad, headings in [0, 2 pi)."""

from math import pi, tau

from pigaming_app.sim.kernel import kernel


@kernel
def wrap(angle: float) -> float:
    """The same direction in [0, 2 pi). Meant for angles at most a few turns out of range."""
    while angle >= tau:
        angle -= tau
    while angle < 0.0:
        angle += tau
    if angle >= tau:  # a tiny negative angle rounds up to a whole turn
        angle = 0.0
    return angle


@kernel
def turn_to(angle: float) -> float:
    """The equivalent turn in (-pi, pi]: the short way round."""
    while angle > pi:
        angle -= tau
    while angle <= -pi:
        angle += tau
    return angle
