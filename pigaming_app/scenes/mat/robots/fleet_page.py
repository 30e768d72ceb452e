"""Fleet page: camera and radio selection, robot status, pairing and latency."""

from dataclasses import replace

import pygame

from pigaming_app.hardware.drivers.ours import OURS
from pigaming_app.hardware.drivers.registry import DRIVERS
from pigaming_app.hardware.radio.serial_line import ports
from pigaming_app.hardware.session.robot_session import camera_warning
from pigaming_app.hardware.vision.camera import shown
from pigaming_app.hardware.vision.discovery import cameras
from pigaming_app.scenes.flow.scene import Context, StackOperation
from pigaming_app.scenes.mat.calibration.picture_quality import exposure_text
from pigaming_app.scenes.mat.robots.avoid_discs import BlockLayout
from pigaming_app.scenes.mat.robots.fleet_state import FleetState, worst_finding
from pigaming_app.scenes.mat.robots.flood_light import FloodLight
from pigaming_app.scenes.mat.robots.marker_discs import MarkerDiscs, tag
from pigaming_app.scenes.mat.session import session_of
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.settings import PHONE
from pigaming_app.ui.draw import ALARM, FOCUS, GREEN, ICE, MIST, Color
from pigaming_app.ui.draw.layers import LitImage, paragraph, text
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.button_prompts import places
from pigaming_app.ui.widgets.labels import blit_sprite, frame, heading
from pigaming_app.ui.widgets.setting_row import SettingValue

BAUDS = (9600, 19200, 38400, 57600, 111111, 115200, 230400)
ACTIONS = ("pair", "latency", "drive")
ROWS = ("mat", "camera", "port", "baud", "radio", *ACTIONS)
REMEDIES = {"foreign": "elsewhere", "key": "copy"}  # text of the remedy by the reason of a misfit; else "flash"
WEAK = 0.7  # share of reports below which a robot is marked
REOPEN_DELAY = 0.8  # s after a change until all devices are reopened
EVERY = 0.4  # s between two readings
EVERYBODY = set(range(ROBOTS))
ROBOTS_H = 486  # px, height of the robots' frame
ABOVE = 7  # rows for which there is room above the message
MESSAGE = pygame.Rect(150, 858, 1620, 80)  # px, between description and prompts
LINE_Y, LINE_PITCH = dials.PANEL.y + 530, 48  # px: description of the focused row


