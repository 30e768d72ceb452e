"""Phones as pads on loopback: from a moved stick to the tick that reads it, with four phones in a running match.

As many others as one address may have wait meanwhile, and report that they are there. Each phone that plays moves its
stick at random moments and reports it as the page does, at most 60 times a second. The match runs
at 60 frames and 50 ticks a second in real time. A latency ends with the tick that reads the stick, so half a tick of
waiting belongs to it; drawing, radio and Wi-Fi do not.
"""

import asyncio
import contextlib
import os
import random
import threading
import time
from functools import partial
from itertools import count
from typing import Any

from aiohttp import ClientSession

from pigaming_app.ai.brain.kind import HumanPlayer
from pigaming_app.ai.game_ai import TURN
from pigaming_app.ai.registry import AIS, new_match
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.sim.world import HZ
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Device, StickState
from pigaming_app.ui.input.filters import apply_dead_zone
from pigaming_app.ui.input.phone_messages import REACH, Touches, pack
from pigaming_app.ui.input.phone_pads import MAX_PHONES
from pigaming_app.ui.input.phones.roster import MAX_OF_ADDRESS
from pigaming_app.ui.input.phones.server import PhoneServer
from pigaming_app.ui.window import Canvas

FPS, RATE = 60, 60  # frames of the arcade, messages of a phone, each per second
WAITING, ALIVE_SECONDS = MAX_OF_ADDRESS - MAX_PHONES, 0.2  # phones in the queue, and between two of their messages
MOVE_SECONDS = 0.12, 0.2  # between two moves of a stick
SECONDS = 20.0
START_SECONDS = 20.0
GOAL_MS = 30.0  # median


class Mover(threading.Thread):
    """The phones in a thread of their own. `moved`: for each that plays, the time of a move by its deflection."""

    def __init__(self, url: str, seconds: float) -> None:
        super().__init__(daemon=True)
        self.url, self.seconds = url, seconds
        self.moved: list[dict[float, float]] = [{} for _ in range(MAX_PHONES)]
        self.messages = 0
        self.begun = threading.Barrier(2, timeout=START_SECONDS)
        self.failed = False

    def run(self) -> None:
        try:
            asyncio.run(self._all())
        except (OSError, threading.BrokenBarrierError):  # a phone that gets no time to report is unplugged
            self.failed = True

    async def _all(self) -> None:
        host, _, token = self.url.removeprefix("http://").partition("/")
        async with ClientSession() as session:
            address, origin = f"ws://{host}/{token}/pad", f"http://{host}"
            sockets = [await session.ws_connect(address, origin=origin) for _ in range(MAX_PHONES)]
            waiting = [
                asyncio.create_task(_wait(await session.ws_connect(address, origin=origin))) for _ in range(WAITING)
            ]
            self.begun.wait()
            await asyncio.gather(*(self._play(socket, phone) for phone, socket in enumerate(sockets)))
            for task in waiting:
                task.cancel()
            for socket in sockets:
                await socket.close()

    async def _play(self, socket: Any, phone: int) -> None:
        """Move the stick now and then; report the latest position 60 times a second."""
        rng, end = random.Random(phone), time.perf_counter() + self.seconds
        move_at, step, x = time.perf_counter() + rng.uniform(*MOVE_SECONDS), count(), 0
        due = time.perf_counter()
        while (now := time.perf_counter()) < end:
            if now >= move_at:
                x = (40 + next(step) % (REACH - 48)) * (-1) ** (phone % 2)
                self.moved[phone][_turn(x)] = move_at
                move_at += rng.uniform(*MOVE_SECONDS)
            await socket.send_bytes(pack(Touches(x / REACH)))
            self.messages += 1
            due = max(due + 1 / RATE, now)  # a page that was late does not catch up
            await asyncio.sleep(max(0.0, due - time.perf_counter()))


async def _wait(socket: Any) -> None:
    """Be in the queue, until cancelled."""
    while True:
        await socket.send_bytes(pack(Touches()))
        await asyncio.sleep(ALIVE_SECONDS)


def measure(seconds: float = SECONDS) -> dict[str, Any]:
    """The figures: latencies in ms, messages a second of each phone. Raises ServerUnavailable, or Refusal if
    other programs leave no time to measure.
    """
    os.environ["SDL_VIDEODRIVER"] = "dummy"
    Canvas.open(Settings(fullscreen=False), headless=True)  # SDL names the keys of the keyboard
    controls = Controls()
    server = PhoneServer(controls.phones, "127.0.0.1", 0, {})
    server.start()
    try:
        mover = Mover(server.url, seconds)
        mover.start()
        with contextlib.suppress(threading.BrokenBarrierError):  # then it has failed
            mover.begun.wait()
        latencies = _played(controls, mover, seconds)
        mover.join()
    finally:
        server.stop()
    if mover.failed or not latencies:
        raise Refusal("this machine is too busy: a phone could not report for more than a second")
    ordered = sorted(latencies)
    median, slow = ordered[len(ordered) // 2], ordered[int(0.99 * (len(ordered) - 1))]
    return {
        "phones": MAX_PHONES,
        "phones_waiting": WAITING,
        "messages_per_second_a_phone": mover.messages / MAX_PHONES / seconds,
        "moves": len(ordered),
        "stick_to_tick_ms_median": median,
        "stick_to_tick_ms_99": slow,
        "stick_to_tick_ms_worst": ordered[-1],
        "goal_ms_median": GOAL_MS,
        "reached": median <= GOAL_MS,
    }


def _played(controls: Controls, mover: Mover, seconds: float) -> list[float]:
    """Play a match with the phones in real time; returns the latency of every move, ms."""
    latencies: list[float] = []
    last = [0.0] * MAX_PHONES

    def read(seat: int) -> StickState:
        state = controls.drive(Device("phone", seat))
        if state.angular != last[seat]:
            last[seat] = state.angular
            if moved_at := mover.moved[seat].pop(state.angular, None):
                latencies.append(1000 * (time.perf_counter() - moved_at))
        return state

    match = _match(read)
    begun = time.perf_counter()
    ticks = frames = 0
    while (now := time.perf_counter() - begun) < seconds:
        controls.presses([])
        while ticks < now * HZ:
            ticks += 1
            match.tick()
        frames += 1
        time.sleep(max(0.0, begun + frames / FPS - time.perf_counter()))
    return latencies


def _match(read: Any) -> Match:
    one, two, three, four = (Seat("human", seat) for seat in range(MAX_PHONES))
    match = new_match(Setup("pitanks", "classic", (one, two, three, four), 60, 1, games()["pitanks"].default.name))
    for seat in range(MAX_PHONES):
        match.sit(seat, HumanPlayer(partial(read, seat), AIS["pitanks"].driving[TURN]))
    return match


def _turn(x: int) -> float:
    """What the arcade reads when a phone sends this deflection."""
    return apply_dead_zone(x / REACH, 0.0)[0]
