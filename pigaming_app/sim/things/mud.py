"""Mud on the mat: a strip of tape, or a sheet, on which robots are slow."""

from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.world import World

SLOW = 0.5  # speed on a thing that is mud, in games without mud of their own


@kernel
def in_mud(world: World, x: float, y: float) -> bool:
    """True if a point lies on a thing that is mud."""
    for i in range(world.mud_count):
        mud = world.muds[i]
        dx, dy = offset_from_wall(mud, x, y)
        if dx * dx + dy * dy < mud.half * mud.half:
            return True
    return False
