"""Scenes that hold a resource are closed whenever they are removed from the stack."""

import pytest

from pigaming_app.scenes.flow.stack import Home, Pop, Push, Quit, Stack, StackOperation, Swap
from tests.scenes.arcade import Floor


class Camera(Floor):
    """A scene that holds a camera."""

    def __init__(self, name: str, told: list[str]) -> None:
        self.name, self.told = name, told

    def on_leave(self) -> None:
        self.told.append(self.name)


@pytest.mark.parametrize("turn", [Pop(), Swap(Floor()), Home(), Home(Floor()), Quit()])
def test_removed_scenes_are_closed(turn: StackOperation) -> None:
    told: list[str] = []
    stack = Stack(Floor())
    stack.apply(Push(Camera("one", told)))
    assert told == []
    stack.apply(turn)
    assert told == ["one"]


def test_covered_scenes_stay_open_and_all_close_topmost_first() -> None:
    told: list[str] = []
    stack = Stack(Floor())
    stack.apply(Push(Camera("low", told)))
    stack.apply(Push(Camera("high", told)))
    stack.apply(None)
    assert told == []
    stack.clear()
    assert told == ["high", "low"]
    assert stack.scenes == []
