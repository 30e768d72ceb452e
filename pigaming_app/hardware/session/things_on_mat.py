"""The things on the mat of a session, from their file."""

import logging

from pigaming_app.hardware.scan.things import LayoutError, ThingKind, ThingLayout
from pigaming_app.hardware.session import store
from pigaming_app.hardware.session.robot_session import RobotSession
from pigaming_app.sim.things.spec import ThingSpec

log = logging.getLogger("pigaming")


def load_layout(session: RobotSession) -> ThingLayout:
    """The things that were scanned last; none if there is no file. Raises LayoutError.

    A new emulated mat is empty, whatever stood on the one before.
    """
    layout = store.load_things(store.things_file(_site(session)))
    return ThingLayout((), layout.projector) if session.empty else layout


def save_layout(session: RobotSession, layout: ThingLayout) -> None:
    """Save the things on the mat. Raises NotSaved."""
    store.save_things(layout, store.things_file(_site(session)))


def things_in_play(session: RobotSession) -> tuple[ThingSpec, ...]:
    """The things for a match; none if their file cannot be read, which is logged."""
    try:
        return tuple(thing.spec for thing in load_layout(session).things)
    except LayoutError as error:
        log.warning("things on the mat: %s", error.message)
        return ()


def with_choices(found: ThingLayout, before: ThingLayout) -> ThingLayout:
    """The layout with the operator's choices of mud for those flat things that were there before."""
    muddy = [thing for thing in before.things if thing.mud]
    for thing in found.things:
        if thing.kind is ThingKind.FLAT and any(other.contains(*thing.middle) for other in muddy):
            found = found.replaced(thing, thing.as_mud(True))
    return found


def _site(session: RobotSession) -> str:
    return "emulated" if session.emulated else "real"
