"""Motor drivers. `drive` takes a speed from -63 to 63, 0 brakes; it allocates no memory, so a timer may call it."""

from machine import PWM, Pin

FULL, TOP, HERTZ = 63, 65535, 20000


class Motor:
    """A motor without an encoder: the speed code sets the voltage."""

    def drive(self, speed):
        self.set(speed * TOP // FULL)

    def regulate(self, ms):
        """Only motors with an encoder are regulated, see Regulated."""


class InIn(Motor):
    """DRV8833: two PWM inputs a motor; slow decay, both high brakes."""

    def __init__(self, ahead, back):
        self.ahead, self.back = PWM(Pin(ahead), freq=HERTZ), PWM(Pin(back), freq=HERTZ)

    def set(self, duty):
        self.ahead.duty_u16(TOP if duty >= 0 else TOP + duty)
        self.back.duty_u16(TOP if duty <= 0 else TOP - duty)


class Enable(Motor):
    """TB6612 or L298N: PWM input and two direction inputs a motor; both direction inputs high brake.

    A TB6612 also needs its pin STBY high: wire it to 3.3 V. An L298N switches slowly: `hertz` 2000.
    """

    def __init__(self, pwm, ahead, back, hertz=HERTZ):
        self.pwm, self.ahead, self.back = PWM(Pin(pwm), freq=hertz), Pin(ahead, Pin.OUT), Pin(back, Pin.OUT)

    def set(self, duty):
        self.ahead.value(duty >= 0)
        self.back.value(duty <= 0)
        self.pwm.duty_u16(abs(duty) if duty else TOP)


class Phase(Motor):
    """DRV8838 and others with one PWM and one direction input a motor, as on Pololu's robots; no PWM brakes."""

    def __init__(self, pwm, back):
        self.pwm, self.back = PWM(Pin(pwm), freq=HERTZ), Pin(back, Pin.OUT)

    def set(self, duty):
        self.back.value(duty < 0)
        self.pwm.duty_u16(abs(duty))


class Regulated:
    """A motor with an encoder on pin `pulses`, `top` pulses a second at full speed: an integral term holds it."""

    def __init__(self, motor, pulses, top):
        self.motor, self.top = motor, top
        self.speed = self.count = self.trim = 0
        pin = Pin(pulses, Pin.IN, Pin.PULL_UP)
        try:
            pin.irq(handler=self._pulse, trigger=Pin.IRQ_RISING, hard=True)
        except (TypeError, ValueError):  # ESP32
            pin.irq(handler=self._pulse, trigger=Pin.IRQ_RISING)

    def _pulse(self, pin):
        self.count += 1

    def drive(self, speed):
        if not speed or (speed > 0) != (self.speed > 0):
            self.trim = 0
        self.speed = speed
        duty = speed * TOP // FULL + (self.trim if speed > 0 else -self.trim if speed else 0)
        self.motor.set(max(-TOP, min(TOP, duty)) if duty * speed > 0 else 0)

    def regulate(self, ms):
        """Correct the voltage, about every 20 ms, by a part of the speed missing in the last `ms`.

        The correction is at most a quarter of full voltage, with a dead encoder too.
        """
        count, self.count = self.count, 0
        if self.speed:
            missing = abs(self.speed) * TOP // FULL - count * 1000 // ms * TOP // self.top
            self.trim = max(-TOP // 4, min(TOP // 4, self.trim + missing // 32))
            self.drive(self.speed)
