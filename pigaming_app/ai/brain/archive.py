"""File format of learned brains: a .npz archive of arrays and a JSON head, which holds a check sum of both.

Reading validates everything and refuses foreign, truncated or edited files in one line.
"""

import hashlib
import json
import warnings
import zipfile
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

HEAD = "head"

failed: list[str] = []  # files whose brains have failed in a match; the arcade shows them and empties the list


class BrainFileError(ValueError):
    """A file is not a valid brain; the message is one line."""


def pack(head: Mapping[str, Any], arrays: Mapping[str, Any]) -> bytes:
    """Content of a file; the check sum is added to the head."""
    import numpy as np

    known = {**head, "check": check_sum(head, arrays)}
    packed = BytesIO()
    np.savez_compressed(packed, **{HEAD: np.array(json.dumps(known)), **arrays})
    return packed.getvalue()


def names(raw: bytes) -> set[str]:
    """Names of the parts of a file; none if it is no archive."""
    try:
        with zipfile.ZipFile(BytesIO(raw)) as archive:
            return {entry.filename.removesuffix(".npy") for entry in archive.infolist()}
    except Exception:  # zipfile raises many kinds of exceptions for damaged files
        return set()


def unpack(raw: bytes, noun: str, form: str, limits: Mapping[str, int]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Head and arrays of a file. The check sum is left to `verify`, arrays' types and shapes to the caller.

    `noun`: the kind of file in messages; `form`: its format in the head; `limits`: unpacked sizes of all parts, bytes.
    Raises BrainFileError.
    """
    import numpy as np

    if not raw.startswith(b"PK"):
        raise BrainFileError(f"not a {noun}")
    try:
        with zipfile.ZipFile(BytesIO(raw)) as archive:
            sizes = {entry.filename: entry.file_size for entry in archive.infolist()}
            if len(archive.infolist()) != len(limits) or sizes.keys() != {f"{part}.npy" for part in limits}:
                raise BrainFileError(f"not a {noun}")
            if any(sizes[f"{part}.npy"] > limit for part, limit in limits.items()):
                raise BrainFileError(f"not a {noun}: a part of it is too big")
            if archive.testzip() is not None:
                raise BrainFileError("truncated or damaged")
        with warnings.catch_warnings(), np.load(BytesIO(raw), allow_pickle=False) as file:
            warnings.simplefilter("error")  # NumPy warns of some headers
            parts = {part: file[part] for part in limits}
            head = json.loads(str(parts.pop(HEAD)))
        for array in parts.values():
            _ = array.dtype.str, array.shape  # NumPy returns bytes for a part that is not an array
    except BrainFileError:
        raise
    except Exception:  # zipfile and NumPy raise many kinds of exceptions for damaged files
        raise BrainFileError("truncated or damaged") from None
    if not isinstance(head, dict) or head.get("format") != form:
        raise BrainFileError(f"not a {noun} of this version")
    return head, parts


def verify(head: Mapping[str, Any], arrays: Mapping[str, Any]) -> None:
    """Raises BrainFileError unless the check sum in the head is that of head and arrays."""
    if head.get("check") != check_sum(head, arrays):
        raise BrainFileError("it was changed after it was saved")


def check_sum(head: Mapping[str, Any], arrays: Mapping[str, Any]) -> str:
    """SHA-256 of the head (without its check sum) and the arrays in order, hex."""
    text = json.dumps({key: value for key, value in head.items() if key != "check"}, sort_keys=True)
    return hashlib.sha256(text.encode() + b"".join(array.tobytes() for array in arrays.values())).hexdigest()


def read(path: Path, limit: int) -> bytes:
    """Content of a regular file of at most `limit` bytes. Raises BrainFileError, which begins with the file's name."""
    try:
        if path.exists() and not path.is_file():  # opening a pipe would block
            raise OSError("it is not a file")
        with path.open("rb") as file:
            raw = file.read(limit + 1)
        if len(raw) > limit:
            raise OSError(f"it is larger than {limit:,} bytes")
        return raw
    except (OSError, ValueError) as error:  # ValueError: a name with a null character
        reason = getattr(error, "strerror", None) or error
        raise BrainFileError(f"{path.name}: cannot be read ({reason})") from None
