"""File format of trained Q-tables: a small .npz with the table and a JSON header of its training parameters.

Reading validates everything and rejects foreign, truncated or edited files with a one-line error. The header holds a
checksum of itself and the table, and the hash of the engine, since results measured with another engine may differ.
"""

import hashlib
import json
import warnings
import zipfile
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from functools import cache
from io import BytesIO
from typing import Any

from pigaming_app import ASSETS
from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.qlearning.features import STATES
from pigaming_app.ai.qlearning.learner import ACTIONS, PAIRS, QTable
from pigaming_app.ai.qlearning.player import Learned, player
from pigaming_app.ai.qlearning.rewards import Recipe
from pigaming_app.games.engine_hash import engine_hash
from pigaming_app.games.setup import MAX_MINUTES, MIN_MINUTES
from pigaming_app.sim.record import dtype

FORMAT, RULE = "pigaming-table-1", "pitanks classic"
MAX_BYTES = 4_000_000  # size limit of a file; a full training takes about 60,000
COUNTS = ("experiences", "pairs", "states", "matches", "random")
FIXED = {"off_wall": 1, "look": 0, "behind_from": 4, "behind_to": 12, "exposure": 1}  # in files before they were knobs
PARTS = {"head": 100_000, "q": 8 * PAIRS + 1000, "n": 8 * PAIRS + 1000}  # limits of the unpacked sizes, bytes


class TableError(ValueError):
    """A file is not a valid trained table; the message is one line."""


@dataclass(frozen=True)
class Trained:
    """A table with the parameters of its training. `rows`: one NumPy record of `QTable`."""

    name: str
    reward: int  # 1 or 2: published reward table; 0: custom
    recipe: Recipe
    seed: int
    arena: str
    minutes: float  # per match
    rows: Any
    engine: str  # hash of the engine it was trained with

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
    import numpy as np

    table = trained.rows[0]
    head: dict[str, Any] = {
        "format": FORMAT,
        "rule": RULE,
        **{key: value for key, value in vars(trained).items() if key not in ("rows", "recipe")},
        "recipe": asdict(trained.recipe),
        **{key: int(table[key]) for key in COUNTS},
    }
    q, n = table["q"], table["n"].astype("<i4")
    head["check"] = _check(head, q, n)
    packed = BytesIO()
    np.savez_compressed(packed, head=np.array(json.dumps(head)), q=q, n=n)
    return packed.getvalue()


def decode(raw: bytes, name: str) -> Trained:
    """Validate and unpack the content of the file `name`. Raises TableError, whose message begins with the name."""
    try:
        return _trained(*_parts(raw))
    except TableError as error:
        raise TableError(f"{name}: {error}") from None


@cache
def shipped(name: str) -> Learned:
    """A table that ships with the arcade, cached. Raises OSError, TableError."""
    path = ASSETS / "brains" / f"{name}.npz"
    return Learned(decode(path.read_bytes(), path.name).rows)


def shipped_brain(name: str) -> BrainKind:
    """The brain of a table that ships with the arcade; the file is read on first use."""
    return player(name, lambda fast: shipped(name)(fast), reflex=True)


def _parts(raw: bytes) -> tuple[dict[str, Any], Any, Any]:
    """Header, Q-values and visit counts of a file, validated in format, type and shape only. Raises TableError."""
    import numpy as np

    if not raw.startswith(b"PK"):
        raise TableError("not a trained table")
    try:
        with zipfile.ZipFile(BytesIO(raw)) as archive:
            sizes = {entry.filename: entry.file_size for entry in archive.infolist()}
            if len(archive.infolist()) != len(PARTS) or sizes.keys() != {f"{part}.npy" for part in PARTS}:
                raise TableError("not a trained table")
            if any(sizes[f"{part}.npy"] > limit for part, limit in PARTS.items()):
                raise TableError("not a trained table: a part of it is too big")
            if archive.testzip() is not None:
                raise TableError("truncated or damaged")
        with warnings.catch_warnings(), np.load(BytesIO(raw), allow_pickle=False) as file:
            warnings.simplefilter("error")  # NumPy warns of some headers
            head, q, n = json.loads(str(file["head"])), file["q"], file["n"]
        layout = q.dtype.str, q.shape, n.dtype.str, n.shape  # NumPy returns bytes for a part that is not an array
    except TableError:
        raise
    except Exception:  # zipfile and NumPy raise many kinds of exceptions for damaged files
        raise TableError("truncated or damaged") from None
    if not isinstance(head, dict) or head.get("format") != FORMAT:
        raise TableError("not a trained table of this version")
    if head.get("rule") != RULE:
        raise TableError("trained by the rules of another game")
    if layout != ("<f8", (PAIRS,), "<i4", (PAIRS,)):
        raise TableError("the table has another shape")
    return head, q, n


def _trained(head: dict[str, Any], q: Any, n: Any) -> Trained:
    """The table after validation of its content. Raises TableError."""
    import numpy as np

    if head.get("check") != _check(head, q, n):
        raise TableError("it was changed after it was saved")
    tried = n.reshape(STATES, ACTIONS) > 0
    counts = {"experiences": int(n.sum()), "pairs": int(tried.sum()), "states": int(tried.any(axis=1).sum())}
    if not np.isfinite(q).all() or (n < 0).any() or any(head.get(key) != count for key, count in counts.items()):
        raise TableError("the table contradicts itself")
    recipe = _recipe(head.get("recipe"))
    rows = np.zeros(1, dtype(QTable))
    rows["q"], rows["n"] = q, n
    try:
        for key in COUNTS:
            rows[key] = int(head[key])
        for key, value in asdict(recipe).items():
            rows["knobs"][key] = value
        trained = Trained(
            name=str(head["name"]),
            reward=int(head["reward"]),
            recipe=recipe,
            seed=int(head["seed"]),
            arena=str(head["arena"]),
            minutes=float(head["minutes"]),
            rows=rows,
            engine=str(head["engine"]),
        )
        if trained.matches < 0 or not MIN_MINUTES <= trained.minutes <= MAX_MINUTES:
            raise TableError("the table contradicts itself")
        return trained
    except TableError:
        raise
    except (KeyError, TypeError, ValueError, OverflowError):
        raise TableError("its head is not complete") from None


def _recipe(numbers: Any) -> Recipe:
    """The recipe after validation. Raises TableError."""
    if not isinstance(numbers, dict) or numbers.keys() | FIXED.keys() != {field.name for field in fields(Recipe)}:
        raise TableError("its recipe is of another version")
    try:
        return Recipe(**FIXED | numbers)
    except (TypeError, ValueError) as error:
        raise TableError(f"its recipe: {error}") from None


def _check(head: Mapping[str, Any], q: Any, n: Any) -> str:
    """SHA-256 of the header (without its checksum) and the table, hex."""
    text = json.dumps({key: value for key, value in head.items() if key != "check"}, sort_keys=True)
    return hashlib.sha256(text.encode() + q.tobytes() + n.tobytes()).hexdigest()
