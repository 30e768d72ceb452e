"""The saved replays: watch one, or delete it with a second press. In a kiosk nothing can be deleted."""

import pygame

from pigaming_app.games.replay import Replay
from pigaming_app.scenes.features.replays import to_match
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.recordings import store
from pigaming_app.scenes.recordings.store import StoreError
from pigaming_app.scenes.replays import view
from pigaming_app.scenes.replays.view import ROWS, ReplayEntry
from pigaming_app.scenes.replays.watch import ReplayScene
from pigaming_app.ui.draw import ICE, LABEL, MIST
from pigaming_app.ui.draw.layers import text
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out

INPUT_LOCKOUT = 0.3  # s during which only BACK counts
PREWARM_MS = 5.0  # ms per frame for prewarming
CONFIRM_SECONDS = 3.0  # s for the second press


class ReplaysPage(Page):
    """Pages of rows, the latest replay first. A file is read when its row is first shown."""

    title, idle = "replays.title", 60.0

    def __init__(self, context: Context) -> None:
        self.entries = [ReplayEntry(path) for path in store.paths()]
        self.page, self.confirm_left = 0, 0.0
        self.asked: ReplayEntry | None = None  # replay that a second press deletes
        super().__init__(context, Focus(self._spots()))
        self.warmup: dict[str, MatchRunner] = {}  # by game

    def on_enter(self) -> None:
        """First display, or return from a replay."""
        self.age = 0.0
        self.context.sounds.music("title")

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE plays, X deletes, LEFT and RIGHT turn the page."""
        if not self.entries:
            return self.leave() if event.button in (Button.FIRE, Button.START) else None
        if self.age < INPUT_LOCKOUT:
            return None
        if event.button in (Button.LEFT, Button.RIGHT):
            self._turn(1 if event.button is Button.RIGHT else -1)
        elif event.button is Button.X and self.deletable:
            self._delete(self.entry)
        elif self._on_cross(event):
            self.focus.handle(event)
            self._delete(self.entry)
        else:
            return super().press(event)
        return None

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        return self._play(self.entries[int(name)])

    def advance(self, seconds: float) -> StackOperation:
        """Read the files of this page, one per frame, and prewarm the focused one."""
        self.confirm_left -= seconds
        unread = next((entry for entry in self._shown() if not entry.read), None)
        if unread:
            unread.load(self.context.words.language)
        elif self.entries and self.entry.replay:
            self._prewarm(self.entry.replay)
        return None

    @property
    def subtitle(self) -> str:
        return f"{self.page + 1} / {self.pages}" if self.pages > 1 else ""

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the rows of this page."""
        words = self.context.words
        if not self.entries:
            text(words("replays.none"), LABEL, ICE, "head").draw(screen, 960, 500)
            text(words("replays.how"), 40, MIST).draw(screen, 960, 580)
        black_out(screen, *map(view.row_box, range(len(self._shown()))))
        for i, entry in enumerate(self._shown()):
            box = view.row_box(i)
            asked = entry is self.asked and self.confirm_left > 0.0
            if asked:
                label = words.key_name(self.context.controls.label(None, Button.X))
                view.question(words("replays.sure", button="{button}"), label).draw(screen, *box.topleft)
            elif entry.read:
                for part in view.row(words, entry, entry is self.entry):
                    part.draw(screen, *box.topleft)
            if self.deletable:
                view.cross(asked).draw(screen, *view.cross_box(i).topleft)
        if self.entries:
            self.focus.draw(screen)

    # ---- inside

    @property
    def hints(self) -> Hints:
        hints = [(Button.FIRE, "replays.hint_play")] if self.entries else []
        hints += [(Button.RIGHT, "replays.hint_page")] if self.pages > 1 else []
        hints += [(Button.X, "replays.hint_delete")] if self.entries and self.deletable else []
        return [*hints, (Button.BACK, "replays.hint_back")]

    @property
    def deletable(self) -> bool:
        """False in a kiosk."""
        return not self.context.kiosk

    @property
    def pages(self) -> int:
        """Number of pages."""
        return max(1, -(-len(self.entries) // ROWS))

    @property
    def entry(self) -> ReplayEntry:
        """The focused replay."""
        return self.entries[int(self.focus.name)]

    def _shown(self) -> list[ReplayEntry]:
        """The replays of this page."""
        return self.entries[self.page * ROWS : (self.page + 1) * ROWS]

    def _spots(self) -> list[FocusSpot]:
        first = self.page * ROWS
        rows = [FocusSpot(str(first + i), view.row_box(i)) for i in range(len(self._shown()))]
        return rows or [FocusSpot("0", view.row_box(0))]

    def _on_cross(self, event: InputEvent) -> bool:
        """True for a click on the cross of a row."""
        boxes = map(view.cross_box, range(len(self._shown())) if self.deletable else ())
        return event.button is Button.CLICK and any(box.collidepoint(event.at or (0, 0)) for box in boxes)

    def _prewarm(self, replay: Replay) -> None:
        """Prewarm the sprites of a game, a few per frame."""
        game = replay.setup.game
        if game not in self.warmup:
            self.warmup[game] = MatchRunner(self.context, to_match(replay), loud=False)
        self.warmup[game].prewarm(PREWARM_MS)

    def _turn(self, delta: int) -> None:
        """Show another page, around the end."""
        if self.pages > 1:
            self.page = (self.page + delta) % self.pages
            self.focus = Focus(self._spots())
            self.context.sounds.play("move")

    def _play(self, entry: ReplayEntry) -> StackOperation:
        replay = store.load(entry.path)
        if replay is None:
            self._say("replays.gone")
            entry.replay = None
            return None
        self.context.sounds.play("accept")
        return Push(ReplayScene(self.context, replay))

    def _delete(self, entry: ReplayEntry) -> None:
        """Ask at the first press, delete at the second."""
        if entry is not self.asked or self.confirm_left <= 0.0:
            self.asked, self.confirm_left = entry, CONFIRM_SECONDS
            self.context.sounds.play("move")
            return
        self.asked = None
        try:
            store.delete(entry.path)
        except StoreError as error:
            self._say(str(error))
            return
        self.entries.remove(entry)
        self.page = min(self.page, self.pages - 1)
        self.focus.set_spots(self._spots())
        self.context.sounds.play("back")

    def _say(self, key: str) -> None:
        self.show_message(self.context.words(key), wrong=True)
        self.context.sounds.play("error")
