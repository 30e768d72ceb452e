"""The person on the ladder, from page to page: the climb, the device that drives, and the place in the file."""

import logging
from dataclasses import dataclass, replace

from pigaming_app.events import climb_files
from pigaming_app.events.ladder import Climb
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders
from pigaming_app.ui.input.events import Device, InputEvent

KEYBOARD = Device("keys", 0)  # drives for a mouse

log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class Climber:
    """A climb and who makes it. `number`: of the climb in the file."""

    climb: Climb
    number: int
    device: Device = KEYBOARD

    def at(self, climb: Climb) -> "Climber":
        """The climber after a change of the climb."""
        return replace(self, climb=climb)

    def save(self) -> bool:
        """Save the climb; false if that is impossible, which the log explains."""
        try:
            climb_files.save(folders().data, self.number, self.climb)
        except NotSaved as reason:
            log.warning("%s", reason)
            return False
        return True

    def forget(self) -> None:
        """Delete the climb from the file: it has ended."""
        try:
            climb_files.delete(folders().data, self.number)
        except NotSaved as reason:
            log.warning("%s", reason)


def device_of(event: InputEvent) -> Device:
    """The device that drives for whoever caused an event; of keys that all clusters share, the one used last."""
    device = event.among[0] if event.among else event.device
    return KEYBOARD if device.kind == "mouse" else device


def begun(game: str, device: Device) -> Climber:
    """A climber on the first rung."""
    return Climber(Climb(game), climb_files.new_number(), device)


def resumable_climbs() -> tuple[dict[str, Climber], bool]:
    """The newest saved climb of each game, still without its device, and true if the file was damaged."""
    found, problems = climb_files.saved_climbs(folders().data)
    for sentence in problems:
        log.warning("%s", sentence)
    newest: dict[str, Climber] = {}
    for saved in found:
        newest.setdefault(saved.climb.game, Climber(saved.climb, saved.number))
    return newest, bool(problems)
