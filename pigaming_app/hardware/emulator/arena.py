"""The emulated arena: four true robots on a mat, a camera and a projector over it, and a radio, in simulated time.

It stands in for everything outside the computer, and shares no calibration and no protocol code with what it proves.
The same seed and the same calls give the same run. Poses go in and out in arena px, as the games have them; inside,
all is in mm on the mat.
"""

from collections import deque
from math import atan2, cos, sin
from random import Random
from threading import Lock

import numpy as np

from pigaming_app.hardware.emulator.camera import EmulatedCamera, FrameTiming
from pigaming_app.hardware.emulator.faults import FaultInjector
from pigaming_app.hardware.emulator.firmware import Firmware
from pigaming_app.hardware.emulator.objects import Placing
from pigaming_app.hardware.emulator.optics import CANVAS, Optics
from pigaming_app.hardware.emulator.radio import EmulatedRadio, RadioChannel
from pigaming_app.hardware.emulator.renderer import CameraScene, SceneRenderer
from pigaming_app.hardware.emulator.robots import STEP, EmulatedRobot, drawn, part
from pigaming_app.hardware.signals import Image
from pigaming_app.sim.plant import Pose

ARENA_AT = (160.0, 140.0)  # px: where the arena lies on the canvas
STARTS: tuple[Pose, ...] = ((200, 200, 0.8), (1400, 200, 2.4), (1400, 700, 3.9), (200, 700, 5.5))
OPEN = 3  # steps that the shutter is open
SHOWS_AFTER = 0.025  # s from a picture being drawn to its light
REFRESH = 0.01  # s: of two pictures closer together, the projector shows only the second
LIGHT_TURN = 40.0  # s that the wandering light needs for its way
RESTLESS = 6.0  # s between two steps of the exposure


class EmulatedArena:
    """The mat and all that is around it. `camera` is a CameraSource, `radio` a SerialPort, `faults` what goes wrong.

    `unrest` is the size of the exposure steps that come by themselves, as a share; `begin` is the time (s) at which
    the clock starts; `refresh` is the painter's: 1 paints every picture whole.
    """

    def __init__(
        self,
        seed: int = 1,
        pace: FrameTiming | None = None,
        air: RadioChannel | None = None,
        refresh: int = 1,
        unrest: float = 0.0,
        begin: float = 0.0,
    ) -> None:
        random = Random(f"arena {seed}")
        self.ticks, self.begin = 0, begin  # ticks of STEP
        self.optics = Optics()
        self.robots = [
            EmulatedRobot(drawn(random), *self._on_mat(pose), Random(f"{seed} {i}")) for i, pose in enumerate(STARTS)
        ]
        self.firmwares = [Firmware(robot, i + 1) for i, robot in enumerate(self.robots)]
        self.radio = EmulatedRadio(self.firmwares, air or RadioChannel(), self.clock, seed)
        self.camera = EmulatedCamera(SceneRenderer(self.optics, seed, refresh), pace or FrameTiming(), self.clock, seed)
        self.faults = FaultInjector(self)
        self.gain = 1.0  # of the exposure
        self.cleared = False  # whether the robots are off the mat, where the camera does not see them
        self.ran = [float("-inf")] * len(self.robots)  # s, when a robot's motors were last given anything
        self._unrest, self._restless = unrest, Random(f"exposure {seed}")
        self._own_gain, self._next_gain = 1.0, begin + RESTLESS
        self._shown: Image = np.zeros((CANVAS[1], CANVAS[0]), dtype=np.uint8)
        self._coming: deque[tuple[float, Image]] = deque()
        self._queue = Lock()  # on `_coming`: the window projects while time passes in another thread
        self._past: deque[list[Placing]] = deque(maxlen=OPEN)

    def clock(self) -> float:
        """Simulated time in s."""
        return self.begin + self.ticks * STEP

    def advance(self, seconds: float) -> None:
        """Let time pass, rounded to whole steps."""
        for _ in range(round(seconds / STEP)):
            self._step()

    def skip(self, seconds: float) -> None:
        """Put the clock forward: nothing happens in that time."""
        self.begin += seconds
        self.camera.due += seconds
        self._next_gain += seconds

    def project(self, image: Image) -> None:
        """Show a grey picture (1080, 1920). The array is kept: hand in another next time."""
        due = self.clock() + SHOWS_AFTER
        with self._queue:
            if self._coming and due - self._coming[-1][0] < REFRESH:
                due = self._coming.pop()[0]
            self._coming.append((due, image))

    def poses(self) -> list[Pose]:
        """Where the robots truly are, in arena px."""
        reach = np.array([(0.5 * cos(robot.heading), 0.5 * sin(robot.heading)) for robot in self.robots])
        middle = np.array([(robot.x, robot.y) for robot in self.robots])
        front, back = self.optics.canvas(middle + reach), self.optics.canvas(middle - reach)
        at, along = (0.5 * (front + back) - ARENA_AT).tolist(), (front - back).tolist()
        return [(x, y, atan2(dy, dx)) for (x, y), (dx, dy) in zip(at, along, strict=True)]

    def place(self, robot: int, pose: Pose) -> None:
        """Put a robot somewhere, in arena px."""
        body = self.robots[robot]
        body.x, body.y, body.heading = self._on_mat(pose)

    def _on_mat(self, pose: Pose) -> tuple[float, float, float]:
        x, y, heading = pose
        on_canvas = np.array([(x, y), (x + cos(heading), y + sin(heading))]) + ARENA_AT
        (x, y), (further, lower) = self.optics.mat(on_canvas).tolist()
        return x, y, atan2(lower - y, further - x)

    def _step(self) -> None:
        self.ticks += 1
        now = self.clock()
        self.radio.step()
        self.faults.tick(now)
        for i, robot in enumerate(self.robots):
            robot.roll()
            if robot.left or robot.right:
                self.ran[i] = now
        part(self.robots)
        with self._queue:
            while self._coming and self._coming[0][0] <= now:
                self._shown = self._coming.popleft()[1]
        self._past.append([(robot.x, robot.y, robot.heading) for robot in self.robots])
        if now >= self.camera.due:
            self.camera.expose(self._scene(now), now - 0.5 * STEP * (OPEN - 1))

    def _scene(self, now: float) -> CameraScene:
        if now >= self._next_gain:
            self._next_gain += RESTLESS
            self._own_gain = 1.0 + self._unrest * self._restless.uniform(-1.0, 1.0)
        things = []
        for i in range(0 if self.cleared else len(self.robots)):
            things += self.faults.things(i, tuple(moment[i] for moment in self._past))
        gain = self.gain * self._own_gain
        return CameraScene(self._shown, tuple(things), (now - self.begin) / LIGHT_TURN, gain, self.camera.exposed)
