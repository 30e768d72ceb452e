"""Tables of people as models: their traits, their wins against the levels, and what these hang on."""

from collections.abc import Callable, Sequence
from dataclasses import fields

from pigaming_app.ai.brain.effort import AUTO
from pigaming_app.ai.brain.kind import NUMBERS, Traits
from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.people.matches import Place, Trial, places
from pigaming_app.ai.people.models import PEOPLE
from pigaming_app.ai.people.series import FIRSTS, Series, series
from pigaming_app.games.registry import games
from pigaming_app.jobs.balance.fairness import Fairness, FairnessOptions, measured
from tests.bench.figures import as_markdown
from tests.bench.figures.duels import some

GAMES = {"pitanks": "PiTanks", "football": "Robot Football", "race": "Robot Race", "factory": "Robot Factory"}
UNITS = {
    "reaction": "reaction time, s",
    "spread": "spread among them, share",
    "decisions": "decisions a second",
    "timing": "error of timing, s",
    "aim": "error of direction, rad",
    "prediction": "share of motion foreseen",
    "lapses": "lapses a minute",
    "lapse": "length of a lapse, s",
    "stick": "noise of the stick, rad",
    "tactics": "knowledge of the game",
    "turbo": "turbo and mines",
}
EQUAL = ("level3", "level5")  # of all four seats
LEANT = {"beginner": "level1", "player": "level3", "expert": "level4"}  # against whom wins with other traits count
FACTORS = (0.7, 1.3)  # of a trait


def traits() -> str:
    """The traits of the models."""
    rows = [["", *(f"`{name}`" for name in PEOPLE)]]
    for field in fields(Traits):
        rows.append([UNITS[field.name], *(shown(getattr(one.traits, field.name)) for one in PEOPLE.values())])
    return as_markdown(rows)


def shown(value: float | bool) -> str:
    return ("yes" if value else "no") if isinstance(value, bool) else f"{value:g}"


def wins(share: float) -> list[list[str]]:
    """Shares of wins in %, by game and person."""
    count, minutes = some(400, share)
    rows = [["", "", *(f"`{level}`" for level in LEVELS)]]
    for game, title in GAMES.items():
        names = people_of(game)
        found = places(Trial(game, count, minutes=minutes), names, LEVELS)
        for name in names:
            rows.append([title, f"`{name}`", *(percent(place) for place in found if place.person == name)])
    return rows


def auto(share: float) -> list[list[str]]:
    """Wins in % against Auto, after the matches in which it learns, by game, person and first strength."""
    count, minutes = some(800, share)
    rows = [["", "", *(f"from `{AUTO[first]}`" for first in FIRSTS)]]
    for game, title in GAMES.items():
        names = ("masher", *PEOPLE)
        found = list(series(Trial(game, count, minutes=minutes), names))
        for name in names:
            rows.append([title, f"`{name}`", *(percent(one) for one in found if one.person == name)])
    return rows


def auto_leant(share: float) -> list[list[str]]:
    """The same from the middle strength, of people who decide less and more often."""
    count, minutes = some(800, share)
    rows = [["", *(f"`{name}`, × {factor}" for name in LEANT for factor in FACTORS)]]
    for game, title in GAMES.items():
        row = [title]
        for name in LEANT:
            for factor in FACTORS:
                trial = Trial(game, count, minutes=minutes)
                row += [percent(one) for one in series(trial, [name], [FIRSTS[1]], f"decisions={factor}")]
        rows.append(row)
    return rows


def people_of(game: str) -> tuple[str, ...]:
    """The people whose wins in a game count: masher where wins decide between people and AIs."""
    return ("masher", *PEOPLE) if game in ("pitanks", "football") else tuple(PEOPLE)


def seats(share: float) -> list[list[str]]:
    """Of four equal AIs: least and most wins of a seat or team in an arena, ties, and what a lead is worth."""
    count, minutes = some(800, share)
    rows = [["", "", "wins, least and most", "ties", "behind at half time wins", "first to lead wins", "changes"]]
    for game, title in GAMES.items():
        teams = games()[game].default.teams
        for level in EQUAL:
            options = FairnessOptions(game=game, seats=level, matches=count, minutes=minutes)
            rows.append([title, f"`{level}`", *lead_figures(measured(options, teams))])
    return rows


def lead_figures(found: Sequence[Fairness]) -> list[str]:
    """The cells of a game: of its arenas, and of all matches, which come last."""
    *each, total = found
    shares = [100 * share for one in each for share in one.shares]
    ties = 100 * total.ties / total.matches
    course = f"{ties:.1f} %", f"{100 * total.turned:.0f} %", f"{100 * total.first:.0f} %", f"{total.changes:g}"
    return [f"{min(shares):.0f}–{max(shares):.0f} %", *course]


def percent(place: Place | Series) -> str:
    low, high = place.interval
    return f"{100 * place.share:.0f} ({100 * low:.0f}–{100 * high:.0f})"


def sensitivity(share: float) -> list[list[str]]:
    """Wins in PiTanks with one trait of all people scaled by 0.7 and by 1.3."""
    return _leant([("pitanks", name) for name in LEANT], [f"`{name}` against `{LEANT[name]}`" for name in LEANT], share)


def sensitivity_elsewhere(name: str) -> Callable[[float], list[list[str]]]:
    """The same of one person in the other games."""
    others = [game for game in GAMES if game != "pitanks"]

    def table(share: float) -> list[list[str]]:
        return _leant([(game, name) for game in others], [GAMES[game] for game in others], share)

    return table


def _leant(columns: Sequence[tuple[str, str]], titles: Sequence[str], share: float) -> list[list[str]]:
    """Wins by trait. `columns`: game and person."""
    count, minutes = some(400, share)
    rows = [["", *(f"{title}, × {factor}" for title in titles for factor in FACTORS)]]
    for trait in NUMBERS:
        row = [UNITS[trait].partition(",")[0]]
        for game, name in columns:
            trial = Trial(game, count, minutes=minutes)
            row += [percent(places(trial, [name], [LEANT[name]], f"{trait}={factor}")[0]) for factor in FACTORS]
        rows.append(row)
    return rows
