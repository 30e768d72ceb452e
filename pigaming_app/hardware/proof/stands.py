"""Stands of the arcade's own drivers: the emulated arena with XBees, micro:bits, boards on Wi-Fi, or Thymios."""

from collections.abc import Callable

from pigaming_app.hardware.drivers.driver import LinkSite, RobotDriver
from pigaming_app.hardware.drivers.ours import RELAY, THYMIO, UDP
from pigaming_app.hardware.drivers.stand import RobotStand
from pigaming_app.hardware.emulator.arena import ARENA_ID, EmulatedArena
from pigaming_app.hardware.emulator.radio import API, API_ESCAPED, TRANSPARENT, EmulatedRadio, RadioChannel
from pigaming_app.hardware.emulator.robots import FULL_SPEED
from pigaming_app.hardware.emulator.thymio import Dongle
from pigaming_app.hardware.emulator.wifi.air import LOOPBACK, WifiChannel
from pigaming_app.hardware.emulator.wifi.radio import WifiRadio
from pigaming_app.hardware.emulator.wifi.relay import MicrobitAir
from pigaming_app.hardware.radio import envelope
from pigaming_app.hardware.radio.aseba import FULL, drive
from pigaming_app.hardware.radio.packets import SEQUENCE, drive_packet
from pigaming_app.hardware.radio.wifi import WifiNetwork
from pigaming_app.hardware.radio.xbee_protocol import XBeeMode, XBeeProtocol
from pigaming_app.hardware.signals import WheelCommand
from pigaming_app.sim.world import ROBOTS

OTHER = 1  # added to the arena id: that of an arcade nearby
KEY, OTHER_KEY = bytes(range(16)), bytes(range(16, 32))
NODES = 7042, 311, 42, 23950  # numbers of the Thymios
MODES = {"api2": API_ESCAPED, "api1": API, "transparent": TRANSPARENT}  # of XBees


class _ArenaStand:
    """The emulated arena on a driver's link."""

    robots = ROBOTS

    def __init__(self, driver: RobotDriver, seed: int, channel: RadioChannel) -> None:
        self.arena = EmulatedArena(seed, channel=channel)
        self.clock, self.network = self.arena.clock, None
        site = LinkSite(self.arena.arena_id, self.clock, "EMU0", open_port=self._port, network=self._new_network)
        self.link = driver.connect(site)

    def advance(self, seconds: float) -> None:
        self.arena.advance(seconds)

    def powered(self, robot: int) -> bool:
        body = self.arena.robots[robot]
        return bool(body.left or body.right)

    def speeds(self, robot: int) -> WheelCommand:
        body = self.arena.robots[robot]
        return WheelCommand(body.left_speed / FULL_SPEED, body.right_speed / FULL_SPEED)

    def lose(self, share: float) -> None:
        self.arena.radio.extra_loss = share

    def switch(self, robot: int, on: bool) -> None:
        self.arena.faults.switch("robot_off", not on, robot)

    def close(self) -> None:
        self.link.close()
        self.arena.radio.end()

    def _port(self, baud: int) -> Callable[[], EmulatedRadio]:
        return self.arena.radio.open

    def _new_network(self) -> WifiNetwork:
        raise NotImplementedError


class XBeeStand(_ArenaStand):
    """Robots with XBees."""

    def __init__(self, driver: RobotDriver, seed: int) -> None:
        channel = RadioChannel(MODES[driver.name])
        super().__init__(driver, seed, channel)
        self._other = EmulatedRadio([], channel, self.clock, seed + 1)
        self._other.neighbours = [self.arena.radio]
        self._protocol = XBeeProtocol(self.arena.arena_id + OTHER, XBeeMode(driver.name))

    def interfere(self, wheels: WheelCommand) -> bool:
        self._other.write(self._protocol.command([wheels] * ROBOTS, self.clock()))
        return True


