"""Ratings for the screen, from the JSON files that `league --out` writes: one for each game, the user's own first."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from msgspec import Meta

from pigaming_app.games.registry import games
from pigaming_app.storage.parsing import MAX_BYTES, describe_error, quote, read
from pigaming_app.storage.schema import PRINTABLE, Line, between, from_json

MOST_POINTS = 10_000
Points = Annotated[float, between(-MOST_POINTS, MOST_POINTS)]


@dataclass(frozen=True)
class Strength:
    """Rating of one AI and its 95 % interval, in points."""

    brain: Annotated[str, PRINTABLE, Meta(min_length=1, max_length=60)]
    rating: Points
    rating95: tuple[Points, Points]

    def __post_init__(self) -> None:
        if not self.low <= self.rating <= self.high:
            raise ValueError("the rating is outside its interval")

    @property
    def low(self) -> float:
        """The lower end of the interval."""
        return self.rating95[0]

    @property
    def high(self) -> float:
        """The upper end of the interval."""
        return self.rating95[1]


@dataclass(frozen=True)
class Ratings:
    """The ratings of a league. `matches`: of each pair."""

    game: Line
    variant: Line
    matches: Annotated[int, Meta(ge=1)]
    standings: Annotated[tuple[Strength, ...], Meta(min_length=2, max_length=100)]

    def __post_init__(self) -> None:
        if len({strength.brain for strength in self.standings}) < len(self.standings):
            raise ValueError("it names an AI twice")

    @property
    def strengths(self) -> list[Strength]:
        """The ratings, best first."""
        return sorted(self.standings, key=lambda one: -one.rating)


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
    ratings = from_json(raw, Ratings)
    if ratings.game != game or ratings.variant not in games()[game].variants:
        raise ValueError(f"it is a league of {quote(ratings.game)}, {quote(ratings.variant)}")
    return ratings
