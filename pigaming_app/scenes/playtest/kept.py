"""The replays of play tests, in a folder of their own. The limit of other replays does not apply to them."""

import logging
from collections.abc import Collection, Mapping
from datetime import datetime
from pathlib import Path

from pigaming_app.games.replay import Replay
from pigaming_app.scenes.flow.driving import DrivingStyles
from pigaming_app.scenes.playtest.replays import STYLES, Participant, PlayTestReplay
from pigaming_app.scenes.recordings import store
from pigaming_app.scenes.recordings.store import StoreError
from pigaming_app.storage.settings import folders
from pigaming_app.ui.input.events import Device

log = logging.getLogger("pigaming")


def folder() -> Path:
    """The folder of the play tests; it may not exist yet."""
    return folders().data / "playtests"


def paths() -> list[Path]:
    """All play tests, the latest first."""
    return store.paths(folder())


def keep(replay: Replay, participants: tuple[Participant, ...]) -> Path:
    """Write the replay of a play test. Raises StoreError."""
    path = store.free_name(folder(), replay, datetime.now())
    store.write(path, PlayTestReplay(**vars(replay), participants=participants))
    return path


def delete(found: Collection[Path]) -> None:
    """Delete play tests for good, as the people were promised. Raises StoreError."""
    for path in found:
        try:
            path.unlink(missing_ok=True)
        except OSError as error:
            log.warning("%s: %s", path, error)
            raise StoreError("replays.not_deleted") from error


def participants_of(
    devices: Mapping[int, Device | None], agreed: Mapping[Device, str], styles: DrivingStyles, game: str
) -> tuple[Participant, ...]:
    """The people of a match; none unless each of them has agreed and drives without help.

    `devices`: of the seats of people; None: gone. `agreed`: age bands of those who have.
    """
    found = []
    for seat, device in devices.items():
        style = styles.of(device, game) if device else ""
        if device is None or device not in agreed or style not in STYLES:
            return ()
        found.append(Participant(seat, device.kind, agreed[device], style))
    return tuple(found)
