"""Fleet page: camera and radio selection, robot status, pairing and latency."""

import logging
from dataclasses import replace

import pygame

from pigaming_app.hardware.radio.serial_line import ports
from pigaming_app.hardware.session.robot_session import camera_warning
from pigaming_app.hardware.vision.discovery import cameras
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.navigation import Navigation
from pigaming_app.scenes.flow.stack import StackOperation
from pigaming_app.scenes.mat.calibration.picture_quality import exposure_text
from pigaming_app.scenes.mat.robots.avoid_discs import BlockLayout
from pigaming_app.scenes.mat.robots.fleet_state import FleetState, worst_finding
from pigaming_app.scenes.mat.robots.flood_light import FloodLight
from pigaming_app.scenes.mat.robots.marker_discs import MarkerDiscs, tag
from pigaming_app.scenes.mat.session import session_of
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import ALARM, FOCUS, GREEN, ICE, MIST, Color
from pigaming_app.ui.draw.layers import backdrop
from pigaming_app.ui.draw.text import paragraph, text
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.button_prompts import places
from pigaming_app.ui.widgets.focus import Focus
from pigaming_app.ui.widgets.labels import blit_sprite, frame, heading
from pigaming_app.ui.widgets.setting_row import SettingValue

BAUDS = (9600, 19200, 38400, 57600, 111111, 115200, 230400)
RADIOS = ("api2", "api1", "transparent", "udp", "stock")
DEEDS = ("pair", "latency")
ROWS = ("mat", "camera", "port", "baud", "radio", *DEEDS)
REMEDIES = {"foreign": "elsewhere", "key": "copy"}  # text of the remedy by the reason of a misfit; else "flash"
WEAK = 0.7  # share of reports below which a robot is marked
IDLE = 600.0  # s without input before the return to the title
MESSAGE_SECONDS = 8.0  # s, display time of a message
REOPEN_DELAY = 0.8  # s after a change until all devices are reopened
EVERY = 0.4  # s between two readings
EVERYBODY = set(range(ROBOTS))
ROBOTS_H = 486  # px, height of the robots' frame
MESSAGE = pygame.Rect(150, 858, 1620, 80)  # px, between description and prompts
LINE_Y, LINE_PITCH = dials.PANEL.y + 530, 48  # px: description of the focused row

log = logging.getLogger("pigaming")


