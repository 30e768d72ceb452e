"""Undo and redo without end: drawings are values, so a history is the list of them."""

from collections.abc import Callable

from pigaming_app.games.drawing.values import Drawing


class History:
    """The drawings up to now, and those that were undone."""

    def __init__(self, drawing: Drawing) -> None:
        self._done, self._undone = [drawing], list[Drawing]()

    @property
    def now(self) -> Drawing:
        """The current drawing."""
        return self._done[-1]

    @property
    def can_undo(self) -> bool:
        return len(self._done) > 1

    @property
    def can_redo(self) -> bool:
        return bool(self._undone)

    def push(self, drawing: Drawing) -> bool:
        """Continue with another drawing; false if it is the same one. Undone drawings are then gone."""
        if drawing == self.now:
            return False
        self._done.append(drawing)
        self._undone.clear()
        return True

    def undo(self) -> bool:
        """Back to the drawing before; false if there is none."""
        if not self.can_undo:
            return False
        self._undone.append(self._done.pop())
        return True

    def redo(self) -> bool:
        """Forward to the drawing that was undone last; false if there is none."""
        if not self.can_redo:
            return False
        self._done.append(self._undone.pop())
        return True

    def rewrite(self, change: Callable[[Drawing], Drawing]) -> None:
        """Change all drawings, such as their title; that cannot be undone."""
        self._done, self._undone = [*map(change, self._done)], [*map(change, self._undone)]
