"""Rewards of Robot Race: the tallies of a seat."""

from typing import Any

from pigaming_app.ai.tallies import Tallies
from pigaming_app.gym.buttons import has_turbo
from pigaming_app.sim.kernel import kernel


@kernel
def tally_race(match: Any, seat: int, senses: Any, totals: Any) -> None:
    """Laps covered, with fractions; complete laps, the rank (fewer is better), the finish, and the win."""
    racer = match.racers[seat]
    totals[0], totals[1] = racer.progress / match.course.length, match.robots[seat].score
    totals[2], totals[3] = -racer.rank, racer.finished
    totals[4] = (1.0 if racer.rank == 1 else -1.0) if match.over or racer.finished else 0.0


@kernel
def has_finished(match: Any, seat: int) -> int:
    """1 if the match is over, or over for this seat."""
    return 1 if match.over or match.racers[seat].finished else 0


@kernel
def usable(match: Any, seat: int, ticks: int) -> tuple[bool, bool]:
    """FIRE as it goes down: with an item, which party may give at once, or lost, which may begin at once.

    An item or a slipstream also refills the meter.
    """
    rules, racer = match.rules, match.racers[seat]
    fire = not racer.fire_held and not racer.finished
    turbo = has_turbo(match.robots[seat], rules.turbo_drain) or rules.party
    return bool(fire), bool(turbo)


TALLIES = Tallies(
    ("progress", "laps", "places", "finish", "win"),
    {"progress": 10.0, "win": 5.0},
    tally_race,
    has_finished,
)
