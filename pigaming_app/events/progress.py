"""The event as it stands after the entries of the journal: rounds, results, who is there.

A round is drawn as soon as the one before it is complete, and drawn anew, after a correction or with a late entrant, as
long as none of its matches has been played. A knock-out match has no result before its extra matches have decided it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from pigaming_app.events.formats import exchanges, sudden_death
from pigaming_app.events.formats.field import Draw, EntrantField, FormatKind, MatchUp
from pigaming_app.events.formats.grouping import seated
from pigaming_app.events.formats.registry import KINDS
from pigaming_app.events.formats.sudden_death import Verdict, through
from pigaming_app.events.journal import (
    Added,
    Arranged,
    Closed,
    Corrected,
    Entry,
    Paused,
    Postponed,
    Recorded,
    Reseated,
    Resumed,
    Substituted,
    Summoned,
    Swapped,
    Withdrawn,
)
from pigaming_app.events.refusals import Refused
from pigaming_app.events.spec import MOST, WALKOVER, Entrant, EventSpec, Fixture, Result, Round, check_name
from pigaming_app.storage.parsing import quote

SEED_STEP = 10_000  # between the seeds of two events, more than an event has matches


@dataclass(frozen=True)
class Progress:
    """A value; `after` is the next one."""

    spec: EventSpec
    entrants: tuple[Entrant, ...]  # by their seeding, late ones last, with the brains of now
    late: frozenset[str] = frozenset()
    left: Mapping[str, int] = field(default_factory=dict)  # who has withdrawn, and the round that was open then
    rounds: tuple[Round, ...] = ()
    outcomes: Mapping[int, Result] = field(default_factory=dict)  # by fixture, walkovers included
    played: Mapping[int, tuple[Result, ...]] = field(default_factory=dict)  # by fixture: the match, then extra ones
    postponed: Mapping[int, int] = field(default_factory=dict)  # times, by fixture
    exchanged: tuple[tuple[int, str, str], ...] = ()  # round, and whose places in the seeding: in a winners' bracket
    called: Mapping[int, str] = field(default_factory=dict)  # arcade, by fixture
    pause: str | None = None  # note of a break; None: play goes on
    closed: int = 0  # periods of a format on call
    joined: Mapping[str, int] = field(default_factory=dict)  # periods closed before somebody entered late

    def after(self, entry: Entry) -> "Progress":
        """The event after this entry. Raises Refused if it is not possible."""
        match entry:
            case Recorded(outcome):
                return self._recorded(outcome)
            case Corrected(outcome):
                return self._corrected(outcome)
            case Added(entrant):
                return self._added(entrant)
            case Withdrawn(name):
                return self._without(name)
            case Postponed(number):
                self._open_fixture(number)
                called = {other: where for other, where in self.called.items() if other != number}
                later = {**self.postponed, number: self.postponed.get(number, 0) + 1}
                return replace(self, postponed=later, called=called)
            case Substituted(name, brain):
                self._present(name)
                entrants = (replace(one, brain=brain) if one.name == name else one for one in self.entrants)
                return replace(self, entrants=tuple(entrants))
            case Swapped(name, other):
                self._present(name)
                self._present(other)
                seeding, rounds = exchanges.swapped(self.as_field(), self.played, name, other)
                by_name = {one.name: one for one in self.entrants}
                ordered, exchanged = tuple(by_name[one] for one in seeding), self.exchanged
                if ordered != self.entrants:
                    number = next(now.number for now, before in zip(rounds, self.rounds, strict=True) if now != before)
                    exchanged = (*exchanged, (number, name, other))
                return replace(self, entrants=ordered, rounds=rounds, exchanged=exchanged)
            case Reseated(number, seats):
                rounds = exchanges.seated(self.rounds, self.played, self._open_fixture(number), seats)
                return replace(self, rounds=rounds)
            case Summoned(number, arcade):
                return self._called(number, arcade)
            case Paused(note):
                if self.pause is not None:
                    raise Refused("break_begun")
                return replace(self, pause=note)
            case Resumed():
                if self.pause is None:
                    raise Refused("no_break")
                return replace(self, pause=None)
            case Arranged(names):
                return self._arranged(names)
            case Closed():
                return self._closed()

    @property
    def kind(self) -> FormatKind:
        """The format."""
        return KINDS[self.spec.format]

    @property
    def withdrawn(self) -> frozenset[str]:
        """Names of those who have withdrawn."""
        return frozenset(self.left)

    @property
    def running(self) -> bool:
        """True while matches can be arranged, in a format on call."""
        on_call = self.kind.on_call
        return on_call is not None and self.closed < on_call.periods(self.spec)

    @property
    def fixtures(self) -> tuple[Fixture, ...]:
        """All fixtures by number."""
        return tuple(fixture for drawn in self.rounds for fixture in drawn.fixtures)

    def order_of_play(self, fixture: Fixture) -> tuple[int, int, int]:
        """A key to sort by: a postponed match follows its round, and the next one too, if it is drawn already."""
        later = self.postponed.get(fixture.number, 0)
        return fixture.round + later, later, fixture.number

    def next_match(self, fixture: Fixture) -> Fixture:
        """An open fixture, or the extra match that it still needs."""
        if before := self.played.get(fixture.number):
            return sudden_death.extra_match(fixture, len(before), self.verdict(fixture).tied)
        return fixture

    def verdict(self, fixture: Fixture) -> Verdict:
        """What the matches of a fixture that has been played have decided; it may be tied if nobody goes on."""
        before, wins = self.played[fixture.number], self.kind.wins(self.spec, fixture)
        return sudden_death.verdict(fixture, before, wins) if wins else Verdict(before[0].places)

    def as_field(self) -> EntrantField:
        """What a draw may look at."""
        names = tuple(entrant.name for entrant in self.entrants)
        return EntrantField(
            self.spec, names, self.late, self.withdrawn, self.rounds, self.outcomes, self.closed, self.joined, self.left
        )

    def drawn(self) -> "Progress":
        """With every round that can be drawn now."""
        progress = self._with_walkovers()
        while draws := self.kind.draws(progress.as_field()):
            for draw in draws:
                progress = progress._with_round(draw)
            progress = progress._with_walkovers()
        return progress

    def _with_round(self, draw: Draw) -> "Progress":
        number = len(self.rounds) + 1
        return replace(self, rounds=(*self.rounds, Round(number, self._fixtures(number, draw.matches), draw.byes)))

    def _fixtures(self, number: int, matches: Sequence[MatchUp]) -> tuple[Fixture, ...]:
        """Matches of a round behind all others."""
        spec, game, arena = self.spec, self.spec.game_of(number), self.spec.arena_of(number)
        first = len(self.fixtures) + 1
        sat = {entrant.name: [0] * 4 for entrant in self.entrants}
        for fixture in self.fixtures:
            for seat, name in enumerate(fixture.entrants):
                sat[name][seat] += 1
        return tuple(
            Fixture(
                number=first + i,
                round=number,
                stage=match.stage,
                game=game,
                arena=arena,
                entrants=match.entrants if match.seated else seated(match.entrants, sat),
                seed=spec.seed * SEED_STEP + first + i,
                fill=spec.seats - len(match.entrants) if spec.fill else 0,
            )
            for i, match in enumerate(matches)
        )

    def _arranged(self, names: tuple[str, ...]) -> "Progress":
        on_call = self.kind.on_call
        if on_call is None:
            raise Refused("drawn")
        if not self.running:
            raise Refused("over")
        for name in names:
            self._present(name)
        on_call.check(self.as_field(), names)
        *before, now = self.rounds
        added = self._fixtures(now.number, (MatchUp(names, on_call.stage),))
        return replace(self, rounds=(*before, replace(now, fixtures=(*now.fixtures, *added))))

    def _closed(self) -> "Progress":
        """The period is over. Nobody wins a match that is open."""
        if not self.running:
            raise Refused("no_period")
        still = [one for one in self.fixtures if one.number not in self.outcomes]
        lapsed = {one.number: Result(one.number, (tuple(sorted(one.entrants)),), note=WALKOVER) for one in still}
        return replace(self, outcomes={**self.outcomes, **lapsed}, closed=self.closed + 1).drawn()

    def _with_walkovers(self) -> "Progress":
        """Open matches without those who have withdrawn; whoever would be alone wins."""
        if not self.withdrawn:
            return self
        outcomes, rounds, progress = dict(self.outcomes), [], self
        for drawn in self.rounds:
            fixtures = []
            for fixture in drawn.fixtures:
                here = tuple(name for name in fixture.entrants if name not in self.withdrawn)
                if fixture.number in self.played:
                    progress = progress._without_extra_match(fixture)
                elif fixture.number not in outcomes and here != fixture.entrants:
                    if len(here) > 1:
                        fixture = replace(fixture, entrants=here)
                    else:
                        away = tuple(sorted({*fixture.entrants} - {*here}))
                        places = (here, away) if here else (away,)
                        outcomes[fixture.number] = Result(fixture.number, places, note=WALKOVER)
                fixtures.append(fixture)
            rounds.append(replace(drawn, fixtures=tuple(fixtures)))
        return replace(progress, rounds=tuple(rounds), outcomes={**outcomes, **progress.outcomes})

    def _without_extra_match(self, fixture: Fixture) -> "Progress":
        """An open extra match goes to those who are there; without any of them, to no matter whom."""
        if fixture.number in self.outcomes:
            return self
        tied = self.verdict(fixture).tied
        here = tuple(name for name in tied if name not in self.withdrawn)
        if here == tied:
            return self
        away = tuple(name for name in tied if name not in here)
        places = (here, away) if here else tuple((name,) for name in away)
        progress = self._after_match(fixture, Result(fixture.number, places, note=WALKOVER))
        return progress._without_extra_match(fixture)

    def _recorded(self, outcome: Result) -> "Progress":
        fixture = self._open_fixture(outcome.fixture)
        progress = self._after_match(fixture, checked(outcome, self.next_match(fixture)))
        return progress.drawn() if progress.as_field().complete else progress

    def _after_match(self, fixture: Fixture, outcome: Result) -> "Progress":
        """With one more match of a fixture. Its result has the places that all of them together decide."""
        number = fixture.number
        played = (*self.played.get(number, ()), outcome)
        postponed = {other: times for other, times in self.postponed.items() if other != number}
        called = {other: arcade for other, arcade in self.called.items() if other != number}
        progress = replace(self, played={**self.played, number: played}, postponed=postponed, called=called)
        decided = progress.verdict(fixture)
        if decided.tied:
            return progress
        return replace(progress, outcomes={**self.outcomes, number: replace(played[0], places=decided.places)})

    def _corrected(self, outcome: Result) -> "Progress":
        number = outcome.fixture
        if number not in self.played:
            raise Refused("unplayed", match=number)
        if not outcome.note.strip():
            raise Refused("no_reason")
        fixture = self.fixtures[number - 1]
        outcomes = {other: kept for other, kept in self.outcomes.items() if other != number}
        before = replace(self, outcomes=outcomes, played={**self.played, number: ()})
        progress = before._after_match(fixture, checked(outcome, fixture))
        if self._qualified(fixture) != progress._qualified(fixture):
            for one in self.fixtures:
                if one.round > fixture.round and self._played(one) and self.kind.wins(self.spec, one):
                    raise Refused("decided", match=number, later=one.number)
            progress = progress._without_exchanges(fixture.round)
        return progress._without_unplayed_rounds().drawn() if self.kind.follows_results else progress

    def through(self, fixture: Fixture) -> frozenset[str]:
        """Who goes on from a match; nobody while it is not decided, or if it decides nothing."""
        outcome, wins = self.outcomes.get(fixture.number), self.kind.wins(self.spec, fixture)
        return through(outcome, wins) if outcome and wins else frozenset()

    def _without_exchanges(self, number: int) -> "Progress":
        """With the seeding as it was before exchanges behind a round: others than these two may have won it now."""
        entrants = list(self.entrants)
        for _, name, other in (one for one in reversed(self.exchanged) if one[0] > number):
            i, j = (next(i for i, one in enumerate(entrants) if one.name == who) for who in (name, other))
            entrants[i], entrants[j] = entrants[j], entrants[i]
        kept = tuple(one for one in self.exchanged if one[0] <= number)
        return replace(self, entrants=tuple(entrants), exchanged=kept)

    def _qualified(self, fixture: Fixture) -> frozenset[str]:
        """Who goes on by a match, or by the table that it counts in."""
        return self.through(fixture) if self.kind.wins(self.spec, fixture) else self.kind.qualified(self.as_field())

    def _added(self, entrant: Entrant) -> "Progress":
        check_name(entrant.name)
        if entrant.team:
            check_name(entrant.team, "bad_team")
        if any(one.name == entrant.name for one in self.entrants):
            raise Refused("entered", name=entrant.name)
        if len(self.entrants) == MOST:
            raise Refused("full", most=MOST)
        if self.kind.on_call:
            if not self.running:
                raise Refused("late_over", name=entrant.name)
            joined = {**self.joined, entrant.name: self.closed}
            return replace(self, entrants=(*self.entrants, entrant), joined=joined)
        progress = self._without_unplayed_rounds()
        if len(progress.rounds) > 1:
            raise Refused("late_round", name=entrant.name)
        late = self.late | {entrant.name} if progress.rounds else self.late
        return replace(progress, entrants=(*self.entrants, entrant), late=late).drawn()

    def _without(self, name: str) -> "Progress":
        self._present(name)
        open_rounds = (one.round for one in self.fixtures if one.number not in self.outcomes)
        progress = replace(self, left={**self.left, name: min(open_rounds, default=len(self.rounds) + 1)})
        return (progress._without_unplayed_rounds() if self.kind.follows_withdrawals else progress).drawn()

    def _without_unplayed_rounds(self) -> "Progress":
        """Without the rounds behind the last one of which a match has been played."""
        kept = max((fixture.round for fixture in self.fixtures if self._played(fixture)), default=0)
        rounds = self.rounds[:kept]
        numbers = {fixture.number for drawn in rounds for fixture in drawn.fixtures}
        return replace(
            self,
            rounds=rounds,
            outcomes={number: outcome for number, outcome in self.outcomes.items() if number in numbers},
            played={number: outcomes for number, outcomes in self.played.items() if number in numbers},
            postponed={number: times for number, times in self.postponed.items() if number in numbers},
            called={number: arcade for number, arcade in self.called.items() if number in numbers},
        )

    def _played(self, fixture: Fixture) -> bool:
        return fixture.number in self.played

    def _open_fixture(self, number: int) -> Fixture:
        fixtures = self.fixtures
        if not 0 < number <= len(fixtures):
            raise Refused("no_match", match=number)
        if number in self.outcomes:
            raise Refused("played", match=number)
        return fixtures[number - 1]

    def _called(self, number: int, arcade: str | None) -> "Progress":
        fixture = self.next_match(self._open_fixture(number))
        called = {other: where for other, where in self.called.items() if other != number}
        if arcade is None:
            if number not in self.called:
                raise Refused("not_called", match=number)
            return replace(self, called=called)
        if arcade:
            check_name(arcade, "bad_arcade")
        if self.pause is not None:
            raise Refused("in_break")
        for other in called.keys() - self.outcomes.keys():
            busy = {*self.next_match(self.fixtures[other - 1]).entrants} & {*fixture.entrants}
            if busy:
                raise Refused("called", name=min(busy), match=other)
        return replace(self, called={**called, number: arcade})

    def _present(self, name: str) -> None:
        if all(entrant.name != name for entrant in self.entrants):
            raise Refused("not_entered", name=name)
        if name in self.withdrawn:
            raise Refused("withdrawn", name=name)


def checked(outcome: Result, fixture: Fixture) -> Result:
    """The outcome with equal places in one order. Raises Refused unless it has every entrant of the match once."""
    named = sorted(name for place in outcome.places for name in place)
    if named != sorted(fixture.entrants) or not all(outcome.places):
        raise Refused("one_place", match=fixture.number, names=", ".join(fixture.entrants))
    if not {*outcome.scores} <= {*fixture.entrants}:
        raise Refused("other_scores", match=fixture.number, names=", ".join(fixture.entrants))
    if outcome.note == WALKOVER:
        raise Refused("bad_note", note=quote(WALKOVER))
    if outcome.extra != fixture.extra:
        raise Refused("other_extra", match=fixture.number, open=fixture.extra, extra=outcome.extra)
    return replace(outcome, places=tuple(tuple(sorted(place)) for place in outcome.places))
