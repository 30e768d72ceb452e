"""Groups of two to four for matches in which as few as possible meet again, and seats that go round."""

from collections.abc import Mapping, Sequence
from itertools import combinations, permutations

from pigaming_app.events.formats.field import Pair

AGAIN = 1000  # a meeting again costs as much as this distance in the order, squared


def sizes(count: int, seats: int) -> list[int]:
    """Sizes of the fewest groups of at most `seats`, as equal as possible, the larger ones first."""
    groups = -(-count // seats)
    return [count // groups + (i < count % groups) for i in range(groups)] if groups else []


def serpentine(names: Sequence[str], seats: int) -> list[tuple[str, ...]]:
    """Groups of equal strength: the best of the seeding are dealt out one to a group, to and fro."""
    wanted = sizes(len(names), seats)
    groups: list[list[str]] = [[] for _ in wanted]
    left, forward = list(names), True
    while left:
        order = range(len(groups)) if forward else range(len(groups) - 1, -1, -1)
        for i in order:
            if left and len(groups[i]) < wanted[i]:
                groups[i].append(left.pop(0))
        forward = not forward
    return [tuple(group) for group in groups]


def neighbours(names: Sequence[str], seats: int, met: Mapping[Pair, int]) -> list[tuple[str, ...]]:
    """Groups of neighbours in the order of `names`, in which as few as possible meet again."""
    left, groups = list(names), []
    for size in sizes(len(names), seats):
        group = [left.pop(0)]
        while len(group) < size:
            best = min(left, key=lambda name: sum(met.get(frozenset((name, one)), 0) for one in group))
            left.remove(best)
            group.append(best)
        groups.append(group)
    _exchange(groups, {name: i for i, name in enumerate(names)}, met)
    return [tuple(group) for group in groups]


def mixed(groups: Sequence[Sequence[str]], met: Mapping[Pair, int]) -> list[tuple[str, ...]]:
    """These groups after exchanges that make fewer meet again, whatever their order."""
    changed = [list(group) for group in groups]
    _exchange(changed, {name: 0 for group in groups for name in group}, met)
    return [tuple(group) for group in changed]


def _exchange(groups: list[list[str]], order: Mapping[str, int], met: Mapping[Pair, int]) -> None:
    """Exchange two entrants of different groups as long as that is better."""
    number = {name: i for i, name in enumerate(name for group in groups for name in group)}
    again = [[0] * len(number) for _ in number]
    for (one, other), times in ((tuple(pair), times) for pair, times in met.items()):
        if one in number and other in number:
            i, j = number[one], number[other]
            again[i][j] = again[j][i] = AGAIN * times * times + (order[one] - order[other]) ** 2 if times else 0
    place = [order[name] for name in number]

    def width(group: Sequence[int]) -> int:
        places = [place[i] for i in group]
        return (max(places) - min(places)) ** 2

    def cost(group: Sequence[int]) -> int:
        return sum(again[one][other] for one, other in combinations(group, 2)) + width(group)

    numbers = [[number[name] for name in group] for group in groups]
    better = True
    while better:
        better = False
        for first, second in combinations(numbers, 2):
            before = cost(first) + cost(second)
            if before < AGAIN:
                continue
            for i in range(len(first)):
                for j in range(len(second)):
                    first[i], second[j] = second[j], first[i]
                    after = cost(first) + cost(second)
                    if after < before:
                        before, better = after, True
                    else:
                        first[i], second[j] = second[j], first[i]
    names = list(number)
    for group, wanted in zip(groups, numbers, strict=True):
        group[:] = [names[i] for i in wanted]


def seated(group: Sequence[str], sat: Mapping[str, Sequence[int]]) -> tuple[str, ...]:
    """The group in the order of seats that each has had least so far. `sat`: times on each seat, by name."""

    def cost(order: Sequence[str]) -> int:
        return sum((1 + 2 * sat[name][seat]) for seat, name in enumerate(order))

    return min(permutations(group), key=cost)
