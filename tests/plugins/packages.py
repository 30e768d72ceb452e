"""Packages of games for the tests: Tag as docs/add-a-game.md makes it, and packages that are installed."""

import re
from pathlib import Path

from pigaming_app.jobs.new_game import write

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "add-a-game.md").read_text(encoding="utf-8")
FILES = dict(re.findall(r"^`(\w+\.py)`:.*?^```python\n(.*?)^```", PAGE, re.M | re.S))


def write_tag(folder: Path) -> Path:
    """Write the package of Tag, as the page makes it."""
    write(folder, "tag")
    for name, code in FILES.items():
        (folder / name).write_text(code, encoding="utf-8")
    return folder


def install(site: Path, game: str, module: str) -> Path:
    """A distribution in the folder `site` with an entry point for a game; its parent packages must not be imported.

    Returns the folder for the game's package.
    """
    *parents, _ = module.split(".")
    for k in range(len(parents)):
        folder = site.joinpath(*parents[: k + 1])
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "__init__.py").touch()
    info = site / f"robot_{game}-1.2.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: robot-{game}\nVersion: 1.2\n")
    (info / "entry_points.txt").write_text(f"[pigaming.games]\n{game} = {module}\n")
    return site.joinpath(*module.split("."))


def changed(file: Path, old: str, new: str) -> int:
    """Change a file of a package. Returns the line on which the first difference lies."""
    text = file.read_text(encoding="utf-8")
    assert old in text, old
    file.write_text(text.replace(old, new, 1), encoding="utf-8")
    same = next(k for k, (a, b) in enumerate(zip(old + "\0", new + "\0", strict=False)) if a != b)
    return text[: text.index(old) + same].count("\n") + 1
