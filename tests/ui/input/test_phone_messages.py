"""The frames of a phone."""

import pytest

from pigaming_app.ui.input.events import Button
from pigaming_app.ui.input.phone_messages import ALL_BITS, BITS, Touches, pack, parse


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
