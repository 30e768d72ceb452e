"""Grand Prix: 10, 6, 3 and 1 by place, equal places share; then most first, second and third places."""

from tests.events.second.board import Board, ranking

POINTS = (10, 6, 3, 1)


def check(board: Board) -> None:
    """The draw of each round: all play, in matches of equal size."""
    for number in range(1, board.rounds + 1):
        here = [name for match in board.round(number) for name in match.entrants]
        everybody = [*here, *board.byes.get(number, ())]
        assert len(everybody) == len({*everybody})
        assert not board.byes.get(number) or board.spec.seats == 2 or len(everybody) == 1
        if not board.gone:
            assert {*everybody} == {*board.names} - (board.late if number == 1 else set())
            sizes = [len(match.entrants) for match in board.round(number)]
            assert len(sizes) == -(-len(here) // board.spec.seats)
            assert max(sizes) - min(sizes) < 2


def table(board: Board) -> tuple[list[tuple[int, str]], dict[str, float]]:
    """Places, and points."""
    points = dict.fromkeys(board.names, 0.0)
    medals = {name: [0, 0, 0] for name in board.names}
    for number in board.matches:
        ahead, places = 0, board.decided(number) or ()
        if number in board.absent:
            places = places[: len(places) - 1]  # those who were there
        for place in places:
            share = sum(POINTS[ahead : ahead + len(place)]) / len(place)
            for name in place:
                points[name] += share
                if ahead < 3 and number not in board.absent:  # a walkover brings points, and no place
                    medals[name][ahead] += 1
            ahead += len(place)
    for number, byes in board.byes.items():
        for name in byes if board.complete(number) else ():
            points[name] += (POINTS[0] + POINTS[1]) / 2
    return ranking({name: (points[name], *medals[name]) for name in board.names}), points
