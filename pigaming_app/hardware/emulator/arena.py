"""The emulated arena: four robots on a mat, a camera and a projector over it, and a radio, in simulated time.

It replaces everything outside the computer and shares no calibration or protocol code with the code under test. The
same seed and calls give the same run. Poses in the interface are in arena px; internally all lengths are mm on the mat.
"""

from collections import deque
from collections.abc import Sequence
from math import atan2, ceil, cos, sin
from random import Random
from threading import Lock

import numpy as np

from pigaming_app.hardware.emulator.camera import CameraTraits, EmulatedCamera, FrameTiming
from pigaming_app.hardware.emulator.faults import FaultInjector
from pigaming_app.hardware.emulator.firmware import Firmware
from pigaming_app.hardware.emulator.objects import LID_HEIGHT, SHEET, FlatObject, Placing
from pigaming_app.hardware.emulator.optics import CANVAS, SENSOR, Floats, Optics
from pigaming_app.hardware.emulator.radio import EmulatedRadio, RadioChannel
from pigaming_app.hardware.emulator.renderer import ExposureSetup, SceneRenderer
from pigaming_app.hardware.emulator.robots import BASE, FULL_SPEED, STEP, EmulatedRobot, push_apart, random_parameters
from pigaming_app.hardware.emulator.television import Television
from pigaming_app.hardware.emulator.things.prism import Prism, obstacles, push_off
from pigaming_app.hardware.signals import Image
from pigaming_app.sim.plant import Pose

ARENA_AT = (160.0, 140.0)  # px, the arena's top left corner on the canvas
STARTS: tuple[Pose, ...] = ((200, 200, 0.8), (1400, 200, 2.4), (1400, 700, 3.9), (200, 700, 5.5))
LONGEST = 0.1  # s of the past that a picture may cover
MOMENTS = 9  # poses in an exposure, at most
SHOWS_AFTER = 0.025  # s, latency of the projector
REFRESH = 0.01  # s, least interval of two projected pictures; of two closer ones only the second is shown
LIGHT_TURN = 40.0  # s, period of the moving light
ARENA_ID = 4711  # of robots and computer, see firmware
EXPOSURE_PERIOD = 6.0  # s between two exposure steps


