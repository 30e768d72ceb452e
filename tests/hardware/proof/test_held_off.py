"""Robots that players drive into real things are held off by virtual walls."""

import pytest

pytest.importorskip("cv2")

from pigaming_app.games.arenas import parse
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.emulator.arena import STARTS
from pigaming_app.hardware.emulator.things.random_scene import some_things
from pigaming_app.hardware.proof.trials import play
from pigaming_app.sim.things.spec import Use, written
from pigaming_app.sim.world import ROBOTS
from tests.cases import repeated
from tests.hardware.proof.rammers import MeasuredBed, Rammer, specs_of

OPEN_FLOOR = '[title]\nen = "Open floor"\npt = "Sala"\n' + "".join(
    f"[[start]]\nat = [{x}, {y}]\nheading = {round(57.3 * heading)}\n" for x, y, heading in STARTS
)


@pytest.mark.long(first=True)
@pytest.mark.parametrize("seed", repeated([1, 2, 3]))
def test_robots_that_are_driven_into_things_at_full_stick_never_touch_them(seed):
    bed = MeasuredBed(seed, 30.0)
    bed.furnish(some_things(seed, 8, bed.arena.optics, STARTS))
    specs = specs_of(bed)
    arena = parse("pitanks", OPEN_FLOOR + written(specs), "open.toml")
    seats = tuple(Seat("human", team) for team in range(ROBOTS))
    setup = Setup("pitanks", "open", seats, 0.5, seed, games()["pitanks"].default.name)
    match = Match(setup, lambda world: RealPlant(world, bed.rig), arena)
    targets = [spec.middle for spec in specs if spec.use is Use.WALL]
    for seat in range(ROBOTS):
        match.sit(seat, Rammer(ROBOTS * seed + seat, targets))
    result = play(bed, match, 30.0)
    assert len(targets) == 6
    assert result.seconds - result.paused >= 29.0
    assert bed.nearest > 0.0
    assert bed.attempts >= 12
