"""One-line headline of the results: the winning person, AI or team, or a draw."""

from collections.abc import Sequence
from dataclasses import dataclass

from pigaming_app.ai.brain_files import display_name
from pigaming_app.ai.registry import AIS
from pigaming_app.games.game import ALLIES, PAIRS, Outcome, Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.brain_names import lit_stars
from pigaming_app.scenes.views.sprites.factory import TEAMS
from pigaming_app.ui.draw import FOCUS, ICE, PLAYERS, Color
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Device


@dataclass(frozen=True)
class EndedMatch:
    """A match and how it ended. `absent`: seats of people replaced by an AI; `devices`: of each seat; `names`: of the
    first seats in an event.
    """

    setup: Setup
    outcome: Outcome
    humans: Sequence[int]
    absent: Sequence[int]
    devices: Sequence[Device | None]
    names: Sequence[str] = ()


def headline(
    words: Words, outcome: Outcome, setup: Setup, absent: Sequence[int] = (), names: Sequence[str] = ()
) -> str:
    """Title for a completed match; an AI has driven for the people in `absent`. `names`: see `EndedMatch`."""
    if is_allied(setup):
        return words(f"results.stars_{stars(outcome)}")
    if not outcome.winners:
        return words("results.tie")
    seat = outcome.winners[0]
    if won := [names[winner] for winner in outcome.winners if winner < len(names)]:
        return words("results.name_wins" if len(won) == 1 else "results.names_win", name=" + ".join(won))
    if in_teams(outcome, setup):
        return words("results.team_wins", team=team_name(words, setup, setup.seats[seat].team))
    brain = setup.seats[seat].brain
    if brain == "human":
        return words("results.stand_in_wins" if seat in absent else "results.wins", player=seat + 1)
    name = (
        lit_stars(brain)
        or f"({words(f'lobby.{brain}').lower() if brain in AIS[setup.game].rivals else display_name(brain)})"
    )
    return words("results.ai_wins", player=seat + 1, name=name)


def in_teams(outcome: Outcome, setup: Setup) -> bool:
    """True if teams played: always in the factory, elsewhere if two robots share a team."""
    return _in_pairs(setup) or len({row.team for row in outcome.rows}) < len(outcome.rows)


def team_name(words: Words, setup: Setup, team: int) -> str:
    """Name of a team, as in the lobby."""
    if _in_pairs(setup):
        return words(f"lobby.side_{team + 1}")
    return words("lobby.team", team=team + 1)


def winning_color(outcome: Outcome, setup: Setup) -> Color:
    """Colour of the title line: the team's, if it has one, else that of the best winner."""
    if not outcome.winners:
        return ICE
    seat = outcome.winners[0]
    if is_allied(setup):
        return FOCUS if stars(outcome) else ICE
    return TEAMS[setup.seats[seat].team] if _in_pairs(setup) else PLAYERS[seat]


def is_allied(setup: Setup) -> bool:
    """True if all robots were in one team, against the clock."""
    return games()[setup.game].variants[setup.variant].team_mode == ALLIES


def stars(outcome: Outcome) -> int:
    """The stars of allies, 0 to 3."""
    return round(outcome.rows[0].stats["stars"])


def _in_pairs(setup: Setup) -> bool:
    return games()[setup.game].variants[setup.variant].team_mode == PAIRS
