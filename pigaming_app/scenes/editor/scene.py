"""The editor: draw with pad, keys or mouse, see at once what cannot be played, play it, save it.

FIRE draws on the empty floor, and takes up what lies there; held, it drags. Nothing is asked, and everything can be
undone.
"""

from collections.abc import Mapping

import pygame

from pigaming_app.games.drawing.values import Drawing
from pigaming_app.scenes.editor import store
from pigaming_app.scenes.editor.board import (
    BOARD,
    Ground,
    clear,
    draw_axes,
    draw_grips,
    draw_outline,
    draw_parts,
    draw_pointer,
)
from pigaming_app.scenes.editor.marks import draw_problems, draw_routes
from pigaming_app.scenes.editor.model.edits import changed_items
from pigaming_app.scenes.editor.model.symmetry import Symmetry
from pigaming_app.scenes.editor.naming import ArenaNamePage
from pigaming_app.scenes.editor.play_test import PlayTest
from pigaming_app.scenes.editor.registry import EDITORS
from pigaming_app.scenes.editor.toolbar import Tile, ToolBar
from pigaming_app.scenes.editor.workbench import Workbench
from pigaming_app.scenes.flow.scene import Context, Pop, Push, StackOperation
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.draw import ALARM, BODY, FOCUS, ICE, LABEL, Color
from pigaming_app.ui.draw.layers import LEFT, RIGHT, backdrop, text
from pigaming_app.ui.input.events import Button, InputEvent

HEAD_Y = 82  # px
REVEAL = 1.6  # s in which a surprise draws itself


