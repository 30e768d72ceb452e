"""How well somebody aims: where the gun points when FIRE goes down, off where models would point it."""

from collections.abc import Iterator, Sequence
from math import log, pi

import numpy as np

from pigaming_app.ai.people.fit.differences import REACTIONS, turned
from pigaming_app.ai.people.fit.wishes import ASKED, Array, Watched

BACK = (0, 1, 2, 3, 5)  # ticks before a press
LEADS = np.linspace(0.0, 1.0, 11)  # shares of the motion of a target that are foreseen
FAR_OFF = 0.5  # rad; more counts as this
SHARPNESS = 200.0  # of the choice of the nearest reaction and lead
SLOW, FAST = 1.2, 2.0  # rad/s: while a robot turns fast, the moment of a decision to fire tells little of its direction
EARLIEST, FEWEST = 30, 5  # tick, presses
ROUNDS = 30  # of a mixture


def aims(plays: Sequence[Watched]) -> dict[str, float]:
    """The reaction and the lead by which presses are nearest to the target, and how far they are off it then."""
    ticks = [np.flatnonzero(np.diff(play.actions[:, 2]) > 0.0) + 1 for play in plays]
    ticks = [some[some > EARLIEST] for some in ticks]
    shots = {back: _off(plays, [some - back for some in ticks]) for back in BACK}
    sizes = np.mean([_sizes(*shots[back][:2]) for back in BACK], axis=0)
    weights = np.exp(-SHARPNESS * (sizes - sizes.min()))
    weights /= weights.sum()
    reactions = np.log([ASKED[i].reaction for i in REACTIONS])
    lead, nearest = float(weights.sum(axis=0) @ LEADS), int(np.argmin(sizes.min(axis=1)))
    found = {"aim_lead": lead, "aim_reaction": float(weights.sum(axis=1) @ reactions), "aim_least": log(sizes.min())}
    for back, (seen, ahead, rates) in shots.items():
        off = turned(seen[:, nearest] + lead * ahead[:, nearest])
        found |= {f"aim{back}_{name}": value for name, value in _spread(off, rates)}
    return found


def _off(plays: Sequence[Watched], ticks: Sequence[Array]) -> tuple[Array, Array, Array]:
    """At these ticks of each match: angles from the gun to the target, and from there to where a shot would meet it.

    Both (n, reactions), rad, NaN: there is no target. And the turn rates, (n,), rad/s.
    """
    aimed = [play.sights[some][:, REACTIONS] for play, some in zip(plays, ticks, strict=True)]
    poses = np.concatenate([play.poses[some] for play, some in zip(plays, ticks, strict=True)])
    sights = np.concatenate(aimed)
    return turned(sights[:, :, 0] - poses[:, :1]), turned(sights[:, :, 1] - sights[:, :, 0]), poses[:, 1]


def _sizes(seen: Array, ahead: Array) -> Array:
    """The mean of how far presses are off, by reaction and lead."""
    off = np.abs(turned(seen[:, :, None] + LEADS * ahead[:, :, None]))
    off = np.minimum(np.nan_to_num(off, nan=FAR_OFF), FAR_OFF)
    return np.array(np.concatenate([off, np.full((2, *off.shape[1:]), 0.5 * FAR_OFF)]).mean(axis=0))


def _spread(off: Array, rates: Array) -> Iterator[tuple[str, float]]:
    known = np.isfinite(off)
    off, rates = off[known], np.abs(rates[known])
    sizes = np.abs(off) if len(off) >= FEWEST else np.full(FEWEST, 0.2)
    yield from ((f"{share}", log(np.quantile(sizes, share) + 0.005)) for share in (0.25, 0.5, 0.75))
    for name, some in (("every", rates >= 0.0), ("slow", rates < SLOW), ("fast", rates >= FAST)):
        spread, share = mixture(off[some])
        yield f"{name}", log(spread)
        yield f"{name}_share", share


def mixture(off: Array) -> tuple[float, float]:
    """Standard deviation of angles around 0, some of which are anywhere, and the share of the others.

    By expectation maximisation; a few angles of usual size are added, for those who have pressed seldom.
    """
    spread, share = 0.2, 0.8
    for _ in range(ROUNDS):
        near = share * np.exp(-0.5 * (off / spread) ** 2) / (spread * (2.0 * pi) ** 0.5)
        chance = near / (near + (1.0 - share) / (2.0 * pi))
        spread = float(np.sqrt((chance @ off**2 + 0.04) / (chance.sum() + 1.0)))
        share = float((chance.sum() + 1.0) / (len(off) + 2.0))
    return spread, share
