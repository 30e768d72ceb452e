"""Tables of people as models: their traits, their wins against the levels, and what these hang on."""

from dataclasses import fields

from pigaming_app.ai.brain.effort import AUTO
from pigaming_app.ai.brain.traits import NUMBERS, Traits
from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.people.matches import Place, Trial, places
from pigaming_app.ai.people.models import PEOPLE
from pigaming_app.ai.people.series import FIRSTS, Series, series
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
LEANT = (("beginner", "level1"), ("player", "level3"))  # whose wins are measured with other traits


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
        names = people_of(game)
        found = list(series(Trial(game, count, minutes=minutes), names))
        for name in names:
            rows.append([title, f"`{name}`", *(percent(one) for one in found if one.person == name)])
    return rows


def people_of(game: str) -> tuple[str, ...]:
    """The people whose wins in a game count: masher where wins decide between people and AIs."""
    return ("masher", *PEOPLE) if game in ("pitanks", "football") else tuple(PEOPLE)


def percent(place: Place | Series) -> str:
    low, high = place.interval
    return f"{100 * place.share:.0f} ({100 * low:.0f}–{100 * high:.0f})"


def sensitivity(share: float) -> list[list[str]]:
    """Wins in PiTanks with one trait of all people scaled by 0.7 and by 1.3."""
    count, minutes = some(400, share)
    trial = Trial("pitanks", count, minutes=minutes)
    head = [f"`{name}` against `{level}`, × {factor}" for name, level in LEANT for factor in (0.7, 1.3)]
    rows = [["", *head]]
    for trait in NUMBERS:
        row = [UNITS[trait].partition(",")[0]]
        for name, level in LEANT:
            row += [percent(places(trial, [name], [level], f"{trait}={factor}")[0]) for factor in (0.7, 1.3)]
        rows.append(row)
    return rows
