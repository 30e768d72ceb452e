"""The entrants of a new event: by letters, from the clipboard or a dropped file, and AIs; then it begins."""

import logging
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from random import shuffle
from string import ascii_uppercase

import pygame

from pigaming_app.ai.brain_files import display_name
from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.registry import AIS, find_brain, level_of
from pigaming_app.events.entrant_lists import ListError, entrants_of_text, read_list
from pigaming_app.events.spec import FEWEST, MAX_NAME, MOST, Entrant
from pigaming_app.scenes.events.names import shortened
from pigaming_app.scenes.events.setup.draft import Draft
from pigaming_app.scenes.events.setup.format_pictures import row_picture
from pigaming_app.scenes.events.setup.letters_page import LettersPage
from pigaming_app.scenes.features.registry import saved_brains
from pigaming_app.scenes.flow.match_words import brain_name
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.storage.parsing import one_line
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, MIST, STEEL, THIN, cut_box, dim, icon, text_width
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size, fit_text, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out
from pigaming_app.ui.widgets.word_filter import HARMLESS, is_rude

MAX_LIST = 1_000_000  # bytes of a dropped file
MAX_SHOWN, MOST_SHOWN = 20, 44  # characters of a file's name, of a line that is refused; of columns
TEAMS = 4  # that can be chosen here
TOP, GAP = 204, 14  # px
NARROW = 300  # px: a cell with little room for a team
GRIDS = {32: (4, 80), 66: (6, 58)}  # columns, and px from row to row, by number of entrants at most
ACTIONS_Y, ACTION_H, ACTION_GAP = 852, 70, 24  # px
LETTERS, ADD_AI, STRENGTH, PASTE, BEGIN = "letters", "add_ai", "strength", "paste", "begin"
SIGNS = {LETTERS: "plus", ADD_AI: "ai", PASTE: "list", BEGIN: "play"}
ACTIONS = {LETTERS: 402, ADD_AI: 292, STRENGTH: 272, PASTE: 402, BEGIN: 264}  # px, width of each

Begin = Callable[[Draft], "StackOperation | str"]

log = logging.getLogger("pigaming")


