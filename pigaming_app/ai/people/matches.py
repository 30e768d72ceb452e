"""Matches of people against AIs: how often a person wins against three AIs, or with a mate against two."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from pigaming_app.ai.brain.kind import NUMBERS, BrainKind
from pigaming_app.ai.game_ai import POINT, TURN
from pigaming_app.ai.learning.league import wilson
from pigaming_app.ai.learning.line_ups import LineUps
from pigaming_app.ai.people.models import PEOPLE, people, person_brain
from pigaming_app.ai.registry import AIS, known_brains
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Setup, Variant
from pigaming_app.games.match import victory
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, make_setup, require_one_of
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import ROBOTS

STYLES = (TURN, POINT)


@dataclass(frozen=True)
class Trial:
    """Matches of a game: over all its arenas and the four seats of the person in turn, with one seed each."""

    game: str
    matches: int
    seed: int = 0
    variant: str | None = None
    minutes: float | None = None

    @property
    def rules(self) -> Variant:
        """The set of rules, the game's first by default."""
        return games()[self.game].variants[self.variant] if self.variant else games()[self.game].default

    def setups(self, person: str, level: str) -> Iterator[tuple[Setup, int]]:
        """Each setup, and the person's seat. Mates are of the person's kind. Raises ChoiceError."""
        names, teams = arenas(self.game), self.rules.teams
        known = [*known_brains(self.game, [level]), person]
        for i in range(self.matches):
            seat = i % ROBOTS
            brains = [person if team == teams[seat] else level for team in teams]
            chosen = names[i // ROBOTS % len(names)], self.minutes, self.seed + i, self.rules.name, None
            yield make_setup(self.game, brains, *chosen, known), seat


@dataclass(frozen=True)
class Place:
    """Result of a person. `wins`: matches that their team won, of n level teams at the top 1/n each."""

    person: str
    level: str
    matches: int
    wins: float
    mean_score: float  # of the person alone

    @property
    def share(self) -> float:
        """Share of the matches that they won."""
        return self.wins / self.matches

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's interval of that share, 95 %."""
        return wilson(round(self.wins), self.matches)


def places(
    trial: Trial, persons: Sequence[str], levels: Sequence[str], scale: str | None = None, driving: str | None = None
) -> list[Place]:
    """The place of each of these people against each of these AIs. Raises ChoiceError or ArenaError.

    `scale`: a trait of the people and a factor, such as "reaction=1.3"; `driving`: their style, turn or point.
    """
    if wrong := [name for name in persons if not is_person(trial.game, name)]:
        raise ChoiceError(f"no model of people '{wrong[0]}' in {trial.game}")
    line_ups = LineUps(trial.game, [*persons, *levels], can_compile(), changed(trial.game, scale, driving))
    return [place(trial, person, level, line_ups) for person in persons for level in levels]


def is_person(game: str, name: str) -> bool:
    """True for the name of somebody whom a game has a model of."""
    return name in people(AIS[game])


def changed(game: str, scale: str | None, driving: str | None) -> dict[str, BrainKind]:
    """The people of a game, with one trait scaled, or with another driving style. Raises ChoiceError."""
    wishes = AIS[game].person
    if wishes is None or not (scale or driving):
        return {}
    if driving:
        require_one_of("driving style", driving, STYLES)
    models = {name: replace(model, driving=driving or model.driving) for name, model in PEOPLE.items()}
    if scale:
        trait, factor = _trait_and_factor(scale)
        models = {name: replace(model, traits=model.traits.scaled(trait, factor)) for name, model in models.items()}
    return {name: person_brain(name, wishes, model) for name, model in models.items()}


def _trait_and_factor(scale: str) -> tuple[str, float]:
    trait, _, factor = scale.partition("=")
    require_one_of("trait", trait, NUMBERS)
    try:
        share = float(factor)
    except ValueError:
        raise ChoiceError(f"{scale}: not a trait and a factor, such as reaction=1.3") from None
    if not 0.0 < share <= 10.0:
        raise ChoiceError(f"{scale}: the factor is not between 0 and 10")
    return trait, share


def place(trial: Trial, person: str, level: str, line_ups: LineUps) -> Place:
    game, setups = games()[trial.game], [*trial.setups(person, level)]
    ends = line_ups.played([setup for setup, _ in setups])
    seats = [seat for _, seat in setups]
    wins = sum(victory(game, end, seat) for end, seat in zip(ends, seats, strict=True))
    score = sum(end.robots[seat].score for end, seat in zip(ends, seats, strict=True)) / len(ends)
    return Place(person, level, len(ends), wins, score)
