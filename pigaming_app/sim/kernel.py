"""One function, two bodies: as it stands for plain play, compiled by numba to train.

`@kernel` only notes the function: the arcade never imports numba. The first time something is compiled, every noted
function becomes callable from compiled code, and the outer loop is compiled and kept on disk.

numba's cache does not see an edit in a function that the outer loop calls, so the folder of the cache carries the hash
of all these sources.
"""

import contextlib
import hashlib
import os
import sys
from collections.abc import Callable
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any, TypeVar

import platformdirs

F = TypeVar("F", bound=Callable[..., Any])

_noted: list[Callable[..., Any]] = []

PACKAGE = Path(__file__).resolve().parent.parent
COMPILED = ("sim", "games", "ai")  # rooms with kernels


def kernel(function: F) -> F:
    """Note a function that must work in both bodies; the function itself is unchanged."""
    _noted.append(function)
    return function


def can_compile() -> bool:
    """Whether the extra `train` (numba) is installed."""
    return find_spec("numba") is not None


def compiled(loop: F) -> F:
    """The compiled twin of an outer loop over NumPy records. Raises ImportError where numba is not installed."""
    numba = _numba()
    while _noted:
        numba.extending.register_jitable(error_model="numpy")(_noted.pop())
    twin: F = numba.njit(nogil=True, error_model="numpy")(loop)
    with contextlib.suppress(RuntimeError):  # there is no folder for the cache
        twin.enable_caching()  # type: ignore[attr-defined]
        _save_if_possible(twin)
    return twin


def compiled_before(loop: Callable[..., Any]) -> bool:
    """Whether an outer loop's compiled twin lies in the folder that `compiled` keeps, so that it loads in a moment."""
    kept = Path(os.environ.get("NUMBA_CACHE_DIR") or _cache_folder())
    name = f"{loop.__module__.rpartition('.')[2]}.{loop.__qualname__}".replace("<locals>", "locals")
    return any(kept.rglob(f"{name}-*.nbi"))


def _save_if_possible(twin: Any) -> None:
    """Let a disk that is full cost only the time to compile again."""
    save = twin._cache.save_overload

    def attempt(signature: Any, compiled_code: Any) -> None:
        with contextlib.suppress(OSError):
            save(signature, compiled_code)

    twin._cache.save_overload = attempt


@cache
def _numba() -> Any:
    os.environ.setdefault("NUMBA_DISABLE_INTEL_SVML", "1")
    os.environ.setdefault("NUMBA_CACHE_DIR", str(_cache_folder()))
    import numba
    import numba.extending

    return numba


def _cache_folder() -> Path:
    home = os.environ.get("PIGAMING_HOME")
    root = Path(home) / "cache" if home else Path(platformdirs.user_cache_dir("pigaming"))
    return root / f"compiled-{sys.version_info[0]}.{sys.version_info[1]}-{_source_hash()[:16]}"


@cache
def _source_hash() -> str:
    """SHA-256 over the paths and texts of all modules with kernels."""
    sha = hashlib.sha256()
    for folder in COMPILED:
        for path in sorted((PACKAGE / folder).rglob("*.py")):
            sha.update(path.relative_to(PACKAGE).as_posix().encode())
            sha.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return sha.hexdigest()
