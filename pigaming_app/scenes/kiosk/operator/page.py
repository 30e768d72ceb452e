"""The operator's page of an open day: quiet hours, volume cap, time limit, second screen, figures, end of all matches.

It opens from the options, and over any screen by holding F10; a match below it stands still.
"""

from collections.abc import Sequence

from pigaming_app.scenes.flow.access import Right, Roles
from pigaming_app.scenes.flow.match_words import game_title
from pigaming_app.scenes.flow.scene import Context, Home, Pop, Push, Scene, StackOperation, Swap
from pigaming_app.scenes.kiosk import safe_start
from pigaming_app.scenes.kiosk.operator import pictures
from pigaming_app.scenes.kiosk.operator.group_limit import InMatch
from pigaming_app.scenes.kiosk.scoreboard.pages import Pages
from pigaming_app.scenes.pages.pin_page import NewPinPage
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.storage.safe_mode import is_safe
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.widgets.setting_row import SettingValue

SAFE_START = "safe_start"  # a row after failed starts only
PIN = "pin"
ROWS = ("figures", "quiet", "group_minutes", "keep_choices", "scoreboard", "board", "trash", "end_all")
QUIET = ("quiet_from", "quiet_until", "volume_cap")  # rows of a page of their own
TIMES = [f"{hour:02}:{minute}" for hour in range(24) for minute in ("00", "30")]  # of the quiet hours
LIMITS = (0, 5, 10, 15, 20, 30, 45, 60)  # minutes of a group


