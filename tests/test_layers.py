"""Imports go one way, and the arcade starts without numba."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parent.parent / "pigaming_app"
MAY = {
    "main": {"boot", "cli"},
    "__init__": set(),
    "__main__": {"cli"},
    "boot": set(),
    "storage": set(),
    "sim": set(),
    "games": {"sim"},
    "hardware": {"sim", "storage"},
    "ai": {"sim", "games"},
    "ui": {"storage"},
    "scenes": {"sim", "storage", "ui", "games", "hardware", "ai"},
    "jobs": {"boot", "sim", "storage", "ui", "games", "hardware", "ai", "scenes"},
    "cli": {"jobs"},
}
DEBTS = {
    ("ui", "scenes"),
}
ONLY_IN = {"pygame": {"ui", "scenes"}, "cv2": {"hardware"}, "serial": {"hardware"}, "torch": set()}
FILES = [PACKAGE.parent / "main.py", *sorted(PACKAGE.rglob("*.py"))]


def imported(path):
    """The modules that a file imports, and whether at once (not inside a function): `pigaming_app.sim`, `os.path`."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    inside = {id(node) for f in ast.walk(tree) if isinstance(f, ast.FunctionDef) for node in ast.walk(f)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((alias.name, id(node) not in inside) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path} imports by a relative name"
            names = [f"pigaming_app.{alias.name}" for alias in node.names if is_module(alias.name)]
            for module in names if node.module == "pigaming_app" and names else [node.module]:
                yield module, id(node) not in inside


def is_module(name):
    return (PACKAGE / name).is_dir() or (PACKAGE / f"{name}.py").is_file()


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.relative_to(PACKAGE.parent).as_posix())
def test_a_file_imports_only_what_its_layer_may(path):
    place = path.relative_to(PACKAGE).parts if PACKAGE in path.parents else (path.name,)
    layer = place[0].removesuffix(".py")
    for module, at_once in imported(path):
        root = module.split(".")[0]
        if root == "pigaming_app" and module.count("."):
            other = module.split(".")[1]
            assert other in {layer, *MAY[layer]} or (layer, other) in DEBTS, f"{path.name} imports {module}"
        if root in ONLY_IN:
            assert layer in ONLY_IN[root], f"{path.name} imports {module}"
        if root == "numba":
            assert place == ("sim", "kernel.py")
            assert not at_once


def test_main_needs_nothing_but_the_standard_library():
    for path in (PACKAGE.parent / "main.py", *(PACKAGE / "boot").glob("*.py")):
        roots = {module.split(".")[0] for module, _ in imported(path)}
        assert roots <= set(sys.stdlib_module_names) | {"pigaming_app"}


def test_the_arcade_is_imported_without_numba_and_numpy():
    code = (
        "import sys\nsys.modules['numba'] = None\n"
        "import pigaming_app.cli, pigaming_app.scenes.app\n"
        "import pigaming_app.scenes.title.scene, pigaming_app.scenes.play.scene\n"
        "assert 'numpy' not in sys.modules, 'numpy costs a tenth of a second at the start'\n"
    )
    subprocess.run([sys.executable, "-c", code], cwd=PACKAGE.parent, check=True)
