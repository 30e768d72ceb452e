"""The route of the walk: every screen, in the languages with the shortest and the longest texts."""

from dataclasses import replace
from functools import partial

from pigaming_app.games.registry import games
from pigaming_app.scenes.editor.registry import EDITORS
from pigaming_app.scenes.flow.scene import Push
from pigaming_app.scenes.options.page import SECTIONS
from pigaming_app.scenes.results.high_scores import HighScores, contest
from pigaming_app.scenes.title.language import SECONDS
from pigaming_app.scenes.walk.events_tour import events
from pigaming_app.scenes.walk.steps import TourWalker, choose, home
from pigaming_app.sim.world import HZ
from pigaming_app.ui.i18n import LANGUAGES

WALKED = ("en", "de")
BRAINS = 5  # presses of F4 to cycle through all AIs of a match


def tour(walker: TourWalker) -> None:
    """The whole tour, in both languages; every arena of each game, and drawing, only in the first."""
    for language in LANGUAGES:
        if language in WALKED:
            walker.wait(SECONDS + 0.5)  # the name of the language is gone
            screens(walker, everything=language == WALKED[0])
        walker.press("tab")
    attract(walker)


def screens(walker: TourWalker, everything: bool) -> None:
    """The screens in one language, from the title back to it."""
    lessons(walker)
    options(walker)
    for game in games():
        play(walker, game, every_arena=everything)
    ladder(walker)
    events(walker)
    lab(walker)
    home(walker)
    if everything:
        editor(walker)
    replays(walker)


def lessons(walker: TourWalker) -> None:
    """The how-to page of each game."""
    walker.set_screen("how to play")
    choose(walker, "howto")
    for _ in games():
        walker.wait(5.0)
        walker.press("d")
    home(walker)


def editor(walker: TourWalker) -> None:
    """The gallery, and a drawing of each game: a wall or a control point, its dials, undo, a match on it."""
    walker.set_screen("gallery")
    choose(walker, "editor")
    walker.wait(1.0)
    for game in EDITORS:
        walker.set_screen(f"{game}: editor")
        walker.press("d", "space", pause=0.5)
        walker.wait(3.0)
        walker.press("s", "s", "d", "space", "d", "d", "s", "space", pause=0.2)
        walker.wait(2.5)
        walker.press("tab", "s", "s", "space", "d", "space", "tab", pause=0.2)
        walker.press("x", pause=0.5)
        walker.wait(2.5)
        walker.press("return", pause=1.0)
        if walker.shows("PlayTest"):
            walker.set_screen(f"{game}: match on a drawing")
            walker.wait(5.0)
            walker.press("return", pause=0.5)
        for _ in range(4):
            if walker.shows("Editor"):
                walker.press("escape", pause=0.3)
        walker.set_screen("gallery")
        walker.press("a", "tab", pause=0.5)
    home(walker)


def replays(walker: TourWalker) -> None:
    """The list of replays, and the latest one: a jump, another speed, the end of a jump ahead."""
    walker.set_screen("replays")
    choose(walker, "replays")
    walker.wait(0.5)
    walker.press("space", pause=1.0)
    if walker.shows("ReplayScene"):
        walker.set_screen("replay")
        walker.wait(2.0)
        walker.press("a", "d", "tab", "d", pause=1.0)
    home(walker)


def options(walker: TourWalker) -> None:
    """The options, row by row, and the pages below them."""
    walker.set_screen("options")
    choose(walker, "options")
    walker.wait(0.5)
    rows(walker)
    home(walker)


def rows(walker: TourWalker) -> None:
    """The rows of a page of options, and the pages that they open; the language is changed and changed back."""
    depth = len(walker.app.stack.scenes)
    for name in [*walker.top.rows]:
        if walker.top.value(name).options == (walker.context.words("options.open"),):
            walker.set_screen(f"options: {name}")
            walker.press("space", pause=1.0)
            if name == "robots":
                robots(walker)
            elif name in (*SECTIONS, "day"):
                rows(walker)
            else:
                walker.press("s", "s", pause=0.3)
            for _ in range(3):
                if len(walker.app.stack.scenes) > depth:
                    walker.press("escape", pause=0.5)
        elif name in ("language", "music", "sounds"):
            walker.press(*("d", "a") if walker.context.words.language == LANGUAGES[0] else ("a", "d"))
        walker.set_screen("options")
        walker.press("s")