class OperatorPage(SettingsPage):
    """`below`: the scenes under it, if it lies over any but the options; `quiet`: the page of QUIET."""

    right = Right.OPERATE
    untimed = True
    table = "operator"

    def __init__(self, context: Context, below: Sequence[Scene] = (), quiet: bool = False) -> None:
        self.below, self.title = below, "operator.quiet" if quiet else "operator.title"
        self.when_idle = Pop() if below else Home()
        self.safe_start = SafeStartNotice(context)
        self.roles = context.shared(Roles)
        rows = (SAFE_START, *ROWS) if self.safe_start.due else ROWS
        own = not context.kiosk or not self.roles.pin.is_set  # in a kiosk, the PIN in use stays
        super().__init__(context, QUIET if quiet else (*rows, PIN) if own else rows)

    def on_enter(self) -> None:
        if self.below:
            self.context.hush()

    def advance(self, seconds: float) -> StackOperation:
        """Keep a match below at rest."""
        for scene in self.below:
            if isinstance(scene, InMatch):
                scene.robots.advance_paused(seconds)
        return None

    def held(self) -> StackOperation:
        self.context.sounds.play("accept")
        return end_all(self.context)

    def picture(self, name: str, chosen: int) -> LitImage:
        return pictures.drawn(name, chosen)

    def line(self, name: str) -> str:
        """The description of a row, or what became of failed starts."""
        return self.safe_start.line if name == SAFE_START else super().line(name)

    def value(self, name: str) -> SettingValue:
        """The value of a row."""
        settings, words = self.context.settings, self.context.words
        match name:
            case "quiet_from" | "quiet_until":
                never = f"  ({words('operator.never')})" if settings.quiet_from == settings.quiet_until else ""
                now = str(getattr(settings, name))
                times = [f"{now}{never}" if i == _slot(now) else time for i, time in enumerate(TIMES)]
                return SettingValue("arrows", tuple(times), _slot(now), endless=True)
            case "volume_cap":
                return SettingValue("meter", (), settings.volume_cap)
            case "group_minutes":
                texts = [
                    words("setup.min", minutes=str(minutes)) if minutes else words("options.off") for minutes in LIMITS
                ]
                return SettingValue("arrows", tuple(texts), _nearest(settings.group_minutes))
            case "keep_choices":
                return SettingValue("toggle", (words("operator.undo"), words("operator.keep")), settings.keep_choices)
            case "safe_start":
                return self.action(self.safe_start.action)
            case "scoreboard":
                displays = self.context.canvas.displays()
                return SettingValue(
                    "arrows", (words("options.off"), *displays), min(settings.scoreboard, len(displays))
                )
            case "board":
                board = self.context.shared(Pages)
                names = [page.name for page in board.pages]
                chosen = names.index(board.chosen)
                return SettingValue("arrows", tuple(words(f"scoreboard.{page}") for page in names), chosen)
        if name == PIN:
            return self.action("operator.pin_change" if self.roles.pin.is_set else "operator.pin_choose")
        return self.action("options.open" if name in ("figures", "quiet", "trash") else "options.clear")

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Open the figures, agree to what became of failed starts, or begin to end all matches."""
        if name == "figures":
            from pigaming_app.scenes.kiosk.operator.figures_page import FiguresPage

            self.context.sounds.play("accept")
            return Push(FiguresPage(self.context))
        if name == "quiet":
            self.context.sounds.play("accept")
            return Push(OperatorPage(self.context, self.below, quiet=True))
        if name == "trash":
            from pigaming_app.scenes.kiosk.operator.trash_page import TrashPage

            self.context.sounds.play("accept")
            return Push(TrashPage(self.context))
        if name == PIN:
            self.context.sounds.play("accept")
            return Push(NewPinPage(self.context))
        if name == SAFE_START:
            self.context.sounds.play("accept")
            self.save(self.safe_start.agree)
            return None if self.safe_start.due else Swap(OperatorPage(self.context, self.below))
        self.context.sounds.play("move")
        self.holding.begin(event)
        return None

    def apply(self, name: str, chosen: int) -> None:
        """Apply a changed value."""
        context, settings = self.context, self.context.settings
        match name:
            case "quiet_from" | "quiet_until":
                setattr(settings, name, TIMES[chosen])
            case "volume_cap":
                settings.volume_cap = chosen
                context.sounds.volume(*settings.loudness)
            case "group_minutes":
                settings.group_minutes = LIMITS[chosen]
            case "keep_choices":
                settings.keep_choices = bool(chosen)
                settings.settle()  # what was chosen by now is the house's
            case "scoreboard":
                settings.scoreboard = chosen
            case "board":
                board = context.shared(Pages)
                board.chosen = board.pages[chosen].name


def _slot(time: str) -> int:
    """The place of the last of TIMES that is not later."""
    return max(i for i, one in enumerate(TIMES) if one <= time)


def _nearest(minutes: int) -> int:
    """The place of the nearest limit; none is only near to none."""
    return min(range(len(LIMITS)), key=lambda i: (bool(minutes) != bool(LIMITS[i]), abs(LIMITS[i] - minutes)))


def end_all(context: Context) -> StackOperation:
    """Stop all robots, then end whatever is being played: back to the title."""
    context.stop_all_robots()
    return Home()


MOST = 2  # names, which the panel has room for in every language


class SafeStartNotice:
    """`due`: there is something to tell."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.safe, self.names = is_safe(), safe_start.taken_back(folders().config)
        self.due = self.safe or bool(self.names)

    @property
    def line(self) -> str:
        """What became of the failed starts."""
        words = self.context.words
        if self.safe:
            return words("operator.defaults_line")
        names = list(dict.fromkeys(setting_name(words, name) for name in self.names))
        return words("operator.taken_back_line", settings=", ".join([*names[:MOST], *(["…"] if names[MOST:] else [])]))

    @property
    def action(self) -> str:
        """What the operator may do about it: the key of its text."""
        return "operator.keep" if self.safe else "operator.understood"

    def agree(self) -> None:
        """Keep the defaults of safe mode for the next start, too; forget what was taken back. Raises NotSaved."""
        config = folders().config
        if self.safe:
            safe_start.keep_defaults(config, self.context.settings)
        safe_start.forget(config)
        self.due = False


def setting_name(words: Words, name: str) -> str:
    """The name of a setting on its page; that of one without a page is the one in the file."""
    if name.startswith("games."):
        return game_title(words, name.split(".")[1])
    name = "phones" if name.startswith("phones") else name
    keys = f"operator.{name}", "options.added" if name == "plugins" else f"options.{name}"
    return next((words(key) for key in keys if key in words), name)
