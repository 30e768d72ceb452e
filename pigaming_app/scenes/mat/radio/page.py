"""Page of arena and radio: the arena's number, channel and PAN of the XBees, and the kind of each robot."""

import logging
import secrets

import pygame

from pigaming_app.hardware.radio.packets import LAST_ARENA
from pigaming_app.hardware.radio.serial_line import BAUD
from pigaming_app.hardware.radio.xbee_frames import CHANNELS
from pigaming_app.hardware.radio.xbee_protocol import XBeeMode
from pigaming_app.hardware.radio.xbee_setup import RadioNetwork, Steps, XBeeSetup, network_of, parameters
from pigaming_app.hardware.robot_kinds import KINDS, set_up_command
from pigaming_app.hardware.session.robot_session import RobotsUnavailable
from pigaming_app.scenes.flow.scene import Context, StackOperation
from pigaming_app.scenes.mat.radio.sketches import sketch
from pigaming_app.scenes.mat.session import session_of
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.messages import OperatorError, OperatorMessage
from pigaming_app.ui.draw import FOCUS, ICE, LABEL
from pigaming_app.ui.draw.layers import LitImage, paragraph, text
from pigaming_app.ui.i18n import english
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.setting_row import SettingValue

RADIO_ROWS = ("channel", "module", "write")
KIND_ROWS = ("robot", "kind")
FACT_X, FACT_Y = dials.spots(("",))[0].rect.x + 40, 830  # px, start of the line with the command or the network
MESSAGE_Y, MESSAGE_PITCH = 796, 48  # px, of the message in its place

log = logging.getLogger("pigaming")


