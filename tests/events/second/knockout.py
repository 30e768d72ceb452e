"""Double elimination: lives as counters, the winners' bracket as a list of places."""

from tests.events.second.board import Board, ranking
from tests.events.second.swiss import FEW, every_pairing

LIVES = 2


def bracket(size: int) -> list[int]:
    """Seeds in the order of the standard bracket: the best of each two meets the last, and the two best meet last."""
    order = [1]
    while len(order) < size:
        order = [seed for best in order for seed in (best, 2 * len(order) + 1 - best)]
    return order


def lives_before(board: Board, number: int) -> dict[str, int]:
    """Lives of everybody as a round begins."""
    lives = {name: LIVES - (name in board.late) for name in board.names}
    for key, match in board.matches.items():
        if match.round < number and board.decided(key) is not None:
            for name in board.through(key)[1]:
                lives[name] -= 1
    return lives


def out_in(board: Board) -> dict[str, tuple[int, int]]:
    """Who is out: the round in which it happened, and the place in that match (negative: more is better)."""
    out: dict[str, tuple[int, int]] = {}
    lives = {name: LIVES - (name in board.late) for name in board.names}
    for number in range(1, board.rounds + 1):
        for match in board.round(number):
            places = board.decided(match.number)
            if places is None:
                continue
            for name in board.through(match.number)[1]:
                if board.gone.get(name) == number and match.number in board.absent:
                    continue
                lives[name] -= 1
                if lives[name] == 0:
                    out[name] = number, -sum(len(place) for place in places[: _at(places, name)])
    for name, number in board.gone.items():
        if name not in out:
            out[name] = number or board.rounds + 1, 1 - board.spec.seats
    return out


def _at(places: tuple[tuple[str, ...], ...], name: str) -> int:
    return next(i for i, place in enumerate(places) if name in place)


def check(board: Board) -> None:
    """Who may meet whom, round by round; of two to a match also the winners' bracket."""
    spec = board.spec
    for number in range(1, board.rounds + 1):
        lives = lives_before(board, number)
        placed = [name for match in board.round(number) for name in match.entrants]
        placed += board.byes.get(number, ())
        assert len(placed) == len({*placed}), "nobody twice"
        for match in board.round(number):
            assert 2 <= len(match.entrants) <= spec.seats
            has = {lives[name] for name in match.entrants}
            if match.stage == "final":
                alive = {name for name in board.here if lives[name]}
                assert {*match.entrants} - {*board.gone} == alive, "the final is between the last two"
                assert has in ({1, 2}, {1})
            else:
                assert has == {2 if match.stage == "winners" else 1}
    _check_next(board)
    if spec.seats == 2 and not board.gone:
        _check_winners(board)
        if board.open_round == 0:
            lives = lives_before(board, board.rounds + 1)
            assert len(board.matches) == LIVES * len(board.names) - len(board.late) - max(lives.values())


