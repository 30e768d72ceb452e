"""A program that plays PiTanks: it turns to the nearest opponent, drives there, and fires when it points at it.

    python3 main.py bots --add ada  prints a key
    python3 examples/bots/hunter.py ws://127.0.0.1:8789/ ada KEY

It waits for the arcade. Needs aiohttp (`pip install aiohttp`). The messages are described in docs/bots.md.
"""

import asyncio
import hmac
import json
import math
import sys
import time

import aiohttp


def decide(message):
    """The command for a tick: stick from -1 to 1, forward and clockwise, and the button."""
    robots, seat = message["robots"], message["seat"]
    own = robots[seat]
    others = [one for one in robots if one["present"] and one["team"] != own["team"]]
    if not others:
        return {}
    target = min(others, key=lambda one: math.dist((one["x"], one["y"]), (own["x"], own["y"])))
    bearing = math.atan2(target["y"] - own["y"], target["x"] - own["x"]) - own["heading"]
    bearing = math.remainder(bearing, math.tau)
    forward = 1.0 if abs(bearing) < 0.5 else 0.0
    return {"linear": forward, "angular": max(-1.0, min(1.0, 2.0 * bearing)), "fire": abs(bearing) < 0.1}


async def play(url, name, key):
    async with aiohttp.ClientSession() as session, session.ws_connect(url) as socket:
        nonce = (await socket.receive_json())["nonce"]

        async def send(message):
            text = json.dumps(message)
            sign = hmac.new(key.encode(), (nonce + text).encode(), "sha256").hexdigest()
            await socket.send_str(f"{sign} {text}")

        await send({"type": "play", "name": name})
        async for frame in socket:
            message = frame.json()
            if message["type"] == "tick":
                place = {part: message[part] for part in ("match", "seat", "tick")}
                await send({"type": "act", **place, **decide(message)})
        return socket.close_code


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    while True:
        try:
            code = asyncio.run(play(*sys.argv[1:]))
            break
        except aiohttp.ClientConnectionError:
            time.sleep(0.5)  # nobody listens yet
    print(f"closed with {code}")
