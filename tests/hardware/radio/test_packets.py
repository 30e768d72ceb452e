"""Packets and frames: reference bytes, round trips, and recovery from noise."""

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from pigaming_app.hardware.radio import packets
from pigaming_app.hardware.radio.packets import (
    ATCommand,
    ATResponse,
    FrameDecoder,
    ModemStatus,
    PacketDecoder,
    ReceivedPacket,
    RobotReport,
    TransmitRequest,
    TransmitStatus,
    decode,
    encode,
    frame,
)
from pigaming_app.hardware.signals import WheelCommand
from tests.hardware.robot_packets import Drive, drive_from, report_packet

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
speeds = st.integers(-63, 63).map(lambda step: step / 63)
crews = st.lists(st.none() | st.builds(WheelCommand, speeds, speeds), min_size=4, max_size=4)
reports = st.builds(RobotReport, st.integers(1, 4), st.integers(0, 127), st.integers(0, 127), st.integers(0, 16383))


def in_pieces(data, sizes):
    """The data in chunks of these sizes, then the rest."""
    for size in sizes:
        yield data[:size]
        data = data[size:]
    yield data


def heard(decoder, data, sizes=()):
    return [found for piece in in_pieces(data, sizes) for found in decoder.feed(piece)]


@pytest.mark.parametrize(("escaped", "line", "message"), GOLDEN.values(), ids=GOLDEN)
def test_reference_frames_are_encoded_and_decoded(escaped, line, message):
    raw = bytes.fromhex(line)
    assert frame(encode(message), escaped) == raw
    assert [decode(data) for data in FrameDecoder(escaped).feed(raw)] == [message]


def test_the_crc_is_that_of_the_catalogue():
    assert packets.crc8(b"123456789") == 0xF4  # CRC-8/SMBUS, its published check value


def test_a_drive_packet_by_hand():
    """Robot 0 at full speed, robot 1 disabled, robot 2 spins at a third of full speed, robot 3 stands."""
    packet = packets.drive_packet(
        5, [WheelCommand(1.0, 1.0), None, WheelCommand(-1 / 3, 1 / 3), WheelCommand(0.0, 0.0)]
    )
    assert packet[:-1].hex(" ") == "d0 05 0d 7e 7e 3f 3f 2a 54 3f 3f"
    assert packet[-1] == packets.crc8(packet[:-1]) & 0x7F


def test_a_report_by_hand():
    """4.8 V is 4800 mV, which is 37 * 128 + 64."""
    assert report_packet(RobotReport(3, 9, packets.LOW, 4800))[:-1].hex(" ") == "d4 03 09 02 40 25"


def test_speeds_beyond_full_are_cut_and_what_is_no_number_stops():
    (packet,) = PacketDecoder().feed(
        packets.drive_packet(0, [WheelCommand(7.0, -7.0), WheelCommand(float("nan"), 1.0)])
    )
    assert drive_from(packet).wheels == (WheelCommand(1.0, -1.0), WheelCommand(0.0, 1.0), None, None)


def test_there_is_no_room_for_a_fifth_robot():
    with pytest.raises(ValueError, match="room for 4"):
        packets.drive_packet(0, [None] * 5)


@given(st.integers(0, 127), crews)
def test_what_robots_are_told_comes_back(seq, crew):
    packet = packets.drive_packet(seq, crew)
    assert all(byte < 0x80 for byte in packet[1:])
    (found,) = PacketDecoder().feed(packet)
    assert drive_from(found) == Drive(seq, tuple(crew))


@given(reports)
def test_what_a_robot_says_comes_back(report):
    (found,) = PacketDecoder().feed(report_packet(report))
    assert packets.report_from(found) == report


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
    room = bytes(packets.LONGEST + 4)  # with AP=1 a frame with a large size field ends only after that many bytes
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


@given(st.binary(max_size=60), crews, reports, st.lists(st.integers(1, 9), max_size=20))
def test_after_any_noise_our_packets_are_found(noise, crew, report, sizes):
    """One packet may be lost to noise that promised one; the byte from 80 on of the next begins anew."""
    decoder = PacketDecoder()
    good = [packets.drive_packet(3, crew), report_packet(report)]
    assert heard(decoder, noise + b"".join(good), sizes)[-2:] == good
    assert decoder.garbage <= len(noise)


def test_a_line_stuck_at_the_escape_fills_no_memory():
    decoder = FrameDecoder(True)
    decoder.feed(b"\x7e" + b"\x7d" * 1000)
    assert len(decoder._buffer) == 0


@given(st.binary(max_size=400), st.booleans())
def test_noise_never_raises_and_is_never_kept(noise, escaped):
    frames, ours = FrameDecoder(escaped), PacketDecoder()
    for data in frames.feed(noise):
        decode(data)
    ours.feed(noise)
    assert len(frames._buffer) <= 2 * (packets.LONGEST + 4)
    assert len(ours._buffer) < 12


def test_a_packet_of_a_flipped_bit_is_refused():
    packet = bytearray(packets.drive_packet(0, [WheelCommand(0.5, 0.5)]))
    for bit in range(7):
        packet[4] ^= 1 << bit
        assert PacketDecoder().feed(bytes(packet)) == []
        packet[4] ^= 1 << bit


def test_kinds_that_are_not_ours_mean_nothing():
    assert decode(b"\x97\x00") is None
    assert decode(b"\x81\x00") is None
