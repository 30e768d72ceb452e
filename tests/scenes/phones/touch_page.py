"""A page in a real browser as a phone: fingers, expressions, waiting. Each browser has its own way to do the rest."""

import asyncio
import time
from contextlib import suppress
from typing import Any

LONG = 60.0  # s, for whatever must come: the machine may be busy
LANDSCAPE, PORTRAIT = (844, 390), (390, 844)
OPEN = "!document.body.classList.contains('closed')"


class TouchPage:
    """A phone. Fingers stay on the screen until they are lifted."""

    def __init__(self, size: tuple[int, int]) -> None:
        self.size = size
        self.fingers: dict[int, tuple[float, float]] = {}

    async def value(self, expression: str) -> Any:
        """The value of an expression in the page. Raises RuntimeError while it is being replaced by another page."""
        raise NotImplementedError

    async def touch(self, finger: int, x: float, y: float) -> None:
        """Put a finger down, or move it."""
        raise NotImplementedError

    async def lift(self, finger: int) -> None:
        raise NotImplementedError

    async def until(self, expression: str) -> None:
        """Wait until an expression is true in the page, which may still be loading."""
        guarded = f"(() => {{ try {{ return {expression}; }} catch (error) {{ return false; }} }})()"
        end = time.monotonic() + LONG
        while True:
            with suppress(RuntimeError):
                if await self.value(guarded):
                    return
            assert time.monotonic() < end, f"not so in the page: {expression}"
            await asyncio.sleep(0.03)

    async def reads(self, name: str, text: str) -> None:
        """Wait until an element has this text."""
        await self.until(f"document.getElementById('{name}').textContent === '{text}'")

    async def middle(self, name: str) -> tuple[float, float]:
        """The middle of an element, px."""
        box = await self.value(
            f"(() => {{ const b = document.getElementById('{name}').getBoundingClientRect();"
            " return [b.x + b.width / 2, b.y + b.height / 2]; })()"
        )
        return float(box[0]), float(box[1])

    async def tap(self, name: str) -> None:
        """Touch an element for a moment."""
        await self.touch(9, *await self.middle(name))
        await asyncio.sleep(0.05)
        await self.lift(9)

    async def tap_first(self, selector: str) -> None:
        """Touch the first element of a CSS selector for a moment."""
        await self.value(f"(document.querySelector('{selector}').id ||= 'first' + performance.now()) && true")
        await self.tap(await self.value(f"document.querySelector('{selector}').id"))

    async def steer(self, x: float, y: float) -> None:
        """Hold the stick at a deflection, each axis in [-1, 1]."""
        mx, my = await self.middle("stick")
        reach = await self.value("document.getElementById('base').offsetWidth / 2")
        if 0 not in self.fingers:
            await self.touch(0, mx, my)
        await self.touch(0, mx + x * reach, my + y * reach)

    async def lock(self, locked: bool) -> None:
        """Lock or unlock the phone: as far as the page knows, it is hidden."""
        hidden = f"Object.defineProperty(document, 'hidden', {{value: {str(locked).lower()}, configurable: true}})"
        await self.value(f"{hidden} && document.dispatchEvent(new Event('visibilitychange'))")
