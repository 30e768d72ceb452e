"""The editor: draw with pad, keys or mouse, see at once what cannot be played, play it, save it.

FIRE draws on the empty floor, and takes up what lies there; held, it drags. Nothing is asked, and everything can be
undone.
"""

from collections.abc import Callable, Mapping

import pygame

from pigaming_app.games.arenas import is_own_name
from pigaming_app.games.drawing.values import Drawing
from pigaming_app.scenes.editor import store
from pigaming_app.scenes.editor.board import (
    BOARD,
    Ground,
    clear,
    draw_grips,
    draw_outline,
    draw_parts,
    draw_pointer,
)
from pigaming_app.scenes.editor.checker import Checker, Verdict
from pigaming_app.scenes.editor.hand import Hand, grip_at, item_at
from pigaming_app.scenes.editor.marks import draw_problems, draw_routes
from pigaming_app.scenes.editor.model.edits import changed_items, removed, replaced, with_copies
from pigaming_app.scenes.editor.model.history import History
from pigaming_app.scenes.editor.model.shapes import Item
from pigaming_app.scenes.editor.model.symmetry import Symmetry
from pigaming_app.scenes.editor.naming import NamePage
from pigaming_app.scenes.editor.play_test import PlayTest
from pigaming_app.scenes.editor.pointer import Pointer
from pigaming_app.scenes.editor.registry import EDITORS
from pigaming_app.scenes.editor.toolbar import Tile, ToolBar
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Home, Pop, Push, StackOperation
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.draw import ALARM, BODY, FOCUS, ICE, LABEL, Color
from pigaming_app.ui.draw.layers import LEFT, RIGHT, backdrop
from pigaming_app.ui.draw.text import text
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.button_prompts import ButtonPrompts

IDLE = 600.0  # s without input until the title
HEAD_Y, PROMPTS_Y, PROMPTS_W = 82, 984, 1728  # px
SENTENCE_SECONDS = 4.0
REVEAL = 1.6  # s in which a surprise draws itself
COPIED = 50.0  # px from a part to its copy
Hints = tuple[tuple[Button, str], ...]


