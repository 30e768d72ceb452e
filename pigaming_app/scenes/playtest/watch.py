"""Keeps the matches of a play test: at the end of each, if all people on its seats have agreed."""

from collections.abc import Mapping, Sequence
from typing import Any

from pigaming_app.scenes.features.feature import Service
from pigaming_app.scenes.flow.scene import Context, Scene, Stack
from pigaming_app.ui.input.events import Device


class PlayTestWatch(Service):
    """Follows the one match that a consent is for. `spoiled`: somebody has driven who has not agreed, or an AI has."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.match: Any = None  # the one that it follows
        self.spoiled = self.done = False

    def update(self, seconds: float, stack: Stack) -> None:
        agreed = agreed_of(stack.scenes)
        scene = match_above(stack.scenes) if agreed else None
        if scene is None:
            return
        if scene.match is not self.match:
            self.match, self.spoiled, self.done = scene.match, False, False
        strangers = {device for device in scene.drivers.devices if device} - agreed.keys()
        self.spoiled |= bool(strangers or scene.drivers.assisted)
        if scene.match.over and not self.done:
            self.done = True
            self._keep(scene, agreed)
            agreed.clear()

    def _keep(self, scene: Any, agreed: Mapping[Device, str]) -> None:
        from pigaming_app.scenes.features.replays import replay_of
        from pigaming_app.scenes.playtest import kept
        from pigaming_app.scenes.recordings.store import StoreError

        words, notices = self.context.words, self.context.notices
        devices = {seat: scene.drivers.devices[seat] for seat in scene.drivers.people}
        people = kept.participants_of(devices, agreed, self.context.driving, scene.setup.game)
        replay = replay_of(scene.match)
        if self.spoiled or not people or replay is None:
            notices.add(words("playtest.not_kept"))
            return
        try:
            kept.keep(replay, people)
            notices.add(words("playtest.kept", count=len(kept.paths())))
        except StoreError as error:
            notices.add(words(str(error)))


def agreed_of(scenes: Sequence[Scene]) -> dict[Device, str]:
    """The age bands of those who have agreed, by device; nobody without a page of consent among the scenes."""
    found = (getattr(scene, "agreed", None) for scene in scenes)
    return next((agreed for agreed in found if agreed), {})


def match_above(scenes: Sequence[Scene]) -> Any:
    """The match among the scenes, with its drivers, or None."""
    return next((scene for scene in reversed(scenes) if hasattr(scene, "drivers") and hasattr(scene, "match")), None)