def robots(walker: TourWalker) -> None:
    """The pages of real robots, as far as possible without any."""
    for spot in [*walker.top.focus.spots]:
        walker.set_screen(f"robots: {spot.name}")
        walker.press("space", pause=1.5)
        if not walker.shows("RobotsMenu"):
            walker.press("d", "s", "space", pause=0.3)
        for _ in range(6):
            if not walker.shows("RobotsMenu"):
                walker.press("escape", pause=0.5)
        walker.set_screen("options: robots")
        walker.press("s")


def play(walker: TourWalker, game: str, every_arena: bool) -> None:
    """From the lobby to the rematch; then briefly each of the other arenas."""
    lobby(walker, game)
    setup(walker, game)
    arenas = len(walker.top.arenas)
    match(walker, game)
    results(walker, game)
    for _ in range(1, arenas if every_arena else 1):
        walker.set_screen(f"{game}: setup")
        walker.wait(0.5)
        walker.press("d", pause=0.5)
        begin(walker, game)
        walker.wait(4.5)
        leave(walker, game)
    home(walker)


def join(walker: TourWalker, game: str) -> None:
    """Take a seat in the lobby of a game."""
    walker.set_screen(f"{game}: lobby")
    walker.wait_until(lambda: walker.shows("Title"))
    walker.wait(0.5)
    choose(walker, game)
    walker.wait_until(lambda: walker.shows("Lobby"))
    walker.wait(0.5)


def lobby(walker: TourWalker, game: str) -> None:
    """Join, add and remove AIs, form teams, get ready."""
    join(walker, game)
    walker.press(*["tab"] * 6, "x", "d", "a", "x")
    walker.wait(3.0)
    walker.press("d", "a")
    walker.wait(1.0)
    walker.press("return")


def setup(walker: TourWalker, game: str) -> None:
    """Every arena, some other options, and back to the first arena."""
    walker.set_screen(f"{game}: setup")
    walker.wait_until(lambda: walker.shows("MatchSetupPage"))
    walker.wait(0.3)
    for _ in walker.top.arenas:
        walker.press("d", pause=0.4)
    walker.press("s", "d", "d", "a", "s", "d", "a", "w", "w", "w")
    walker.press(*["a"] * len(walker.top.arenas), pause=0.0)


def begin(walker: TourWalker, game: str) -> None:
    """Start the match."""
    walker.set_screen(f"{game}: match")
    walker.press("return")
    walker.wait_until(lambda: walker.shows("MatchScene"))


def match(walker: TourWalker, game: str) -> None:
    """A match with overlay and pause, up to its end, which is brought forward."""
    begin(walker, game)
    walker.wait(6.0)
    walker.set_screen(f"{game}: match with F4")
    for _ in range(BRAINS):
        walker.press("f4", pause=1.0)
    walker.set_screen(f"{game}: pause")
    walker.press("return", pause=0.5)
    walker.press("s", "s")
    walker.set_screen(f"{game}: pause, controls")
    walker.press("space", pause=0.5)
    walker.press("escape", pause=0.3)
    walker.set_screen(f"{game}: match")
    walker.press("escape", pause=5.0)
    state = walker.top.match.state
    state.robots[0].score = 3
    state.rules.ticks = min(state.rules.ticks, state.tick + 2 * HZ)
    walker.wait_until(lambda: walker.shows("Results") or walker.shows("Initials"))


def results(walker: TourWalker, game: str) -> None:
    """The results, initials if asked for, high scores, and a rematch that is ended at once."""
    walker.set_screen(f"{game}: results")
    walker.wait(4.0)
    if walker.shows("Initials"):
        walker.set_screen(f"{game}: initials")
        walker.press("w", "space", "s", "space", "space", "return", pause=0.3)
        walker.wait(2.0)
        if walker.shows("HighScores"):
            walker.press("escape", pause=0.5)
    walker.press("w", pause=1.0)  # saves the replay
    walker.set_screen(f"{game}: numbers")
    walker.press("d", pause=1.0)
    walker.set_screen(f"{game}: best scores")
    walker.app.stack.apply(Push(HighScores(walker.context, contest(walker.top.setup))))
    walker.wait(3.0)
    walker.press("d", "s", "escape", pause=0.5)
    walker.set_screen(f"{game}: rematch")
    walker.wait_until(lambda: walker.shows("Results"))
    walker.wait(6.0)
    walker.press("return")
    walker.wait_until(lambda: walker.shows("MatchScene"))
    walker.wait(2.0)
    leave(walker, game)


