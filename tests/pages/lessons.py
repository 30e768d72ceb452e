"""The lessons of docs/lessons: pages in Markdown, and the notebooks that are made of them.

A block ```python of a page is a cell; a block ```text after it is what the cell prints. The notebook has the sections
with cells, without what they print: a class is to guess first. The last picture of a page lies beside it.

python -m tests.pages.lessons --write [PART OF A NAME]    runs pages; renews texts, pictures and notebooks
python -m tests.pages.lessons --run PAGE …                prints what each of their cells prints, as JSON
"""

import argparse
import ast
import contextlib
import io
import json
import os
import re
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from tests.pages.commands import ROOT

FOLDER = ROOT / "docs" / "lessons"
PAGES = {language: sorted((FOLDER / language).glob("*.md")) for language in ("en", "pt")}
CELL = re.compile(r"^```python\n(.*?)^```\n(?:\n```text\n(.*?)^```\n)?", re.MULTILINE | re.DOTALL)
SHOWN = re.compile(r"^!\[.*\]\(.*\)\n\n?", re.MULTILINE)  # pictures: a notebook draws its own
WORDS = {"title", "suptitle", "label", "labels", "xlabel", "ylabel", "xticklabels", "yticklabels"}  # of a picture
QUIET = ("-W", "error", "-W", "ignore:FigureCanvasAgg")  # a warning is an error, but that no window opens
KERNEL = {"display_name": "Python 3", "language": "python", "name": "python3"}


def cells(page: Path) -> list[str]:
    """The code of each cell of a page."""
    return [code for code, _ in CELL.findall(page.read_text(encoding="utf-8"))]


def printed(page: Path) -> list[str]:
    """What each cell of a page prints, as the page shows it."""
    return [text for _, text in CELL.findall(page.read_text(encoding="utf-8"))]


def notebook(page: Path) -> str:
    """The notebook of a page, as the text of its file."""
    text = page.read_text(encoding="utf-8")
    head, *sections = re.split(r"^(?=## )", text, flags=re.MULTILINE)
    title = head.splitlines()[0]
    kept = "".join(section for section in sections if CELL.search(section))
    parts = [("markdown", f"{title}\n\n[{page.name}]({page.name})\n")]
    end = 0
    for cell in CELL.finditer(kept):
        parts += [("markdown", kept[end : cell.start()]), ("code", cell[1])]
        end = cell.end()
    parts.append(("markdown", kept[end:]))
    filled = [(kind, SHOWN.sub("", part).strip("\n")) for kind, part in parts]
    found = [_cell(kind, part, f"cell-{n}") for n, (kind, part) in enumerate(filled) if part]
    book = {"cells": found, "metadata": {"kernelspec": KERNEL}, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(book, indent=1, ensure_ascii=False) + "\n"


def _cell(kind: str, text: str, name: str) -> dict[str, Any]:
    made: dict[str, Any] = {"cell_type": kind, "id": name, "metadata": {}, "source": text.splitlines(keepends=True)}
    return made | ({"execution_count": None, "outputs": []} if kind == "code" else {})


def without_words(code: str) -> str:
    """A cell without what may differ between languages: comments, texts in `print`, `names` and pictures."""
    tree = ast.parse(code)
    for node in ast.walk(tree):
        spoken: list[ast.AST] = []
        match node:
            case ast.Call(func=ast.Name(id="print")):
                spoken = [*node.args]
            case ast.keyword(arg=name) if name in WORDS:
                spoken = [node.value]
            case ast.Assign(targets=[ast.Name(id="names")]):
                spoken = [node.value]
            case ast.FunctionDef() | ast.ClassDef() if ast.get_docstring(node):
                spoken = [node.body[0]]
        for text in (part for whole in spoken for part in ast.walk(whole)):
            if isinstance(text, ast.Constant) and isinstance(text.value, str):
                text.value = ""
    return ast.dump(tree)


def run(page: Path, picture: Path | None = None) -> list[str]:
    """What each cell of a page prints, run one after the other in this process; `picture`: where to save the last."""
    import matplotlib.pyplot as plt

    space: dict[str, Any] = {"__name__": "__main__"}
    found = []
    plt.close("all")
    for code in cells(page):
        with contextlib.redirect_stdout(io.StringIO()) as out:
            exec(compile(code, page.name, "exec"), space)
        found.append(out.getvalue())
    if picture:
        plt.gcf().savefig(picture, dpi=80, pil_kwargs={"lossless": True})
    return found


def run_apart(pages: list[Path], folder: Path, *options: str) -> list[list[str]]:
    """`run` of each page, in a process of their own, without a window; `folder`: where they write files."""
    command = [sys.executable, *QUIET, "-m", "tests.pages.lessons", *options, "--run", *map(str, pages)]
    variables = {**os.environ, "MPLBACKEND": "Agg", "PYTHONPATH": str(ROOT), "SDL_VIDEODRIVER": "dummy"}
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", env=variables, cwd=folder)
    if done.returncode:
        raise RuntimeError(done.stderr[-3000:])
    return list(json.loads(done.stdout))


def write(page: Path) -> None:
    """Run a page and renew what it shows, its picture and its notebook."""
    with TemporaryDirectory() as folder:
        (found,) = run_apart([page], Path(folder), "--picture", str(page.with_suffix(".webp")))
    texts = iter(found)

    def renewed(cell: re.Match[str]) -> str:
        text = next(texts)
        return f"```python\n{cell[1]}```\n" + (f"\n```text\n{text}```\n" if text else "")

    page.write_text(CELL.sub(renewed, page.read_text(encoding="utf-8")), encoding="utf-8")
    page.with_suffix(".ipynb").write_text(notebook(page), encoding="utf-8")


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description="runs the lessons")
    parser.add_argument("--write", nargs="?", const="", metavar="PART")
    parser.add_argument("--run", type=Path, nargs="+", metavar="PAGE")
    parser.add_argument("--picture", type=Path)
    options = parser.parse_args()
    if options.run:
        print(json.dumps([run(page, options.picture) for page in options.run]))
    for page in [*PAGES["en"], *PAGES["pt"]]:
        if options.write is not None and options.write in page.as_posix():
            write(page)


if __name__ == "__main__":
    main()
