"""An XBee in its carrier is found in any mode, written, saved and read back; refusals are one sentence."""

import pytest

from pigaming_app.hardware.emulator.arena import ARENA_ID, EmulatedArena
from pigaming_app.hardware.emulator.xbee import EmulatedCarrier as EmulatedCarrier
from pigaming_app.hardware.emulator.xbee import Module
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.radio.xbee_protocol import XBeeProtocol
from pigaming_app.hardware.radio.xbee_setup import Carrier, RadioNetwork, XBeeSetup, network_of, parameters
from pigaming_app.storage.messages import OperatorError
from tests.hardware.sentences import sentence
from tests.hardware.wire import Time

NETWORK = network_of(4711)


class Cable(EmulatedCarrier):
    """The carrier on a cable that is pulled after so many accesses; `late`: s until an answer arrives."""

    accesses, late = 10**9, 0.0

    @property
    def in_waiting(self):
        self._access()
        waiting = super().in_waiting
        return waiting if self.clock() - self._last >= self.late else 0

    def write(self, data):
        self._access()
        return super().write(data)

    def _access(self):
        self.accesses -= 1
        if self.accesses < 0:
            raise OSError(5, "Input/output error")


def set_up(module, number, mode="api2", network=NETWORK, baud=57600, cable=None):
    """Write a module in simulated time; returns the seconds needed."""
    cable = cable or Cable(module, Time())
    time, begun = cable.clock, cable.clock.now
    carrier = Carrier(cable.open, time, "COM3")
    for _ in XBeeSetup(carrier, parameters(number, network, mode, baud), baud).steps():
        time.now += 0.01
        assert time.now < begun + 10.0
    return time.now - begun


def test_network_and_addresses_follow_from_the_arena():
    """4711 is 1267 (hex); channels are those that an XBee-PRO takes as well."""
    assert RadioNetwork(0x13, 0x5267) == NETWORK
    assert {network_of(arena).channel for arena in range(1, 100)} == {*range(0x0C, 0x18)}
    assert network_of(4711, 0x1A, 0x3332) == (0x1A, 0x3332)
    assert str(NETWORK) == "CH 13, ID 5267"
    robot = {"CH": 0x13, "ID": 0x5267, "MY": 2, "DH": 0, "DL": 0, "BD": 6, "AP": 0}
    assert parameters(2, NETWORK, "api2", 57600) == robot
    assert parameters(0, NETWORK, "transparent", 57600)["DL"] == 0xFFFF


@pytest.mark.parametrize(("mode", "baud"), [(0, 9600), (0, 57600), (1, 57600), (2, 57600)])
@pytest.mark.parametrize(("number", "target"), [(0, "api2"), (0, "api1"), (0, "transparent"), (3, "api2")])
def test_a_radio_in_any_mode_is_written_and_keeps_it(mode, baud, number, target):
    module = Module(mode, 0, baud)
    set_up(module, number, target)
    wanted = parameters(number, NETWORK, target, 57600)
    assert {name.decode(): value for name, value in module.saved.items()} == wanted
    module.power_up()
    assert module.network == NETWORK


@pytest.mark.parametrize("mode", [0, 2])
def test_a_refused_channel_is_one_sentence_and_nothing_is_saved(mode):
    module = Module(mode, 0, top_channel=0x17)
    with pytest.raises(OperatorError) as refusal:
        set_up(module, 0, network=RadioNetwork(0x1A, 1))
    assert sentence(refusal.value) == (
        "The radio at COM3 refuses CH 1A: choose another value. An XBee-PRO takes channels C to 17."
    )
    assert module.saved[b"CH"] == 0x0C


@pytest.mark.parametrize("mode", [0, 1, 2])
def test_after_a_refusal_another_value_is_taken_at_once(mode):
    module = Module(mode, 0, top_channel=0x17)
    cable = Cable(module, Time())
    with pytest.raises(OperatorError):
        set_up(module, 0, network=RadioNetwork(0x1A, 1), cable=cable)
    set_up(module, 0, network=RadioNetwork(0x12, 1), cable=cable)
    assert (module.saved[b"CH"], module.saved[b"ID"]) == (0x12, 1)


