"""`pigaming_app.api` is all that plug-ins import: Football, the template, the guide, the examples."""

import ast
import inspect
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

from pigaming_app.storage.plugins.parts import ABOVE
from tests.pages.api import MODULES, PAGE, definition, docstring, page

ROOT = Path(__file__).resolve().parents[2]
PLUGINS = [ROOT / "pigaming_football", ROOT / "assets" / "new_game"]
NAMES = {f"{module.__name__}.{name}" for module in MODULES for name in module.__all__}
MOST, MOST_OF_DRIVERS = 80, 11  # names for games; names for drivers of robots
OTHERS = {"screens": {"pygame"}, "editor": {"pygame"}, "training": {"numpy"}}  # packages that a part may import, too


def sources() -> Iterator[tuple[str, str, str]]:
    """Where, which part of a plug-in, and the text of all that stands for the work of other people."""
    for folder in PLUGINS:
        for path in folder.rglob("*.py"):
            yield str(path), path.relative_to(folder).parts[0].removesuffix(".py"), path.read_text(encoding="utf-8")
    for path in (ROOT / "examples").glob("*.py"):
        yield str(path), "example", path.read_text(encoding="utf-8")
    page = (ROOT / "docs" / "add-a-game.md").read_text(encoding="utf-8")
    for name, code in re.findall(r"^`(\w+)\.py`.*?^```python\n(.*?)^```", page, re.M | re.S):
        yield f"guide, {name}", name, code
    for code in re.findall(r"^```python\n(.*?)^```", page, re.M | re.S):
        yield "guide", "training", code


def imported(text: str) -> Iterator[str]:
    """The full names of what a file imports from other packages, late imports and modules named in texts included."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and " " not in node.value:
            yield from re.findall(r"^pigaming_app\.\w[\w.]*$", node.value)


def test_a_plug_in_imports_the_public_face_and_nothing_else_of_this_package() -> None:
    for place, part, text in sources():
        for name in imported(text):
            root = name.partition(".")[0]
            if root == "pigaming_app":
                assert name in NAMES | {module.__name__ for module in MODULES}, f"{place} imports {name}"
            elif part != "example":
                assert root in {*sys.stdlib_module_names, *OTHERS.get(part, ())}, f"{place} imports {name}"


def test_rules_do_not_depend_on_the_parts_above_them() -> None:
    """These are left out of the hash in replays, and a match is judged without them."""
    for folder in PLUGINS:
        for path in (path for path in folder.rglob("*.py") if path.relative_to(folder).parts[0][:-3] not in ABOVE):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.ImportFrom) and node.level == len(path.relative_to(folder).parts):
                    assert (node.module or "").partition(".")[0] not in ABOVE, f"{path} imports {node.module}"


def test_the_face_is_small_and_documented() -> None:
    drivers = {name for name in NAMES if name.startswith("pigaming_app.api.robots.")}
    assert len(NAMES - drivers) <= MOST, len(NAMES - drivers)
    assert len(drivers) <= MOST_OF_DRIVERS, len(drivers)
    for module in MODULES:
        assert module.__doc__
        public = {name for name, value in vars(module).items() if name[0] != "_" and not isinstance(value, ModuleType)}
        assert public - {"MODULES"} == {*module.__all__}, module


def test_all_but_the_screens_is_imported_without_pygame() -> None:
    """Workers of a training have none."""
    code = (
        "import sys\nsys.modules['pygame'] = None\n"
        "from pigaming_app.ai.ppo.registry import TASKS\nfrom pigaming_app.ai.registry import AIS\n"
        "assert 'football' in TASKS and 'football' in AIS"
    )
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True)


def test_the_page_about_it_is_the_present_one_and_every_name_is_explained() -> None:
    """By a docstring, or by a remark beside its value. `.venv/bin/python -m tests.pages.api --write` writes it."""
    assert PAGE.read_text(encoding="utf-8") == page()
    for module in MODULES:
        for name in module.__all__:
            place, statement = definition(module, name)
            remark = inspect.getsource(place).splitlines()[statement.lineno - 1].partition("  # ")[2]
            assert docstring(statement) or remark, f"{module.__name__}.{name}"
