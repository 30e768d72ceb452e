"""Who won, in one line: a person, an AI by its name, a team by its own; or nobody."""

from collections.abc import Sequence

from pigaming_app.ai import RIVALS
from pigaming_app.games.game import PAIRS, Outcome, Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.views.sprites.factory import TEAMS
from pigaming_app.ui.draw import ICE, PLAYERS, Color
from pigaming_app.ui.i18n import Words


def headline(words: Words, outcome: Outcome, setup: Setup, absent: Sequence[int] = ()) -> str:
    """The title of the results of a match that was played to its end; for the people `absent` an AI has driven."""
    if not outcome.winners:
        return words("results.tie")
    seat = outcome.winners[0]
    if in_teams(outcome, setup):
        return words("results.team_wins", team=team_name(words, setup, setup.seats[seat].team))
    brain = setup.seats[seat].brain
    if brain == "human":
        return words("results.stand_in_wins" if seat in absent else "results.wins", player=seat + 1)
    level = words(f"lobby.{brain}").lower() if brain in RIVALS[setup.game] else brain
    return words("results.ai_wins", player=seat + 1, level=level)


def in_teams(outcome: Outcome, setup: Setup) -> bool:
    """Whether teams played: always two in the factory, elsewhere where two robots share one."""
    return games()[setup.game].team_mode == PAIRS or len({row.team for row in outcome.rows}) < len(outcome.rows)


def team_name(words: Words, setup: Setup, team: int) -> str:
    """What a team is called in the lobby."""
    if games()[setup.game].team_mode == PAIRS:
        return words(f"lobby.side_{team + 1}")
    return words("lobby.team", team=team + 1)


def winning_color(outcome: Outcome, setup: Setup) -> Color:
    """The colour of the line: the team's where teams have one, else that of the best of the winners."""
    if not outcome.winners:
        return ICE
    seat = outcome.winners[0]
    return TEAMS[setup.seats[seat].team] if games()[setup.game].team_mode == PAIRS else PLAYERS[seat]
