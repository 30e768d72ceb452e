"""An event: a spec and a journal. Everything else follows from these two, so they are all that a file holds."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from pigaming_app.events.formats.registry import KINDS
from pigaming_app.events.journal import (
    Added,
    Arranged,
    Closed,
    Corrected,
    Entry,
    Postponed,
    Recorded,
    Substituted,
    Withdrawn,
)
from pigaming_app.events.progress import Progress
from pigaming_app.events.spec import Entrant, EventSpec, Fixture, Format, Result, Standing, check_spec
from pigaming_app.storage.schema import to_plain, typed


@dataclass(frozen=True)
class Event:
    """A value: each change returns the event with one more entry, or raises ValueError with one plain sentence."""

    spec: EventSpec
    journal: tuple[Entry, ...] = ()

    @cached_property
    def progress(self) -> Progress:
        """The state after the journal. Raises ValueError if spec or journal are impossible."""
        check_event(self.spec)
        progress = Progress(self.spec, self.spec.entrants).drawn()
        for entry in self.journal:
            progress = progress.after(entry)
        return progress

    @property
    def entrants(self) -> tuple[Entrant, ...]:
        """Everybody who was ever entered, by the seeding, late ones last; each with the brain of now."""
        return self.progress.entrants

    @property
    def withdrawn(self) -> frozenset[str]:
        """Names of those who have withdrawn."""
        return self.progress.withdrawn

    @cached_property
    def fixtures(self) -> tuple[Fixture, ...]:
        """Every match known so far, played or open, in order of play. A bye is no match."""
        return tuple(sorted(self.progress.fixtures, key=self.progress.order_of_play))

    @cached_property
    def open(self) -> tuple[Fixture, ...]:
        """The matches that can be played now, the next one first; of a tied knock-out match, its extra match."""
        progress = self.progress
        return tuple(progress.next_match(one) for one in self.fixtures if one.number not in progress.outcomes)

    @cached_property
    def outcomes(self) -> dict[int, Result]:
        """The results by number of the match; walkovers have the note WALKOVER."""
        return dict(self.progress.outcomes)

    @property
    def played(self) -> Mapping[int, tuple[Result, ...]]:
        """Every match that was played, by number: the match itself, then its extra matches."""
        return self.progress.played

    def lots(self, number: int) -> bool:
        """True if lots were drawn for a match, as its extra matches were level, too."""
        return number in self.played and self.progress.verdict(self.progress.fixtures[number - 1]).lots

    def through(self, fixture: Fixture) -> frozenset[str]:
        """Who goes on from a match; nobody while it is not decided, or if it decides nothing."""
        return self.progress.through(fixture)

    @property
    def byes(self) -> dict[int, tuple[str, ...]]:
        """Who has a bye, by round."""
        return {drawn.number: drawn.byes for drawn in self.progress.rounds if drawn.byes}

    @cached_property
    def standings(self) -> tuple[Standing, ...]:
        """The table, best first."""
        return self.progress.kind.table(self.progress.as_field())

    @cached_property
    def part_standings(self) -> Mapping[str, tuple[Standing, ...]]:
        """The tables of the groups by their names, best first; none in most formats."""
        return self.progress.kind.parts(self.progress.as_field())

    @cached_property
    def team_standings(self) -> tuple[Standing, ...]:
        """The table of teams, best first, by the sum of the points, then of the wins, of their entrants; empty without
        teams. `entrant` is the team.
        """
        rows = {row.entrant: row for row in self.standings}
        members: dict[str, list[Standing]] = {}
        for entrant in self.entrants:
            if entrant.team:
                members.setdefault(entrant.team, []).append(rows[entrant.name])
        points = {team: sum(row.points for row in team_rows) for team, team_rows in members.items()}
        won = {team: sum(row.wins for row in team_rows) for team, team_rows in members.items()}
        order = sorted(members, key=lambda team: (-points[team], -won[team]))
        ranks = [(points[team], won[team]) for team in order]
        return tuple(
            Standing(
                place=1 + ranks.index((points[team], won[team])),
                entrant=team,
                points=points[team],
                wins=won[team],
                played=sum(row.played for row in members[team]),
                tie_breaks={"wins": float(won[team])},
            )
            for team in order
        )

    @property
    def calls(self) -> dict[int, str]:
        """The arcade of each open match that is called, by number; empty: the only one."""
        return {number: arcade for number, arcade in self.progress.called.items() if number not in self.outcomes}

    @property
    def pause(self) -> str | None:
        """The note of a break; None while play goes on."""
        return self.progress.pause

    def next_at(self, arcade: str) -> Fixture | None:
        """The match that an arcade plays next: one called to it, or the first whose entrants are free.

        None while all others are called elsewhere, and at the end.
        """
        calls = self.calls
        own = next((one for one in self.open if calls.get(one.number) == arcade), None)
        if own:
            return own
        busy = {name for one in self.open if one.number in calls for name in one.entrants}
        free = (one for one in self.open if one.number not in calls and not busy & {*one.entrants})
        return next(free, None)

    @property
    def round(self) -> int:
        """Round of the next match; after the last one that of the last."""
        return self.open[0].round if self.open else max((one.number for one in self.progress.rounds), default=1)

    @property
    def over(self) -> bool:
        """True if there is nothing left to play, and nothing to be arranged."""
        return not self.open and not self.progress.running

    def record(self, outcome: Result) -> "Event":
        """With the result of an open match."""
        return self.after(Recorded(outcome))

    def correct(self, outcome: Result) -> "Event":
        """With another result of a match that has been played; its note gives the reason."""
        return self.after(Corrected(outcome))

    def add(self, entrant: Entrant) -> "Event":
        """With a late entrant, before a match of round two has been played."""
        return self.after(Added(entrant))

    def withdraw(self, name: str) -> "Event":
        """Without an entrant, whose open matches are walkovers; those of three or four are played by the others."""
        return self.after(Withdrawn(name))

    def postpone(self, fixture: int) -> "Event":
        """With others before this open match."""
        return self.after(Postponed(fixture))

    def substitute(self, name: str, brain: str) -> "Event":
        """With an AI in the place of an entrant, under the same name; an empty brain: a person again."""
        return self.after(Substituted(name, brain))

    def arrange(self, *names: str) -> "Event":
        """With a match of these entrants, in a format on call; of a challenge, the challenger first."""
        return self.after(Arranged(names))

    def continued(self) -> "Event":
        """With the matches that AIs would arrange next, in a format on call; without any, the day or week is closed."""
        on_call, event = KINDS[self.spec.format].on_call, self
        assert on_call
        while names := on_call.next(event.progress.as_field()):
            event = event.arrange(*names)
        return self.close() if event is self else event

    def close(self) -> "Event":
        """With the end of a day or a week, in a format on call."""
        return self.after(Closed())

    def renamed(self, title: str) -> "Event":
        """Under another title."""
        event = Event(replace(self.spec, title=title), self.journal)
        check_event(event.spec)
        return event

    def after(self, entry: Entry) -> "Event":
        """With one more entry, which its file can hold."""
        event = Event(self.spec, (*self.journal, entry))
        event.__dict__["progress"] = self.progress.after(entry)  # the cached value: no replay from the beginning
        typed(to_plain(entry), type(entry))
        return event


def check_event(spec: EventSpec) -> None:
    """Raises ValueError, with one sentence, for a spec that cannot be played."""
    typed(to_plain(spec), EventSpec)
    check_spec(spec)
    kind = KINDS[spec.format]
    if spec.seats not in kind.seats:
        low, high = min(kind.seats), max(kind.seats)
        raise ValueError(f"a match has {low} to {high} seats, not {spec.seats}".replace(f"{low} to {low} ", f"{low} "))
    if spec.fill and not kind.fills:
        raise ValueError(f"AIs fill seats in {', '.join(form for form in Format if KINDS[form].fills)} only")
    kind.check(spec)
