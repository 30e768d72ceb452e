"""File format of trained Q-tables: a small .npz with the table and a JSON header of its training parameters.

Reading validates everything and rejects foreign, truncated or edited files with a one-line error. The header holds a
checksum of itself and the table, and the hash of the engine, since results measured with another engine may differ.
"""

from dataclasses import asdict, dataclass, fields
from functools import cache
from typing import Annotated, Any

from pigaming_app import ASSETS
from pigaming_app.ai.brain.archive import BrainFileError, pack, unpack, verify
from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.qlearning.features import STATES
from pigaming_app.ai.qlearning.recipe import Recipe
from pigaming_app.ai.qlearning.table import ACTIONS, PAIRS, Learned, QTable, player, set_recipe
from pigaming_app.games.engine_hash import engine_hash
from pigaming_app.games.setup import MAX_MINUTES, MIN_MINUTES
from pigaming_app.sim.record import dtype
from pigaming_app.storage.parsing import ParseError
from pigaming_app.storage.schema import Line, between, typed

FORMAT, RULE = "pigaming-table-1", "pitanks classic"
MAX_BYTES = 4_000_000  # size limit of a file; a full training takes about 60,000
COUNTS = ("experiences", "pairs", "states", "matches", "random")
PARTS = {"head": 100_000, "q": 8 * PAIRS + 1000, "n": 8 * PAIRS + 1000}  # limits of the unpacked sizes, bytes


class TableError(BrainFileError):
    """A file is not a valid trained table; the message is one line."""


@dataclass(frozen=True)
class Trained:
    """A table with the parameters of its training. `rows`: one NumPy record of `QTable`."""

    name: Line
    reward: int  # 1 or 2: published reward table; 0: custom
    recipe: Recipe
    seed: int
    arena: Line
    minutes: Annotated[float, between(MIN_MINUTES, MAX_MINUTES)]  # per match
    rows: Any
    engine: Line  # hash of the engine it was trained with

    @property
    def matches(self) -> int:
        """Matches of the training so far."""
        return int(self.rows["matches"][0])

    @property
    def other_engine(self) -> bool:
        """True if it was trained with another version of the engine, so that results may differ."""
        return self.engine != engine_hash()


def encode(trained: Trained) -> bytes:
    """Content of the file of a trained table."""
    table = trained.rows[0]
    head: dict[str, Any] = {
        "format": FORMAT,
        "rule": RULE,
        **{key: value for key, value in vars(trained).items() if key not in ("rows", "recipe")},
        "recipe": asdict(trained.recipe),
        **{key: int(table[key]) for key in COUNTS},
    }
    return pack(head, {"q": table["q"], "n": table["n"].astype("<i4")})


def decode(raw: bytes, name: str) -> Trained:
    """Validate and unpack the content of the file `name`. Raises TableError, whose message begins with the name."""
    try:
        return _trained(*_parts(raw))
    except BrainFileError as error:
        raise TableError(f"{name}: {error}") from None


def brain_of(trained: Trained) -> BrainKind:
    """The brain of a table, for matches against people: it frees itself when stuck."""
    return player(trained.name, Learned(trained.rows), reflex=True)


@cache
def shipped(name: str) -> Learned:
    """A table that ships with the arcade, cached. Raises OSError, TableError."""
    path = ASSETS / "brains" / f"{name}.npz"
    return Learned(decode(path.read_bytes(), path.name).rows)


def shipped_brain(name: str) -> BrainKind:
    """The brain of a table that ships with the arcade; the file is read on first use."""
    return player(name, lambda fast: shipped(name)(fast), reflex=True)


def _parts(raw: bytes) -> tuple[dict[str, Any], Any, Any]:
    """Header, Q-values and visit counts of a file, validated in format, type and shape only. Raises BrainFileError."""
    head, arrays = unpack(raw, "trained table", FORMAT, PARTS)
    q, n = arrays["q"], arrays["n"]
    if head.get("rule") != RULE:
        raise TableError("trained by the rules of another game")
    if (q.dtype.str, q.shape, n.dtype.str, n.shape) != ("<f8", (PAIRS,), "<i4", (PAIRS,)):
        raise TableError("the table has another shape")
    return head, q, n


def _trained(head: dict[str, Any], q: Any, n: Any) -> Trained:
    """The table after validation of its content. Raises BrainFileError."""
    import numpy as np

    verify(head, {"q": q, "n": n})
    tried = n.reshape(STATES, ACTIONS) > 0
    counts = {"experiences": int(n.sum()), "pairs": int(tried.sum()), "states": int(tried.any(axis=1).sum())}
    if not np.isfinite(q).all() or (n < 0).any() or any(head.get(key) != count for key, count in counts.items()):
        raise TableError("the table contradicts itself")
    rows = np.zeros(1, dtype(QTable))
    rows["q"], rows["n"] = q, n
    try:
        trained = typed({**head, "rows": rows}, Trained)
        if {*head["recipe"], "rest"} != {field.name for field in fields(Recipe)}:
            raise TableError("its recipe is of another version")
        for key in COUNTS:
            rows[key] = typed(head.get(key), int)
        set_recipe(rows[0], trained.recipe)
    except (ParseError, OverflowError) as error:
        raise TableError(f"its head: {error}") from None
    if trained.matches < 0:
        raise TableError("the table contradicts itself")
    return trained