def _check_next(board: Board) -> None:
    """The round that has not begun: which brackets play, and who meets whom in the losers' bracket."""
    number = board.rounds
    matches = board.round(number)
    if any(match.number in board.reports for match in matches) or any(when == number for when, _, _ in board.swaps):
        return
    lives = lives_before(board, number)
    unbeaten, beaten = ([name for name in board.here if lives[name] == left] for left in (2, 1))
    if len(unbeaten) + len(beaten) < 3:
        assert [{*match.entrants} for match in matches] == [{*unbeaten, *beaten}]
        return
    stages = {match.stage for match in matches}
    winners = {"winners"} if len(unbeaten) > 1 and len(unbeaten) >= len(beaten) else set()
    assert stages == winners | ({"losers"} if len(beaten) > 1 else set())
    for stage, names in (("winners", unbeaten), ("losers", beaten)):
        of_stage = [match.entrants for match in matches if match.stage == stage]
        if stage in stages and board.spec.seats > 2:
            assert sorted(name for entrants in of_stage for name in entrants) == sorted(names)
            sizes = [len(entrants) for entrants in of_stage]
            assert len(sizes) == -(-len(names) // board.spec.seats)
            assert max(sizes) - min(sizes) < 2
    if board.spec.seats == 2 and "losers" in stages:
        _check_losers(board, number, beaten)


def _check_losers(board: Board, number: int, beaten: list[str]) -> None:
    """An odd one rests, in turn; those who have just come meet those of the other end, nobody again if possible."""
    pairs = [frozenset(match.entrants) for match in board.round(number) if match.stage == "losers"]
    if len(beaten) % 2:
        byes = {name: sum(name in rest for when, rest in board.byes.items() if when < number) for name in beaten}
        (rested,) = {*beaten} - {name for pair in pairs for name in pair}
        seeding = _seeding(board)
        assert rested == min(beaten, key=lambda name: (byes[name], seeding.index(name)))
        beaten = [name for name in beaten if name != rested]
    place = {name: i for i, name in enumerate(_slots(board)) if name} | {
        name: 1000 + i for i, name in enumerate(board.names) if name in board.late
    }
    before = [match for match in board.matches.values() if match.round < number]
    stayed = [name for name in beaten if any(name in match.entrants for match in before if match.stage == "losers")]
    fallen = [name for name in beaten if name not in stayed]
    stayed.sort(key=place.__getitem__)
    fallen.sort(key=place.__getitem__, reverse=bool(stayed))
    line = []
    for i in range(max(len(stayed), len(fallen))):
        line += stayed[i : i + 1] + fallen[i : i + 1]
    wanted = [frozenset(line[i : i + 2]) for i in range(0, len(line), 2)]
    met = [frozenset(match.entrants) for match in before]
    if not any(pair in met for pair in wanted):
        assert {*pairs} == {*wanted}
    elif len(line) <= FEW:
        assert sum(pair in met for pair in pairs) == min(
            sum(frozenset(pair) in met for pair in pairing) for pairing in every_pairing(line)
        )


def _seeding(board: Board) -> list[str]:
    """Everybody by the place that they have in the winners' bracket: who exchanged it has the other's seed."""
    names = [*board.names]
    for _, one, other in board.lasting:
        names = [other if name == one else one if name == other else name for name in names]
    return names


def _slots(board: Board) -> list[str | None]:
    """The first round of the winners' bracket, with the exchanges of places since then."""
    names = [name for name in _seeding(board) if name not in board.late]
    size = 1
    while size < len(names):
        size *= 2
    return [names[seed - 1] if seed <= len(names) else None for seed in bracket(size)]


def _check_winners(board: Board) -> None:
    """The winners' bracket, place by place."""
    size = 1
    names = [name for name in board.names if name not in board.late]
    while size < len(names):
        size *= 2
    slots: list[str | None] = [names[seed - 1] if seed <= len(names) else None for seed in bracket(size)]
    for number in range(1, board.rounds + 1):
        matches = {frozenset(one.entrants): one for one in board.round(number) if one.stage == "winners"}
        if not matches:
            continue
        for when, one, other in board.lasting:
            if when == number:
                slots = [other if who == one else one if who == other else who for who in slots]
        pairs = [(slots[i], slots[i + 1]) for i in range(0, len(slots), 2)]
        assert {*matches} == {frozenset(pair) for pair in pairs if None not in pair}
        following: list[str | None] = []
        for upper, lower in pairs:
            if upper is None or lower is None:
                following.append(upper or lower)
                continue
            key = matches[frozenset((upper, lower))].number
            following.append(None if board.decided(key) is None else min(board.through(key)[0]))
        slots = following


def table(board: Board) -> tuple[list[tuple[int, str]], dict[str, float]]:
    """Places, and points: the number of entrants behind."""
    out = out_in(board)
    lives = lives_before(board, board.rounds + 1)
    worth: dict[str, tuple[float, ...]] = {name: out.get(name, (10**6, lives[name])) for name in board.names}
    places = ranking(worth)
    return places, {name: float(sum(other[0] > place for other in places)) for place, name in places}
