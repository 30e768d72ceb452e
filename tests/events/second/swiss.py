"""Swiss draws: of all pairings of few entrants the best by the four rules of docs/events.md, of more what must hold."""

from collections.abc import Iterator

from pigaming_app.events.spec import Fixture
from tests.events.second.board import Board
from tests.events.second.round_robin import share

FEW = 8  # entrants, of whom every pairing is tried
Pairing = list[tuple[str, str]]
BYE = ""


def check(board: Board) -> None:
    """The draw of each round, and of the one that has not begun whether there is a better one."""
    for number in range(1, board.rounds + 1):
        here = [name for match in board.round(number) for name in match.entrants]
        everybody = [*here, *board.byes.get(number, ())]
        assert len(everybody) == len({*everybody})
        assert not board.byes.get(number) or board.spec.seats == 2 or len(everybody) == 1
    number = board.rounds
    begun = any(match.number in board.reports for match in board.round(number))
    if number and not begun and all(when != number for when, _, _ in board.swaps):
        drawn = [(name, BYE) for name in board.byes.get(number, ())]
        here = [name for match in board.round(number) for name in match.entrants] + [name for name, _ in drawn]
        assert {*here} == {*board.here}, "a round that has not begun is of all who are there"
        if board.spec.seats == 2 and len(board.here) <= FEW:
            drawn += [_pair(match) for match in board.round(number)]
            rules = Rules(board, number)
            assert rules.merit(drawn) == min(rules.merit(pairing) for pairing in every_pairing(board.here))


def _pair(match: Fixture) -> tuple[str, str]:
    one, other = match.entrants
    return one, other


def every_pairing(names: list[str]) -> Iterator[Pairing]:
    """All ways to make pairs; of an odd number, one has a bye."""
    if not names:
        yield []
        return
    first, *left = names
    for other in left if len(names) % 2 == 0 else [*left, BYE]:
        rest = [name for name in left if name != other]
        if other == BYE:
            for pairs in every_pairing(rest):
                yield [(first, BYE), *pairs]
        else:
            for pairs in every_pairing(rest):
                yield [(first, other), *pairs]


class Rules:
    """How good a pairing of a round is, by the rules in their order: less is better."""

    def __init__(self, board: Board, number: int) -> None:
        rests = [name for when, byes in board.byes.items() if when < number for name in byes]
        self.byes = {name: rests.count(name) for name in board.here}
        self.met = [frozenset(match.entrants) for match in board.matches.values() if match.round < number]
        score = dict.fromkeys(board.names, 0.0)
        for key, match in board.matches.items():
            if match.round < number:
                places = board.decided(key)
                assert places is not None
                for one, other in (match.entrants, match.entrants[::-1]):
                    nobody = key in board.absent and len(places) == 1
                    score[one] += 0.0 if nobody else share(places, one, other)
        for name in rests:
            score[name] += 1.0
        self.score = score
        self.order = sorted(board.here, key=lambda name: -score[name])
        self.steps = sorted({score[name] for name in board.here}, reverse=True)
        self.group = {name: self.steps.index(score[name]) for name in board.here} | {BYE: len(self.steps)}

    def merit(self, pairing: Pairing) -> tuple[object, ...]:
        """Byes of who has one, meetings again, floats from each group, ranks in line from the top."""
        at = {name: i for i, name in enumerate(self.order)} | {BYE: len(self.order)}
        pairs = sorted((tuple(sorted(pair, key=at.__getitem__)) for pair in pairing), key=lambda pair: at[pair[0]])
        rested = sum(self.byes[one] for one, other in pairs if other == BYE)
        again = sum(self.met.count(frozenset(pair)) for pair in pairs)
        floats = [sum(self.group[one] <= i < self.group[other] for one, other in pairs) for i in range(len(self.steps))]
        ranks = []
        for name in self.order:
            other = next((other for one, other in pairs if one == name), None)
            ranks.append(0 if other is None else self.line(name).index(other))
        return rested, again, floats, ranks

    def line(self, name: str) -> list[str]:
        """Opponents behind somebody, the next in line first."""
        own = [one for one in self.order if self.group[one] == self.group[name]]
        above = sum(self.group[one] < self.group[name] for one in self.order)
        skipped = above % 2
        upper = own[: skipped + (len(own) - skipped) // 2]
        lower = own[len(upper) :]
        behind = self.order[self.order.index(name) + 1 :]
        line = [one for one in lower if one in behind] + [one for one in reversed(upper) if one in behind]
        return line + [one for one in behind if one not in line] + [BYE]
