"""A match of several rounds. Rounds won decide; among equals, the points of all rounds."""

from collections.abc import Collection, Iterable, Mapping

from pigaming_app.games.game import Outcome, Row

BEST_OF = (1, 3)  # the choices; 1: an ordinary match


class Rounds:
    """The rounds played so far, of at most `best_of`."""

    def __init__(self, best_of: int) -> None:
        self.best_of = best_of
        self.outcomes: list[Outcome] = []
        self.assisted: list[frozenset[int]] = []  # for each round the seats whose results are no records

    def add(self, outcome: Outcome, assisted: Collection[int] = ()) -> None:
        """Count a round. `assisted`: seats for which an AI has driven, or all in slow motion."""
        self.outcomes.append(outcome)
        self.assisted.append(frozenset(assisted))

    @property
    def number(self) -> int:
        """Number of the next round, from 1."""
        return len(self.outcomes) + 1

    @property
    def needed(self) -> int:
        """Rounds that decide the match."""
        return self.best_of // 2 + 1

    @property
    def done(self) -> bool:
        """True if a team cannot be overtaken any more, or all rounds are played."""
        return len(self.outcomes) == self.best_of or max(self.wins().values(), default=0) == self.needed

    def wins(self) -> Mapping[int, int]:
        """Rounds won by each seat, or by its team; empty before the first round has ended."""
        seats = [row.seat for outcome in self.outcomes[:1] for row in outcome.rows]
        return {seat: sum(seat in outcome.winners for outcome in self.outcomes) for seat in seats}

    def points(self, seat: int) -> list[int]:
        """Points of a seat in each round."""
        return [row.score for outcome in self.outcomes for row in outcome.rows if row.seat == seat]

    def outcome(self) -> Outcome:
        """The standings over all rounds played, at least one: total points, and the best record of each seat."""
        wins, rows = self.wins(), {row.seat: row for row in self.outcomes[0].rows}
        total = {seat: sum(self.points(seat)) for seat in rows}
        teams: dict[int, list[int]] = {}
        for seat, row in rows.items():
            teams.setdefault(row.team, []).append(seat)
        keys = {team: (wins[seats[0]], sum(total[seat] for seat in seats)) for team, seats in teams.items()}
        key_of = {seat: keys[row.team] for seat, row in rows.items()}
        order = sorted(rows, key=lambda seat: (-key_of[seat][0], -key_of[seat][1], rows[seat].team, -total[seat]))
        leaders = [team for team, key in keys.items() if key == max(keys.values())]
        return Outcome(
            tuple(
                Row(
                    seat=seat,
                    team=rows[seat].team,
                    place=1 + sum(key_of[other] > key_of[seat] for other in rows),
                    score=total[seat],
                    stats={"wins": wins[seat]},
                    records=self._records(seat),
                    times=(),
                )
                for seat in order
            ),
            tuple(seat for seat in sorted(rows) if [rows[seat].team] == leaders),
            (),
            sum(outcome.seconds for outcome in self.outcomes),
        )

    def _records(self, seat: int) -> dict[str, int]:
        """The most points of a seat in one round that counts."""
        best: dict[str, int] = {}
        for name, value in self._record_values(seat):
            best[name] = max(value, best.get(name, value))
        return best

    def _record_values(self, seat: int) -> Iterable[tuple[str, int]]:
        for outcome, assisted in zip(self.outcomes, self.assisted, strict=True):
            for row in outcome.rows:
                if row.seat == seat and seat not in assisted:
                    yield from row.records.items()
