"""One-line headline of the results: the winning person, AI or team, or a draw."""

from collections.abc import Sequence
from dataclasses import dataclass

from pigaming_app.ai.brain.effort import AUTO
from pigaming_app.ai.brain_files import display_name
from pigaming_app.ai.game_ai import STAND_IN
from pigaming_app.ai.registry import AIS
from pigaming_app.games.game import ALLIES, PAIRS, Outcome, Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.match_words import lit_stars
from pigaming_app.scenes.views.hud.ai_sign import name_of
from pigaming_app.scenes.views.sprites.teams import TEAMS
from pigaming_app.ui.draw import FOCUS, ICE, PLAYERS, Color
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Device


@dataclass(frozen=True)
class EndedMatch:
    """A match and how it ended. `devices`: of each seat at its end; `names`: of the entrants on the first seats, in an
    event, else of the phones; `stood_in`: seats of people of the event for whom an AI has driven from the start.
    """

    setup: Setup
    outcome: Outcome
    devices: Sequence[Device | None]
    names: Sequence[str] = ()
    stood_in: Sequence[int] = ()

    @property
    def humans(self) -> list[int]:
        """Seats of people, present or away."""
        seats = sorted(row.seat for row in self.outcome.rows)
        return [seat for seat in seats if self.devices[seat] or self.setup.seats[seat].brain == "human"]

    @property
    def absent(self) -> list[int]:
        """Seats of people for whom an AI has driven."""
        return [*(seat for seat in self.humans if not self.devices[seat]), *self.stood_in]

    def brain(self, seat: int) -> str:
        """The AI that drove a seat at the end; empty: a person."""
        brain = self.setup.seats[seat].brain
        return "" if self.devices[seat] else STAND_IN if brain == "human" else brain


def headline(words: Words, ended: EndedMatch) -> str:
    """Title for a completed match."""
    outcome, setup = ended.outcome, ended.setup
    if is_allied(setup):
        return words(f"results.stars_{stars(outcome)}")
    if not outcome.winners:
        return words("results.tie")
    seat, names = outcome.winners[0], [_entrant(words, ended, seat) for seat in outcome.winners]
    if len(names) > 1 and all(name_of(ended.names, winner) for winner in outcome.winners):
        return words("results.names_win", name=" + ".join(names))
    if in_teams(outcome, setup):
        return words("results.team_wins", team=team_name(words, setup, setup.seats[seat].team))
    brain = ended.brain(seat)
    kind = "stand_in_" if seat in ended.absent else "ai_" if brain else ""
    if name := name_of(ended.names, seat):
        return words(f"results.{kind}name_wins", name=name)
    if kind != "ai_":
        return words(f"results.{kind}wins", player=seat + 1)
    return words("results.ai_wins", player=seat + 1, name=lit_stars(brain) or f"({_of_ai(words, setup.game, brain)})")


def _of_ai(words: Words, game: str, brain: str) -> str:
    """The name of an AI that is no level, within a sentence."""
    if brain in AUTO:
        return words("match.auto")
    return words(f"lobby.{brain}").lower() if brain in AIS[game].rivals else display_name(brain)


def _entrant(words: Words, ended: EndedMatch, seat: int) -> str:
    """The name of an entrant in a team, marked if an AI drove."""
    name = name_of(ended.names, seat)
    return words("results.ai_named", name=name) if ended.brain(seat) else name


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