class EntrantsPage(Page):
    """The page of a draft. `begin`: see `SetupPage`."""

    title, idle = "events.who", 180.0

    def __init__(self, context: Context, draft: Draft, begin: Begin) -> None:
        self.draft, self.begin = draft, begin
        self.brains = brains_for(draft.games)
        self.brain = "level3"
        super().__init__(context, Focus(self._spots(), LETTERS))
        context.dropped.clear()

    def on_enter(self) -> None:
        """First display, or return from the letters."""
        self.focus.set_spots(self._spots())

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE does what is selected, X removes an entrant or shuffles all, Y turns teams, START begins."""
        if event.button is Button.START:
            return self._begin()
        if event.button is Button.X:
            self._remove(self.focus.name)
            return None
        if event.button is Button.Y and self.focus.name in ACTIONS and self.draft.classes:
            self._turn_classes()
            return None
        if event.button is Button.Y and self.draft.kind.series:
            self._change_team(self.focus.name)
            return None
        return super().press(event)

    def advance(self, seconds: float) -> StackOperation:
        """Read dropped files."""
        while self.context.dropped:
            self._read(self.context.dropped.pop(0))
        return None

    @property
    def subtitle(self) -> str:
        return self.context.words("events.count", count=len(self.draft.entrants))

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the entrants and the actions."""
        words, draft = self.context.words, self.draft
        black_out(screen, *(spot.rect for spot in self.focus.spots))
        for spot in self.focus.spots:
            hot = spot.name == self.focus.name
            if spot.name in ACTIONS:
                action(self._label(spot.name), SIGNS.get(spot.name, ""), spot.rect.w, hot).draw(
                    screen, *spot.rect.topleft
                )
            else:
                entrant = self._entrant(spot.name)
                cell(entrant.name, entrant.team, bool(entrant.brain), spot.rect.size, hot).draw(
                    screen, *spot.rect.topleft
                )
        if not draft.entrants:
            row_picture("entrants", 0).draw(screen, 960, 390)
            text(words("events.nobody"), LABEL, MIST, "head").draw(screen, 960, 610)
            text(words("events.drop"), BODY, MIST).draw(screen, 960, 690)
        self.focus.draw(screen)

    # ---- changes

    def add(self, name: str) -> str:
        """Enter a person; returns the sentence why not, or an empty one."""
        return self._add(Entrant(name))

    def _add(self, entrant: Entrant) -> str:
        words, entrants = self.context.words, self.draft.entrants
        if len(entrants) >= MOST:
            return words("events.full", most=MOST)
        if any(other.name == entrant.name for other in entrants):
            return words("events.taken", name=entrant.name)
        entrants.append(entrant)
        self.focus.set_spots(self._spots())
        return ""

    def add_list(self, text: str, file: str = "") -> None:
        """Enter everybody of a list, and show how many. `file`: its name."""
        words, count = self.context.words, 0
        try:
            found = entrants_of_text(one_a_line(text), self._require_brain)
        except ListError as error:
            log.warning("list of entrants %s: %s", file, error)
            shown = one_line(error.text, MAX_SHOWN)
            self._refuse(words(f"events.bad_{error.kind}", line=error.line, text=shown, most=MOST), file)
            return
        for entrant in found.entrants:
            name = HARMLESS if is_rude(entrant.name.upper()) else entrant.name
            added = not self._add(replace(entrant, name=name))
            count += added
            if added and entrant.name in found.classes:
                self.draft.classes[name] = found.classes[entrant.name]
        if not count:
            self._refuse(words("events.no_names"), file)
            return
        message = words("events.added", count=count)
        if found.told_apart:
            message += "  ·  " + one_line(", ".join(found.told_apart), MOST_SHOWN)
        if found.ignored:
            message += "  ·  " + words("events.ignored", columns=one_line(", ".join(found.ignored), MOST_SHOWN))
        self.show_message(message)
        self.context.sounds.play("ready")

    def _require_brain(self, brain: str) -> None:
        """Raises ChoiceError unless an AI plays all games of the event."""
        for game in self.draft.games:
            find_brain(game, brain)

    def _read(self, path: Path) -> None:
        try:
            self.add_list(read_list(path, MAX_LIST), path.name)
        except (OSError, ValueError) as error:
            log.warning("%s: %s", path.name, error)
            self._refuse(self.context.words("events.unread"), path.name)

    def _paste(self) -> None:
        try:
            self.add_list(pygame.scrap.get_text())
        except pygame.error as error:
            log.warning("clipboard: %s", error)
            self._refuse(self.context.words("events.no_names"))

    def _refuse(self, sentence: str, file: str = "") -> None:
        """Show why not. `file`: name of the file that is refused."""
        self.show_message(f"{one_line(file, MAX_SHOWN)}: {sentence}" if file else sentence)
        self.context.sounds.play("refused")

    def _change_team(self, spot: str) -> None:
        """The next team of an entrant; after the last one, none."""
        if spot not in ACTIONS:
            entrant = self._entrant(spot)
            teams = ("", *(self.context.words(f"events.team_{number}") for number in range(1, TEAMS + 1)))
            now = teams.index(entrant.team) if entrant.team in teams else 0
            self.draft.entrants[int(spot)] = replace(entrant, team=teams[(now + 1) % len(teams)])
            self.context.sounds.play("move")

    def _turn_classes(self) -> None:
        """Each class becomes a team; teams that are classes are given up again."""
        draft = self.draft
        wanted = [replace(one, team=draft.classes.get(one.name, one.team)) for one in draft.entrants]
        if wanted == draft.entrants:
            wanted = [replace(one, team="" if one.name in draft.classes else one.team) for one in draft.entrants]
        draft.entrants[:] = wanted
        self.context.sounds.play("move")

    def _shuffle(self) -> None:
        """Another order of the seeding, by chance."""
        shuffle(self.draft.entrants)
        self.show_message(self.context.words("events.shuffled"))
        self.context.sounds.play("move")

    def _remove(self, spot: str) -> None:
        if spot in ACTIONS:
            if len(self.draft.entrants) > 1:
                self._shuffle()
            return
        index = int(spot)
        del self.draft.entrants[index]
        self.focus.set_spots(self._spots())
        self.focus.move_to(str(min(index, len(self.draft.entrants) - 1)) if self.draft.entrants else LETTERS)
        self.context.sounds.play("back")

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        if name == LETTERS:
            self.context.sounds.play("accept")
            return Push(LettersPage(self.context, self.add, lambda: [entrant.name for entrant in self.draft.entrants]))
        if name == ADD_AI:
            refusal = self._add(Entrant(self._ai_name(), self.brain))
            self.context.sounds.play("refused" if refusal else "ready")
            if refusal:
                self.show_message(refusal)
        elif name == STRENGTH:
            self.brain = self.brains[(self.brains.index(self.brain) + 1) % len(self.brains)]
            self.context.sounds.play("move")
        elif name == PASTE:
            self._paste()
        elif name == BEGIN:
            return self._begin()
        return None

    def _begin(self) -> StackOperation:
        words = self.context.words
        few = len(self.draft.entrants) < FEWEST
        result = words("events.few", fewest=FEWEST) if few else self.begin(self.draft)
        if isinstance(result, str):
            self.show_message(result)
            self.context.sounds.play("refused")
            return None
        self.context.sounds.play("accept")
        return result

    # ---- inside

    @property
    def hints(self) -> Hints:
        """The prompts of what can be done now: an entrant changes, and enough of them begin."""
        named, teams = self.focus.name not in ACTIONS, self.draft.kind.series
        return [
            *([] if named else [(Button.FIRE, "events.hint_choose")]),
            *([(Button.X, "events.hint_remove")] if named else []),
            *([(Button.X, "events.hint_shuffle")] if not named and len(self.draft.entrants) > 1 else []),
            *([(Button.Y, "events.hint_classes")] if not named and self.draft.classes else []),
            *([(Button.Y, "events.hint_team")] if named and teams else []),
            *([(Button.START, "events.hint_begin")] if len(self.draft.entrants) >= FEWEST else []),
            (Button.BACK, "events.hint_back"),
        ]

    def _entrant(self, spot: str) -> Entrant:
        return self.draft.entrants[int(spot)]

    def _ai_name(self) -> str:
        """An unused name for another AI of this strength."""
        taken = {entrant.name for entrant in self.draft.entrants}
        level = level_of(self.brain)
        base = f"BOT{level}" if level else display_name(self.brain).upper()[: MAX_NAME - 1]
        more = (f"{base}{letter}" for letter in ascii_uppercase[1:])
        numbered = (f"{base[:8]}{number}" for number in range(10, 100))
        return next(name for name in (base, *more, *numbered) if name not in taken)

    def _label(self, action: str) -> str:
        words = self.context.words
        if action != STRENGTH:
            return words(f"events.{action}")
        return brain_name(words, self.draft.games[0], self.brain)

    def _spots(self) -> list[FocusSpot]:
        x, spots = LEFT, []
        for name, w in ACTIONS.items():
            spots.append(FocusSpot(name, pygame.Rect(x, ACTIONS_Y, w, ACTION_H)))
            x += w + ACTION_GAP
        return [*spots_of(len(self.draft.entrants)), *spots]


