"""What every part of the tour needs: the walker, the way to the title, and from there to a screen."""

from typing import Any, Protocol


class TourWalker(Protocol):
    """Interface of the walker, see walker.py."""

    app: Any
    context: Any

    @property
    def top(self) -> Any: ...

    def shows(self, class_name: str) -> bool: ...

    def set_screen(self, screen: str) -> None: ...

    def wait(self, seconds: float) -> None: ...

    def wait_until(self, condition: Any) -> None: ...

    def press(self, *keys: str, pause: float = 0.1) -> None: ...


def home(walker: TourWalker) -> None:
    """Return to the title."""
    for _ in range(12):
        if walker.shows("Title"):
            break
        walker.press("escape", pause=0.8)
    walker.set_screen("title")
    walker.wait_until(lambda: walker.shows("Title"))
    walker.wait(0.5)


def choose(walker: TourWalker, name: str) -> None:
    """Focus and open an item of the title."""
    focus, menu = walker.top.focus, len(walker.top.tiles.names)
    for _ in range(20 + menu):
        names = [spot.name for spot in focus.spots]
        here, there = names.index(focus.name), names.index(name)
        if here == there:
            break
        if (here < menu) != (there < menu):
            walker.press("s" if here < menu else "w", pause=0.0)
        else:
            walker.press("d" if here < there else "a", pause=0.0)
    walker.press("space")
