"""Round robin and Swiss: shares of a match, Berger's tables, tie-breaks by FIDE C.07."""

from itertools import combinations

from pigaming_app.events.spec import Format
from tests.events.second import grand_prix
from tests.events.second.board import Board, Places


def berger(count: int) -> list[list[tuple[int, int]]]:
    """The Berger table of entrants from 1: the sum of two who meet is the round plus 1, modulo count - 1."""
    even = count + count % 2
    rounds = []
    for number in range(1, even):
        pairs = []
        for one, other in combinations(range(1, even), 2):
            if (one + other - number - 1) % (even - 1) == 0:
                pairs.append((one, other) if (one + other) % 2 else (other, one))
        with_last = next(one for one in range(1, even) if (2 * one - number - 1) % (even - 1) == 0)
        if count == even:
            pairs.append((with_last, even) if with_last <= even // 2 else (even, with_last))
        rounds.append(pairs)
    return rounds


def share(places: Places, one: str, other: str) -> float:
    """1 if the one is ahead of the other, ½ if level, 0 behind."""
    at = {name: place for place, names in enumerate(places) for name in names}
    return 0.5 + 0.5 * ((at[other] > at[one]) - (at[other] < at[one]))


class Cross:
    """All that tie-breaks look at: what each has got against each other in each match."""

    def __init__(self, board: Board) -> None:
        self.board = board
        self.void = {name for name in board.gone if self._left_early(name)}
        self.swiss = board.spec.format == Format.SWISS
        self.against: dict[str, list[tuple[int, str, float]]] = {name: [] for name in board.names}
        self.gained: dict[str, dict[int, float]] = {name: {} for name in board.names}
        for number, match in board.matches.items():
            places = board.decided(number)
            names = [name for name in match.entrants if name not in self.void]
            if places is None:
                continue
            nobody = number in board.absent and len(places) == 1
            for name in names:
                mine = {other: 0.0 if nobody else share(places, name, other) for other in names if other != name}
                if mine:
                    self.gained[name][number] = sum(mine.values()) / len(mine)
                if not (self.swiss and number in board.absent):
                    self.against[name] += [(number, other, got) for other, got in mine.items()]

    def _left_early(self, name: str) -> bool:
        board = self.board
        if board.spec.format != Format.ROUND_ROBIN:
            return False
        own = [number for number in board.matches if name in board.matches[number].entrants]
        every = board.rounds - (name in board.late) if board.spec.seats > 2 else len(own)
        return 2 * sum(number in board.reports for number in own) < every

    def met(self, name: str) -> dict[int, list[tuple[str, float]]]:
        """Opponents of each match, and what was got against them."""
        found: dict[int, list[tuple[str, float]]] = {}
        for number, other, got in self.against[name]:
            found.setdefault(number, []).append((other, got))
        return found

    def points(self) -> dict[str, float]:
        """Shares of matches; in a Swiss a bye is a win."""
        points = {name: sum(self.gained[name].values()) for name in self.board.names}
        if self.swiss:
            for number, byes in self.board.byes.items():
                for name in byes if self.board.complete(number) else ():
                    points[name] += 1.0
        return points

    def head_to_head(self, level: list[str]) -> dict[str, float]:
        """Points against the others; with missing matches only of those who are ahead whatever these bring."""
        mean = {
            (one, other): sum(got) / len(got)
            for one in level
            for other in level
            if (got := [points for _, who, points in self.against[one] if who == other])
        }
        total = {one: sum(mean.get((one, other), 0.0) for other in level) for one in level}
        missing = {one: sum(other != one and (one, other) not in mean for other in level) for one in level}
        if not any(missing.values()):
            return total
        value, left = dict.fromkeys(level, -1.0), [*level]
        while left:
            first = max(left, key=total.__getitem__)
            left.remove(first)
            if any(total[first] <= total[other] + missing[other] for other in left):
                break
            value[first] = total[first]
        return value

    def sonneborn(self) -> dict[str, float]:
        """The points of the others, each times what was got against them, of several in a match the mean."""
        points, value = self.points(), {}
        for name in self.board.names:
            total = 0.0
            for match in self.met(name).values():
                total += sum(points[other] * got for other, got in match) / len(match)
            if self.swiss:
                unplayed = sum(got for number, got in self.gained[name].items() if number in self.board.absent)
                unplayed += sum(name in byes for number, byes in self.board.byes.items() if self.board.complete(number))
                total += unplayed * points[name]
            value[name] = total
        return value

    def wins(self) -> dict[str, float]:
        """Matches won at the robots."""
        return {
            name: float(
                sum(
                    number in self.board.reports and (self.board.decided(number) or ((),))[0] == (name,)
                    for number in self.gained[name]
                )
            )
            for name in self.board.names
        }

    def buchholz(self) -> dict[str, float]:
        """The points of the opponents; a round without one counts as one against somebody with the own points."""
        points = self.points()
        value = {}
        for name in self.board.names:
            total = 0.0
            met = {self.board.matches[number].round: others for number, others in self.met(name).items()}
            for number in range(1, self.board.rounds + 1):
                if number in met:
                    total += sum(points[other] for other, _ in met[number]) / len(met[number])
                elif self.board.complete(number):
                    total += points[name]
            value[name] = total
        return value


def table(board: Board) -> tuple[list[tuple[int, str]], dict[str, float]]:
    """Places, and points."""
    cross = Cross(board)
    points = cross.points()
    swiss = board.spec.format == Format.SWISS
    sums = {"buchholz": cross.buchholz, "sonneborn": cross.sonneborn, "wins": cross.wins}
    names = ["buchholz", "direct", "sonneborn", "wins"] if swiss else ["direct", "wins", "sonneborn"]
    order = _split(board.names, points)
    for name in names:
        finer: list[list[str]] = []
        for level in order:
            finer += _direct(cross, level) if name == "direct" else _split(level, sums[name]())
        order = finer
    return [(1 + sum(map(len, order[:i])), name) for i, level in enumerate(order) for name in level], points


def _split(level: list[str], worth: dict[str, float]) -> list[list[str]]:
    steps = sorted({round(worth[name], 6) for name in level}, reverse=True)
    return [[name for name in level if round(worth[name], 6) == step] for step in steps]


def _direct(cross: Cross, level: list[str]) -> list[list[str]]:
    parts = _split(level, cross.head_to_head(level))
    return [level] if len(parts) == 1 else [finer for part in parts for finer in _direct(cross, part)]


def check(board: Board) -> None:
    """Each two meet as often as everybody, nobody twice in a round; without late entrants by Berger's table."""
    for number in range(1, board.rounds + 1):
        here = [name for match in board.round(number) for name in match.entrants]
        everybody = [*here, *board.byes.get(number, ())]
        assert len(everybody) == len({*everybody})
    times = board.spec.rounds or 1
    if board.spec.seats > 2:
        if not board.gone and not board.late:
            grand_prix.check(board)
            twos = [frozenset(pair) for one in board.matches.values() for pair in combinations(one.entrants, 2)]
            perfect = -(-times * (len(board.names) - 1) // (min(len(one.entrants) for one in board.round(1)) - 1))
            every = all(twos.count(frozenset(pair)) >= times for pair in combinations(board.names, 2))
            assert every or board.rounds == 3 * perfect
        return
    met = sorted(tuple(sorted(match.entrants)) for match in board.matches.values())
    assert met == sorted(tuple(sorted(pair)) for pair in combinations(board.names, 2) for _ in range(times))
    if not board.late:
        rounds = berger(len(board.names))
        for number in range(1, board.rounds + 1):
            pairs = rounds[(number - 1) % len(rounds)]
            names = {frozenset((board.names[one - 1], board.names[other - 1])) for one, other in pairs}
            assert {frozenset(match.entrants) for match in board.round(number)} == names
