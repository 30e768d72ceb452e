"""The robot session of a context."""

from pigaming_app.hardware.session.robot_session import RobotSession
from pigaming_app.scenes.flow.scene import Context


def session_of(context: Context) -> RobotSession:
    """The session of the mat."""
    session = session_if_any(context)
    assert session is not None
    return session


def session_if_any(context: Context) -> RobotSession | None:
    """The session of the mat; None without one."""
    session: RobotSession | None = getattr(context.mat, "session", None)
    return session