class RadioPage(SettingsPage):
    """The page. Robots and camera stay closed, so that the radio's port is free."""

    table, title = "arena_radio", "arena_radio.title"
    idle, stay = 600.0, 12.0

    def __init__(self, context: Context) -> None:
        self.session = session_of(context)
        own = () if self.session.emulated else ("arena",)  # emulated robots were flashed with their arena's number
        xbees = RADIO_ROWS if context.settings.radio in [*XBeeMode] else ()
        self.module = 0  # radio to be written: of the computer, or of robot 1 to 4
        self.arena, self.robot = 0, 1  # robot whose kind is shown
        self._steps: Steps[None] | None = None  # of the writing in progress
        super().__init__(context, (*own, *xbees, *KIND_ROWS))

    def on_enter(self) -> None:
        """Find the arena's number."""
        try:
            self.arena = self.session.arena_id
        except RobotsUnavailable as error:
            self._show(error.message)

    def on_leave(self) -> None:
        """Give up writing; the radio keeps what it has saved."""
        if self._steps is not None:
            self._steps.close()

    @property
    def network(self) -> RadioNetwork:
        """Channel and PAN of the settings, or those of the arena's number."""
        return network_of(self.arena, self.context.settings.radio_channel, self.context.settings.radio_pan)

    @property
    def subtitle(self) -> str:
        return self.context.words("arena_radio.state", number=self.arena)

    def press(self, event: InputEvent) -> StackOperation:
        """While a radio is written, only BACK counts."""
        return super().press(event) if self._steps is None else None

    def advance(self, seconds: float) -> StackOperation:
        """Advance the writing of a radio."""
        self.session.advance(seconds)
        if self._steps is not None:
            try:
                next(self._steps)
            except StopIteration:
                self._steps = None
                self._say(f"{'own' if self.module == 0 else 'robot'}_written")
                self.context.sounds.play("accept")
            except OperatorError as error:
                self._steps = None
                self._show(error.message)
                self.context.sounds.play("error")
        return None

    def picture(self, name: str, chosen: int) -> LitImage:
        return sketch(name, (self.robot if name in KIND_ROWS else self.module) - 1)

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the message, or the fact about the focused row, below the rows."""
        sentence = self.context.words("arena_radio.writing") if self._steps is not None else self.message
        if not sentence:
            text(self._fact(), LABEL, ICE, "body", "l", dials.W - 80).draw(screen, FACT_X, FACT_Y)
        for i, line in enumerate(paragraph(sentence, dials.W - 40, 3, FOCUS) if sentence else ()):
            line.draw(screen, FACT_X, MESSAGE_Y + MESSAGE_PITCH * i)
        self.prompts.draw(screen)

    # ---- inside

    def _fact(self) -> str:
        """The command that sets up a robot, the network, or the size of a kind of robot."""
        if (name := self.focus.name) == "arena":
            return self._set_up(1)
        if name == "module" and self.module:
            return self._set_up(self.module)
        if name in KIND_ROWS:
            chosen = self.context.settings.kinds[self.robot - 1]
            kind = next((kind for kind in KINDS if kind.key == chosen), None)
            if kind is None:
                return ""
            words, mm = self.context.words, round(2 * kind.radius_mm)
            return words("arena_radio.fact", name=kind.name, mm=mm, volts=f"{kind.warn_mv / 1000:.1f}")
        return str(self.network)

    def _set_up(self, robot: int) -> str:
        settings = self.context.settings
        return set_up_command(robot, self.arena, settings.radio, settings.kinds[robot - 1])

    def _say(self, key: str) -> None:
        self.show_message(self.context.words(f"arena_radio.{key}", robot=self.module, network=str(self.network)))

    def _show(self, message: OperatorMessage) -> None:
        log.warning("%s", english().long_sentence(message))
        self.show_message(self.context.words.sentence(message))

    # ---- rows

    def value(self, name: str) -> SettingValue:
        if name == "write":
            return self.action("arena_radio.begin")
        if name == "arena":
            return SettingValue("arrows", (str(self.arena),))
        values, now = self._choices(name)
        return SettingValue("arrows", tuple(values.values()), list(values).index(now))

    def _choices(self, name: str) -> tuple[dict[object, str], object]:
        """Options of a row, by stored value, and the current value."""
        words, settings = self.context.words, self.context.settings
        if name == "channel":
            channels: dict[object, str] = {channel: f"{channel:X}" for channel in CHANNELS}
            auto = words("arena_radio.auto", value=f"{network_of(self.arena).channel:X}")
            return {0: auto, **channels}, settings.radio_channel
        robots: dict[object, str] = {robot: words("mat.robot", robot=robot) for robot in range(1, ROBOTS + 1)}
        if name == "module":
            return {0: words("arena_radio.own"), **robots}, self.module
        if name == "robot":
            return robots, self.robot
        kinds: dict[object, str] = {"": words("arena_radio.announced"), **{kind.key: kind.name for kind in KINDS}}
        chosen = settings.kinds[self.robot - 1]
        return kinds, chosen if chosen in kinds else ""

    def step(self, name: str, by: int) -> None:
        """Step a value; the arena's numbers go round."""
        if name == "arena":
            self._renumber(self.arena + by)
        else:
            super().step(name, by)

    def fire(self, name: str, event: InputEvent) -> StackOperation:
        """FIRE on the arena's number draws another one."""
        if name != "arena":
            return super().fire(name, event)
        self._renumber(1 + secrets.randbelow(LAST_ARENA))
        return None

    def apply(self, name: str, chosen: int) -> None:
        settings, new = self.context.settings, list(self._choices(name)[0])[chosen]
        if name in ("module", "robot"):
            setattr(self, name, new)
        elif name == "channel":
            settings.choose("radio_channel", new)
        else:
            settings.kinds = [*settings.kinds]
            settings.kinds[self.robot - 1] = str(new)

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Begin to write the radio."""
        settings = self.context.settings
        mode, baud = ("api2", BAUD) if self.session.emulated else (settings.radio, settings.baud)
        try:
            wanted = parameters(self.module, self.network, mode, baud)
            self._steps = XBeeSetup(self.session.carrier(self.module), wanted, baud).steps()
        except RobotsUnavailable as error:
            self._show(error.message)
        except ValueError:
            self._say("no_rate")
        return None

    def _renumber(self, number: int) -> None:
        """Change the arena's number, and save it."""
        self.context.settings.choose("arena_id", (number - 1) % LAST_ARENA + 1)
        self.arena = self.session.arena_id
        self.context.sounds.play("move")
        self.save()
