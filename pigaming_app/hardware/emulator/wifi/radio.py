"""Wi-Fi robots of an emulated arena: their boards drive its motors.

It takes the place of the arena's radio, so the same faults can be injected.
"""

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.radio import EmulatedRadio, RadioChannel
from pigaming_app.hardware.emulator.wifi.air import Air, WifiChannel
from pigaming_app.hardware.emulator.wifi.boards import BoardConfig, Boards

CELLS_EVERY = 0.02  # s between two looks at the batteries
BOARDS = ("board_esp32", "board_pico_w")  # in turn


class WifiRadio(EmulatedRadio):
    """Four boards, the network to an arcade at UDP port `arcade`, and their wires to motors and batteries.

    `number` and `key` are those of the arena. The boards' time is the arena's if `paced`, else the system's. Raises
    NoMicroPython.
    """

    def __init__(
        self, arena: EmulatedArena, channel: WifiChannel, arcade: int, number: int, key: bytes, paced: bool = True
    ) -> None:
        super().__init__(arena.firmwares, RadioChannel(), arena.clock, number)
        self._arena = arena
        self._powered = [True] * len(arena.robots)
        self._cells = [0] * len(arena.robots)  # mV
        self._cells_at = float("-inf")
        self.air = Air(len(arena.robots), arcade, channel, number)
        configs = [
            BoardConfig(i + 1, number, key, self.air.port(i), f"Robot {i + 1}", BOARDS[i % len(BOARDS)])
            for i in range(len(arena.robots))
        ]
        self._paced, self.boards = paced, Boards(configs, paced)
        self.air.robots = self.boards.ports

    def step(self) -> None:
        """Advance paced boards to the arena's time and apply the outputs of all."""
        arena, now = self._arena, self._arena.clock()
        self.air.dead, self.air.extra_loss = self.dead, self.extra_loss
        self.air.mute = {robot for robot, firmware in enumerate(arena.firmwares) if firmware.mute}
        self.air.pump(now)
        if now >= self._cells_at:
            self._cells_at = now + CELLS_EVERY
            self._supply()
        if self._paced:
            self.boards.advance(now - arena.begin, self.air.delivered)
        for robot, body in enumerate(arena.robots):
            body.left, body.right = self.boards.motors(robot) if body.alive else (0.0, 0.0)

    def end(self) -> None:
        """End boards and network. Idempotent."""
        self.boards.close()
        self.air.close()

    def _supply(self) -> None:
        """Batteries of the arena's robots, and their switches."""
        for robot, body in enumerate(self._arena.robots):
            if body.alive != self._powered[robot]:
                self._powered[robot] = body.alive
                self.boards.disturb(robot, do="reboot" if body.alive else "off")
            if (millivolts := round(1000 * body.battery)) != self._cells[robot]:
                self._cells[robot] = millivolts
                self.boards.disturb(robot, battery=millivolts)
