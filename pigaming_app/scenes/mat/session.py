"""The robot session of a context."""

from typing import Protocol, runtime_checkable

from pigaming_app.hardware.session.robot_session import RobotSession
from pigaming_app.scenes.flow.context import Context


@runtime_checkable
class WithSession(Protocol):
    """A mat with a session."""

    session: RobotSession


def session_of(context: Context) -> RobotSession:
    """The session of the mat."""
    assert isinstance(context.mat, WithSession)
    return context.mat.session


def session_if_any(context: Context) -> RobotSession | None:
    """The session of the mat; None without one."""
    return context.mat.session if isinstance(context.mat, WithSession) else None
