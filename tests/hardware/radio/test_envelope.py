"""The datagrams of Wi-Fi robots, against an independent computation of their message code."""

import hashlib

import pytest

from pigaming_app.hardware.radio import envelope
from pigaming_app.hardware.radio.envelope import ANNOUNCE, DRIVE, REPORT, Announcement, announce, seal, unseal

KEY, NONCE = bytes(range(16)), b"12345678"
ROBOT = Announcement(300, 2, 1, 2, NONCE, 7, 5012, 1, "Ruby é")
OTHERS = [b"", b"PG2A", announce(KEY, 1, ROBOT)[:40], seal(KEY, NONCE, REPORT, 1, bytes(40))]


def by_hand(key, message):
    """HMAC-SHA-256 by its definition (RFC 2104)."""
    padded = key + bytes(64 - len(key))
    inner = hashlib.sha256(bytes(byte ^ 0x36 for byte in padded) + message).digest()
    return hashlib.sha256(bytes(byte ^ 0x5C for byte in padded) + inner).digest()


def test_a_datagram_has_a_counter_and_the_start_of_an_hmac_over_nonce_and_bytes():
    datagram = seal(KEY, NONCE, DRIVE, 258, b"body")
    assert datagram[:-8] == b"PG2D" + bytes((0, 0, 0, 0, 0, 0, 1, 2)) + b"body"
    assert datagram[-8:] == by_hand(KEY, NONCE + datagram[:-8])[:8]
    assert unseal(KEY, NONCE, DRIVE, datagram) == (258, b"body")


def test_no_flipped_bit_no_other_key_nonce_or_kind_is_accepted():
    datagram = seal(KEY, NONCE, DRIVE, 1, bytes(18))
    for place in range(8 * len(datagram)):
        broken = bytearray(datagram)
        broken[place // 8] ^= 1 << place % 8
        assert unseal(KEY, NONCE, DRIVE, bytes(broken)) is None
    assert unseal(KEY[::-1], NONCE, DRIVE, datagram) is None
    assert unseal(KEY, NONCE[::-1], DRIVE, datagram) is None
    assert unseal(KEY, NONCE, REPORT, datagram) is None
    assert not any(unseal(KEY, NONCE, DRIVE, datagram[:length]) for length in range(len(datagram)))


def test_an_announcement_carries_the_state_of_a_robot_and_a_printable_name():
    datagram = announce(KEY, 5, ROBOT)
    assert envelope.announcement_from(datagram) == ROBOT
    assert unseal(KEY, NONCE, ANNOUNCE, datagram) is not None
    assert envelope.announcement_from(announce(KEY, 5, ROBOT._replace(name="a\x1b\nb"))).name == "ab"
    cut = announce(KEY, 5, ROBOT._replace(name="é" * 15 + "x"))
    assert envelope.announcement_from(cut).name == "é" * 8
    assert envelope.announcement_from(announce(KEY, 5, ROBOT._replace(name="x" + "é" * 15))).name == "x" + "é" * 7


@pytest.mark.parametrize("datagram", OTHERS)
def test_other_datagrams_are_no_announcement(datagram):
    assert envelope.announcement_from(datagram) is None
