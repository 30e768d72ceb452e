"""What has happened in an event, entry by entry: who is there, what was played, who has won without a match.

Matches are read from the event, as chance may pair; whether they are allowed is the matter of the formats.
"""

from dataclasses import dataclass, field

from pigaming_app.events.event import Event
from pigaming_app.events.journal import Added, Corrected, Entry, Recorded, Swapped, Withdrawn
from pigaming_app.events.spec import Advance, EventSpec, Fixture, Format, Result

Places = tuple[tuple[str, ...], ...]
LEVEL = 3  # extra matches in a row without a difference, after which lots are drawn


@dataclass
class Board:
    """The event after each `step`."""

    spec: EventSpec
    names: list[str]  # in the order of the seeding, late ones last
    late: set[str] = field(default_factory=set)
    gone: dict[str, int] = field(default_factory=dict)  # the round that was open as somebody withdrew
    reports: dict[int, list[Places]] = field(default_factory=dict)  # of a match: itself, then its extra matches
    absent: dict[int, Places] = field(default_factory=dict)  # walkovers
    matches: dict[int, Fixture] = field(default_factory=dict)
    drawn_for: dict[int, tuple[str, ...]] = field(default_factory=dict)  # those of a match before anybody withdrew
    byes: dict[int, tuple[str, ...]] = field(default_factory=dict)
    swaps: list[tuple[int, str, str]] = field(default_factory=list)  # round, and who exchanged places
    lasting: list[tuple[int, str, str]] = field(default_factory=list)  # those of them in a winners' bracket
    lots: dict[int, Places] = field(default_factory=dict)  # what lots have decided, as the event says

    def step(self, entry: Entry | None, event: Event) -> None:
        """One more entry; `event` is after it. None: the draw before the first one."""
        open_round = self.open_round
        redraw = False
        if isinstance(entry, Recorded):
            self.reports.setdefault(entry.outcome.fixture, []).append(_sorted(entry.outcome))
            self.absent.pop(entry.outcome.fixture, None)
        elif isinstance(entry, Corrected):
            number = entry.outcome.fixture
            before = self.through(number) if self.decided(number) else None
            self.reports[number] = [_sorted(entry.outcome)]
            self.lots.pop(number, None)
            if before != (None if self.tied(number) else self.through(number)):
                self.lasting = [one for one in self.lasting if one[0] <= self.matches[number].round]
            redraw = True
        elif isinstance(entry, Added):
            self.names.append(entry.entrant.name)
            redraw = True
            if any(self.matches[number].round == 1 for number in self.reports):
                self.late.add(entry.entrant.name)
        elif isinstance(entry, Withdrawn):
            self.gone[entry.name] = open_round
            redraw = self.spec.format in (Format.KNOCKOUT, Format.SWISS, Format.GRAND_PRIX)
        elif isinstance(entry, Swapped):
            self.swaps.append((open_round, entry.name, entry.other))
            if self.spec.format == Format.KNOCKOUT and not self._beaten(entry.name):
                self.lasting.append(self.swaps[-1])
        begun = max((self.matches[number].round for number in self.reports), default=0)
        self.matches = {one.number: one for one in event.fixtures}
        self.byes = dict(event.byes)
        if redraw and self.spec.format not in (Format.ROUND_ROBIN,):
            self.absent = {number: one for number, one in self.absent.items() if self._round(number) <= begun}
            self.swaps = [one for one in self.swaps if one[0] <= begun or one in self.lasting]
        self.absent = {number: one for number, one in self.absent.items() if number in self.matches}
        self.lots = {number: event.outcomes[number].places for number in self.matches if event.lots(number)}
        self._settle()

    def _beaten(self, name: str) -> bool:
        """True if somebody has begun with a defeat, or lost a match that decides who goes on."""
        decided = [number for number in self.matches if self.winners(number) and self.decided(number)]
        return name in self.late or any(name in self.through(number)[1] for number in decided)

    def _round(self, number: int) -> int:
        return self.matches[number].round if number in self.matches else 10**6

    def _settle(self) -> None:
        """Whoever is there wins the open matches of those who are not."""
        for number, match in self.matches.items():
            here = tuple(name for name in match.entrants if name not in self.gone)
            away = tuple(sorted({*match.entrants} - {*here}))
            if number in self.reports:
                while tied := self.tied(number):
                    there = tuple(name for name in tied if name not in self.gone)
                    left = tuple(sorted({*tied} - {*there}))
                    if not left:
                        break
                    self.reports[number].append((there, left) if there else tuple((name,) for name in left))
            elif number not in self.absent and away:
                assert len(here) < 2, f"match {number} waits for {away}"
                self.absent[number] = (here, away) if here else (away,)

    # ---- what has been decided

    @property
    def open_round(self) -> int:
        """Round of the first match without a decision; 0 without one."""
        return min((one.round for number, one in self.matches.items() if self.decided(number) is None), default=0)

    @property
    def here(self) -> list[str]:
        """Those who have not withdrawn."""
        return [name for name in self.names if name not in self.gone]

    def round(self, number: int) -> list[Fixture]:
        """The matches of a round by number."""
        return [self.matches[key] for key in sorted(self.matches) if self.matches[key].round == number]

    @property
    def rounds(self) -> int:
        """Rounds that are drawn."""
        return max([0, *(one.round for one in self.matches.values()), *self.byes])

    def complete(self, number: int) -> bool:
        """True if all matches of a round are decided."""
        return all(self.decided(match.number) is not None for match in self.round(number))

    def winners(self, number: int) -> int:
        """How many go on from a match; 0: it decides nothing."""
        match = self.matches[number]
        if self.spec.format == Format.GROUPS:
            return 0 if match.stage.startswith("group") else 1
        if self.spec.format != Format.KNOCKOUT:
            return 0
        return 1 if self.spec.advance == Advance.QUARTER or len(match.entrants) == 2 else 2

    def decided(self, number: int) -> Places | None:
        """The places of a match; None: open, or an extra match is."""
        if number not in self.reports:
            return self.absent.get(number)
        if self.tied(number):
            return None
        return self._after_extra(number)[0]

    def tied(self, number: int) -> tuple[str, ...]:
        """Those who have to play an extra match."""
        return self._after_extra(number)[1]

    def _after_extra(self, number: int) -> tuple[Places, tuple[str, ...]]:
        first, *extra = self.reports[number]
        places, level = [*first], 0
        while (at := self._across(places, self.winners(number))) is not None:
            if level == LEVEL:
                assert number in self.lots, f"lots for match {number}"
                found = [place for place in self.lots[number] if {*place} <= {*places[at]}]
                assert sorted(name for (name,) in found) == sorted(places[at]), "lots leave nobody level"
                places[at : at + 1] = found
            elif not extra:
                return tuple(places), places[at]
            else:
                result = extra.pop(0)
                level = level + 1 if len(result) == 1 else 0
                places[at : at + 1] = result
        assert not extra, f"match {number} was decided before its last extra match"
        return tuple(places), ()

    @staticmethod
    def _across(places: list[tuple[str, ...]], winners: int) -> int | None:
        """The place that is shared across the line between those who go on and those who do not."""
        ahead = 0
        for at, place in enumerate(places):
            if ahead < winners < ahead + len(place):
                return at
            ahead += len(place)
        return None

    def through(self, number: int) -> tuple[set[str], set[str]]:
        """Those who go on from a decided match, and the others. Nobody wins a match that nobody attends."""
        places = self.decided(number)
        assert places is not None
        if number not in self.reports and len(places) == 1:
            return set(), {*places[0]}
        order = [name for place in places for name in place]
        return {*order[: self.winners(number)]}, {*order[self.winners(number) :]}

    def played(self, name: str) -> int:
        """Matches that somebody has played; extra matches are part of theirs."""
        return sum(name in self.matches[number].entrants for number in self.reports if self.decided(number))

    def won(self, name: str) -> int:
        """Matches that somebody has played and won alone."""
        return sum((self.decided(number) or ((),))[0] == (name,) for number in self.reports)


def new_board(event: Event) -> Board:
    """The board before the first entry; `event` has none yet."""
    board = Board(event.spec, [one.name for one in event.spec.entrants])
    board.step(None, event)
    return board


def _sorted(outcome: Result) -> Places:
    return tuple(tuple(sorted(place)) for place in outcome.places)


def ranking(worth: dict[str, tuple[float, ...]]) -> list[tuple[int, str]]:
    """Place and name, best first; equal ones share the place, in the order of the dict."""
    order = sorted(worth, key=lambda name: worth[name], reverse=True)
    return [(1 + sum(worth[other] > worth[name] for other in worth), name) for name in order]
