"""The stand of a conformance run: robots on a driver's link, whose motors are observed and whose radio is disturbed."""

from typing import TYPE_CHECKING, Protocol

from pigaming_app.hardware.signals import WheelCommand

if TYPE_CHECKING:
    from pigaming_app.hardware.radio.link import CommandLink


class RobotStand(Protocol):
    """Emulated robots; robot 0 to `robots` - 1. The link runs only in its `pump`, time passes only in `advance`."""

    robots: int

    @property
    def link(self) -> "CommandLink":
        """The link that the driver has opened to them."""

    def clock(self) -> float:
        """Time of the link and the robots, s."""

    def advance(self, seconds: float) -> None:
        """Let time pass for the robots and on the way to them."""

    def powered(self, robot: int) -> bool:
        """Whether a motor of a robot is under power."""

    def speeds(self, robot: int) -> WheelCommand:
        """Speeds of the wheels, as shares of full speed."""

    def lose(self, share: float) -> None:
        """Lose this share of what is sent from here on, either way, at random."""

    def switch(self, robot: int, on: bool) -> None:
        """Switch a robot off or on."""

    def interfere(self, wheels: WheelCommand) -> bool:
        """Command all robots once as another arcade in range would, which is not paired with them; false: it cannot."""

    def close(self) -> None:
        """End the robots. Idempotent."""
