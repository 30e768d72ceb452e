"""Events as a feature: tournaments, and the one that a kiosk goes on with after a crash, a hang or a power cut."""

import logging
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from pigaming_app.scenes.features.board_page import BoardPage
from pigaming_app.scenes.features.feature import Feature, MenuItem, Service
from pigaming_app.scenes.flow.scene import Context, Scene, Stack
from pigaming_app.scenes.launch import Options
from pigaming_app.storage.settings import folders

if TYPE_CHECKING:  # the title does not wait for it
    from pigaming_app.events.network.link import EventLink
    from pigaming_app.scenes.events.desk.host import DeskHost
    from pigaming_app.scenes.events.running import RunningEvent

LIVE_SECONDS = 1.0  # s between two files

log = logging.getLogger("pigaming")


class EventMarker(Service):
    """Notes the running event on disk: from the first of its pages until only the title is left."""

    def __init__(self, context: Context, data: Path) -> None:
        from pigaming_app.events import resume

        self.context, self.data = context, data
        self.path, self.arcade = resume.marked(data), resume.marked_arcade(data)

    def update(self, seconds: float, stack: Stack) -> None:
        """Note the event of the scenes on the stack; a match on top of the title belongs to the event before it."""
        scenes = stack.scenes
        running = running_of(scenes) if len(scenes) > 1 else None
        path = running.path.absolute() if running else None
        if path == self.path or (path is None and len(scenes) != 1):
            return
        from pigaming_app.events import resume

        self.path = path
        try:
            if path and running:
                resume.mark(self.data, path, running.arcade)
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
            return page_of(self.context, RunningEvent(self.path, event, arcade=self.arcade)) if event else None
        except Exception:  # the title has to appear, whatever is wrong with the event
            log.exception("the running event cannot be shown")
            return None


class LiveScores(Service):
    """Writes what this arcade plays beside the event's file, for pages in a browser."""

    def __init__(self, context: Context) -> None:
        self.context, self._left, self._beat = context, 0.0, 0
        self._written: tuple[Path, str] | None = None  # event and name of the arcade

    def update(self, seconds: float, stack: Stack) -> None:
        self._left -= seconds
        if self._left > 0.0:
            return
        self._left = LIVE_SECONDS
        scenes = stack.scenes
        match = next((after for scene in reversed(scenes) if (after := getattr(scene, "after", None))), None)
        running = getattr(match, "running", None) or running_of(scenes)
        if running is None:
            self.close()
            return
        from pigaming_app.events.changes import live
        from pigaming_app.scenes.events.board.live_scores import live_match

        self._written, self._beat = (running.path, running.arcade), self._beat + 1
        live.write(running.path, live_match(self.context.words, scenes, running, match, self._beat))

    def close(self) -> None:
        """Nothing of an event is shown."""
        if self._written:
            from pigaming_app.events.changes import live

            live.remove(*self._written)
            self._written = None


class LinkService(Service):
    """Keeps the copy of another computer's event up to date, from its first page until another one is shown."""

    def __init__(self, context: Context) -> None:
        self.context, self._left = context, 0.0
        self._path: Path | None = None
        self._link: EventLink | None = None

    def update(self, seconds: float, stack: Stack) -> None:
        self._left -= seconds
        running = running_of(stack.scenes) if self._left <= 0.0 else None
        if running is None:
            return
        self._left = LIVE_SECONDS
        if running.path != self._path:
            self.close()
            from pigaming_app.events.network.link import link_of

            self._path, self._link = running.path, link_of(running.path, running.arcade)
        running.alone = bool(self._link and self._link.trouble)

    def close(self) -> None:
        if self._link:
            self._link.stop()
        self._path, self._link = None, None


class DeskService(Service):
    """Serves the event that was shown last to browsers, while the operator has switched that on."""

    def __init__(self, context: Context) -> None:
        self.context, self._left = context, 0.0
        self._path: Path | None = None
        self._host: DeskHost | None = None

    def update(self, seconds: float, stack: Stack) -> None:
        self._left -= seconds
        if self._left > 0.0:
            return
        self._left = LIVE_SECONDS
        if running := running_of(stack.scenes):
            self._path = running.path
        settings = self.context.settings
        if settings.desk and self._path and self._host is None:
            from pigaming_app.scenes.events.desk.host import desk_host

            self._host = self.context.shared(desk_host)
        if self._host:
            path = self._path if settings.desk else None
            self._host.follow(path, settings.phones_network, self.context.words.language)

    def close(self) -> None:
        if self._host:
            self._host.close()


class EventService(Service):
    """The services of a running event."""

    def __init__(self, *parts: Service) -> None:
        self.parts = parts

    def first_page(self) -> Scene | None:
        return next((page for part in self.parts if (page := part.first_page())), None)

    def update(self, seconds: float, stack: Stack) -> None:
        for part in self.parts:
            part.update(seconds, stack)

    def close(self) -> None:
        for part in self.parts:
            part.close()


def running_of(scenes: Sequence[Scene]) -> "RunningEvent | None":
    """The event of the topmost page of one."""
    if not any(hasattr(scene, "running") for scene in scenes):
        return None
    from pigaming_app.scenes.events.running import RunningEvent

    found = (getattr(scene, "running", None) for scene in reversed(scenes))
    return next((running for running in found if isinstance(running, RunningEvent)), None)


def service(context: Context, options: Options) -> Service | None:
    marker = [EventMarker(context, folders().data)] if options.kiosk and not options.without_title else []
    return EventService(*marker, LiveScores(context), LinkService(context), DeskService(context))


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
    return running_of(scenes) is not None


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
