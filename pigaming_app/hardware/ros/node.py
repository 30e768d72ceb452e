"""The node of PiGaming in a ROS 1 network: the only module that imports rospy, which belongs to the system's Python.

Poses and twists cross this boundary in m and rad, in a frame with its origin at the arena's lower left corner, x to the
right and y up, headings and turns counter-clockwise (REP 103).
"""

import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from http.client import HTTPConnection, HTTPException
from math import atan2, cos, sin, tau
from typing import Any
from xmlrpc.client import Error, ServerProxy, Transport

from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.storage.messages import OperatorError, OperatorMessage

SYSTEM = "/usr/lib/python3/dist-packages"  # where Debian installs rospy
FRAME = "arena"
STATE = "/game/state"
QUEUE = 1  # messages: only the newest counts
ANSWER = 3.0  # s, timeout of the roscore

Pose = tuple[float, float, float]  # m, m, rad
PoseHandler = Callable[[int, Pose, float], None]  # robot, pose, age in s
Twist = tuple[float, float]  # m/s, rad/s


class RosUnavailable(OperatorError):
    """No ROS on this computer, or no roscore."""


def require_roscore() -> None:
    """Raises RosUnavailable without rospy and its messages, or if no roscore answers."""
    if SYSTEM not in sys.path:
        sys.path.append(SYSTEM)  # last: packages of our own environment come first
    try:
        import geometry_msgs.msg  # noqa: F401
        import rosgraph
        import rospy  # noqa: F401
        import sensor_msgs.msg  # noqa: F401
        import std_msgs.msg  # noqa: F401
    except ImportError as error:
        raise RosUnavailable(OperatorMessage("ros_missing", package=error.name or "rospy")) from None
    address = rosgraph.get_master_uri()
    if not _answers(address):
        raise RosUnavailable(OperatorMessage("ros_master", address=address or '""'))


def _answers(address: str) -> bool:
    """True if a roscore answers there within ANSWER s."""
    try:
        ServerProxy(address, transport=_Impatient()).getPid("/pigaming")
    except (OSError, ValueError, HTTPException, Error):
        return False
    return True


class _Impatient(Transport):
    """HTTP with a timeout."""

    def make_connection(self, host: Any) -> HTTPConnection:
        connection = super().make_connection(host)
        connection.timeout = ANSWER
        return connection


