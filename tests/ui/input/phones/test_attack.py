"""Phones play on while others attack the server with all they have, from processes of their own."""

import asyncio
import subprocess
import sys
from collections import Counter

import pytest
from aiohttp import ClientSession

from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.input.phone_messages import BITS
from tests.ui.input.phones.client import phone, play, serving

pytestmark = [pytest.mark.long, pytest.mark.usefixtures("_no_threads_stay")]
TAPS, SECONDS = 60, 3
ATTACK = """
import socket, sys, time
host, port, token, kind, seconds = sys.argv[1:]
end = time.monotonic() + float(seconds)
here = f"{host}:{port}"
def shake(token, origin=f"http://{here}"):
    lines = [f"GET /{token}/pad HTTP/1.1", f"Host: {here}", "Upgrade: websocket", "Connection: Upgrade",
             "Sec-WebSocket-Version: 13", "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==", f"Origin: {origin}"]
    return ("\\r\\n".join(lines) + "\\r\\n\\r\\n").encode()
FRAMES = b"\\x82\\x84\\0\\0\\0\\0\\1\\0\\0\\0" * 2000
FIRST = {"flood": shake(token), "pings": shake(token), "token": shake("a" * 10), "origin": shake(token, "http://evil"),
         "noise": b"\\0" * 4000, "connect": b""}[kind]
THEN = {"flood": FRAMES, "pings": b"\\x89\\x80\\0\\0\\0\\0" * 2000}.get(kind, b"")
tries = 0
while time.monotonic() < end or tries < (200 if kind == "connect" else 3):
    tries += 1
    try:
        with socket.create_connection((host, int(port)), 1.0) as peer:
            peer.settimeout(30.0)  # so that each is answered, also by a busy machine
            peer.sendall(FIRST)
            if THEN:
                peer.recv(500)
                for _ in range(100):
                    peer.sendall(THEN)
            elif kind != "connect":
                peer.recv(500)
    except OSError:
        pass
"""


@pytest.mark.parametrize("kind", ["flood", "pings", "token", "origin", "noise", "connect"])
def test_every_tap_arrives_once_and_nobody_is_unplugged(controls: Controls, kind: str) -> None:
    with serving(controls.phones) as server:

        async def story(session: ClientSession) -> None:
            three = [await phone(session, server) for _ in range(3)]
            arguments = [server.address, str(server.port), server.token, kind, str(SECONDS)]
            attacker = subprocess.Popen([sys.executable, "-c", ATTACK, *arguments])
            for i in range(2 * TAPS):
                for one in three:
                    await one.touch(buttons=BITS[Button.FIRE] if i % 2 == 0 else 0)
                await asyncio.sleep(SECONDS / 2 / TAPS)
            while attacker.poll() is None:
                for one in three:
                    await one.touch()
                await asyncio.sleep(0.1)
            assert attacker.returncode == 0
            for one in three:
                await one.touch(buttons=BITS[Button.START])  # the last press
            seen: Counter[tuple[Button, int]] = Counter()
            last = [(Button.START, number) for number in range(3)]
            while not all(seen[press] or seen[Button.LOST, press[1]] for press in last):
                await asyncio.sleep(0.01)
                seen.update((press.button, press.device.number) for press in controls.presses([]))
            assert {number: seen[Button.FIRE, number] for number in range(3)} == dict.fromkeys(range(3), TAPS)
            assert not any(seen[Button.LOST, number] for number in range(3))
            assert sum(server.refusals.counts.values()) > 0

        play(story)