def test_who_gives_up_midway_can_begin_again_at_once():
    module, time = Module(0, 0), Time()
    cable = Cable(module, time)
    cable.late = 0.015
    carrier = Carrier(cable.open, cable.clock, "COM3")
    steps = XBeeSetup(carrier, parameters(2, NETWORK, "api2", 57600), 57600).steps()
    while module.values[b"ID"] != NETWORK.pan:
        next(steps)
        time.now += 0.01
    steps.close()
    assert module.saved[b"ID"] != NETWORK.pan
    assert set_up(module, 2, cable=cable) < 4.0
    assert module.saved[b"ID"] == NETWORK.pan


@pytest.mark.parametrize("name", [b"CH", b"ID", b"MY", b"DL", b"BD", b"AP"])
def test_a_value_that_is_taken_but_not_kept_is_named(name, monkeypatch):
    """Every wanted value differs from the one that the radio keeps."""
    module = Module(0, 9, baud=9600)
    command, kept = module.command, module.values[name]

    def forgetful(asked, given):
        answer = command(asked, given)
        if asked == b"WR":
            module.values[name] = kept
        return answer

    monkeypatch.setattr(module, "command", forgetful)
    module.values[b"DH"] = 1
    with pytest.raises(OperatorError) as refusal:
        set_up(module, 0, "transparent" if name == b"DL" else "api2")
    assert refusal.value.message.key == "radio_setup_unsaved"
    assert name.decode() in sentence(refusal.value)


@pytest.mark.parametrize(("mode", "number"), [(0, 3), (2, 0)])
def test_a_radio_unplugged_at_any_time_is_one_sentence_and_can_be_written_again(mode, number):
    keys: list[str] = []
    for accesses in range(0, 10**4, 3 if mode else 7):
        module = Module(mode, number)
        before, cable = dict(module.saved), Cable(module, Time())
        cable.accesses = accesses
        try:
            set_up(module, number, cable=cable)
        except OperatorError as trouble:
            keys.append(trouble.message.key)
        else:
            break
        wanted = {name.encode(): value for name, value in parameters(number, NETWORK, "api2", 57600).items()}
        assert module.saved in (before, wanted), "all or nothing"
        module.power_up()
        set_up(module, number)
        assert module.saved == wanted
    assert len(keys) > 5
    assert set(keys) == {"radio_unplugged"}


def test_no_radio_and_a_lost_one_are_one_sentence():
    module = Module(2, 0, 115200)  # a rate that is not tried
    with pytest.raises(OperatorError) as refusal:
        set_up(module, 0)
    assert sentence(refusal.value).startswith("No XBee answers at COM3: put it into the USB carrier")

    def absent(baud):
        raise FileNotFoundError(2, "could not open port")

    with pytest.raises(OperatorError) as refusal:
        next(XBeeSetup(Carrier(absent, Time(), "COM3"), {}, 57600).steps())
    assert refusal.value.message.key == "radio_absent"


def test_on_a_new_channel_only_robots_that_followed_are_heard():
    arena = EmulatedArena(1)
    arena.camera.due = float("inf")
    link = Link(arena.radio.open, arena.clock, XBeeProtocol(ARENA_ID))

    def heard(seconds=0.5):
        begun = arena.clock()
        for _ in range(round(seconds / 0.02)):
            link.pump()
            arena.advance(0.02)
        return sorted(robot for robot, report in link.telemetry.items() if report.received > begun + 0.25)

    assert heard() == [0, 1, 2, 3]
    set_up(arena.radio.module, 0)
    assert heard() == []
    assert link.fault is None
    set_up(arena.radio.modules[2], 3)
    assert heard() == [2]