class FleetPage:
    """Fleet page, shown where robots are available."""

    def __init__(self, context: Context) -> None:
        self.context = context
        session = session_of(context)
        self.check = FleetState(session, context.settings)
        self.flood = FloodLight()
        self.flood.level = 0.0
        self.names = (
            ROWS if session.radio and not session.emulated else ("radio", *DEEDS) if context.robots_problem else DEEDS
        )
        self.focus = Focus(dials.spots(self.names), "pair")
        self.reopen_in, self.age = 0.0, EVERY
        self.aside, self.sheet = BlockLayout(), pygame.Surface((1920, 1080))
        self.lines: list[tuple[str, Color, str, Color]] = []  # per robot: radio and vision status
        hints = [
            (Button.RIGHT, "calibrate.hint_change"),
            (Button.FIRE, "robots.hint_ok"),
            (Button.BACK, "robots.hint_back"),
        ]
        self.navigation = Navigation(context, self.focus, hints, IDLE, MESSAGE_SECONDS)

    def on_enter(self) -> None:
        """Open camera and radio."""
        self.check.begin()

    def on_leave(self) -> None:
        """Stop the robots; release camera and radio."""
        self.check.end()

    def handle(self, event: InputEvent) -> StackOperation:
        """Up and down select, left and right change, FIRE runs; while robots move, any input stops them."""
        event = self.navigation.prompts.as_button(self._to_sheet(event))
        if self.check.busy and event.button not in (Button.POINT, Button.LOST, Button.FOUND):
            self.check.stop()
            self.navigation.show_message(self.context.words("fleet.stopped"))
            return None
        if turn := self.navigation.handle(event):
            return turn
        name = self.focus.name
        if by := dials.step_of(event, self.focus, self._value(name)):
            self._change(name, by, False)
        elif self.focus.activated(event) and (event.button is not Button.CLICK or self._value(name).kind == "deed"):
            self._run(name)
        return None

    def update(self, seconds: float) -> StackOperation:
        """Refresh the readings."""
        words = self.context.words
        turn = self.navigation.update(seconds)
        self.age += seconds
        if self.reopen_in > 0.0:
            self.reopen_in -= seconds
            if self.reopen_in <= 0.0:
                self.check.end()
                self.on_enter()
        pairing = self.check.pairing is not None
        self.flood.update(seconds, self.check.looking)
        if self.check.update(seconds):
            if pairing:
                self._report_pairing()
            else:
                self.navigation.show_message(words("fleet.measured" if self.check.latencies else "fleet.nobody"))
            self.context.sounds.play("accept")
        if self.age >= EVERY:
            self.age = 0.0
            self.lines = [self._read(robot) for robot in range(ROBOTS)]
        self.aside.update(seconds, self._blocks(), self.discs.circles(EVERYBODY) if self.discs else ())
        return turn

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the page in blocks that avoid the discs, then the discs."""
        words = self.context.words
        if self.flood.full:
            self.flood.draw(screen, words("fleet.looking"), words("fleet.any_stops"))
            return
        screen.blit(backdrop(), (0, 0))
        heading(words("fleet.title"), self._state()).draw(screen)
        self._draw_blocks(self.sheet)
        self.aside.draw(screen, self.sheet)
        self.flood.draw(screen, "")
        if self.discs:
            self.discs.draw(screen, EVERYBODY)

    # ---- drawing

    @property
    def discs(self) -> MarkerDiscs | None:
        """Discs for the robots' markers, once a rig is open."""
        return MarkerDiscs(self.check.rig) if self.check.rig is not None else None

    def _blocks(self) -> list[pygame.Rect]:
        """Blocks of the page: rows, robots, description, prompts and faults."""
        low = self.focus.spots[-1].rect.bottom
        ends = places(self.navigation.prompts.labels, self.navigation.prompts.room)
        left, right = round(ends[0][0]) - 16, round(ends[-1][1]) + 16
        boxes = [
            pygame.Rect(72, 192, dials.PANEL.x - 12 - 72, low + 20 - 192),
            pygame.Rect(dials.PANEL.x - 8, dials.PANEL.y - 8, dials.PANEL.w + 16, ROBOTS_H + 16),
            pygame.Rect(dials.PANEL.x - 8, LINE_Y - 34, dials.PANEL.w + 16, MESSAGE.top - LINE_Y + 34),
            pygame.Rect(left, self.navigation.prompts.y - 40, right - left, 80),
        ]
        return [*boxes, MESSAGE] if self._message() else boxes

    def _message(self) -> str:
        """Fault, result of the last action, or warning about the camera."""
        return self._fault() or self.navigation.sentence or self._warning()

    def _to_sheet(self, event: InputEvent) -> InputEvent:
        """Map a mouse event from the canvas to the sheet."""
        return replace(event, at=self.aside.back(event.at)) if event.at else event

    def _draw_blocks(self, screen: pygame.Surface) -> None:
        """Draw everything below the heading on the sheet."""
        words = self.context.words
        screen.fill("black")
        dials.draw(screen, self.context.words, self.focus, "fleet", {name: self._value(name) for name in self.names})
        frame(dials.PANEL.w, ROBOTS_H).draw(screen, *dials.PANEL.topleft)
        for robot, (heard, bright, seen, dim) in enumerate(self.lines):
            x, y = dials.PANEL.x + 60, dials.PANEL.y + 74 + 118 * robot
            blit_sprite(screen, tag(robot), x, y)
            text(heard, 40, bright, "body", "l", dials.PANEL.w - 140).draw(screen, x + 60, y - 26)
            text(seen, 34, dim, "body", "l", dials.PANEL.w - 140).draw(screen, x + 60, y + 26)
        moving = self.check.moving
        told = words("fleet.moving", robot=moving + 1) if moving is not None else self._line()
        for i, line in enumerate(paragraph(told, dials.PANEL.w - 60, 3, FOCUS if moving is not None else MIST)):
            line.draw(screen, dials.PANEL.x + 30, LINE_Y + LINE_PITCH * i)
        sentence = self._message()
        lines = paragraph(sentence, 1600, 2, FOCUS, "c") if sentence else []
        for i, line in enumerate(lines):
            line.draw(screen, 960, MESSAGE.centery + 44 * i - 22 * (len(lines) - 1))
        self.navigation.prompts.draw(screen)

    # ---- readings

    def _line(self) -> str:
        """Description of the focused row, or the reason why matches reject its value."""
        reason = self.context.robots_problem if self.focus.name == "radio" else None
        return self.context.words.sentence(reason) if reason else self.context.words(f"fleet.{self.focus.name}_line")

    def _state(self) -> str:
        """Camera status."""
        words, check = self.context.words, self.check
        if check.rig is None:
            return words.sentence(check.refusal) if check.refusal else words("fleet.no_camera")
        if not check.session.radio:
            return words("fleet.poses", rate=round(check.rate))
        if not check.rate:
            return words("fleet.dark")
        exposure = check.rig.camera.exposure
        return words("fleet.rate", rate=round(check.rate)) + (
            "  ·  " + exposure_text(words, exposure) if exposure.bound else ""
        )

    def _fault(self) -> str | None:
        """Fault message of camera or radio."""
        message = self.check.session.fault
        return self.context.words.sentence(message) if message else None

    def _warning(self) -> str:
        """Warning about exposure or sharpness of the camera."""
        message = self.check.rig and camera_warning(self.check.session, self.check.rig)
        return self.context.words.sentence(message) if message else ""

    def _read(self, robot: int) -> tuple[str, Color, str, Color]:
        words, health = self.context.words, self.check.health(robot)
        seen = words("fleet.seen" if health.seen else "fleet.unseen")
        if health.seen and health.latency is not None:
            seen = words("fleet.late", ms=round(1000 * health.latency))
        if health.misfit is not None:
            reason, arena = health.misfit.reason, health.misfit.arena
            return words(f"fleet.{reason}"), ALARM, words(f"fleet.{REMEDIES.get(reason, 'flash')}", arena=arena), MIST
        if health.battery is None:
            return words("fleet.silent"), MIST, seen, MIST
        key = "heard_named" if health.name else "heard" if health.battery else "heard_only"
        volts = words("fleet.volts", volts=f"{health.battery:.1f}") if health.battery else "–"
        heard = words(f"fleet.{key}", name=health.name, volts=volts, share=round(100 * health.share))
        if health.empty:
            return words("fleet.empty", volts=f"{health.battery:.1f}"), ALARM, words("fleet.charge"), MIST
        if health.parked:
            return words("fleet.parked"), FOCUS, words("fleet.press"), MIST
        if health.deaf:
            return words("fleet.deaf"), ALARM, seen, MIST
        weak = 0.0 < health.battery < health.kind.warn_mv / 1000 or health.share < WEAK
        if health.restarted:
            return heard, ALARM if weak else ICE, f"{seen}  ·  {words('fleet.restarted')}", FOCUS
        if self.check.session.radio:
            seen += f"  ·  {health.kind.name}"
        return heard, ALARM if weak else ICE, seen, GREEN if health.seen else MIST

    # ---- rows

    def _value(self, name: str) -> SettingValue:
        words, settings = self.context.words, self.context.settings
        match name:
            case "mat":
                return SettingValue("toggle", (words("options.off"), words("options.on")), int(settings.mat))
            case "pair" | "latency":
                return SettingValue("deed", (words("fleet.begin"),))
        values, now = self._choices(name)
        return SettingValue("arrows", tuple(values.values()), list(values).index(now))

    def _choices(self, name: str) -> tuple[dict[object, str], object]:
        """Options of a row, by stored value, and the current value."""
        words, settings = self.context.words, self.context.settings
        if settings.radio == "udp" and name in ("port", "baud"):
            return {getattr(settings, name): words("fleet.no_line")}, getattr(settings, name)
        if name == "camera":
            known: dict[object, str] = {camera.number: f"{camera.number}: {camera.name}" for camera in cameras()}
            return {settings.camera: str(settings.camera), **known}, settings.camera
        if name == "port":
            there: dict[object, str] = {port.device: port.device for port in ports()}
            first = words("fleet.first", port=next(iter(there), "-"))
            return {"": first, settings.port or "": settings.port or first, **there}, settings.port
        if name == "baud":
            return {baud: str(baud) for baud in sorted({*BAUDS, settings.baud})}, settings.baud
        return {radio: words(f"fleet.{radio}") for radio in RADIOS}, settings.radio

    def _change(self, name: str, delta: int, around: bool) -> None:
        """Step a row's value by `delta`."""
        settings = self.context.settings
        if name in DEEDS:
            return
        if name == "mat":
            settings.mat = not settings.mat
        else:
            values, now = self._choices(name)
            keys = list(values)
            at = keys.index(now) + delta
            settings.choose(name, keys[at % len(keys) if around else max(0, min(len(keys) - 1, at))])
            self.reopen_in = REOPEN_DELAY
        self.context.sounds.play("move")
        try:
            settings.save(folders().config)
        except NotSaved as error:
            log.warning("%s", error)
            self.navigation.show_message(self.context.words("app.unsaved"))

    def _run(self, name: str) -> None:
        """Run a row's action, or step its value."""
        if name not in DEEDS:
            self._change(name, 1, True)
            return
        begun = self.check.pair() if name == "pair" else self.check.measure()
        self.context.sounds.play("accept" if begun else "error")
        if not begun:
            self.navigation.show_message(self.context.words("fleet.nobody"))

    def _report_pairing(self) -> None:
        """Report the result of the pairing."""
        words, finding = self.context.words, worst_finding(self.check.findings)
        if finding is None:
            self.navigation.show_message(words("fleet.paired"))
        else:
            marker = 0 if finding.marker is None else finding.marker + 1
            self.navigation.show_message(words(f"fleet.case_{finding.case}", radio=finding.channel + 1, marker=marker))
        try:
            self.context.settings.save(folders().config)
        except NotSaved as error:
            log.warning("%s", error)
