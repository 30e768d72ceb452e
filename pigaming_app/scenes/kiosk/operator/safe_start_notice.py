"""What the operator's page tells about failed starts of a kiosk: settings that were taken back, or safe mode."""

from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.match_words import game_title
from pigaming_app.scenes.kiosk import safe_start
from pigaming_app.storage.safe_mode import is_safe
from pigaming_app.storage.settings import folders
from pigaming_app.ui.i18n import Words

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
