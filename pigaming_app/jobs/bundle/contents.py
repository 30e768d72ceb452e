"""What a bundle contains beside the libraries that PyInstaller finds by itself."""

import py_compile
import re
import sys
from importlib.util import cache_from_source
from pathlib import Path

from pigaming_app import ASSETS, ROOT
from pigaming_app.boot.interpreter import ARCADE, packages, requirements
from pigaming_app.boot.start import OPTIONAL

EXCLUDED = (  # large libraries that no job of a bundle needs, but an installed package could import
    "IPython", "PIL.ImageTk", "PIL._avif", "PIL._imagingcms", "PIL._imagingft", "PIL._webp", "PyInstaller", "_pytest",
    "cffi", "gymnasium", "hatchling", "hypothesis", "matplotlib", "mypy", "numpy.f2py", "onnxruntime", "pandas",
    "pettingzoo", "pycparser", "pydoc_data", "pygments", "pymunk", "pytest", "ray", "readline", "scipy", "setuptools",
    "soundfile", "stable_baselines3", "tkinter", "torch", "yaml",
)  # fmt: skip
PACKAGES = sorted(path.parent for path in ROOT.glob("pigaming_*/__init__.py"))  # this one, and games beside it
ASSET_FOLDERS = ("arenas", "benchmark", "brains", "desk", "fonts", "new_game", "people", "phones", "sounds", "text")
SHARED = "micropython"  # folders with programs of another interpreter


def modules() -> list[str]:
    """All modules of these packages: jobs and games are imported by name."""
    found = (path.relative_to(ROOT).with_suffix("") for path in _sources())
    return sorted(".".join(path.parts).removesuffix(".__init__") for path in found)


def bytecode(folder: Path) -> list[tuple[str, str]]:
    """The bytecode of all modules, made in a folder: files to copy, each with its folder in the bundle.

    It is valid whatever dates the sources get when they are copied or unpacked.
    """
    made = []
    for path in _sources():
        beside = Path(cache_from_source(str(path.relative_to(ROOT))))
        mode = py_compile.PycInvalidationMode.UNCHECKED_HASH
        py_compile.compile(str(path), str(folder / beside), doraise=True, invalidation_mode=mode)
        made.append((str(folder / beside), str(beside.parent)))
    return made


def _sources() -> list[Path]:
    return sorted(path for package in PACKAGES for path in package.rglob("*.py") if SHARED not in path.parts)


def files() -> list[tuple[str, str]]:
    """Files to copy, each with its folder in the bundle; modules are not among them."""
    chosen = [path for folder in ASSET_FOLDERS for path in (ASSETS / folder).rglob("*")]
    chosen = [path for path in chosen if path.parent != ASSETS / "sounds" or path.suffix == ".ogg"]  # not their script
    inside = (path for package in PACKAGES for path in package.rglob("*"))
    chosen += [path for path in inside if path.suffix != ".py" or SHARED in path.parts]
    chosen += [ASSETS / "rude.toml", ROOT / "pyproject.toml", ROOT / "LICENSE"]
    kept = (path for path in sorted(chosen) if path.is_file() and "__pycache__" not in path.parts)
    return [(str(path), str(path.parent.relative_to(ROOT))) for path in kept]


def distributions() -> list[str]:
    """The installed packages whose versions the doctor reports. Raises StartError."""
    installed = packages(Path(folder) for folder in sys.path if folder.endswith("-packages"))
    wanted = (re.split("[<>]", requirement)[0] for requirement in requirements({ARCADE} | OPTIONAL["bundle"]))
    return [name for name in wanted if name in installed]
