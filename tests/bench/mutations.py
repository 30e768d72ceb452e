"""Planted faults: which of them do the tests find?

    python -m tests.bench.mutations [--tree DIR] [--room NAME] [--again]
    python -m tests.bench.mutations --draw 200 [--seed 1]

Each fault of tests/data/mutations.json changes one line of a copy of a tree. The tests of its module run on it: those
that import the module, and if these pass, the folder that mirrors its room. Found: a test fails that passes without
faults, or does not end. Results are kept in the temporary folder as they come, so that a run that was ended goes on
where it was; `--again` forgets them. `--draw` adds faults that the tests of a module find, from random lines.
"""

import argparse
import ast
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "tests" / "data" / "mutations.json"
PACKAGES = ("pigaming_app", "pigaming_football")
SECONDS = 600  # for the tests of one module
ENDLESS, GONE = "does not end", "gone"
SLOW = ("tests/pages", "tests/plugins", "tests/bench", "tests/features", "tests/test_")  # all rooms at once
SWAPS = {
    "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "is": "is not", "is not": "is", "in": "not in",
    "not in": "in", "+": "-", "-": "+", "*": "/", "/": "*", "//": "*", "%": "//", "and": "or", "or": "and",
}  # fmt: skip


@dataclass(frozen=True)
class Fault:
    """A line in a function, and the line in its place; `file` is where it was when it was drawn."""

    file: str
    function: str
    old: str
    new: str

    @property
    def room(self) -> str:
        """The folder below the package."""
        parts = Path(self.file).parts
        return parts[1] if len(parts) > 2 else parts[0]