class EmulatedArena:
    """The mat and its surroundings. `camera` is a CameraSource, `radio` a SerialPort, `faults` a FaultInjector.

    `exposure_jitter`: size of spontaneous exposure steps, as a share; `begin`: start of the clock, s; `refresh`: see
    SceneRenderer, 1 renders every picture completely; `arena_id`: of its robots; `traits`: of the camera;
    `wheels`: their nominal speed, mm/s, and mm between them.
    """

    def __init__(
        self,
        seed: int = 1,
        timing: FrameTiming | None = None,
        channel: RadioChannel | None = None,
        refresh: int = 1,
        exposure_jitter: float = 0.0,
        begin: float = 0.0,
        arena_id: int = ARENA_ID,
        traits: CameraTraits | None = None,
        optics: Optics | None = None,
        wheels: tuple[float, float] = (FULL_SPEED, BASE),
    ) -> None:
        random = Random(f"arena {seed}")
        self.ticks, self.begin, self.arena_id = 0, begin, arena_id  # ticks of STEP
        traits = traits or CameraTraits()
        self.optics = optics or Optics(traits.lens)
        self.robots = [
            EmulatedRobot(random_parameters(random, *wheels), *self._on_mat(pose), Random(f"{seed} {i}"))
            for i, pose in enumerate(STARTS)
        ]
        self.firmwares = [Firmware(robot, i + 1, arena_id) for i, robot in enumerate(self.robots)]
        self.radio = EmulatedRadio(self.firmwares, channel or RadioChannel(), self.clock, seed)
        painter = SceneRenderer(self.optics, seed, refresh, size=traits.size, defocus=traits.defocus, jpeg=traits.jpeg)
        self.camera = EmulatedCamera(painter, timing or FrameTiming(), self.clock, seed, traits)
        self.lids = list(SHEET)  # marker on each robot's lid
        self.faults = FaultInjector(self)
        self.things: tuple[Prism, ...] = ()  # on the mat
        self._obstacles: list[Prism] = []  # those that stop robots
        self.gain = 1.0  # exposure
        self.television: Television | None = None  # in place of the mat
        self.cleared = False  # True if the robots are off the mat, out of view
        self.last_driven = [float("-inf")] * len(self.robots)  # s, when a robot's motors last ran
        self._exposure_jitter, self._exposure_random = exposure_jitter, Random(f"exposure {seed}")
        self._drift_gain, self._next_gain = 1.0, begin + EXPOSURE_PERIOD
        self._shown: Image = np.zeros((CANVAS[1], CANVAS[0]), dtype=np.uint8)
        self._pending: deque[tuple[float, Image]] = deque()
        self._queue = Lock()  # guards `_pending`: the window projects while another thread advances time
        self._past: deque[list[Placing]] = deque(maxlen=round(LONGEST / STEP))

    def clock(self) -> float:
        """Simulated time, s."""
        return self.begin + self.ticks * STEP

    def advance(self, seconds: float) -> None:
        """Advance time, rounded to whole steps."""
        for _ in range(round(seconds / STEP)):
            self._step()

    def skip(self, seconds: float) -> None:
        """Set the clock forward without simulating that time."""
        self.begin += seconds
        self.camera.due += seconds
        self._next_gain += seconds

    def project(self, image: Image) -> None:
        """Show a grey picture (1080, 1920). The array is kept without a copy: do not modify it."""
        due = self.clock() + SHOWS_AFTER
        with self._queue:
            if self._pending and due - self._pending[-1][0] < REFRESH:
                due = self._pending.pop()[0]
            self._pending.append((due, image))

    def project_window(self, pixels: Image) -> None:
        """Show a window's pixels, (height, width, 4) BGRA, of any size.

        The projector has the canvas's aspect ratio: of a window with another one it shows the centre, without the bars.
        """
        import cv2

        height, width = pixels.shape[:2]
        scale = min(width / CANVAS[0], height / CANVAS[1])
        left, top = round(width - scale * CANVAS[0]) // 2, round(height - scale * CANVAS[1]) // 2
        grey = cv2.cvtColor(pixels[top : height - top, left : width - left], cv2.COLOR_BGRA2GRAY)
        if (grey.shape[1], grey.shape[0]) != CANVAS:
            grey = cv2.resize(grey, CANVAS, interpolation=cv2.INTER_AREA)
        self.project(np.asarray(grey, dtype=np.uint8))

    def poses(self) -> list[Pose]:
        """True poses of the robots, arena px and rad."""
        reach = np.array([(0.5 * cos(robot.heading), 0.5 * sin(robot.heading)) for robot in self.robots])
        middle = np.array([(robot.x, robot.y) for robot in self.robots])
        front, back = self.optics.canvas(middle + reach), self.optics.canvas(middle - reach)
        at, along = (0.5 * (front + back) - ARENA_AT).tolist(), (front - back).tolist()
        return [(x, y, atan2(dy, dx)) for (x, y), (dx, dy) in zip(at, along, strict=True)]

    def place(self, robot: int, pose: Pose) -> None:
        """Place a robot, arena px and rad."""
        body = self.robots[robot]
        body.x, body.y, body.heading = self._on_mat(pose)

    def lay_television(self, television: Television) -> None:
        """Replace mat and projector by a television; `Optics` has the corners of its picture."""
        self.television = television
        self.camera.painter.lay_television(television)

    def furnish(self, things: Sequence[Prism]) -> None:
        """Put these things on the mat, in place of all that stand on it."""
        self.things = tuple(things)
        self._obstacles = obstacles(self.things)
        self.camera.painter.furnish(self.things)

    def outline(self, thing: Prism) -> Floats:
        """True outline of a thing on the mat, arena px, (n, 2)."""
        return self.optics.canvas(np.array(thing.outline)) - ARENA_AT

    def _seen(self, robot: int) -> list[FlatObject]:
        """The objects of a robot, with its poses while its row of the sensor is exposed."""
        readout, open_for = self.camera.traits.readout, max(1, round(self.camera.shutter / STEP))
        path = [moment[robot] for moment in self._past]
        if not readout:
            return self.faults.things(robot, tuple(path[-open_for :: ceil(open_for / MOMENTS)]))
        row = float(self.optics.sensor(np.array([path[-1][:2]]), LID_HEIGHT)[0, 1]) / SENSOR[1]
        last = max(0, len(path) - 1 - round(readout * (1.0 - min(max(row, 0.0), 1.0)) / STEP))
        poses = tuple(path[max(0, last - open_for + 1) : last + 1 : ceil(open_for / MOMENTS)])
        (x, y, _), (to_x, to_y, _) = path[max(0, last - 1)], path[last]
        pace = readout / SENSOR[1] / STEP
        slant = (to_x - x) * pace, (to_y - y) * pace
        return [thing._replace(slant=slant) for thing in self.faults.things(robot, poses)]

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
                self.last_driven[i] = now
        push_apart(self.robots)
        push_off(self.robots, self._obstacles)
        with self._queue:
            while self._pending and self._pending[0][0] <= now:
                self._shown = self._pending.popleft()[1]
        self._past.append([(robot.x, robot.y, robot.heading) for robot in self.robots])
        if now >= self.camera.due:
            self.camera.expose(self._scene(now), now - 0.5 * (self.camera.shutter + self.camera.traits.readout - STEP))

    def _scene(self, now: float) -> ExposureSetup:
        if now >= self._next_gain:
            self._next_gain += EXPOSURE_PERIOD
            self._drift_gain = 1.0 + self._exposure_jitter * self._exposure_random.uniform(-1.0, 1.0)
        things = []
        for i in range(0 if self.cleared else len(self.robots)):
            things += self._seen(i)
        shine: tuple[float, ...] = (1.0,)
        if self.television:
            shutter, late = self.camera.shutter, self.camera.traits.readout
            begins = (now - shutter - late * (1.0 - share / 64) for share in range(65 if late else 1))
            shine = tuple(self.television.shine(begin, shutter) for begin in begins)
        gain, light = self.gain * self._drift_gain * self.camera.brightness, (now - self.begin) / LIGHT_TURN
        return ExposureSetup(self._shown, tuple(things), light, gain, self.camera.exposed, self.camera.boost, shine)
