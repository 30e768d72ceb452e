"""Ratings for the screen, from the JSON files that `league --out` writes: one for each game, the user's own first."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Any

from pigaming_app.games.registry import games
from pigaming_app.storage.parsing import MAX_BYTES, describe_error, parse_json, quote, read

MOST_POINTS = 10_000.0
MOST_ENTRANTS = 100
MAX_NAME = 60  # characters


@dataclass(frozen=True)
class Strength:
    """Rating of one AI and its 95 % interval, in points."""

    brain: str
    rating: float
    low: float
    high: float


@dataclass(frozen=True)
class Ratings:
    """The ratings of a league, best first. `matches`: of each pair."""

    game: str
    variant: str
    matches: int
    strengths: tuple[Strength, ...]


def file_name(game: str) -> str:
    """Name of the file of a game, in any folder."""
    return f"league_{game}.json"


def ratings_of(game: str, folders: Sequence[Path]) -> tuple[Ratings | None, list[str]]:
    """The ratings of a game from the first folder with a valid file, and a sentence for every damaged one."""
    problems: list[str] = []
    for folder in folders:
        path = folder / file_name(game)
        try:
            return parse(read(path, MAX_BYTES), game), problems
        except FileNotFoundError:
            continue
        except (OSError, ValueError) as error:
            problems.append(f"{path} cannot be read ({describe_error(error)}).")
    return None, problems


def parse(raw: bytes, game: str) -> Ratings:
    """The ratings in a file. Raises ValueError with the reason if it is not a league of this game."""
    match parse_json(raw):
        case {"game": str(name), "variant": str(variant), "matches": int(matches), "standings": list(standings)}:
            pass
        case _:
            raise ValueError("it is not a league")
    if name != game or variant not in games()[game].variants:
        raise ValueError(f"it is a league of {quote(name)}, {quote(variant)}")
    if isinstance(matches, bool) or matches < 1 or not 1 < len(standings) <= MOST_ENTRANTS:
        raise ValueError("it has no matches or no entrants")
    strengths = [_strength(entry) for entry in standings]
    if len({strength.brain for strength in strengths}) < len(strengths):
        raise ValueError("it names an AI twice")
    return Ratings(game, variant, matches, tuple(sorted(strengths, key=lambda one: -one.rating)))


def _strength(entry: Any) -> Strength:
    match entry:
        case {"brain": str(brain), "rating": rating, "rating95": [low, high]}:
            pass
        case _:
            raise ValueError(f"{quote(entry)} is not the rating of an AI")
    points = [value for value in (rating, low, high) if isinstance(value, int | float) and not isinstance(value, bool)]
    plausible = len(points) == 3 and all(isfinite(value) and abs(value) <= MOST_POINTS for value in points)
    if not plausible or not low <= rating <= high or not brain.isprintable() or not 0 < len(brain) <= MAX_NAME:
        raise ValueError(f"{quote(entry)} is not the rating of an AI")
    return Strength(brain, float(rating), float(low), float(high))
