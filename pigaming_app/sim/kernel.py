"""Functions that run both as plain Python, in the arcade, and compiled by numba, for training.

`@kernel` only registers a function, so that the arcade never imports numba. The first compilation makes all registered
functions callable from compiled code; compiled outer loops are cached on disk.

numba's cache does not detect an edit in a function that the outer loop calls, so the name of the cache folder contains
a hash of all these sources.
"""

import contextlib
import hashlib
import os
import sys
from collections.abc import Callable, Iterable
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any, TypeVar

import platformdirs

F = TypeVar("F", bound=Callable[..., Any])

_registered: list[tuple[Callable[..., Any], Callable[..., Any], dict[str, str]]] = []  # plain, to compile, options

PACKAGE = Path(__file__).resolve().parent.parent
COMPILED = ("sim", "games", "ai", "gym")  # rooms with kernels
_added: dict[Path, tuple[Path, ...]] = {}  # folders of other packages, and their modules with kernels


def kernel(function: F) -> F:
    """Register a function that must run both plain and compiled. Returns it unchanged."""
    _registered.append((function, function, {}))
    return function


def inlined_kernel(function: F) -> F:
    """Register a small kernel that is compiled into its callers. Returns it unchanged."""
    _registered.append((function, function, {"inline": "always"}))
    return function


def kernel_with_loops(loops: Callable[..., Any]) -> Callable[[F], F]:
    """Register a function that runs as written when plain, and as `loops`, with the same arguments, when compiled.

    For array arithmetic, where NumPy is fastest plain and loops are fastest compiled. Both must give the same bits.
    """

    def register(function: F) -> F:
        _registered.append((function, loops, {}))
        return function

    return register


def add_sources(folder: Path, modules: Iterable[Path]) -> None:
    """Count modules in a folder among the sources of kernels. To be called before anything is compiled."""
    if folder not in _added:
        _added[folder] = tuple(modules)
        _source_hash.cache_clear()


def can_compile() -> bool:
    """True if the extra `train` (numba) is installed."""
    return find_spec("numba") is not None


def compiled(loop: F) -> F:
    """Compile an outer loop over NumPy records. Raises ImportError if numba is not installed."""
    numba = _numba()
    while _registered:
        _make_callable(numba, *_registered.pop())
    dispatcher: F = numba.njit(nogil=True, error_model="numpy")(loop)
    with contextlib.suppress(RuntimeError):  # no writable folder for the cache
        dispatcher.enable_caching()  # type: ignore[attr-defined]
        _ignore_cache_errors(dispatcher)
    return dispatcher


def _make_callable(numba: Any, plain: Callable[..., Any], source: Callable[..., Any], options: dict[str, str]) -> None:
    """Make calls of `plain` in compiled code calls of the compiled `source`."""

    def choose(*_: Any) -> Callable[..., Any]:
        return source

    numba.extending.overload(plain, jit_options={"error_model": "numpy"}, strict=False, **options)(choose)


def compiled_before(loop: Callable[..., Any]) -> bool:
    """True if the compiled form of an outer loop is in the cache of `compiled`, so that it loads without compiling."""
    cached = Path(os.environ.get("NUMBA_CACHE_DIR") or _cache_folder())
    name = f"{loop.__module__.rpartition('.')[2]}.{loop.__qualname__}".replace("<locals>", "locals")
    return any(cached.rglob(f"{name}-*.nbi"))


def _ignore_cache_errors(dispatcher: Any) -> None:
    """Suppress OSError, such as a full disk, when the cache is written: the loop is then compiled again next time."""
    save = dispatcher._cache.save_overload

    def attempt(signature: Any, compiled_code: Any) -> None:
        with contextlib.suppress(OSError):
            save(signature, compiled_code)

    dispatcher._cache.save_overload = attempt


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
    """SHA-256 over the paths and texts of all modules in rooms with kernels, and of added ones."""
    sha = hashlib.sha256()
    ours = {PACKAGE / room: tuple((PACKAGE / room).rglob("*.py")) for room in COMPILED}
    for folder, modules in sorted((ours | _added).items()):
        for path in sorted(modules):
            sha.update(path.relative_to(folder.parent).as_posix().encode())
            sha.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return sha.hexdigest()
