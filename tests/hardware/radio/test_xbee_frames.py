"""Frames of an XBee: reference bytes, round trips, and recovery from noise."""

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from pigaming_app.hardware.radio.xbee_frames import (
    LONGEST,
    ATCommand,
    ATResponse,
    FrameDecoder,
    ModemStatus,
    ReceivedPacket,
    TransmitRequest,
    TransmitStatus,
    decode,
    encode,
    frame,
)
from tests.hardware.wire import heard

SENT = TransmitRequest(1, 0x0001, bytes.fromhex("5007117E"))
GOLDEN = {  # reference frames
    "AP1 TX16": (False, "7E 00 09 01 01 00 01 00 50 07 11 7E 16", SENT),
    "AP2 TX16": (True, "7E 00 09 01 01 00 01 00 50 07 7D 31 7D 5E 16", SENT),
    "RX16": (False, "7E 00 07 81 00 01 28 00 10 27 1E", ReceivedPacket(1, -40, 0, b"\x10\x27")),
    "TX status": (False, "7E 00 03 89 01 00 75", TransmitStatus(1, 0)),
}

octets = st.integers(0, 255)
addresses = st.integers(0, 0xFFFF)
payloads = st.binary(max_size=100)
commands = st.text("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789", min_size=2, max_size=2)
messages = st.one_of(
    st.builds(TransmitRequest, octets, addresses, payloads, octets),
    st.builds(ReceivedPacket, addresses, octets.map(lambda dbm: -dbm), octets, payloads),
    st.builds(TransmitStatus, octets, octets),
    st.builds(ATCommand, octets, commands, payloads),
    st.builds(ATResponse, octets, commands, octets, payloads),
    st.builds(ModemStatus, octets),
)


@pytest.mark.parametrize(("escaped", "line", "message"), GOLDEN.values(), ids=GOLDEN)
def test_reference_frames_are_encoded_and_decoded(escaped, line, message):
    raw = bytes.fromhex(line)
    assert frame(encode(message), escaped) == raw
    assert [decode(data) for data in FrameDecoder(escaped).feed(raw)] == [message]


@given(messages, st.booleans(), st.lists(st.integers(1, 20), max_size=8))
def test_every_message_comes_back_in_both_modes_and_in_pieces(message, escaped, sizes):
    raw = frame(encode(message), escaped)
    if escaped:
        assert not {0x7E, 0x11, 0x13} & set(raw[1:])
    assert [decode(data) for data in heard(FrameDecoder(escaped), raw, sizes)] == [message]


@given(st.binary(max_size=60).filter(lambda noise: 0x7E not in noise), st.lists(messages, max_size=5), st.booleans())
def test_noise_without_delimiters_costs_no_frame(noise, those, escaped):
    decoder = FrameDecoder(escaped)
    raw = b"".join(noise + frame(encode(one), escaped) for one in those) + noise
    assert [decode(data) for data in heard(decoder, raw)] == those
    assert decoder.garbage == len(noise) * (len(those) + 1)


@given(st.binary(max_size=80), messages)
def test_after_any_noise_an_escaped_frame_is_found(noise, message):
    assert decode(heard(FrameDecoder(True), noise + frame(encode(message), True))[-1]) == message


@given(messages, messages, st.booleans(), st.data())
def test_a_truncated_frame_does_not_take_the_next_one_with_it(broken, message, escaped, data):
    raw = frame(encode(broken), escaped)
    cut = raw[: data.draw(st.integers(1, len(raw) - 1))]
    room = bytes(LONGEST + 4)  # with AP=1 a frame with a large size field ends only after that many bytes
    decoded = [decode(one) for one in heard(FrameDecoder(escaped), cut + frame(encode(message), escaped) + room)]
    # With AP=1 nothing tells the two frames apart if the checksum of both together happens to fit.
    assume(escaped or message in decoded or not decoded)
    assert message in decoded


@pytest.mark.parametrize("escaped", [False, True])
@pytest.mark.parametrize("size", ["00 00", "00 81", "7F FF", "FF FF"])
def test_frames_of_no_size_and_oversized_ones_are_passed_over_at_once(escaped, size):
    line = bytes.fromhex("7E" + size) + frame(encode(SENT), escaped)
    assert [decode(data) for data in FrameDecoder(escaped).feed(line)] == [SENT]


def test_a_flipped_bit_is_noticed():
    raw = bytearray(frame(encode(SENT), False))
    raw[8] ^= 0x10
    decoder = FrameDecoder(False)
    assert decoder.feed(bytes(raw)) == []
    assert decoder.feed(frame(encode(SENT), False)) == [encode(SENT)]


def test_a_line_stuck_at_the_escape_fills_no_memory():
    decoder = FrameDecoder(True)
    decoder.feed(b"\x7e" + b"\x7d" * 1000)
    assert len(decoder._buffer) == 0


@given(st.binary(max_size=400), st.booleans())
def test_noise_never_raises_and_is_never_kept(noise, escaped):
    decoder = FrameDecoder(escaped)
    for data in decoder.feed(noise):
        decode(data)
    assert len(decoder._buffer) <= 2 * (LONGEST + 4)


def test_kinds_that_are_not_ours_mean_nothing():
    assert decode(b"\x97\x00") is None
    assert decode(b"\x81\x00") is None
