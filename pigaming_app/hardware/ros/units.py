"""Arena px, y down and clockwise, to the m of ROS, y up and counter-clockwise, and back."""

from dataclasses import dataclass
from math import tau

from pigaming_app.sim.plant import Pose, Twist
from pigaming_app.sim.world import HEIGHT, WIDTH


@dataclass(frozen=True)
class ArenaFrame:
    """The arena's frame in ROS. `mm`: mm of the mat per arena px."""

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
