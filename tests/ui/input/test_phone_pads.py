"""Phones as devices of `Controls`: as pads behave."""

import json
from dataclasses import asdict

import pytest

from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent, StickState
from pigaming_app.ui.input.filters import FIRST_REPEAT
from pigaming_app.ui.input.phone_messages import ALL_BITS, BITS, SeatView, Touches
from pigaming_app.ui.input.phone_pads import FRESH_SECONDS, MAX_CHANGES, MAX_PHONES, Phones

FIRE, TURBO = BITS[Button.FIRE], BITS[Button.BACK]
STILL = StickState()


class Clock:
    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock(controls: Controls) -> Clock:
    clock = Clock()
    controls.phones.clock = clock
    return clock


def noticed(controls: Controls) -> list[tuple[Button, Device]]:
    return [(press.button, press.device) for press in controls.presses([])]


def join(controls: Controls) -> tuple[int, Device]:
    number = controls.phones.connect()
    device = Device("phone", number)
    assert noticed(controls) == [(Button.FOUND, device)]
    return number, device


def test_four_phones_are_four_devices(controls: Controls, clock: Clock) -> None:
    four = [join(controls) for _ in range(MAX_PHONES)]
    assert controls.phones.full
    assert controls.handhelds() == [device for _, device in four]
    assert [device for device in controls.players() if device.kind == "phone"] == controls.handhelds()
    for number, device in four:
        controls.phones.receive(number, Touches(buttons=FIRE))
        assert noticed(controls) == [(Button.FIRE, device)]
        assert [controls.drive(other).fire for _, other in four] == [other == device for _, other in four]
        controls.phones.receive(number, Touches())
        assert noticed(controls) == []


def test_every_button_is_reported_once_and_labelled(controls: Controls, clock: Clock) -> None:
    number, device = join(controls)
    for button, bit in BITS.items():
        controls.phones.receive(number, Touches(buttons=bit))
        assert noticed(controls) == [(button, device)]
        assert controls.holds(device, button)
        controls.phones.receive(number, Touches(buttons=bit))
        assert noticed(controls) == []
        assert controls.label(device, button)
        controls.phones.receive(number, Touches())
        assert noticed(controls) == []
        assert not controls.touched(device)
    assert controls.last == device
    assert controls.label(None, Button.FIRE) == "A"
    assert controls.name(device) == "Phone"


def test_the_stick_drives_ahead_and_clockwise_and_steers_menus(controls: Controls, clock: Clock) -> None:
    number, device = join(controls)
    controls.phones.receive(number, Touches(0.0, -1.0))
    assert controls.drive(device) == StickState(linear=1.0)
    assert noticed(controls) == [(Button.UP, device)]
    assert controls.repeats(FIRST_REPEAT) == [InputEvent(Button.UP, device, repeat=True)]
    controls.phones.receive(number, Touches(1.0, 0.0))
    assert controls.drive(device) == StickState(angular=1.0)
    assert noticed(controls) == [(Button.RIGHT, device)]
    controls.phones.receive(number, Touches(0.15, -0.15))
    assert controls.drive(device) == STILL, "a thumb that rests"
    assert noticed(controls) == []
    assert controls.repeats(FIRST_REPEAT) == []


def test_a_tap_between_two_frames_fires_exactly_once(controls: Controls, clock: Clock) -> None:
    number, device = join(controls)
    controls.phones.receive(number, Touches(buttons=FIRE))
    assert controls.drive(device) == STILL, "buttons count from the frame on that reports them"
    controls.phones.receive(number, Touches())
    assert noticed(controls) == [(Button.FIRE, device)]
    assert [controls.drive(device).fire for _ in range(3)] == [True, False, False]
    controls.phones.receive(number, Touches(buttons=TURBO))
    controls.phones.receive(number, Touches())
    noticed(controls)
    assert [controls.drive(device).turbo for _ in range(3)] == [True, False, False]


def test_a_silent_phone_stands_still(controls: Controls, clock: Clock) -> None:
    number, device = join(controls)
    controls.phones.receive(number, Touches(0.0, -1.0, FIRE))
    noticed(controls)
    assert controls.drive(device) == StickState(1.0, 0.0, True)
    assert controls.drive(device) == StickState(1.0, 0.0, True)
    clock.now = FRESH_SECONDS + 0.01
    assert controls.drive(device) == STILL


def test_a_lost_phone_is_an_unplugged_pad(controls: Controls, clock: Clock) -> None:
    number, device = join(controls)
    controls.phones.receive(number, Touches(0.0, -1.0, FIRE))
    noticed(controls)
    controls.phones.disconnect(number)
    assert controls.connected(device), "until the main loop knows"
    assert noticed(controls) == [(Button.LOST, device)]
    assert not controls.connected(device)
    assert controls.drive(device) == STILL
    assert not controls.touched(device)
    assert controls.repeats(FIRST_REPEAT) == []
    assert controls.last != device
    assert controls.handhelds() == []
    controls.phones.connect(number)
    assert noticed(controls) == [(Button.FOUND, device)]
    assert controls.drive(device) == STILL, "nothing held before counts"


def test_a_phone_that_comes_and_goes_within_a_frame_is_not_noticed(controls: Controls, clock: Clock) -> None:
    controls.phones.disconnect(controls.phones.connect())
    assert noticed(controls) == []


def test_a_rumble_and_the_seat_are_sent_once(controls: Controls, clock: Clock) -> None:
    sent: list[tuple[int, str]] = []
    controls.phones.send = lambda number, text: sent.append((number, text))
    number, device = join(controls)
    controls.rumble(device, 0.9, 0.6, 0.28)
    assert sent == [(number, '{"rumble": [0.9, 0.6, 280]}')]
    for seat in (1, 1, 2):
        controls.phones.show(number, SeatView(seat, "#ff9200", True))
    assert [(to, json.loads(text)["state"]) for to, text in sent[1:]] == [
        (number, asdict(SeatView(seat, "#ff9200", True))) for seat in (1, 2)
    ]
    controls.stop_rumble()
    assert sent[3:] == [(number, '{"rumble": [0.0, 0.0, 0]}')]


def test_the_language_of_the_page_follows_the_screen(controls: Controls, clock: Clock) -> None:
    sent: list[str] = []
    controls.phones.send = lambda number, text: sent.append(text)
    number, device = join(controls)
    for word in ("fire", "fire", "Feuer"):
        controls.phones.translate(number, {"page_fire": word})
    controls.phones.disconnect(number)
    assert noticed(controls) == [(Button.LOST, device)]
    controls.phones.translate(number, {"page_fire": "tir"})
    controls.phones.connect(number)
    assert noticed(controls) == [(Button.FOUND, device)]
    controls.phones.translate(number, {"page_fire": "Feuer"})
    assert [json.loads(text)["texts"]["page_fire"] for text in sent] == ["fire", "Feuer", "Feuer"]


def test_what_is_queued_while_nobody_reads_is_limited() -> None:
    phones = Phones()
    number = phones.connect()
    accepted = [phones.receive(number, Touches(buttons=ALL_BITS * (i % 2))) for i in range(1, MAX_CHANGES)]
    assert accepted[0]
    assert not accepted[-1]
