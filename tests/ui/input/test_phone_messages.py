"""The frames of a phone."""

import pytest

from pigaming_app.ui.input.events import Button
from pigaming_app.ui.input.phone_messages import (
    ALL_BITS,
    BITS,
    MAX_FRAME,
    Touches,
    Wish,
    WishKind,
    pack,
    pack_wish,
    parse,
    parse_wish,
)


@pytest.mark.parametrize(
    "touches",
    [Touches(), Touches(1.0, -1.0, ALL_BITS), Touches(-1.0, 1.0, BITS[Button.FIRE]), Touches(64 / 127, 0.0, 0)],
)
def test_a_frame_holds_the_whole_state(touches: Touches) -> None:
    assert len(pack(touches)) == 4
    assert parse(pack(touches)) == touches


@pytest.mark.parametrize(
    "frame",
    [
        b"",
        b"\x01\x00\x00",
        b"\x01\x00\x00\x00\x00",
        b"\x02\x00\x00\x00",  # another version
        b"\x01\x80\x00\x00",  # -128
        b"\x01\x00\x80\x00",
        b"\x01\x00\x00\x20",  # an unknown button
        b"\x01\x00\x00\xff",
    ],
)
def test_a_malformed_frame_is_no_state(frame: bytes) -> None:
    assert parse(frame) is None


def test_every_frame_of_four_bytes_is_a_state_in_range_or_none() -> None:
    for third in range(256):
        for fourth in range(256):
            touches = parse(bytes((1, 127, third, fourth)))
            assert touches is None or (abs(touches.y) <= 1.0 and touches.x == 1.0 and touches.buttons <= ALL_BITS)


@pytest.mark.parametrize(
    "wish", [Wish(WishKind.NAME, text="Zoë"), Wish(WishKind.NAME), *(Wish(kind, 255) for kind in [*WishKind][1:])]
)
def test_a_wish_is_its_kind_and_a_name_or_a_number_and_never_a_state(wish: Wish) -> None:
    assert parse_wish(pack_wish(wish)) == wish
    assert parse(pack_wish(wish)) is None


def test_every_other_frame_is_no_wish_and_none_raises() -> None:
    for first in range(256):
        for rest in (b"", b"\x00", b"\xff", b"ab", b"\xff" * (MAX_FRAME - 1)):
            wish = parse_wish(bytes([first]) + rest)
            text = first == WishKind.NAME and b"\xff" not in rest
            assert (wish is not None) == (text or (first in {*WishKind} - {WishKind.NAME} and len(rest) == 1))
    assert parse_wish(b"") is None
