"""Set-up of a robot: the board on USB gets its number, the arcade's key, the Wi-Fi if it has one, and its program."""

import threading

import pygame

from pigaming_app.hardware.commissioning import board_setup
from pigaming_app.hardware.commissioning.board_setup import KINDS, SetupFailed
from pigaming_app.hardware.session.store import arena_id, wifi_key
from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.mat.robots.sketches import sketch
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.pages.wifi import WIFI, wifi_typing, wifi_value
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.ui.draw import BODY, GREEN, MIST
from pigaming_app.ui.draw.layers import LEFT, RIGHT, LitImage, paragraph, text
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.widgets.setting_row import SettingValue

ROWS = ("robot", *WIFI, "board", "begin")
STEPS_Y, STEP = 720, 46  # px: the files that were written


class BoardWork(threading.Thread):
    """Sets a board up. `done`: names of the files that are in place; `fault`: why it failed, or None."""

    def __init__(self, robot: int, board: str, arena: int, key: bytes, network: str, password: str) -> None:
        super().__init__(name="board set-up", daemon=True)
        self.robot, self.board = robot, board
        self.done: list[str] = []
        self.ready = False
        self.fault: OperatorMessage | None = None
        self._files = lambda kind: board_setup.files_of(kind, robot, arena, key, network, password)

    def run(self) -> None:
        try:
            port = board_setup.only_port()
            board_setup.set_up(port, self.board, self._files, lambda name, new: self.done.append(name))
            self.ready = True
        except SetupFailed as failed:
            self.fault = failed.message
        except Exception:  # of the library: the page goes on
            self.fault = OperatorMessage("broken")
            raise


class SetUpPage(SettingsPage):
    """The page. The Wi-Fi is that of the phones, typed once."""

    right = Right.ROBOTS
    table, title = "board", "board.title"
    idle = 600.0

    def __init__(self, context: Context) -> None:
        self.robot, self.board = 1, ""
        self.work: BoardWork | None = None
        super().__init__(context, ROWS)

    @property
    def busy(self) -> bool:
        """True while a board is being set up."""
        return self.work is not None and self.work.is_alive()

    def value(self, name: str) -> SettingValue:
        words = self.context.words
        if name == "robot":
            return SettingValue("arrows", tuple(str(i + 1) for i in range(ROBOTS)), self.robot - 1, endless=True)
        if name == "board":
            kinds = ("", *KINDS)
            shown = (words("board.automatic"), "Pico W", "ESP32", "Pololu 2040")
            return SettingValue("arrows", shown, kinds.index(self.board), endless=True)
        if name == "begin":
            return self.action("board.working" if self.busy else "board.start")
        return wifi_value(self, name)

    def apply(self, name: str, chosen: int) -> None:
        if name == "robot":
            self.robot = chosen + 1
        else:
            self.board = ("", *KINDS)[chosen]

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Type name or password of the Wi-Fi, or begin."""
        if self.busy:
            self.context.sounds.play("refused")
            return None
        self.context.sounds.play("accept")
        if name in WIFI:
            return Push(wifi_typing(self, name))
        settings = self.context.settings
        arena, key = arena_id(settings), wifi_key(settings)
        wifi = settings.phones_wifi, settings.phones_wifi_key
        self.work = BoardWork(self.robot, self.board, arena, key, *wifi)
        self.work.start()
        return None

    def advance(self, seconds: float) -> StackOperation:
        """Tell how it went; the next robot has the next number."""
        work = self.work
        if work and not work.is_alive():
            self.work = None
            if work.ready:
                self.context.sounds.play("ready")
                self.show_message(self.context.words("board.done", robot=work.robot))
                self.robot = work.robot % ROBOTS + 1
            elif work.fault:
                self.context.sounds.play("error")
                self.show_message(self.context.words.sentence(work.fault), wrong=True)
            self.rewarm()
        return None

    def paint(self, screen: pygame.Surface) -> None:
        super().paint(screen)
        for i, name in enumerate(self.work.done if self.work else ()):
            text(name, BODY, GREEN, "body", "l").draw(screen, LEFT + 40 + 300 * (i % 5), STEPS_Y + STEP * (i // 5))

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the message in place of the prompts: a fault may need two lines."""
        if not self.message:
            self.prompts.draw(screen)
            return
        lines = paragraph(self.message, RIGHT - LEFT, 2, MIST, "c")
        for i, line in enumerate(lines):
            line.draw(screen, 960, self.prompts_y + 44 * i - 22 * (len(lines) - 1))

    def picture(self, name: str, chosen: int) -> LitImage:
        return sketch("board")
