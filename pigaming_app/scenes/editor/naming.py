"""Name entry for an arena: its title, and in small letters the name of its file."""

from collections.abc import Callable
from itertools import count
from unicodedata import normalize

from pigaming_app.games.arenas import is_own_name
from pigaming_app.scenes.editor.store import NEW, file_name, own_names
from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation
from pigaming_app.scenes.pages import name_page

LENGTH, IDLE = 9, 120.0  # letters, s


class ArenaNamePage(name_page.NamePage):
    """Prompts for the name of an arena that is called `before`, and proposes one. `enter(title)` saves it."""

    def __init__(self, context: Context, game: str, before: str, title: str, enter: Callable[[str], None]) -> None:
        self.game, self.before, self.enter = game, before, enter
        super().__init__(context, "editor.name", "", LENGTH, IDLE)
        usable = title.strip() and all(letter in name_page.LETTERS for letter in title.upper())
        self.spell(title.upper() if usable else self.proposal)

    @property
    def proposal(self) -> str:
        """The kind of arena and the first number that is free: ARENA 2."""
        kind = normalize("NFKD", self.context.words(f"setup.arena_{self.game}").upper())
        word = "".join(letter for letter in kind if letter in name_page.LETTERS)[: LENGTH - 3]
        return next(name for k in count(1) if not self.is_taken(name := f"{word} {k}"))

    def is_taken(self, name: str) -> bool:
        return file_name(name) != self.before and file_name(name) in own_names(self.game)

    def is_possible(self, name: str) -> bool:
        """In a kiosk nobody replaces the arena of somebody else."""
        made = file_name(name)
        free = not (self.context.kiosk and self.is_taken(name))
        return free and is_own_name(self.game, made) and not NEW.fullmatch(made)

    def keep(self, name: str) -> StackOperation:
        self.enter(name)
        return Pop()
