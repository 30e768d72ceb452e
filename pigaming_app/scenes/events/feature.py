"""Events as a feature: tournaments, and the one that a kiosk goes on with after a crash, a hang or a power cut."""

import logging
from collections.abc import Sequence
from pathlib import Path

from pigaming_app.scenes.features.board_page import BoardPage
from pigaming_app.scenes.features.feature import Feature, MenuItem, Service
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Scene, Stack
from pigaming_app.scenes.launch import Options
from pigaming_app.storage.settings import folders

log = logging.getLogger("pigaming")


class EventMarker(Service):
    """Notes the running event on disk: from the first of its pages until only the title is left."""

    def __init__(self, context: Context, data: Path) -> None:
        from pigaming_app.events import resume

        self.context, self.data = context, data
        self.path = resume.marked(data)

    def update(self, seconds: float, stack: Stack) -> None:
        """Note the event of the scenes on the stack; a match on top of the title belongs to the event before it."""
        scenes = stack.scenes
        path = running_path(scenes) if len(scenes) > 1 else None
        if path == self.path or (path is None and len(scenes) != 1):
            return
        from pigaming_app.events import resume

        self.path = path
        try:
            if path:
                resume.mark(self.data, path)
            else:
                resume.clear(self.data)
        except OSError as error:
            log.warning("%s", error)

    def first_page(self) -> Scene | None:
        """The page of the noted event; None without one, or if its file is gone or damaged."""
        if self.path is None:
            return None
        try:
            from pigaming_app.events import event_files
            from pigaming_app.scenes.events.choice import page_of
            from pigaming_app.scenes.events.running import RunningEvent

            event, problems = event_files.load(self.path)
            for line in problems:
                log.warning("%s", line)
            return page_of(self.context, RunningEvent(self.path, event)) if event else None
        except Exception:  # the title has to appear, whatever is wrong with the event
            log.exception("the running event cannot be shown")
            return None


def running_path(scenes: Sequence[Scene]) -> Path | None:
    """The file of the topmost page of an event."""
    if not any(hasattr(scene, "running") for scene in scenes):
        return None
    from pigaming_app.scenes.events.running import RunningEvent

    found = (getattr(scene, "running", None) for scene in reversed(scenes))
    return next((running.path.absolute() for running in found if isinstance(running, RunningEvent)), None)


def service(context: Context, options: Options) -> Service | None:
    return EventMarker(context, folders().data) if options.kiosk and not options.without_title else None


def page(context: Context, game: str) -> Scene:
    from pigaming_app.scenes.events.choice import EventsPage

    return EventsPage(context)


def board_pages(context: Context) -> Sequence[BoardPage]:
    from pigaming_app.scenes.events.board.event_page import EventBoardPage

    return [EventBoardPage(context)]


def next_match(context: Context, scenes: Sequence[Scene]) -> str:
    from pigaming_app.scenes.events.board.event_page import event_now, next_line

    now = event_now(context, scenes)
    return next_line(context.words, now) if now else ""


def is_running(scenes: Sequence[Scene]) -> bool:
    return running_path(scenes) is not None


FEATURE = Feature(
    "events",
    rooms=("scenes.events", "jobs.events", "events"),
    menu=MenuItem(2, page),
    service=service,
    board_pages=board_pages,
    next_line=next_match,
    without_limit=is_running,
    preload=("pigaming_app.scenes.events.choice",),
)