def functions(tree: ast.AST, above: str = "") -> Iterator[tuple[str, ast.AST]]:
    """The functions of a module with their qualified names."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            name = f"{above}{node.name}"
            if isinstance(node, ast.FunctionDef):
                yield name, node
            yield from functions(node, f"{name}.")


def changes(node: ast.AST, lines: list[str]) -> Iterator[tuple[int, int, int, str]]:
    """Faults at one node: line number, first and last column (bytes), text in their place."""
    if isinstance(node, ast.Constant) and isinstance(node.value, int | float):
        text = repr(not node.value if isinstance(node.value, bool) else node.value + 1)
        yield node.lineno, node.col_offset, node.end_col_offset or 0, text
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        yield node.lineno, node.col_offset, node.col_offset + 4, ""
    elif isinstance(node, ast.Name) and node.id in ("min", "max"):
        yield node.lineno, node.col_offset, node.col_offset + 3, "max" if node.id == "min" else "min"
    else:
        for left, right in _operands(node):
            if left.end_lineno == right.lineno:
                start, end = left.end_col_offset or 0, right.col_offset
                between = lines[right.lineno - 1].encode()[start:end].decode()
                sign = between.strip("() ")
                if sign in SWAPS:
                    yield right.lineno, start, end, between.replace(sign, SWAPS[sign])


def _operands(node: ast.AST) -> list[tuple[ast.expr, ast.expr]]:
    """The two sides of each operator of a node."""
    if isinstance(node, ast.Compare):
        return list(zip([node.left, *node.comparators], node.comparators, strict=False))
    if isinstance(node, ast.BoolOp):
        return list(zip(node.values, node.values[1:], strict=False))
    return [(node.left, node.right)] if isinstance(node, ast.BinOp) else []


def faults_of(path: Path, root: Path) -> list[Fault]:
    """All that can be planted in a module, in lines that occur once in their function."""
    text = path.read_text(encoding="utf-8")
    lines, found = text.splitlines(), []
    for name, function in functions(ast.parse(text)):
        for node in ast.walk(function):
            for number, start, end, instead in changes(node, lines):
                raw = lines[number - 1].encode()
                new = (raw[:start] + instead.encode() + raw[end:]).decode()
                found.append(Fault(path.relative_to(root).as_posix(), name, lines[number - 1], new))
    return found


@cache
def modules(root: Path) -> dict[Path, str]:
    """The texts of all modules of the program."""
    paths = (path for package in PACKAGES for path in sorted((root / package).rglob("*.py")))
    return {path: path.read_text(encoding="utf-8") for path in paths if "micropython" not in path.parts}


def place(fault: Fault, root: Path) -> tuple[Path, int] | None:
    """The module and line number of a fault, wherever its function has moved to."""
    texts = modules(root)
    there = root / fault.file
    for path in [there, *texts] if there in texts else texts:
        if fault.old in texts[path]:
            lines = texts[path].splitlines()
            for name, node in functions(ast.parse(texts[path])):
                if name.rpartition(".")[2] == fault.function.rpartition(".")[2]:
                    span = range(node.lineno, node.end_lineno + 1)  # type: ignore[attr-defined]
                    hits = [number for number in span if lines[number - 1] == fault.old]
                    if len(hits) == 1:
                        return path, hits[0]
    return None


def tests_of(path: Path, root: Path) -> list[list[str]]:
    """Tests of a module: first the files named after it or importing it, then the folder that mirrors its room."""
    name = ".".join(path.relative_to(root).with_suffix("").parts).removesuffix(".__init__")
    package, _, stem = name.rpartition(".")
    room = Path("tests", *package.split(".")[1:]) if package.startswith(PACKAGES[0]) else Path("tests/football")
    importing = (
        f"from {name} import",
        f"import {name}\n",
        f"from {package} import {stem}\n",
        f"{package} import {stem},",
    )
    files = [
        file.relative_to(root).as_posix()
        for file in sorted((root / "tests").rglob("test_*.py"))
        if any(text in file.read_text(encoding="utf-8") for text in importing) or file.stem == f"test_{stem}"
    ]
    near = [file for file in files if not file.startswith(SLOW)] or files
    near.sort(key=lambda file: (Path(file).stem != f"test_{stem}", Path(file).parent != room))
    while not (root / room).is_dir():
        room = room.parent
    return [near[:3], [room.as_posix()]] if near else [[room.as_posix()]]


def copy_of(tree: Path, folder: Path) -> Path:
    """A copy of the files that git lists."""
    listed = subprocess.run(["git", "ls-files"], cwd=tree, capture_output=True, text=True, check=True).stdout
    for name in listed.splitlines():
        if (tree / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(tree / name, folder / name)
    return folder


def failure(tests: Sequence[str], root: Path) -> str:
    """The first test that fails; "" if none does."""
    command = [sys.executable, "-m", "pytest", "-qx", "-rfE", "--tb=no", "-p", "no:cacheprovider", "-m", "not long"]
    environment = os.environ | {"PYTHONDONTWRITEBYTECODE": ""}
    try:
        ended = subprocess.run(
            [*command, *tests], cwd=root, env=environment, capture_output=True, text=True, timeout=SECONDS, check=False
        )
    except subprocess.TimeoutExpired:
        return ENDLESS
    named = re.search(r"^(?:FAILED|ERROR) ([^\[\s]+)", ended.stdout, re.MULTILINE)
    return named[1] if named else "" if ended.returncode in (0, 5) else ended.stdout[-200:]


def finder(fault: Fault, root: Path, groups: int = 2) -> str:
    """The test that finds a fault; "" if none does, `GONE` if its line is no longer there."""
    where = place(fault, root)
    if where is None:
        return GONE
    path, number = where
    text = path.read_text(encoding="utf-8")
    lines = text.splitlines(keepends=True)
    lines[number - 1] = f"{fault.new}\n"
    path.write_text("".join(lines), encoding="utf-8")
    try:
        return next((name for tests in tests_of(path, root)[:groups] if (name := failure(tests, root))), "")
    finally:
        path.write_text(text, encoding="utf-8")


def known() -> list[Fault]:
    return [Fault(**row) for row in json.loads(DATA.read_text(encoding="utf-8"))] if DATA.exists() else []


def drawn(root: Path, count: int, seed: int) -> Iterator[Fault]:
    """Faults of random modules, one a function; a module is as likely as its lines are many."""
    chance, texts = random.Random(seed), modules(root)
    weights = [len(text) for text in texts.values()]
    used = {(fault.file, fault.function) for fault in known()}
    while count:
        (path,) = chance.choices(list(texts), weights)
        fresh = [fault for fault in faults_of(path, root) if (fault.file, fault.function) not in used]
        if fresh:
            fault = chance.choice(fresh)
            used.add((fault.file, fault.function))
            if place(fault, root):
                count -= 1
                yield fault


def draw(root: Path, count: int, seed: int) -> None:
    """Add to the data those of so many new faults that are found."""
    for fault in drawn(root, count, seed):
        by = finder(fault, root, 1)
        print(f"{by or 'SURVIVES'}: {fault}", flush=True)
        if by:
            rows = ",\n".join(json.dumps(asdict(row), ensure_ascii=False) for row in [*known(), fault])
            DATA.write_text(f"[\n{rows}\n]\n", encoding="utf-8")


def examine(root: Path, state: Path, room: str) -> int:
    """Plant all faults; print those that survive and the shares of the rooms. 1 if one survives."""
    results: dict[str, str] = json.loads(state.read_text()) if state.exists() else {}
    chosen = {str(fault): fault for fault in known() if room in ("", fault.room)}
    for key, fault in chosen.items():
        if key not in results:
            results[key] = finder(fault, root)
            state.write_text(json.dumps(results, indent=1))
    ends = {key: results[key] for key in chosen}
    for broken in _failing_anyway({end for end in ends.values() if "::" in end}, root):
        print(f"fails without a fault: {broken}")
        ends = {key: "" if end == broken else end for key, end in ends.items()}
    for key, end in ends.items():
        if end in ("", GONE):
            print(f"{end or 'SURVIVES'}: {key}")
    counts = Counter((chosen[key].room, end if end in ("", GONE) else "found") for key, end in ends.items())
    for name in sorted({fault.room for fault in chosen.values()}):
        print(f"{name}: {counts[name, 'found']} found, {counts[name, '']} survive, {counts[name, GONE]} gone")
    return int("" in ends.values())


def _failing_anyway(tests: set[str], root: Path) -> set[str]:
    broken: set[str] = set()
    while name := failure(sorted(tests - broken), root) if tests - broken else "":
        broken.add(name)
    return broken


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--tree", type=Path, default=ROOT, help="a checkout; this one unless given")
    parser.add_argument("--room", default="")
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--draw", type=int, default=0, metavar="COUNT")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    tree = options.tree.resolve()
    commit = subprocess.run(
        ["git", "rev-parse", "--short", "HEAD"], cwd=tree, capture_output=True, text=True, check=True
    )
    state = Path(tempfile.gettempdir(), f"mutations-{commit.stdout.strip()}.json")
    if options.again:
        state.unlink(missing_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        root = copy_of(tree, Path(folder))
        if options.draw:
            draw(root, options.draw, options.seed)
            return 0
        return examine(root, state, options.room)


if __name__ == "__main__":
    sys.exit(main())