def spots_of(count: int) -> list[FocusSpot]:
    """The places of so many entrants, by number from 0."""
    columns, down = next(grid for most, grid in GRIDS.items() if count <= most)
    across = (RIGHT - LEFT + GAP) // columns
    boxes = (
        pygame.Rect(LEFT + across * (i % columns), TOP + down * (i // columns), across - GAP, down - GAP)
        for i in range(count)
    )
    return [FocusSpot(str(i), box) for i, box in enumerate(boxes)]


def brains_for(played: tuple[str, ...]) -> tuple[str, ...]:
    """AIs that play all these games: the levels; in a single game its other ones, in PiTanks visitors' robots, too."""
    if len(played) > 1:
        return LEVELS
    saved = list(map(str, saved_brains())) if played == ("pitanks",) else []
    return (*AIS[played[0]].rivals, *saved)


def one_a_line(text: str) -> str:
    """A list with one entrant in each line, also if all of them stand in one line."""
    text = text.replace("\0", "").strip()
    return text if "\n" in text or "\r" in text else re.sub(r"\s*[;,\t]\s*", "\n", text)


@cached
def action(word: str, sign: str, w: int, hot: bool) -> LitImage:
    """A box with an icon, if any, and a word; top left at (0, 0)."""
    layer, color = Layer(0, 0, w, ACTION_H), ICE if hot else MIST
    layer.glow.line(cut_box(0, 0, w, ACTION_H, 12), FOCUS if hot else STEEL, THIN, True)
    lead = 60 if sign else 0
    size = fit_size(word, BODY, w - lead - 24)
    left = (w - lead - text_width(word, size)) / 2
    if sign:
        icon(layer.glow, sign, left + 20, ACTION_H / 2, 20, FOCUS if hot else MIST, THIN)
    layer.canvas.crisp.text(word, size, left + lead, ACTION_H / 2, color, "head")
    return layer.render()


@cached
def cell(name: str, team: str, ai: bool, size: tuple[int, int], hot: bool, lit: bool = True) -> LitImage:
    """An entrant with the team, or another note; top left at (0, 0). `lit`: can be chosen."""
    w, h = size
    layer = Layer(0, 0, w, h)
    layer.glow.line(cut_box(0, 0, w, h, 12), FOCUS if hot else STEEL, THIN, True)
    left = 58 if ai else 16
    if ai:
        icon(layer.glow, "ai", 34, h / 2, 18, MIST, 3)
    side = w // 3 if team and w > NARROW else min(84, text_width(team, BODY) + 14) if team else 0
    right = w - 14 - side
    if team:
        layer.canvas.text(shortened(team, side - 10, BODY), BODY, w - 14, h / 2, MIST, "head", "r")
    name, font_size = fit_text(name, LABEL, right - left, "hero", BODY)
    color = FOCUS if hot else ICE if lit else dim(MIST, 0.7)
    layer.canvas.text(name, font_size, (left + right) / 2, h / 2, color, "hero", "c")
    return layer.render()
