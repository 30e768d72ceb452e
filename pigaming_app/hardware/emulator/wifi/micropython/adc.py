"""ADCs of the emulated chips, as MicroPython offers them, with numbers from the makers' documents alone.

ESP32: ESP-IDF Programming Guide, "Analog to Digital Converter (ADC) Calibration Driver", and its
`adc_cali_line_fitting.c` (ADC1): 12 bits; a reading of 0 is the offset of the attenuation, 142 mV at 11 dB, and a step
is 2.99991 / 4096 of the chip's reference: 0.806 mV at the usual 1100 mV. Chips have 1000 to 1200 mV; the eFuse holds
that in steps of 7 mV. MicroPython's `read_uv` is calibrated by the eFuse, to 1 mV. Real ones bend above a reading of
2880, about 2.46 V.
RP2040 and RP2350: their data sheets, "ADC": 12 bits of the supply, 3.3 V. MicroPython offers `read_u16` alone.
"""

STEPS = 4096


def _filled(raw):
    """A reading of 12 bits in 16, as by MicroPython: 4095 becomes 65535."""
    return raw << 4 | raw >> 8


class Esp32:
    ATTN_0DB, ATTN_2_5DB, ATTN_6DB, ATTN_11DB = 0, 1, 2, 3
    SCALES, OFFSETS = (0.87632707, 1.16327136, 1.60951523, 2.99991113), (75, 78, 107, 142)  # by attenuation; mV
    USUAL, FUSED = 1100, 7  # mV
    PINS = ("32", "33", "34", "35", "36", "37", "38", "39")  # of ADC1; Wi-Fi occupies the other

    def __init__(self, pin, atten=ATTN_0DB):
        if pin.name not in self.PINS:
            raise ValueError("invalid pin")
        self.pin = pin
        self.atten(atten)

    def atten(self, attenuation):
        self.scale, self.offset = self.SCALES[attenuation] / STEPS, self.OFFSETS[attenuation]

    def read(self):
        millivolts, reference = self.pin.analog()
        return max(0, min(STEPS - 1, int((millivolts - self.offset) / (self.scale * reference))))

    def read_u16(self):
        return _filled(self.read())

    def read_uv(self):
        _, reference = self.pin.analog()
        fused = self.USUAL + self.FUSED * round((reference - self.USUAL) / self.FUSED)
        return 1000 * (round(self.read() * self.scale * fused) + self.offset)


class Rp2:
    SUPPLY = 3300  # mV
    PINS = ("26", "27", "28", "29")

    def __init__(self, pin):
        if pin.name not in self.PINS:
            raise ValueError("Pin doesn't have ADC capabilities")
        self.pin = pin

    def read_u16(self):
        millivolts, _ = self.pin.analog()
        return _filled(max(0, min(STEPS - 1, int(millivolts * STEPS / self.SUPPLY))))
