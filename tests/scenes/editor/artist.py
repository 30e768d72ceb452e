"""People who draw in the editor: real events of mouse, keyboard and pad."""

import time
from collections.abc import Callable

import pygame

from pigaming_app.scenes.editor.board import on_canvas
from pigaming_app.scenes.editor.checker import CheckResult
from pigaming_app.scenes.editor.pointer import GRID
from pigaming_app.scenes.editor.scene import Editor
from tests.scenes.arcade import Arcade
from tests.ui.input.virtual_pad import VirtualPad

Point = tuple[float, float]
KEYS = {
    "left": pygame.KSCAN_A,
    "right": pygame.KSCAN_D,
    "up": pygame.KSCAN_W,
    "down": pygame.KSCAN_S,
    "fire": pygame.KSCAN_SPACE,
    "x": pygame.KSCAN_X,
    "y": pygame.KSCAN_TAB,
    "start": pygame.KSCAN_RETURN,
    "back": pygame.KSCAN_ESCAPE,
}
PAD = {"fire": "a", "back": "b"}  # the others are called the same


class Artist:
    """Draws in the editor on top of an arcade. `press` and `release`: of a button, by its name in KEYS."""

    def __init__(self, arcade: Arcade) -> None:
        self.arcade = arcade

    @property
    def editor(self) -> Editor:
        return self.arcade.shown(Editor)

    def press(self, button: str) -> None:
        raise NotImplementedError

    def release(self, button: str) -> None:
        raise NotImplementedError

    def tap(self, *buttons: str) -> None:
        for button in buttons:
            self.press(button)
            self.arcade.frame(1 / 60)
            self.release(button)
            self.arcade.frame(1 / 60)

    def go(self, at: Point) -> None:
        """Move the pointer to a point of the grid, step by step."""
        for axis, less, more in ((0, "left", "right"), (1, "up", "down")):
            steps = round((at[axis] - self.editor.bench.pointer.at[axis]) / GRID)
            self.tap(*[more if steps > 0 else less] * abs(steps))
        assert self.editor.bench.pointer.at == at

    def drag(self, a: Point, b: Point) -> None:
        """Hold the button from a to b."""
        self.go(a)
        self.press("fire")
        self.arcade.frame(1 / 60)
        self.go(b)
        self.release("fire")
        self.arcade.frame(1 / 60)

    def click(self, at: Point) -> None:
        """Press and release at a point."""
        self.go(at)
        self.tap("fire")

    def choose(self, tile: str) -> None:
        """Choose a tile of the tool bar by directions."""
        self.tap("y")
        focus = self.editor.bar.focus
        for _ in range(20):
            if focus.name == tile:
                break
            here, there = focus.spot.rect, focus.rect(tile)
            if here.x != there.x:
                self.tap("right" if there.x > here.x else "left")
            if here.y != there.y:
                self.tap("down" if there.y > here.y else "up")
        assert focus.name == tile
        self.tap("fire")
        if isinstance(self.arcade.stack.top, Editor) and self.editor.bar.open:
            self.tap("y")


class Typist(Artist):
    """With the first cluster of the keyboard."""

    def press(self, button: str) -> None:
        self._post(pygame.KEYDOWN, button)

    def release(self, button: str) -> None:
        self._post(pygame.KEYUP, button)

    def _post(self, kind: int, button: str) -> None:
        pygame.event.post(pygame.Event(kind, key=0, scancode=KEYS[button], mod=0, unicode=""))


class Gamer(Artist):
    """With a pad."""

    def __init__(self, arcade: Arcade, pad: VirtualPad) -> None:
        super().__init__(arcade)
        self.pad = pad

    def press(self, button: str) -> None:
        self.pad.press(PAD.get(button, button))

    def release(self, button: str) -> None:
        self.pad.release(PAD.get(button, button))


class Mouse(Artist):
    """With the mouse; it clicks on tiles, and on prompts in place of buttons."""

    def press(self, button: str) -> None:
        self._post(pygame.MOUSEBUTTONDOWN)

    def release(self, button: str) -> None:
        self._post(pygame.MOUSEBUTTONUP)

    def go(self, at: Point) -> None:
        self._move(on_canvas(*at))

    def choose(self, tile: str) -> None:
        self._move(self.editor.bar.focus.rect(tile).center)
        self.tap("fire")

    def _move(self, at: Point) -> None:
        self.at = at
        pygame.event.post(pygame.Event(pygame.MOUSEMOTION, pos=at, rel=(0, 0), buttons=(0, 0, 0), touch=False))
        self.arcade.frame(1 / 60)

    def _post(self, kind: int) -> None:
        pygame.event.post(pygame.Event(kind, pos=self.at, button=pygame.BUTTON_LEFT, touch=False))


def wait_for(arcade: Arcade, condition: Callable[[], bool], seconds: float = 120.0) -> None:
    """Run frames in real time, as checks take place in a thread."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it did not happen"
        arcade.frame(1 / 60)
        time.sleep(0.002)


def checked(artist: Artist) -> Editor:
    """The editor, once its drawing is checked and kept."""
    editor = artist.editor
    wait_for(artist.arcade, lambda: bool(editor.bench.verdict and editor.bench.verdict.done))
    editor.bench.autosave.finish()
    return editor


def verdict_of(artist: Artist) -> CheckResult:
    """What the checks of the drawing found."""
    verdict = checked(artist).bench.verdict
    assert verdict
    return verdict