class RosNode:
    """A node named `name` with a suffix of its own, which publishes `topics`. Raises RosUnavailable.

    All topics are registered here: without a roscore, a registration blocks its thread until one is back.
    """

    def __init__(self, name: str, topics: Iterable[str]) -> None:
        require_roscore()  # without one, init_node would wait for ever
        import geometry_msgs.msg as geometry
        import rospy
        import sensor_msgs.msg as sensors
        import std_msgs.msg as standard

        self._ros, self._geometry, self._sensors, self._standard = rospy, geometry, sensors, standard
        if not rospy.core.is_initialized():
            rospy.init_node(name, anonymous=True, disable_signals=True)
        self._publishers = {topic: self._publisher(topic) for topic in topics}
        self._subscribers: list[Any] = []

    @property
    def fault(self) -> OperatorMessage | None:
        """Set once the node has been shut down from outside."""
        return OperatorMessage("ros_gone") if self._ros.is_shutdown() else None

    def on_pose(self, robot: int, handle: PoseHandler) -> None:
        """Call `handle` for every pose of a robot: geometry_msgs PoseStamped or Pose2D."""

        def take(raw: Any) -> None:
            kind = raw._connection_header["type"]
            if kind == "geometry_msgs/PoseStamped":
                stamped = self._geometry.PoseStamped().deserialize(raw._buff)
                x, y, heading = _flat(stamped.pose)
                sent = stamped.header.stamp
                age = (self._ros.Time.now() - sent).to_sec() if sent else 0.0
                handle(robot, (x, y, heading), max(0.0, age))
            elif kind == "geometry_msgs/Pose2D":
                flat = self._geometry.Pose2D().deserialize(raw._buff)
                handle(robot, (flat.x, flat.y, flat.theta), 0.0)

        self._subscribe(topic_of(robot, "pose"), self._ros.AnyMsg, take)

    def on_twist(self, robot: int, handle: Callable[[int, Twist], None]) -> None:
        """Call `handle` for every command to a robot: geometry_msgs Twist."""
        self._subscribe(
            topic_of(robot, "cmd_vel"),
            self._geometry.Twist,
            lambda twist: handle(robot, (twist.linear.x, twist.angular.z)),
        )

    def on_joystick(self, handle: Callable[[str, tuple[float, ...], tuple[int, ...]], None]) -> None:
        """Call `handle` with frame, axes and buttons of every sensor_msgs Joy on /joystick."""
        self._subscribe(
            "/joystick", self._sensors.Joy, lambda joy: handle(joy.header.frame_id, tuple(joy.axes), tuple(joy.buttons))
        )

    def on_keys(self, handle: Callable[[str], None]) -> None:
        """Call `handle` with every std_msgs String on /key_input."""
        self._subscribe("/key_input", self._standard.String, lambda keys: handle(keys.data))

    def publish_pose(self, robot: int, pose: Pose) -> None:
        """Publish a pose of now."""
        message = self._geometry.PoseStamped()
        message.header.frame_id = FRAME
        message.header.stamp = self._ros.Time.now()
        message.pose.position.x, message.pose.position.y = pose[0], pose[1]
        message.pose.orientation.z, message.pose.orientation.w = sin(0.5 * pose[2]), cos(0.5 * pose[2])
        self._publish(topic_of(robot, "pose"), message)

    def publish_twist(self, robot: int, twist: Twist) -> None:
        """Publish a command."""
        message = self._geometry.Twist()
        message.linear.x, message.angular.z = twist
        self._publish(topic_of(robot, "cmd_vel"), message)

    def publish_state(self, text: str) -> None:
        """Publish the state of the match, JSON."""
        self._publish(STATE, self._standard.String(text))

    def close(self) -> None:
        """Leave all topics; a node of the same process may join again."""
        for topic in (*self._subscribers, *self._publishers.values()):
            topic.unregister()
        self._subscribers.clear()
        self._publishers.clear()

    def _subscribe(self, topic: str, kind: type, handle: Callable[[Any], None]) -> None:
        self._subscribers.append(self._ros.Subscriber(topic, kind, handle, queue_size=QUEUE, tcp_nodelay=True))

    def _publisher(self, topic: str) -> Any:
        kinds = {"pose": self._geometry.PoseStamped, "cmd_vel": self._geometry.Twist, "state": self._standard.String}
        kind = kinds[topic.rpartition("/")[2]]
        return self._ros.Publisher(topic, kind, queue_size=5, tcp_nodelay=True)

    def _publish(self, topic: str, message: Any) -> None:
        if not self._ros.is_shutdown():
            self._publishers[topic].publish(message)


def topic_of(robot: int, name: str) -> str:
    """Topic of a robot, counted from 0 here and from 1 there."""
    return f"/robot_{robot + 1}/{name}"


def _flat(pose: Any) -> Pose:
    """Position and heading in the plane."""
    at, turn = pose.position, pose.orientation
    heading = atan2(2.0 * (turn.w * turn.z + turn.x * turn.y), 1.0 - 2.0 * (turn.y * turn.y + turn.z * turn.z))
    return at.x, at.y, heading


@dataclass(frozen=True)
class ArenaFrame:
    """The arena's frame in ROS: its px, y down and clockwise, to m, y up and counter-clockwise, and back.

    `mm`: mm of the mat per arena px.
    """

    mm: float

    @classmethod
    def of_width(cls, mm: float) -> "ArenaFrame":
        """The frame of an arena so many mm wide."""
        return cls(mm / WIDTH)

    def to_ros(self, pose: Pose) -> Pose:
        """Pose in m and rad."""
        m = 1e-3 * self.mm
        return pose[0] * m, (HEIGHT - pose[1]) * m, -pose[2]

    def from_ros(self, pose: Pose) -> Pose:
        """Pose in arena px and rad, its heading from 0 to a whole turn."""
        px = 1e3 / self.mm
        return pose[0] * px, HEIGHT - pose[1] * px, -pose[2] % tau

    def twist_to_ros(self, twist: Twist) -> Twist:
        """Speeds in m/s and rad/s."""
        return 1e-3 * self.mm * twist[0], -twist[1]

    def twist_from_ros(self, twist: Twist) -> Twist:
        """Speeds in px/s and rad/s."""
        return 1e3 / self.mm * twist[0], -twist[1]
