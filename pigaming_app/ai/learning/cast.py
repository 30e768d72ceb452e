"""Any brain of a game on any seat of a compiled loop.

A loop over matches is compiled for a *cast*: a set of brains. Brains with the same code (the strengths of one machine,
all trained tables, all networks) form one family. A seat has one mind record with room for each family, and a number
that names the family in charge, so one compiled loop serves every line-up of the cast.
"""

from collections.abc import Callable, Iterable, Sequence
from functools import cache
from typing import Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.kernel import inlined_kernel
from pigaming_app.sim.record import packed, record
from pigaming_app.sim.world import ROBOTS

Think = Callable[[Any, int, Any, Any], None]
Family = tuple[Think, type]  # decision function and record of the mind


class Cast:
    """The brains that a loop can seat. `families` determines its code; `weights` holds their learned parameters."""

    def __init__(self, kinds: Iterable[BrainKind], fast: bool) -> None:
        """`fast`: NumPy records, else plain ones. Kinds may repeat. Raises what reading their weights raises."""
        self.kinds = tuple(dict.fromkeys(kinds))
        self.fast = fast
        self.families = families_of(self.kinds)
        self.mind = mind_record(self.families)
        members = [[kind for kind in self.kinds if family_of(kind) == family] for family in self.families]
        rows: list[list[Any]] = []
        self._place: dict[BrainKind, tuple[int, int]] = {}
        for number, family in enumerate(members):
            found: list[Any] = []
            for kind in family:
                row = kind.weights(fast)
                if not any(row is other for other in found):
                    found.append(row)
                self._place[kind] = number, next(i for i, other in enumerate(found) if other is row)
            rows.append(found)
        self.weights = tuple(_joined(found, fast) for found in rows)

    def mind_of(self, kind: BrainKind, seed: int) -> Any:
        """A plain mind that makes a seat play by `kind`, freshly reset."""
        mind = self.mind()
        mind.family, mind.row = self._place[kind]
        kind.begin(getattr(mind, f"mind{mind.family}"), seed)
        return mind

    def minds(self, line_ups: Sequence[Sequence[tuple[BrainKind, int]]]) -> Any:
        """Minds by match and seat, from the brain and seed of each: NumPy (n, 4) if fast, else nested lists."""
        if not self.fast:
            return [[self.mind_of(kind, seed) for kind, seed in line_up] for line_up in line_ups]
        import numpy as np

        flat = [seated for line_up in line_ups for seated in line_up]
        minds = np.repeat(packed([self.mind()]), len(flat))
        for kind in {kind for kind, _ in flat}:
            places = [i for i, (seated, _) in enumerate(flat) if seated is kind]
            own = [kind.mind() for _ in places]
            for mind, i in zip(own, places, strict=True):
                kind.begin(mind, flat[i][1])
            family, row = self._place[kind]
            minds["family"][places], minds["row"][places], minds[f"mind{family}"][places] = family, row, packed(own)
        return minds.reshape(-1, ROBOTS)


def family_of(kind: BrainKind) -> Family:
    """The family of a brain."""
    return kind.think, kind.mind


def families_of(kinds: Iterable[BrainKind]) -> tuple[Family, ...]:
    """The families of some brains, in an order that does not depend on that of the brains."""
    return tuple(sorted({family_of(kind) for kind in kinds}, key=_name))


def _name(family: Family) -> tuple[str, str, str]:
    think, mind = family
    return think.__module__, think.__qualname__, mind.__qualname__


@cache
def mind_record(families: tuple[Family, ...]) -> type:
    """The record of a seat's mind, with one field for each family: mind0, mind1, ..."""
    hints: dict[str, type] = {"family": int, "row": int}
    hints |= {f"mind{number}": mind for number, (_, mind) in enumerate(families)}
    return record(type("SeatMind", (), {"__annotations__": hints, "__module__": __name__}))


@cache
def dispatcher(families: tuple[Family, ...]) -> Think:
    """A kernel think(match, seat, mind, weights) that hands over to the family in charge of the seat."""
    chain: Think = _nobody
    for number, (think, _) in reversed([*enumerate(families)]):
        chain = _branch(number, f"mind{number}", think, chain)
    return chain


@inlined_kernel
def _nobody(match: MatchState, seat: int, mind: Any, weights: Any) -> None:
    """The end of the chain: no family is in charge."""


def _branch(number: int, field: str, think: Think, otherwise: Think) -> Think:
    def choose(match: MatchState, seat: int, mind: Any, weights: Any) -> None:
        if mind.family == number:
            think(match, seat, getattr(mind, field), weights[number][mind.row])
        else:
            otherwise(match, seat, mind, weights)

    return inlined_kernel(choose)


def _joined(rows: list[Any], fast: bool) -> Any:
    if not fast:
        return [row[0] for row in rows]
    import numpy as np

    return rows[0] if len(rows) == 1 else np.concatenate(rows)