class RelayStand:
    """Micro:bits that run their own programs: the relay, and four robots without bodies. Raises NoMicroPython."""

    robots = ROBOTS

    def __init__(self, driver: RobotDriver, seed: int) -> None:
        self.air = MicrobitAir(ROBOTS, ARENA_ID, seed)
        self.clock, self._count = self.air.clock, 0
        self.link = driver.connect(LinkSite(ARENA_ID, self.clock, "EMU0", open_port=lambda baud: self.air.open))

    def advance(self, seconds: float) -> None:
        self.air.advance(seconds)

    def powered(self, robot: int) -> bool:
        return any(self.speeds(robot))

    def speeds(self, robot: int) -> WheelCommand:
        return WheelCommand(*self.air.boards.motors(1 + robot))

    def lose(self, share: float) -> None:
        self.air.loss = share

    def switch(self, robot: int, on: bool) -> None:
        self.air.boards.disturb(1 + robot, do="reboot" if on else "off")

    def interfere(self, wheels: WheelCommand) -> bool:
        self._count += 1
        packet = drive_packet(ARENA_ID + OTHER, self._count % SEQUENCE, [wheels] * ROBOTS)
        for robot in range(ROBOTS):
            self.air.put(1 + robot, bytes([ARENA_ID % 84, ARENA_ID // 84]) + packet)  # on our own channel and group
        return True

    def close(self) -> None:
        self.link.close()
        self.air.end()


class ThymioStand:
    """Thymios without bodies, on a dongle; motors follow their targets at once."""

    def __init__(self, driver: RobotDriver, seed: int, dongle: Dongle | None = None) -> None:
        self.dongle = dongle or Dongle(NODES, seed)
        self.robots, self.clock, self.advance = ROBOTS, self.dongle.clock, self.dongle.advance
        self.switch = self.dongle.switch
        self.link = driver.connect(LinkSite(ARENA_ID, self.clock, "EMU0", open_port=lambda baud: self.dongle.open))
        self._count = 0

    def powered(self, robot: int) -> bool:
        return any(self.speeds(robot))

    def speeds(self, robot: int) -> WheelCommand:
        left, right = self.dongle.motors(robot)
        return WheelCommand(left / FULL, right / FULL)

    def lose(self, share: float) -> None:
        self.dongle.loss = share

    def interfere(self, wheels: WheelCommand) -> bool:
        self._count += 1
        self.dongle.put(drive(ARENA_ID + OTHER, self._count, 0, [wheels] * ROBOTS))
        return True

    def close(self) -> None:
        self.link.close()
        self.dongle.end()


class WifiStand(_ArenaStand):
    """Boards that run their own program on a network of their own. Raises NoMicroPython."""

    def __init__(self, driver: RobotDriver, seed: int) -> None:
        self._count = 0
        super().__init__(driver, seed, RadioChannel())

    def interfere(self, wheels: WheelCommand) -> bool:
        radio = self.arena.radio
        assert isinstance(radio, WifiRadio)
        self._count += 1
        packet = drive_packet(self.arena.arena_id + OTHER, self._count % SEQUENCE, [wheels] * ROBOTS)
        for robot in range(ROBOTS):
            sealed = envelope.seal(OTHER_KEY, bytes(envelope.NONCE), envelope.DRIVE, self._count, packet)
            radio.air.inject(robot, sealed)
        return True

    def _new_network(self) -> WifiNetwork:
        network = WifiNetwork(self.arena.arena_id, KEY, self.clock, 0, LOOPBACK).open()
        self.arena.radio = WifiRadio(self.arena, WifiChannel(), network.bound, network.arena, network.key)
        return network


def stand_of(driver: RobotDriver, seed: int) -> RobotStand | None:
    """The emulated robots of a driver; None: it has none. Raises NoMicroPython."""
    if driver.stand is not None:
        return driver.stand(seed)
    if driver.name in MODES:
        return XBeeStand(driver, seed)
    if driver.name == RELAY:
        return RelayStand(driver, seed)
    if driver.name == THYMIO:
        return ThymioStand(driver, seed)
    return WifiStand(driver, seed) if driver.name == UDP else None