class FleetPage(SettingsPage):
    """Fleet page, shown where robots are available."""

    table = "fleet"
    idle, stay = 600.0, 8.0

    def __init__(self, context: Context) -> None:
        session = session_of(context)
        self.check = FleetState(session, context.settings)
        self.flood = FloodLight(context)
        self.flood.level = 0.0
        self.reopen_in, self.since_read = 0.0, EVERY
        self.aside, self.sheet = BlockLayout(), pygame.Surface((1920, 1080))
        self.lines: list[tuple[str, Color, str, Color]] = []  # per robot: radio and vision status
        real = session.radio and not session.emulated
        rows = ROWS if real else ("radio", *ACTIONS) if context.robots_problem else ACTIONS
        super().__init__(context, rows, "pair")
        self.focus.set_spots(dials.spots(rows, ABOVE))

    def on_enter(self) -> None:
        """Open camera and radio."""
        self.check.begin()

    def on_leave(self) -> None:
        """Stop the robots; release camera and radio."""
        self.check.end()

    def handle(self, event: InputEvent) -> StackOperation:
        """Mouse events lie on the sheet; while robots move, any input stops them."""
        event = replace(event, at=self.aside.back(event.at)) if event.at else event
        if self.check.busy and event.button not in (Button.POINT, Button.LOST, Button.FOUND):
            self.check.stop()
            self.show_message(self.context.words("fleet.stopped"))
            return None
        return super().handle(event)

    def advance(self, seconds: float) -> StackOperation:
        """Refresh the readings."""
        words = self.context.words
        self.since_read += seconds
        if self.reopen_in > 0.0:
            self.reopen_in -= seconds
            if self.reopen_in <= 0.0:
                self.check.end()
                self.on_enter()
        pairing, driving = self.check.pairing is not None, self.check.drive is not None
        self.flood.update(seconds, self.check.looking)
        if self.check.update(seconds):
            if pairing:
                self._report_pairing()
            elif driving:
                self._report_drive()
            else:
                self.show_message(words("fleet.measured" if self.check.latencies else "fleet.nobody"))
            self.context.sounds.play("accept")
        if self.since_read >= EVERY:
            self.since_read = 0.0
            self.lines = [self._read(robot) for robot in range(ROBOTS)]
        self.aside.update(seconds, self._blocks(), self.discs.circles(EVERYBODY) if self.discs else ())
        return None

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the page, or the floodlight while markers are looked for."""
        if self.flood.full:
            self.flood.draw(screen, self.context.words("fleet.looking"), self.context.words("fleet.any_stops"))
        else:
            super().draw(screen)

    @property
    def heading(self) -> LitImage:
        return heading(self.context.words("fleet.title"), self._state())

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the page in blocks that avoid the discs, then the discs."""
        self._draw_blocks(self.sheet)
        self.aside.draw(screen, self.sheet)
        self.flood.draw(screen, "")
        if self.discs:
            self.discs.draw(screen, EVERYBODY)

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Prompts and message are blocks, too."""

    # ---- drawing

    @property
    def discs(self) -> MarkerDiscs | None:
        """Discs for the robots' markers, once a rig is open."""
        return MarkerDiscs(self.check.rig, session_of(self.context).printed) if self.check.rig is not None else None

    def _blocks(self) -> list[pygame.Rect]:
        """Blocks of the page: rows, robots, description, prompts and faults."""
        low = self.focus.spots[-1].rect.bottom
        ends = places(self.prompts.labels, self.prompts_room)
        left, right = round(ends[0][0]) - 16, round(ends[-1][1]) + 16
        boxes = [
            pygame.Rect(72, 192, dials.PANEL.x - 12 - 72, low + 20 - 192),
            pygame.Rect(dials.PANEL.x - 8, dials.PANEL.y - 8, dials.PANEL.w + 16, ROBOTS_H + 16),
            pygame.Rect(dials.PANEL.x - 8, LINE_Y - 34, dials.PANEL.w + 16, MESSAGE.top - LINE_Y + 34),
            pygame.Rect(left, self.prompts_y - 40, right - left, 80),
        ]
        return [*boxes, MESSAGE] if self._notice() else boxes

    def _notice(self) -> str:
        """Fault, result of the last action, or warning about the camera."""
        return self._fault() or self.message or self._warning()

    def _draw_blocks(self, screen: pygame.Surface) -> None:
        """Draw everything below the heading on the sheet."""
        words = self.context.words
        screen.fill("black")
        self.draw_rows(screen)
        frame(dials.PANEL.w, ROBOTS_H).draw(screen, *dials.PANEL.topleft)
        for robot, (heard, bright, seen, dim) in enumerate(self.lines):
            x, y = dials.PANEL.x + 60, dials.PANEL.y + 74 + 118 * robot
            blit_sprite(screen, tag(robot), x, y)
            text(heard, 40, bright, "body", "l", dials.PANEL.w - 140).draw(screen, x + 60, y - 26)
            text(seen, 34, dim, "body", "l", dials.PANEL.w - 140).draw(screen, x + 60, y + 26)
        moving = self.check.moving
        told = words("fleet.moving", robot=moving + 1) if moving is not None else self.line(self.focus.name)
        for i, line in enumerate(paragraph(told, dials.PANEL.w - 60, 3, FOCUS if moving is not None else MIST)):
            line.draw(screen, dials.PANEL.x + 30, LINE_Y + LINE_PITCH * i)
        sentence = self._notice()
        lines = paragraph(sentence, 1600, 2, FOCUS, "c") if sentence else []
        for i, line in enumerate(lines):
            line.draw(screen, 960, MESSAGE.centery + 44 * i - 22 * (len(lines) - 1))
        self.prompts.draw(screen)

    # ---- readings

    def line(self, name: str) -> str:
        """Description of a row, or the reason why matches reject its value."""
        reason = self.context.robots_problem if name == "radio" else None
        return self.context.words.sentence(reason) if reason else super().line(name)

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

    def value(self, name: str) -> SettingValue:
        if name == "mat":
            return self.switch(self.context.settings.mat)
        if name in ACTIONS:
            return self.action("fleet.begin")
        values, now = self._choices(name)
        return SettingValue("arrows", tuple(values.values()), list(values).index(now))

    def _choices(self, name: str) -> tuple[dict[object, str], object]:
        """Options of a row, by stored value, and the current value."""
        words, settings = self.context.words, self.context.settings
        driver = DRIVERS.get(settings.radio)
        if driver is not None and not driver.serial and name in ("port", "baud"):
            return {getattr(settings, name): words("fleet.no_line")}, getattr(settings, name)
        if name == "camera":
            known: dict[object, str] = {camera.number: f"{camera.number}: {camera.name}" for camera in cameras()}
            phone = words("calibrate.phone") if settings.camera == PHONE else ""
            return {settings.camera: phone or str(shown(settings.camera)), **known}, settings.camera
        if name == "port":
            there: dict[object, str] = {port.device: port.device for port in ports()}
            first = words("fleet.first", port=next(iter(there), "-"))
            return {"": first, settings.port or "": settings.port or first, **there}, settings.port
        if name == "baud":
            return {baud: str(baud) for baud in sorted({*BAUDS, settings.baud})}, settings.baud
        offered: dict[object, str] = {} if settings.radio in DRIVERS else {settings.radio: settings.radio}
        for own, one in DRIVERS.items():
            offered[own] = words(f"fleet.{own}") if own in OURS else one.title or own
        return offered, settings.radio

    def apply(self, name: str, chosen: int) -> None:
        """Change a setting; all devices are opened again soon."""
        if name == "mat":
            self.context.settings.mat = bool(chosen)
        else:
            self.context.settings.choose(name, list(self._choices(name)[0])[chosen])
            self.reopen_in = REOPEN_DELAY

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Begin to pair, to measure the latency, or to drive."""
        begun = {"pair": self.check.pair, "latency": self.check.measure, "drive": self.check.try_speeds}[name]()
        self.context.sounds.play("accept" if begun else "error")
        if not begun:
            self.show_message(self.context.words("fleet.nobody"))
        return None

    def draw_picture(self, screen: pygame.Surface, name: str, chosen: int) -> None:
        """The readings of the robots take the place of pictures."""

    def _report_drive(self) -> None:
        """Report the result of the test drive, and save it."""
        words, drive = self.context.words, self.check.driven
        if drive is None or drive.held_up:
            self.show_message(words("fleet.held_up" if drive else "fleet.nobody"))
            return
        tops = {robot: top for robot, top in drive.tops_mm.items() if top}
        if drive.late:
            self.show_message(words("fleet.too_late", robot=min(drive.late) + 1))
        elif tops:
            robot = min(tops, key=lambda robot: tops[robot])
            self.show_message(words("fleet.slower", robot=robot + 1, mm=tops[robot]))
        else:
            self.show_message(words("fleet.full_speed"))
        self.save()

    def _report_pairing(self) -> None:
        """Report the result of the pairing, and save it."""
        words, finding = self.context.words, worst_finding(self.check.findings)
        if finding is None:
            self.show_message(words("fleet.paired"))
        else:
            marker = 0 if finding.marker is None else finding.marker + 1
            self.show_message(words(f"fleet.case_{finding.case}", radio=finding.channel + 1, marker=marker))
        self.save()
