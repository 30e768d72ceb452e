"""The running event of a kiosk: noted on disk, and opened again after a crash, a hang or a power cut."""

import logging
from collections.abc import Sequence
from pathlib import Path

from pigaming_app.events import event_files
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Scene
from pigaming_app.storage import resume

log = logging.getLogger("pigaming")


class EventMarker:
    """Part of a kiosk. An event runs from the first of its pages until only the title is left."""

    def __init__(self, data: Path) -> None:
        self.data = data
        self.path = resume.marked(data)

    def update(self, scenes: Sequence[Scene]) -> None:
        """Note the event of the scenes on the stack; a match on top of the title belongs to the event before it."""
        path = running_path(scenes) if len(scenes) > 1 else None
        if path == self.path or (path is None and len(scenes) > 1):
            return
        self.path = path
        try:
            if path:
                resume.mark(self.data, path)
            else:
                resume.clear(self.data)
        except OSError as error:
            log.warning("%s", error)

    def page(self, context: Context) -> Scene | None:
        """The page of the noted event; None without one, or if its file is gone or damaged."""
        from pigaming_app.scenes.events.choice import page_of  # late: few kiosks start with an event

        if self.path is None:
            return None
        try:
            event, problems = event_files.load(self.path)
            for line in problems:
                log.warning("%s", line)
            return page_of(context, RunningEvent(self.path, event)) if event else None
        except Exception:  # the title has to appear, whatever is wrong with the event
            log.exception("the running event cannot be shown")
            return None


def running_path(scenes: Sequence[Scene]) -> Path | None:
    """The file of the topmost page of an event."""
    found = (getattr(scene, "running", None) for scene in reversed(scenes))
    return next((running.path.absolute() for running in found if isinstance(running, RunningEvent)), None)
