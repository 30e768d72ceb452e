"""Functions that run both as plain Python, in the arcade, and compiled by numba, for training.

`@kernel` only registers a function, so that the arcade never imports numba. The first compilation makes all registered
functions callable from compiled code; compiled outer loops are cached on disk.

numba's own cache goes by the path of a module, and does not detect an edit in a function that the outer loop calls.
This one goes by a hash of all these sources and by what a loop is a closure over: every copy of the program on a
machine loads what the first has compiled.
"""

import contextlib
import hashlib
import os
import sys
from collections.abc import Callable, Iterable
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import FunctionType
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
    with contextlib.suppress(OSError):  # no writable folder for the cache
        dispatcher._cache = _loop_cache()(loop)  # type: ignore[attr-defined]
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


@cache
def _loop_cache() -> Any:
    """numba's cache of a function, without the paths of this copy of the program in its names and keys."""
    caching: Any = import_module("numba.core.caching")

    class Folder(caching._CacheLocator):  # type: ignore[misc]
        """The folder of all loops, whichever module they come from."""

        def __init__(self, loop: Callable[..., Any], module: str) -> None:
            self._py_file, self._module = module, loop.__module__

        @classmethod
        def from_function(cls, loop: Callable[..., Any], module: str) -> "Folder":
            folder = cls(loop, module)
            folder.ensure_cache_path()
            return folder

        def get_cache_path(self) -> str:
            return os.environ.get("NUMBA_CACHE_DIR") or str(_cache_folder())

        def get_source_stamp(self) -> str:
            return _source_hash()

        def get_disambiguator(self) -> str:
            return self._module

    class LoopResults(caching.CompileResultCacheImpl):  # type: ignore[misc]
        _locator_classes = (Folder,)

    class LoopCache(caching.FunctionCache):  # type: ignore[misc]
        _impl_class = LoopResults

        def _index_key(self, signature: Any, codegen: Any) -> str:
            """A key with files of its own, so that processes that compile side by side do not mix theirs up."""
            text = f"{signature}{codegen.magic_tuple()}{_source_hash()}{_identity(self._py_func)}"
            key = hashlib.sha256(text.encode()).hexdigest()
            name = f"{self._impl.filename_base}-{key[:16]}"
            self._cache_file = caching.IndexDataCacheFile(self.cache_path, name, _source_hash())
            return key

        def save_overload(self, signature: Any, result: Any) -> None:
            with contextlib.suppress(OSError):  # such as a full disk: compiled again next time
                super().save_overload(signature, result)

    return LoopCache


def _identity(value: Any, *above: Any) -> str:
    """Text that names a value of a closure by its content and its names in the sources, not by its place in memory.

    `above`: the functions and records that contain it.
    """
    if isinstance(value, tuple | list | dict):
        parts = value.items() if isinstance(value, dict) else value
        return f"({','.join(_identity(one, *above) for one in parts)})"
    if any(value is one for one in above):
        return "…"
    if isinstance(value, FunctionType):
        cells = [cell.cell_contents for cell in value.__closure__ or ()]
        code = (value.__code__.co_code, value.__code__.co_names, value.__defaults__, cells)
        return f"{value.__module__}.{value.__qualname__}{_identity(code, *above, value)}"
    if isinstance(value, type):
        return (
            f"{value.__module__}.{value.__qualname__}{_identity(getattr(value, '__annotations__', {}), *above, value)}"
        )
    if value is None or isinstance(value, bool | int | float | str | bytes):
        return repr(value)
    return hashlib.sha256(import_module("numba.core.serialize").dumps(value)).hexdigest()


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
    named = (
        (path.relative_to(folder.parent).as_posix(), path) for folder, all in (ours | _added).items() for path in all
    )
    for name, path in sorted(named):
        sha.update(name.encode())
        sha.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return sha.hexdigest()