def leave(walker: TourWalker, game: str) -> None:
    """End a match by hand, choose the same game again and go on to its setup."""
    walker.set_screen(f"{game}: pause")
    walker.press("return", pause=0.5)
    walker.press("w", pause=0.3)
    walker.set_screen(f"{game}: results")
    for _ in range(4):
        if walker.shows("Pause"):
            walker.press("space", pause=0.5)
    walker.wait_until(lambda: walker.shows("Results"))
    walker.wait(5.0)
    walker.set_screen("change of game")
    walker.press("x", pause=0.5)
    walker.wait_until(lambda: walker.shows("GameChoice"))
    while walker.top.focus.name != game:
        walker.press("d")
    walker.set_screen(f"{game}: lobby")
    walker.press("space", pause=0.5)
    walker.wait_until(lambda: walker.shows("Lobby"))
    walker.press("return")
    walker.set_screen(f"{game}: setup")
    walker.wait_until(lambda: walker.shows("MatchSetupPage"))


def ladder(walker: TourWalker) -> None:
    """A climb through all games: a match, the offer of weaker robots, the end of the climb, the letters, the table."""
    walker.set_screen("ladder: choice")
    choose(walker, "ladder")
    walker.wait(0.5)
    walker.press("tab", pause=1.5)
    walker.press("d", "escape", pause=0.5)
    walker.set_screen("strengths")
    walker.press("x", "d", "d", pause=1.5)
    walker.press("escape", pause=0.5)
    walker.set_screen("ladder: choice")
    walker.press("s", "space", pause=1.0)
    walker.set_screen("ladder: match")
    walker.press("space")
    walker.wait_until(lambda: walker.shows("MatchScene"))
    walker.wait(5.0)
    state = walker.top.match.state
    state.robots[0].score = 9
    state.rules.ticks = min(state.rules.ticks, state.tick + HZ)
    walker.wait_until(lambda: walker.shows("LadderPage"))
    walker.set_screen("ladder: between matches")
    climb = walker.top.climb
    walker.top.climber = replace(walker.top.climber, climb=replace(climb, rung=3, clear=2, beaten=2))
    walker.top.focus.set_spots(walker.top.spots())
    walker.wait(1.5)
    walker.press("s", "w", "s", "space", pause=0.5)
    walker.press("s", "space", pause=0.5)
    walker.set_screen("ladder: end of the climb")
    walker.wait_until(lambda: walker.shows("Summit"))
    walker.wait(3.0)
    walker.press("space", pause=1.0)
    if walker.shows("Initials"):
        walker.press("s", "return", pause=0.5)
    walker.set_screen("ladder: best climbers")
    walker.wait(2.0)
    home(walker)


def lab(walker: TourWalker) -> None:
    """The Lab, its menu and subpages, and a challenge match."""
    walker.set_screen("Lab")
    choose(walker, "lab")
    walker.wait(3.0)
    walker.press("tab", "tab", "d", "s", "space", "d", "d", "space")
    walker.wait(3.0)
    for item, name in enumerate(("save", "open", "compare")):
        walker.set_screen("Lab: menu")
        walker.press("return", pause=0.5)
        walker.press(*["s"] * item)
        walker.set_screen(f"Lab: {name}")
        walker.press("space", pause=2.0)
        walker.press("w", "d", *(["return"] if name == "save" else []))
        for _ in range(8):
            if not walker.shows("Lab"):
                walker.press("escape", pause=0.3)
        walker.set_screen("Lab")
        walker.wait(0.5)
    walker.set_screen("Lab: match")
    walker.press("x")
    walker.wait_until(lambda: walker.shows("Challenge"))
    walker.wait(5.0)
    state = walker.top.inner.match.state
    state.rules.ticks = state.tick + HZ
    walker.wait_until(lambda: walker.shows("ChallengeResult"))
    walker.wait(2.0)
    walker.press("escape", pause=1.0)
    walker.set_screen("Lab")
    walker.wait_until(lambda: walker.shows("Lab"))
    walker.wait(1.0)
    home(walker)


def attract(walker: TourWalker) -> None:
    """One round of shows for every game."""
    walker.context.settings.attract_seconds = 5.0
    walker.set_screen("attract mode")
    walker.wait_until(lambda: walker.shows("Attract"))
    for _ in range(3 * len(games())):
        show = walker.top.show
        walker.wait(4.0)
        if hasattr(show, "runner"):
            state = show.runner.match.state
            state.rules.ticks = min(state.rules.ticks, state.tick + HZ)
        walker.wait_until(partial(other_show, walker, show))
    home(walker)


def other_show(walker: TourWalker, show: object) -> bool:
    """True if attract mode shows another show."""
    return walker.top.show is not show
