"""Scenes that hold something are told when they are taken off the stack, however that happens."""

import pygame
import pytest

from pigaming_app.scenes.flow.stack import Home, Pop, Push, Quit, Stack, Swap, Turn
from pigaming_app.ui.input.events import InputEvent


class Plain:
    """A scene that holds nothing."""

    def entered(self) -> None:
        pass

    def on(self, event: InputEvent) -> Turn:
        return None

    def update(self, seconds: float) -> Turn:
        return None

    def draw(self, screen: pygame.Surface) -> None:
        pass


class Camera(Plain):
    """A scene that holds a camera."""

    def __init__(self, name: str, told: list[str]) -> None:
        self.name, self.told = name, told

    def left(self) -> None:
        self.told.append(self.name)


@pytest.mark.parametrize("turn", [Pop(), Swap(Plain()), Home(), Home(Plain()), Quit()])
def test_whoever_is_taken_off_lets_go(turn: Turn) -> None:
    told: list[str] = []
    stack = Stack(Plain())
    stack.turn(Push(Camera("one", told)))
    assert told == []
    stack.turn(turn)
    assert told == ["one"]


def test_a_page_above_does_not_make_it_let_go_and_all_let_go_from_the_top() -> None:
    told: list[str] = []
    stack = Stack(Plain())
    stack.turn(Push(Camera("low", told)))
    stack.turn(Push(Camera("high", told)))
    stack.turn(None)
    assert told == []
    stack.clear()
    assert told == ["high", "low"]
    assert stack.scenes == []
