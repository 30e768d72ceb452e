"""Set-up of a robot: the board on USB gets its number, the arcade's key, the Wi-Fi if it has one, and its program.

Then it is tried on blocks, over the same cable, and its marker is written for a printer.
"""

import threading
from collections.abc import Callable

import pygame

from pigaming_app.hardware.commissioning import board_setup
from pigaming_app.hardware.commissioning.board_setup import KINDS
from pigaming_app.hardware.commissioning.boards.kind import SetupFailed
from pigaming_app.hardware.session.store import arena_id, wifi_key
from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.mat.paper.sheet_file import write_sheet
from pigaming_app.scenes.mat.robots.sketches import sketch
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.pages.wifi import WIFI, wifi_line, wifi_typing, wifi_value
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.ui.draw import BODY, GREEN, MIST
from pigaming_app.ui.draw.layers import LEFT, RIGHT, LitImage, paragraph, text
from pigaming_app.ui.i18n import numeral
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.web import wifi
from pigaming_app.ui.widgets.setting_row import SettingValue

ROWS = ("robot", *WIFI, "board", "begin", "blocks", "sheet")
STEPS_Y, STEP, WIDTH = 852, 46, 1160  # px: of what was done
COLUMNS = {"begin": 4, "blocks": 2}  # of what was done, by row

Note = Callable[[str], None]


class BoardWork(threading.Thread):
    """Work on the board on USB, of a row. `done`: what was done, so far; then `result`, or why it failed: `fault`."""

    def __init__(self, row: str, action: Callable[[Note], str | int]) -> None:
        super().__init__(name="board set-up", daemon=True)
        self.row, self._action = row, action
        self.done: list[str] = []
        self.result: str | int | None = None
        self.fault: OperatorMessage | None = None

    def run(self) -> None:
        try:
            self.result = self._action(self.done.append)
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
        """True while there is work on a board."""
        return self.work is not None and self.work.is_alive()

    def label(self, name: str) -> str:
        return self.context.words("robots.sheet") if name == "sheet" else super().label(name)

    def line(self, name: str) -> str:
        if name == "sheet":
            return self.context.words("robots.sheet_line")
        return wifi_line(self, name) if name in WIFI else super().line(name)

    def value(self, name: str) -> SettingValue:
        words = self.context.words
        if name == "robot":
            return SettingValue("arrows", tuple(str(i + 1) for i in range(ROBOTS)), self.robot - 1, endless=True)
        if name == "board":
            named = (words("board.relay") if key == "relay" else kind.name for key, kind in KINDS.items())
            return SettingValue(
                "arrows", (words("board.automatic"), *named), ("", *KINDS).index(self.board), endless=True
            )
        if name in COLUMNS:
            return self.action("board.working" if self.busy else "board.start")
        return self.action("robots.write") if name == "sheet" else wifi_value(self, name)

    def apply(self, name: str, chosen: int) -> None:
        if name == "robot":
            self.robot = chosen + 1
        else:
            self.board = ("", *KINDS)[chosen]

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Type name or password of the Wi-Fi, write the markers, or begin work on the board."""
        if self.busy:
            self.context.sounds.play("refused")
            return None
        self.context.sounds.play("accept")
        if name in WIFI:
            return Push(wifi_typing(self, name))
        if name == "sheet":
            self.show_message(write_sheet(self))
            return None
        self.work = BoardWork(name, self._set_up() if name == "begin" else self._try_on_blocks())
        self.work.start()
        return None

    def advance(self, seconds: float) -> StackOperation:
        """Tell how it went; the next robot has the next number."""
        work = self.work
        if work and not work.is_alive():
            self.work = None
            if work.fault:
                self.context.sounds.play("error")
                self.show_message(self.context.words.sentence(work.fault), wrong=True)
            elif work.result is not None:
                self.context.sounds.play("ready")
                self.show_message(self._told(work.result))
                if work.row == "begin" and work.result != "relay":
                    self._save_kind(str(work.result))
                    self.robot = self.robot % ROBOTS + 1
            self.rewarm()
        return None

    def paint(self, screen: pygame.Surface) -> None:
        super().paint(screen)
        if self.work:
            columns = COLUMNS[self.work.row]
            for i, name in enumerate(self.work.done):
                x, y = LEFT + 40 + WIDTH // columns * (i % columns), STEPS_Y + STEP * (i // columns)
                text(name, BODY, GREEN, "body", "l").draw(screen, x, y)

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

    def _set_up(self) -> Callable[[Note], str]:
        """The set-up of the board as the rows have it; its value is the kind of board."""
        settings, robot, board = self.context.settings, self.robot, self.board
        arena, key = arena_id(settings), wifi_key(settings)

        def files(kind: str) -> dict[str, bytes]:
            password = wifi.password(settings, wifi.PATIENT)
            return board_setup.files_of(kind, robot, arena, key, settings.phones_wifi, password)

        return lambda note: board_setup.set_up(board_setup.only_port(), board, files, lambda name, new: note(name))

    def _save_kind(self, board: str) -> None:
        """Keep the kind of the robot that this board has become."""
        kinds = [*self.context.settings.kinds]
        kinds[self.robot - 1] = board_setup.kind_for_settings(board, kinds[self.robot - 1])
        self.context.settings.kinds = kinds
        self.save()

    def _try_on_blocks(self) -> Callable[[Note], int]:
        """The test of the board; its value is the battery's voltage, mV."""
        words, board = self.context.words, self.board
        return lambda note: board_setup.try_on_blocks(
            board_setup.only_port(), board, lambda turn: note(words(f"board.turn_{turn}"))
        )

    def _told(self, result: str | int) -> str:
        words = self.context.words
        if isinstance(result, int):
            return words(
                "board.tried",
                volts=f"{words.decimal(numeral(result / 1000, 1))} V" if result else words("board.unmeasured"),
            )
        return words("board.done_relay") if result == "relay" else words("board.done", robot=self.robot)
