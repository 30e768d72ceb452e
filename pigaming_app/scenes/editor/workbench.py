"""The drawing that is being edited: its history, what is selected and in hand, its checks, its draft.

Actions return the name of a sound, "" if there is none.
"""

import threading
from collections.abc import Callable

from pigaming_app.games.arenas import is_own_name, own_arenas
from pigaming_app.games.drawing.values import Drawing
from pigaming_app.scenes.editor import store
from pigaming_app.scenes.editor.checker import Checker, CheckResult
from pigaming_app.scenes.editor.hand import Hand, grip_at, item_at
from pigaming_app.scenes.editor.model.edits import removed, replaced, with_copies
from pigaming_app.scenes.editor.model.history import History
from pigaming_app.scenes.editor.model.shapes import Item, Tools
from pigaming_app.scenes.editor.model.symmetry import Symmetry
from pigaming_app.scenes.editor.pointer import Pointer
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import InputEvent

COPIED = 50.0  # px from a part to its copy


class Workbench:
    """A drawing of the user, which is called `name`; `fresh`: it is not in a file yet, but worth one."""

    def __init__(self, tools: Tools, name: str, drawing: Drawing, fresh: bool) -> None:
        self.tools, self.name = tools, name
        self.history, self.pointer, self.symmetry = History(drawing), Pointer(), Symmetry.OFF
        self.tool = 0
        self.selected: Item | None = None
        self.hand: Hand | None = None
        self.checker, self.autosave = Checker(tools, name), store.Autosave(store.draft_file(tools.game, name))
        self.checker.check(drawing)
        if fresh:
            self.autosave.write(drawing)

    def close(self) -> None:
        """End the checks, and wait until the draft is written."""
        self.checker.end()
        self.autosave.finish()

    @property
    def shown(self) -> Drawing:
        """The drawing with what is in hand."""
        return self.hand.drawing if self.hand else self.history.now

    @property
    def verdict(self) -> CheckResult | None:
        """What is known about the current drawing; while something is in hand, about what was checked last."""
        return self.checker.verdict if self.hand else self.checker.of(self.history.now)

    @property
    def named(self) -> bool:
        """True if the user has given it a name."""
        return is_own_name(self.tools.game, self.name) and not store.NEW.fullmatch(self.name)

    @property
    def pointed(self) -> Item | None:
        """The part under the pointer."""
        return item_at(self.tools, self.history.now, (self.pointer.x, self.pointer.y))

    # ---- drawing

    def press(self, event: InputEvent) -> str:
        """Let go, or take up what is pointed at, or begin to draw."""
        if self.hand:
            return self.drop(self.hand)
        now, at = self.history.now, (self.pointer.x, self.pointer.y)
        grip = grip_at(self.tools, now, self.selected, at)
        item = self.selected if grip is not None else self.pointed
        if item:
            self.hand = Hand(event, now, at, item=item, grip=grip)
        else:
            self.hand = Hand(event, now, self.pointer.at, self.tools.palette[self.tool])
        self.selected = item
        self.hand.follow(self.tools, self.pointer, self.symmetry)
        if self.hand.tool and not self.hand.items:  # there is no room for more
            self.hand = None
            return "refused"
        return "move"

    def drag(self, controls: Controls) -> str:
        """Follow the pointer; let go when the button is released, but of a line not before it is drawn."""
        hand = self.hand
        if hand is None:
            return ""
        hand.follow(self.tools, self.pointer, self.symmetry)
        self.checker.check(hand.drawing, plan=False)
        if hand.loose or controls.holds(hand.event.device, hand.event.button):
            return ""
        if hand.tool and not hand.tool.tap and not hand.moved:
            hand.loose = True
            return ""
        return self.drop(hand)

    def drop(self, hand: Hand) -> str:
        """Let go."""
        hand.follow(self.tools, self.pointer, self.symmetry)
        self.hand = None
        self.selected = hand.items[0] if hand.items else None
        return self.change(hand.drawing)

    def cancel(self) -> None:
        """Let go of what is in hand, which stays as it was."""
        self.hand = None
        self.checker.check(self.history.now)

    def change(self, drawing: Drawing) -> str:
        """Go on with another drawing."""
        if not self.history.push(drawing):
            self.checker.check(drawing)
            return ""
        self._changed()
        return "accept"

    def undo(self) -> str:
        return self._step(self.history.undo)

    def redo(self) -> str:
        return self._step(self.history.redo)

    def turn(self, i: int) -> str:
        """Press a dial of the selected part."""
        if self.selected is None:
            return "refused"
        now, item = self.history.now, self.selected
        part = self.tools.part(now, item)
        turned = self.tools.shapes[item.kind].dials(part)[i].turned(part)
        return self.change(replaced(self.tools, now, item, turned, self.symmetry)[0])

    def copy(self) -> str:
        """Add a copy of the selected part beside it, which is then selected."""
        item, now = self.selected, self.history.now
        most = max((tool.most for tool in self.tools.palette if item and tool.kind == item.kind), default=0)
        if item is None or not most:
            return "refused"
        part = self.tools.shapes[item.kind].moved(self.tools.part(now, item), COPIED, COPIED)
        drawing, items = with_copies(self.tools, now, part, most, self.symmetry)
        if not items:
            return "refused"
        sound = self.change(drawing)
        self.selected = items[0]
        return sound

    def delete(self) -> str:
        """Remove the selected part, or the one under the pointer."""
        item = self.selected or self.pointed
        after = removed(self.tools, self.history.now, item, self.symmetry) if item and not self.hand else None
        if after is None:
            return "refused"
        self.selected = None
        return self.change(after)

    # ---- files

    def save(self, title: str) -> None:
        """Save the arena under a title. Raises NotSaved."""
        game = self.tools.game
        name = self.name if self.named else store.file_name(title)
        drawing, before = store.titled(self.history.now, title), self.name
        self.autosave.finish()
        store.save(game, name, drawing, before)
        self.history.rewrite(lambda one: store.titled(one, title))
        self.name = name
        self.autosave = store.Autosave(store.draft_file(game, name))
        self.checker.check(drawing)
        threading.Thread(
            target=own_arenas, args=(game,), name="own arenas", daemon=True
        ).start()  # read it for the lobby

    # ---- inside

    def _step(self, step: Callable[[], bool]) -> str:
        if self.hand or not step():
            return "refused"
        self._changed()
        return "move"

    def _changed(self) -> None:
        """Check and keep the current drawing."""
        items = self.tools.items(self.history.now)
        self.selected = self.selected if self.selected in items else None
        self.checker.check(self.history.now)
        self.autosave.write(self.history.now)
