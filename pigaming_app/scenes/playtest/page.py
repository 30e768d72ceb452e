"""The operator's page of play tests: what is recorded, the game, begin, and the matches kept so far."""

from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.match_words import game_title
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.playtest import kept, pictures
from pigaming_app.scenes.playtest.consent import ConsentPage
from pigaming_app.scenes.recordings.store import StoreError
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.widgets.setting_row import SettingValue

ROWS = ("begin", "game", "last", "all")


class PlayTestPage(SettingsPage):
    """Changes are not saved; holding FIRE deletes."""

    right = Right.SETTINGS
    table, title, saves = "playtest", "playtest.title", False

    def __init__(self, context: Context) -> None:
        self.games = shown_games()
        self.game = self.games[0]
        self.count = len(kept.paths())
        super().__init__(context, ROWS)

    def on_enter(self) -> None:
        """Count what is kept, also after a match."""
        self.count = len(kept.paths())
        self.context.sounds.music("title")

    @property
    def subtitle(self) -> str:
        return self.context.words("playtest.count", count=self.count)

    def value(self, name: str) -> SettingValue:
        if name == "game":
            titles = tuple(game_title(self.context.words, game) for game in self.games)
            return SettingValue("arrows", titles, self.games.index(self.game), endless=True)
        return self.action("playtest.go" if name == "begin" else "options.clear")

    def apply(self, name: str, chosen: int) -> None:
        self.game = self.games[chosen]

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Ask the people, or begin to delete."""
        self.context.sounds.play("accept" if name == "begin" else "move")
        if name == "begin":
            return Push(ConsentPage(self.context, self.game))
        self.holding.begin(event)
        return None

    def held(self) -> StackOperation:
        """Delete the last match, or all."""
        found = kept.paths()
        try:
            kept.delete(found if self.focus.name == "all" else found[:1])
        except StoreError as error:
            self.show_message(self.context.words(str(error)), wrong=True)
        self.count = len(kept.paths())
        self.context.sounds.play("back")
        return None

    def picture(self, name: str, chosen: int) -> LitImage:
        return pictures.drawn(name)
