"""The part of `bench robots` with Wi-Fi robots: their own program in MicroPython, over a network that loses 5 %.

Without Node.js it is left out, with a line that says why.
"""

from collections.abc import Callable
from concurrent.futures import Executor, Future
from typing import NamedTuple

from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.emulator.wifi.boards import NoMicroPython, interpreter
from pigaming_app.hardware.proof import emergencies, trials
from pigaming_app.hardware.proof.testbed import Testbed
from pigaming_app.hardware.proof.trials import ButtonMasher, MatchResult
from pigaming_app.sim.world import ROBOTS

MINUTES = 0.5  # of a match
FPS = 30.0


class WifiRuns(NamedTuple):
    """Submitted proofs."""

    matches: dict[str, Future[MatchResult]]  # by game
    faults: Future[dict[str, float]]


def submit(pool: Executor, note: Callable[[str], None]) -> WifiRuns | None:
    """Begin with matches and faults; None, and a note, without MicroPython."""
    try:
        interpreter()
    except NoMicroPython as reason:
        note(f"Wi-Fi robots were not tried: {reason}")
        return None
    played = {game: pool.submit(play, game, seed) for seed, game in enumerate(games(), 1)}
    return WifiRuns(played, pool.submit(emergencies.wifi_faults, 1))


def collect(runs: WifiRuns | None, note: Callable[[str], None]) -> dict[str, float]:
    """Stopping times by fault, s; {} if nothing was submitted. Raises RuntimeError."""
    if runs is None:
        return {}
    for game, future in runs.matches.items():
        run = future.result()
        note(f"Wi-Fi, {game}: played to its end in {run.seconds:.0f} s, {run.paused:.1f} s of them paused")
    stops = runs.faults.result()
    for name, seconds in stops.items():
        note(f"Wi-Fi, {name}: motors stood after {1e3 * seconds:.0f} ms")
    return stops


def play(game: str, seed: int, minutes: float = MINUTES, paired: bool = False) -> MatchResult:
    """A match of four Wi-Fi robots with random buttons, on its own emulated mat. Raises RuntimeError.

    `paired`: each radio is assigned its robot first.
    """
    rules = games()[game].default
    one, two, three, four = (Seat("random", team) for team in rules.teams)
    setup = Setup(
        game, arenas(game)[0], (one, two, three, four), minutes, seed, rules.name, max(rules.goals, default=0)
    )
    bed = Testbed(seed, FPS, wifi=emergencies.LOSSY)
    try:
        if paired:
            bed.session.find()
            emergencies.pair(bed)
        match = Match(setup, lambda world: RealPlant(world, bed.rig))
        for seat in range(ROBOTS):
            match.sit(seat, ButtonMasher(ROBOTS * seed + seat))
            robot = match.state.robots[seat]
            bed.arena.place(seat, (robot.x, robot.y, robot.heading))
        return trials.play(bed, match, 60.0 * minutes)
    finally:
        bed.session.end()
