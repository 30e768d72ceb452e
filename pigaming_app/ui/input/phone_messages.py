"""Messages between the arcade and a phone's page.

A phone sends its whole state in a binary frame of four bytes: the version, x and y of the stick (signed, -127..127, y
down), and a bit for each button held down. A wish is a frame, too: its kind, then a text or a number. The arcade
answers with JSON: `{"state": {...}}` describes seat and queue, `{"rumble": [strong, weak, milliseconds]}` shakes the
phone, `{"texts": {...}}` sets the language of its page, `{"ballot": {...}}` what it may vote for, `{"name": ...}`
answers a name, `{"resume": "..."}` identifies it when it returns.
"""

import json
import struct
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from enum import IntEnum

from pigaming_app.ui.input.events import Button

VERSION = 1
FRAME = struct.Struct("<Bbbb")
REACH = 127  # full deflection of an axis
BITS = {Button.FIRE: 1, Button.BACK: 2, Button.X: 4, Button.Y: 8, Button.START: 16}
ALL_BITS = sum(BITS.values())
MAX_FRAME = 64  # bytes; a longer one is refused before it is read
MAX_RATE = 200  # messages in a second
CLOSED_MALFORMED, CLOSED_FLOOD, CLOSED_FULL, CLOSED_REPLACED, CLOSED_SILENT = 4000, 4001, 4002, 4003, 4004
CLOSED_REMOVED = 4005  # by the operator
ITS_TURN, LEFT_QUEUE = -1, -2  # in place of the number of phones that come first


@dataclass(frozen=True)
class Touches:
    """What a phone's player touches: the stick, each axis in [-1, 1] with y down, and the buttons, a sum of BITS."""

    x: float = 0.0
    y: float = 0.0
    buttons: int = 0


class WishKind(IntEnum):
    """The first byte of a wish: a name in UTF-8, or one byte for a colour, a cheer, a game or an arena."""

    NAME = 0x10
    COLOUR = 0x11
    CHEER = 0x12
    GAME = 0x13
    ARENA = 0x14


@dataclass(frozen=True)
class Wish:
    """What a phone's owner wants. `number`: of a list that its page has; `text`: a name."""

    kind: WishKind
    number: int = 0
    text: str = ""


@dataclass(frozen=True)
class SeatView:
    """What a phone shows: its seat (0..3; -1: none), the colour as #rrggbb, and whether it plays in a match.

    `score` and `clock` of a match, and the final `place`, as shown on the screen; empty: none. Without a seat:
    `before`, the phones that come first, or ITS_TURN or LEFT_QUEUE, and `line`, the match in one line; `called`: its
    owner is called by name.
    """

    seat: int = -1
    color: str = ""
    playing: bool = False
    score: str = ""
    clock: str = ""
    place: str = ""
    before: int = ITS_TURN
    line: str = ""
    name: str = ""
    called: bool = False


def parse(frame: bytes) -> Touches | None:
    """The state in a frame of a phone; None if it is malformed."""
    if len(frame) != FRAME.size:
        return None
    version, x, y, buttons = FRAME.unpack(frame)
    if version != VERSION or min(x, y) < -REACH or not 0 <= buttons <= ALL_BITS:
        return None
    return Touches(x / REACH, y / REACH, buttons)


def parse_wish(frame: bytes) -> Wish | None:
    """The wish in a frame of a phone; None if it is malformed."""
    if len(frame) < 1 or frame[0] not in {*WishKind}:
        return None
    kind, rest = WishKind(frame[0]), frame[1:]
    if kind is WishKind.NAME:
        try:
            return Wish(kind, text=rest.decode())
        except UnicodeDecodeError:
            return None
    return Wish(kind, rest[0]) if len(rest) == 1 else None


def pack_wish(wish: Wish) -> bytes:
    """The frame that a page sends for this wish."""
    return bytes([wish.kind]) + (wish.text.encode() if wish.kind is WishKind.NAME else bytes([wish.number]))


def pack(touches: Touches) -> bytes:
    """The frame that a page sends for this state."""
    return FRAME.pack(VERSION, round(touches.x * REACH), round(touches.y * REACH), touches.buttons)


def rumble_text(strong: float, weak: float, seconds: float) -> str:
    """The message that shakes a phone; strengths in [0, 1]. Zero seconds stop it."""
    return json.dumps({"rumble": [round(strong, 2), round(weak, 2), round(1000 * seconds)]})


def state_text(view: SeatView) -> str:
    """The message that describes the seat."""
    return json.dumps({"state": asdict(view)})


def texts_text(texts: Mapping[str, str]) -> str:
    """The message with the texts of the page."""
    return json.dumps({"texts": dict(texts)})


def name_text(name: str, refused: bool) -> str:
    """The answer to a name: the one that the phone has now, and whether the wanted one was refused."""
    return json.dumps({"name": name, "refused": refused})


def ballot_text(games: Sequence[str], arenas: Sequence[str]) -> str:
    """The message with the games and arenas that a phone may vote for."""
    return json.dumps({"ballot": {"games": list(games), "arenas": list(arenas)}})


def resume_text(token: str) -> str:
    """The message with the token by which a phone gets its device number back."""
    return json.dumps({"resume": token})
