"""What bots and observers receive of a match: its record as JSON, without what nobody sees on the field.

Units are those of the record: px from the upper left corner (y down), rad clockwise, ticks of 1/50 s.
"""

import json
from typing import Any

from pigaming_app.sim.record import Field, fields_of
from pigaming_app.sim.world import World

HIDDEN = {"random", "rules", "actions", "starts", "walls", "muds", "wall_count", "mud_count", "shifts", "grid"}
HIDDEN |= {"radius", "gain", "requested_linear", "requested_angular"}
HIDDEN |= {"recover", "recover_x", "recover_y", "recover_heading"}
ALIVE = ("alive", "exists")  # fields of entries that come and go
LONGEST = 64  # longer lists are maps for planning
DIGITS = 3  # after the point
CAPSULE = ("ax", "ay", "bx", "by", "half")


def shown(state: World) -> dict[str, Any]:
    """A match at this tick: clock, robots, and what the game adds, such as `bullets` or `ball`."""
    return _plain(state)


def layout(state: World) -> dict[str, Any]:
    """Walls that stand, and ground on which robots are slow; capsules."""
    walls = [_capsule(wall) for wall in state.walls[: state.wall_count] if wall.health]
    return {"walls": walls, "muds": [_capsule(mud) for mud in state.muds[: state.mud_count]]}


def standing(state: World) -> tuple[int, ...]:
    """Changes with the layout."""
    return state.shifts, *(i for i in range(state.wall_count) if state.walls[i].health)


def rules(state: Any) -> dict[str, Any]:
    """The parameters of the rules."""
    return _plain(state.rules)


def text(message: dict[str, Any]) -> str:
    """A message as it is sent."""
    return json.dumps(message, separators=(",", ":"), allow_nan=False)


def _capsule(capsule: Any) -> dict[str, float]:
    return {name: round(getattr(capsule, name), DIGITS) for name in CAPSULE}


def _plain(record: Any) -> dict[str, Any]:
    return {
        field.name: _value(field, getattr(record, field.name))
        for field in fields_of(type(record))
        if field.name not in HIDDEN and (field.count or 0) <= LONGEST
    }


def _value(field: Field, value: Any) -> Any:
    if field.code:
        return value if field.kind is int else _rounded(value)
    if field.count is None:
        return _plain(value)
    alive = next((name for name in ALIVE if any(name == one.name for one in fields_of(field.kind))), "")
    if not alive:
        return [_plain(one) for one in value]
    return [{"index": i, **_plain(one)} for i, one in enumerate(value) if getattr(one, alive)]


def _rounded(value: Any) -> Any:
    return [round(one, DIGITS) for one in value] if isinstance(value, list) else round(value, DIGITS)
