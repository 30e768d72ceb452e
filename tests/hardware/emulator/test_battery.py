"""Battery voltages at the arcade, measured by ADCs that follow the data sheets of the chips."""

import runpy
from types import SimpleNamespace

import pytest

from pigaming_app.hardware.emulator.wifi.boards import HERE
from pigaming_app.hardware.radio.packets import EMPTY, LOW, report_from

adc = SimpleNamespace(**runpy.run_path(str(HERE / "adc.py")))

ERROR = 25  # mV, stated in docs/hardware.md
PICO, PICO_STEP = "board_pico_w", 3300 / 4096
# Voltages at a pin of a real ESP32 and its readings at 11 dB: github.com/espressif/arduino-esp32/issues/92
MEASURED = {1641: 1814, 819: 823, 2462: 2811}


class Pin:
    """A pin at a voltage, mV, of a chip with a reference, mV."""

    def __init__(self, name, millivolts, reference=1100):
        self.name, self.voltages = name, (millivolts, reference)

    def analog(self):
        return self.voltages


def test_the_emulated_esp32_reads_like_a_real_one_of_a_reference_of_its_own():
    for millivolts, reading in MEASURED.items():
        assert abs(adc.Esp32(Pin("34", millivolts, 1128), adc.Esp32.ATTN_11DB).read() - reading) <= 4


def test_readings_are_those_of_the_documents():
    usual = {mv: adc.Esp32(Pin("34", mv), adc.Esp32.ATTN_11DB) for mv in (0, 142, 1792.1, 4000)}
    assert [sensor.read() for sensor in usual.values()] == [0, 0, 2048, 4095]
    assert [sensor.read_uv() for sensor in usual.values()] == [142_000, 142_000, 1_792_000, 3_441_000]
    assert usual[1792.1].read_u16() == 2048 << 4 | 2048 >> 8
    assert adc.Rp2(Pin("26", 3300)).read_u16() == 65535
    assert adc.Rp2(Pin("26", 1650)).read_u16() == pytest.approx(32768, abs=16)
    assert not hasattr(adc.Rp2, "read_uv"), "MicroPython has none for this chip"
    for kind, pin in ((adc.Esp32, "25"), (adc.Rp2, "22")):
        with pytest.raises(ValueError, match=r"invalid pin|capabilities"):
            kind(Pin(pin, 0))


def voltages_at_arcade(arcade, **disturbances):
    """Battery voltage in the next report, mV, and its flags, once the average has settled."""
    arcade.boards.disturb(0, **disturbances)
    for _ in range(30):
        arcade.send(arcade.packet() if arcade.config.radio == "serial_radio" else arcade.sealed())
        arcade.now += 0.02
        arcade.boards.advance(arcade.now, [arcade.delivered])
    report = arcade.received(b"PG2T")[-1][12:-8] if arcade.nonce else arcade.received(b"\xd5")[-1]
    return report_from(report).millivolts, report_from(report).flags & (LOW | EMPTY)


@pytest.mark.long
@pytest.mark.parametrize(
    ("arcade", "references"),
    [
        ({"board": "board_esp32"}, (1000, 1060, 1100, 1200)),
        ({"board": PICO}, (1100,)),
        ({"board": "board_pololu_2040", "radio": "serial_radio"}, (1100,)),
    ],
    ids=["ESP32", "Pico W", "3pi+ 2040"],
    indirect=["arcade"],
)
def test_the_voltage_of_the_battery_reaches_the_arcade(arcade, references):
    if arcade.config.radio == "wifi":
        arcade.meet()
    for reference in references:
        for volts in (7300, 6400, 5800, 5200, 4800, 4390, 3990, 3000, 1500, 800):
            found, flags = voltages_at_arcade(arcade, battery=volts, reference=reference)
            assert abs(found - volts) <= ERROR, (volts, reference)
            assert flags == LOW * (volts < 4400) | EMPTY * (volts < 4000), (volts, reference)