class Editor:
    """The editor of a drawing of the user, which is called `name`. `reveal`: it draws itself first."""

    def __init__(self, context: Context, game: str, name: str, drawing: Drawing, reveal: bool = False) -> None:
        self.context, self.game, self.name, self.tools = context, game, name, EDITORS[game]
        self.history = History(drawing)
        self.pointer, self.bar, self.ground = Pointer(), ToolBar(), Ground(self.tools)
        self.tool, self.symmetry = 0, Symmetry.OFF
        self.selected: Item | None = None
        self.hand: Hand | None = None
        self.checker, self.autosave = Checker(self.tools, name), store.Autosave(store.draft_file(game, name))
        self.waiting: InputEvent | None = None  # asked to play or to save, as soon as it is checked
        self.saving = False
        self.clock, self.reveal = 0.0, REVEAL if reveal else 0.0
        self.sentence, self.sentence_left, self.wrong = "", 0.0, False
        self.told = False  # that the disk refuses
        self._prompts: dict[Hints, ButtonPrompts] = {}
        self.checker.check(drawing)
        if reveal:
            self.autosave.write(drawing)

    # ---- scene

    def on_enter(self) -> None:
        """First display, or return from a match or from the name."""
        self.context.sounds.music(False)
        self.context.controls.forget_taps()
        self.waiting, self.bar.open = None, False

    def on_leave(self) -> None:
        self.checker.end()
        self.autosave.finish()

    def handle(self, event: InputEvent) -> StackOperation:
        """Draw, drag, choose tiles; X deletes, Y opens the tool bar, START plays, BACK lets go or leaves."""
        event = self.prompts.as_button(event)
        self.reveal = 0.0 if event.button not in (Button.POINT, Button.FOUND, Button.LOST) else self.reveal
        match event.button:
            case Button.POINT if event.at:
                self.pointer.place(event.at)
            case Button.CLICK if event.at:
                return self._click(event, event.at)
            case Button.FIRE:
                return self._tile(self.bar.focus.name, event) if self.bar.open else self._press(event)
            case Button.UP | Button.DOWN | Button.LEFT | Button.RIGHT:
                self._direction(event)
            case Button.X:
                self._delete()
            case Button.Y:
                self._play_sound("move")
                self.bar.open = not self.bar.open and self.hand is None
            case Button.START:
                return self._ask(event, False)
            case Button.BACK:
                return self._back()
            case _:
                pass
        return None

    def update(self, seconds: float) -> StackOperation:
        """Move the pointer and what is in hand; go on when the drawing is checked."""
        self.clock += seconds
        self.sentence_left -= seconds
        self.reveal -= seconds
        self.bar.update(seconds)
        if not self.bar.open:
            self.pointer.glide(self.context.controls, seconds)
        if self.hand:
            self._drag(self.hand)
        else:
            self.ground.work(self.history.now)
        if self.autosave.failed and not self.told:
            self.told = True
            self.say("editor.disk", wrong=True)
        if self.waiting:
            return self._ask(self.waiting, self.saving)
        return Home() if self.context.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        screen.blit(backdrop(), (0, 0))
        drawing, verdict = self.shown, self.verdict
        in_hand = changed_items(self.tools, self.hand.base, drawing) if self.hand else ()
        clear(screen)
        share = 1.0 - max(0.0, self.reveal) / REVEAL
        self.ground.draw(screen, drawing, share)
        if verdict and not self.hand:
            draw_routes(screen, verdict.routes, self.clock)
        draw_parts(screen, self.tools, drawing, in_hand, share)
        for item in in_hand:
            draw_outline(screen, self.tools, drawing, item)
        if self.selected and not in_hand:
            draw_outline(screen, self.tools, drawing, self.selected, 2)
            draw_grips(screen, self.tools, drawing, self.selected)
        if verdict:
            draw_problems(screen, verdict.problems, self.clock)
        if self.pointer.shown and not self.bar.open:
            draw_pointer(screen, self.pointer.at)
        self.bar.draw(screen, self.tiles)
        self._head(screen)
        self.prompts.draw(screen)

    # ---- what is shown

    @property
    def shown(self) -> Drawing:
        """The drawing with what is in hand."""
        return self.hand.drawing if self.hand else self.history.now

    @property
    def verdict(self) -> Verdict | None:
        """What is known about the current drawing."""
        return self.checker.of(self.history.now)

    @property
    def title(self) -> str:
        return store.title_of(self.history.now, self.context.words.language)

    @property
    def tiles(self) -> Mapping[str, Tile]:
        """The tiles of the tool bar."""
        tiles = {f"tool {i}": Tile(tool.name, on=i == self.tool) for i, tool in enumerate(self.tools.palette)}
        removable = copied = False
        if self.selected:
            part = self.tools.part(self.history.now, self.selected)
            removable = self.tools.removable(self.history.now, self.selected)
            copied = any(tool.kind == self.selected.kind for tool in self.tools.palette)
            for i, dial in enumerate(self.tools.shapes[self.selected.kind].dials(part)):
                tiles[f"dial {i}"] = Tile(dial.icon, dial.read(part))
        tiles["copy"], tiles["delete"] = Tile("copy", live=copied), Tile("delete", live=removable)
        tiles["mirror"] = Tile("mirror", self.symmetry.name, self.symmetry is not Symmetry.OFF)
        tiles["grid"] = Tile("grid", "on" if self.pointer.snap else "", self.pointer.snap)
        tiles["undo"] = Tile("undo", live=self.history.can_undo)
        tiles["redo"] = Tile("redo", live=self.history.can_redo)
        playable = self.verdict is None or not self.verdict.blocked
        tiles["play"], tiles["save"] = Tile("play", live=playable), Tile("save", live=playable)
        return tiles

    @property
    def prompts(self) -> ButtonPrompts:
        """The button prompts of the moment."""
        leave = (Button.BACK, "editor.hint_back")
        common: Hints = ((Button.Y, "editor.hint_tools"), (Button.START, "editor.hint_play"), leave)
        hints: Hints
        if self.hand:
            hints = ((Button.FIRE, "editor.hint_drop"), (Button.BACK, "editor.hint_cancel"))
        elif self.bar.open:
            hints = ((Button.FIRE, "editor.hint_choose"), (Button.Y, "editor.hint_draw"), *common[1:])
        elif item_at(self.tools, self.history.now, (self.pointer.x, self.pointer.y)):
            hints = ((Button.FIRE, "editor.hint_take"), (Button.X, "editor.hint_delete"), *common)
        elif self.selected and self.tools.removable(self.history.now, self.selected):
            hints = ((Button.FIRE, "editor.hint_draw"), (Button.X, "editor.hint_delete"), *common)
        else:
            hints = ((Button.FIRE, "editor.hint_draw"), *common)
        if hints not in self._prompts:
            self._prompts[hints] = self.context.prompts(hints, PROMPTS_Y, PROMPTS_W)
        return self._prompts[hints]

    def say(self, key: str, wrong: bool = False, **values: object) -> None:
        """Show a sentence for a while."""
        self.sentence, self.sentence_left = self.context.words(key, **values), SENTENCE_SECONDS
        self.wrong = wrong
        self._play_sound("error" if wrong else "accept")

    # ---- input

    def _click(self, event: InputEvent, at: tuple[float, float]) -> StackOperation:
        if name := self.bar.hit(event):
            self.bar.focus.move_to(name)
            return self._tile(name, event)
        self.bar.open = False
        if BOARD.inflate(24, 24).collidepoint(at):
            self.pointer.place(at)
            return self._press(event)
        return None

    def _direction(self, event: InputEvent) -> None:
        if self.bar.open:
            if self.bar.handle(event):
                self._play_sound("move")
        elif not event.repeat and not self.pointer.tap(event.button):
            self.bar.open = event.button is Button.LEFT and self.hand is None

    def _press(self, event: InputEvent) -> StackOperation:
        """Let go, or take up what is pointed at, or begin to draw."""
        if self.hand:
            self._drop(self.hand)
            return None
        now, at = self.history.now, (self.pointer.x, self.pointer.y)
        grip = grip_at(self.tools, now, self.selected, at)
        item = self.selected if grip is not None else item_at(self.tools, now, at)
        if item:
            self.hand = Hand(event, now, at, item=item, grip=grip)
        else:
            self.hand = Hand(event, now, self.pointer.at, self.tools.palette[self.tool])
        self.selected = item
        self.hand.follow(self.tools, self.pointer, self.symmetry)
        if self.hand.tool and not self.hand.items:  # there is no room for more
            self.hand = None
            self._play_sound("refused")
        else:
            self._play_sound("move")
        return None

    def _drag(self, hand: Hand) -> None:
        """Follow the pointer; let go when the button is released, but of a line not before it is drawn."""
        hand.follow(self.tools, self.pointer, self.symmetry)
        if hand.loose or self.context.controls.holds(hand.event.device, hand.event.button):
            return
        if hand.tool and not hand.tool.tap and not hand.moved:
            hand.loose = True
        else:
            self._drop(hand)

    def _drop(self, hand: Hand) -> None:
        hand.follow(self.tools, self.pointer, self.symmetry)
        self.hand = None
        self.selected = hand.items[0] if hand.items else None
        self._change(hand.drawing)

    def _change(self, drawing: Drawing) -> None:
        """Go on with another drawing."""
        if self.history.push(drawing):
            self._play_sound("accept")
            self._changed()

    def _changed(self) -> None:
        """Check and keep the current drawing."""
        self.waiting = None
        items = self.tools.items(self.history.now)
        self.selected = self.selected if self.selected in items else None
        self.checker.check(self.history.now)
        self.autosave.write(self.history.now)

    def _back(self) -> StackOperation:
        self._play_sound("back")
        if self.hand:
            self.hand = None
        elif self.bar.open:
            self.bar.open = False
        elif self.selected:
            self.selected = None
        else:
            return Pop()
        return None

    # ---- tiles

    def _tile(self, name: str, event: InputEvent) -> StackOperation:
        kind, _, number = name.partition(" ")
        tile = self.tiles.get(name)
        if tile is None or (not tile.live and name != "play"):
            self._play_sound("refused")
            return None
        match kind:
            case "tool":
                self.tool, self.bar.open, self.selected = int(number), False, None
                self._play_sound("accept")
            case "dial":
                self._turn(int(number))
            case "copy":
                self._copy()
            case "delete":
                self._delete()
            case "mirror":
                self.symmetry = self.symmetry.following
                self._play_sound("move")
            case "grid":
                self.pointer.snap = not self.pointer.snap
                self._play_sound("move")
            case "undo" | "redo":
                self._step(self.history.undo if kind == "undo" else self.history.redo)
            case _:
                return self._ask(event, kind == "save")
        return None

    def _step(self, step: Callable[[], bool]) -> None:
        """Undo or redo."""
        if step():
            self._play_sound("move")
            self._changed()

    def _turn(self, i: int) -> None:
        """Press a dial of the selected part."""
        if self.selected:
            now, item = self.history.now, self.selected
            part = self.tools.part(now, item)
            turned = self.tools.shapes[item.kind].dials(part)[i].turned(part)
            self._change(replaced(self.tools, now, item, turned, self.symmetry)[0])

    def _copy(self) -> None:
        if self.selected:
            now, item = self.history.now, self.selected
            part = self.tools.shapes[item.kind].moved(self.tools.part(now, item), COPIED, COPIED)
            most = next(tool.most for tool in self.tools.palette if tool.kind == item.kind)
            drawing, items = with_copies(self.tools, now, part, most, self.symmetry)
            self.selected = items[0] if items else item
            self._change(drawing) if items else self._play_sound("refused")

    def _delete(self) -> None:
        now = self.history.now
        item = self.selected or item_at(self.tools, now, (self.pointer.x, self.pointer.y))
        after = removed(self.tools, now, item, self.symmetry) if item and not self.hand else None
        if after is None:
            self._play_sound("refused")
            return
        self.selected = None
        self._change(after)

    # ---- play and save

    def _ask(self, event: InputEvent, saving: bool) -> StackOperation:
        """Play or save as soon as the drawing is checked; if it cannot be played, its marks say so."""
        if self.hand:
            return None
        self.waiting, self.saving = event, saving
        verdict = self.verdict
        if verdict is None or not (verdict.done or (saving and verdict.arena)):
            return None
        self.waiting = None
        if verdict.blocked or verdict.arena is None:
            self._play_sound("refused")
            return None
        if not saving:
            self._play_sound("accept")
            device = event.device if event.device.kind != "mouse" else self.context.controls.last
            return Push(PlayTest(self.context, self.game, verdict.arena, device))
        if is_own_name(self.game, self.name) and not store.NEW.fullmatch(self.name):
            self.save(self.title)
            return None
        self._play_sound("accept")
        return Push(NamePage(self.context, self.game, self.name, "", self.save))

    def save(self, title: str) -> None:
        """Save the arena under a title. It is then the one that the lobby proposes."""
        name = store.file_name(title) if store.NEW.fullmatch(self.name) else self.name
        if store.is_full(self.game) and not store.own_file(self.game, name).exists():
            self.say("editor.full", wrong=True)
            return
        drawing, before = store.titled(self.history.now, title), self.name
        try:
            self.autosave.finish()
            store.save(self.game, name, drawing, before)
        except NotSaved:
            self.say("editor.disk", wrong=True)
            return
        self.history.rewrite(lambda one: store.titled(one, title))
        self.name = name
        self.autosave = store.Autosave(store.draft_file(self.game, name))
        self.checker.check(drawing)
        self.context.settings.choice(self.game).arena = name
        self.say("editor.saved", name=title)

    # ---- inside

    def _head(self, screen: pygame.Surface) -> None:
        """The title, and a sentence or the first problem."""
        words = self.context.words
        name = self.title if not store.NEW.fullmatch(self.name) else ""
        text(name or words("editor.new"), LABEL, ICE, "head", "l", 620).draw(screen, LEFT, HEAD_Y)
        line, color = self.line
        if line:
            text(line, BODY, color, "body", "r", 1060).draw(screen, RIGHT, HEAD_Y)

    @property
    def line(self) -> tuple[str, Color]:
        """The sentence at the top."""
        if self.sentence_left > 0.0:
            return self.sentence, ALARM if self.wrong else FOCUS
        verdict = None if self.hand else self.verdict
        if verdict and verdict.problems:
            worst = next((problem for problem in verdict.problems if problem.blocks), verdict.problems[0])
            kind = worst.key.partition("[")[0].partition(".")[0] if worst.blocks else "gap"
            key = f"editor.problem_{kind}"
            words = self.context.words
            return words(key if key in words else "editor.problem_arena"), ALARM if worst.blocks else FOCUS
        return "", ICE

    def _play_sound(self, name: str) -> None:
        self.context.sounds.play(name)