class Editor(Page):
    """The editor of a drawing of the user, which is called `name`. `reveal`: it draws itself first."""

    idle = 600.0
    prompts_y, prompts_room = 984, 1728

    def __init__(self, context: Context, game: str, name: str, drawing: Drawing, reveal: bool = False) -> None:
        super().__init__(context)
        self.game, self.tools = game, EDITORS[game]
        self.bench, self.bar, self.ground = Workbench(self.tools, name, drawing, reveal), ToolBar(), Ground(self.tools)
        self.waiting: InputEvent | None = None  # asked to play or to save, as soon as it is checked
        self.saving = False
        self.reveal = REVEAL if reveal else 0.0
        self.told = False  # that the disk refuses

    # ---- scene

    def on_enter(self) -> None:
        """First display, or return from a match or from the name."""
        self.context.sounds.music(None)
        self.context.controls.forget_taps()
        self.waiting, self.bar.open = None, False

    def on_leave(self) -> None:
        self.bench.close()

    def handle(self, event: InputEvent) -> StackOperation:
        """The tool bar follows the mouse."""
        self.bar.point(event)
        return super().handle(event)

    def press(self, event: InputEvent) -> StackOperation:
        """Draw, drag, choose tiles; X deletes, Y opens the tool bar, START plays."""
        bench = self.bench
        self.reveal = 0.0 if event.button not in (Button.POINT, Button.FOUND, Button.LOST) else self.reveal
        if event.button in (Button.FIRE, Button.CLICK, Button.X):
            self.waiting = None  # drawn on instead
        match event.button:
            case Button.POINT if event.at:
                bench.pointer.place(event.at)
            case Button.CLICK if event.at:
                return self._click(event, event.at)
            case Button.FIRE:
                if self.bar.open:
                    return self._tile(self.bar.focus.name, event)
                self._play(bench.press(event))
            case Button.UP | Button.DOWN | Button.LEFT | Button.RIGHT:
                self._direction(event)
            case Button.X:
                self._play(bench.delete())
            case Button.Y:
                self._play("move")
                self.bar.open = not self.bar.open and bench.hand is None
            case Button.START:
                return self._ask(event, False)
        return None

    def advance(self, seconds: float) -> StackOperation:
        """Move the pointer and what is in hand; go on when the drawing is checked."""
        self.reveal -= seconds
        self.bar.update(seconds)
        if not self.bar.open:
            self.bench.pointer.glide(self.context.controls, seconds)
        self._play(self.bench.drag(self.context.controls))
        if not self.bench.hand:
            self.ground.work(self.bench.history.now)
        if self.bench.autosave.failed and not self.told:
            self.say("editor.disk", wrong=True)
        self.told = self.bench.autosave.failed
        if self.waiting:
            return self._ask(self.waiting, self.saving)
        return None

    def show(self, screen: pygame.Surface) -> None:
        """Draw the board and the tools; the heading is a line."""
        screen.blit(backdrop(), (0, 0))
        bench, drawing, verdict = self.bench, self.bench.shown, self.bench.verdict
        in_hand = changed_items(self.tools, bench.hand.base, drawing) if bench.hand else ()
        share = 1.0 - max(0.0, self.reveal) / REVEAL
        clear(screen)
        self.ground.draw(screen, drawing, share)
        if bench.symmetry is not Symmetry.OFF:
            draw_axes(screen, bench.symmetry)
        if verdict and not bench.hand and share >= 1.0:
            draw_routes(screen, verdict.routes, self.age)
        draw_parts(screen, self.tools, drawing, in_hand, share)
        for item in in_hand:
            draw_outline(screen, self.tools, drawing, item)
        if bench.selected and not in_hand:
            draw_outline(screen, self.tools, drawing, bench.selected)
            draw_grips(screen, self.tools, drawing, bench.selected)
        if verdict:
            draw_problems(screen, verdict.problems, self.age)
        if bench.pointer.shown and not self.bar.open:
            draw_pointer(screen, bench.pointer.at)
        self.bar.draw(screen, self.tiles, self.context.words)
        name = self.drawing_title if bench.named else self.context.words("editor.new")
        text(name, LABEL, ICE, "head", "l", 620).draw(screen, LEFT, HEAD_Y)
        line, color = self.line
        if line:
            text(line, BODY, color, "body", "r", 1060).draw(screen, RIGHT, HEAD_Y)

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Messages are the line at the top."""
        self.prompts.draw(screen)

    # ---- what is shown

    @property
    def drawing_title(self) -> str:
        return store.title_of(self.bench.history.now, self.context.words.language)

    @property
    def tiles(self) -> Mapping[str, Tile]:
        """The tiles of the tool bar."""
        bench, now = self.bench, self.bench.history.now
        tiles = {
            f"tool {i}": Tile(tool.name, on=i == bench.tool, live=len(now.of(tool.kind)) < tool.most)
            for i, tool in enumerate(self.tools.palette)
        }
        removable = copied = False
        if bench.selected:
            part = self.tools.part(now, bench.selected)
            removable = self.tools.removable(now, bench.selected)
            copied = any(tool.kind == bench.selected.kind for tool in self.tools.palette)
            for i, dial in enumerate(self.tools.shapes[bench.selected.kind].dials(part)):
                tiles[f"dial {i}"] = Tile(dial.icon, dial.read(part))
        tiles["copy"], tiles["delete"] = Tile("copy", live=copied), Tile("delete", live=removable)
        tiles["mirror"] = Tile("mirror", bench.symmetry.name, bench.symmetry is not Symmetry.OFF)
        tiles["grid"] = Tile("grid", "on" if bench.pointer.snap else "", bench.pointer.snap)
        tiles["undo"] = Tile("undo", live=bench.history.can_undo)
        tiles["redo"] = Tile("redo", live=bench.history.can_redo)
        playable = bench.verdict is None or not bench.verdict.blocked
        for name in ("play", "save"):
            tiles[name] = Tile(name, on=bool(self.waiting) and self.saving == (name == "save"), live=playable)
        return tiles

    @property
    def hints(self) -> Hints:
        """The prompts of the moment."""
        bench = self.bench
        common = (
            (Button.Y, "editor.hint_tools"),
            (Button.START, "editor.hint_play"),
            (Button.BACK, "editor.hint_back"),
        )
        if bench.hand:
            return ((Button.FIRE, "editor.hint_drop"), (Button.BACK, "editor.hint_cancel"))
        if self.bar.open:
            return ((Button.FIRE, "editor.hint_choose"), (Button.Y, "editor.hint_draw"), *common[1:])
        pointed, meant = bench.pointed, bench.selected or bench.pointed
        removable = meant is not None and self.tools.removable(bench.history.now, meant)
        return (
            (Button.FIRE, "editor.hint_take" if pointed else "editor.hint_draw"),
            *(((Button.X, "editor.hint_delete"),) if removable else ()),
            *common,
        )

    @property
    def line(self) -> tuple[str, Color]:
        """The sentence at the top: a message, or the worst problem."""
        if self.message:
            return self.message, ALARM if self.wrong else FOCUS
        verdict = self.bench.verdict
        if verdict and verdict.problems:
            worst = next((problem for problem in verdict.problems if problem.blocks), verdict.problems[0])
            words, color = self.context.words, ALARM if worst.blocks else FOCUS
            keys = f"editor.{self.game}_problem_{worst.kind}", f"editor.problem_{worst.kind}"
            return words(next((key for key in keys if key in words), "editor.problem_arena")), color
        return "", ICE

    def say(self, key: str, wrong: bool = False, **values: object) -> None:
        """Show a sentence for a while."""
        self.show_message(self.context.words(key, **values), wrong)
        self._play("error" if wrong else "accept")

    # ---- input

    def _click(self, event: InputEvent, at: tuple[float, float]) -> StackOperation:
        if name := self.bar.hit(event):
            self.bar.focus.move_to(name)
            return self._tile(name, event)
        self.bar.open = False
        if BOARD.inflate(24, 24).collidepoint(at):
            self.bench.pointer.place(at)
            self._play(self.bench.press(event))
        return None

    def _direction(self, event: InputEvent) -> None:
        if self.bar.open:
            if self.bar.handle(event):
                self._play("move")
        elif not event.repeat and not self.bench.pointer.tap(event.button):
            self.bar.open = event.button is Button.LEFT and self.bench.hand is None

    def leave(self) -> StackOperation:
        """Let go of what is asked for, in hand, open or selected, one after the other; then leave."""
        self._play("back")
        self.reveal = 0.0
        if self.waiting:
            self.waiting = None
        elif self.bench.hand:
            self.bench.cancel()
        elif self.bar.open:
            self.bar.open = False
        elif self.bench.selected:
            self.bench.selected = None
        else:
            return Pop()
        return None

    def _tile(self, name: str, event: InputEvent) -> StackOperation:
        """Press a tile."""
        bench, tile = self.bench, self.tiles.get(name)
        kind, _, number = name.partition(" ")
        if tile is None or not tile.live or bench.hand:
            self._play("refused")
            return None
        match kind:
            case "tool":
                bench.tool, bench.selected, self.bar.open = int(number), None, False
                self._play("accept")
            case "dial":
                self._play(bench.turn(int(number)))
            case "mirror":
                bench.symmetry = bench.symmetry.following
                self._play("move")
            case "grid":
                bench.pointer.snap = not bench.pointer.snap
                self._play("move")
            case "play" | "save":
                return self._ask(event, kind == "save")
            case _:
                act = {"copy": bench.copy, "delete": bench.delete, "undo": bench.undo, "redo": bench.redo}
                self._play(act[kind]())
        return None

    # ---- play and save

    def _ask(self, event: InputEvent, saving: bool) -> StackOperation:
        """Play or save as soon as the drawing is checked; if it cannot be played, its marks say so."""
        if self.bench.hand:
            return None
        self.waiting, self.saving = event, saving
        verdict = self.bench.verdict
        if verdict is None or not (verdict.done or (saving and verdict.arena)):
            return None
        self.waiting = None
        if verdict.blocked or verdict.arena is None:
            self._play("refused")
            return None
        if not saving:
            self._play("accept")
            return Push(PlayTest(self.context, self.game, verdict.arena, event.device))
        if self.bench.named:
            self.save_as(self.drawing_title)
            return None
        self._play("accept")
        return Push(ArenaNamePage(self.context, self.game, self.bench.name, "", self.save_as))

    def save_as(self, title: str) -> None:
        """Save the arena under a title. It is then the one that the lobby proposes."""
        if not self.bench.named and store.is_full(self.game):
            self.say("editor.full", wrong=True)
            return
        try:
            self.bench.save(title)
        except NotSaved:
            self.say("editor.disk", wrong=True)
            return
        self.context.settings.choice(self.game).arena = self.bench.name
        self.say("editor.saved", name=title)

    def _play(self, sound: str) -> None:
        if sound:
            self.context.sounds.play(sound)
