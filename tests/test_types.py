"""Types and names of the whole package, read from its sources."""

import ast
import re
from collections import Counter
from importlib import import_module
from pathlib import Path
from typing import get_type_hints

import pytest

from pigaming_app.jobs.registry import jobs

PACKAGE = Path(__file__).resolve().parents[1] / "pigaming_app"
DOCSTRING = re.compile(r'""".*?"""', re.DOTALL)
PLAIN = [job for job in jobs().values() if job.name not in ("event", "kiosk", "train")]  # without sub-commands


@pytest.mark.parametrize("room", ["sim", "games", "ai"])
def test_hardly_a_parameter_of_the_engine_is_untyped(room: str) -> None:
    """At most 5 % of all parameters are Any, and 1 % of those of kernels, where a misspelt field costs most."""
    for kernels, share in ((False, 0.05), (True, 0.01)):
        hints = [
            ast.unparse(parameter.annotation).strip("'")
            for path in (PACKAGE / room).rglob("*.py")
            for function in ast.walk(ast.parse(path.read_text("utf-8")))
            if isinstance(function, ast.FunctionDef)
            and (not kernels or any("kernel" in ast.unparse(one) for one in function.decorator_list))
            for parameter in (*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs)
            if parameter.annotation
        ]
        loose = sum("Any" in hint.split(" | ") for hint in hints)
        assert len(hints) > 90
        assert loose <= share * len(hints)


def test_options_leave_the_command_line_as_dataclasses() -> None:
    """Only what declares and reads options sees a Namespace of argparse."""
    seen = {path.name for path in PACKAGE.rglob("*.py") if re.search(r"\bNamespace\b", path.read_text("utf-8"))}
    assert seen == {"options.py"}
    kinds = [get_type_hints(import_module(f"pigaming_app.jobs.{job.module}").run)["options"] for job in PLAIN]
    assert len(kinds) > 15
    assert all(kind.__dataclass_params__.frozen for kind in kinds)


def test_no_class_name_stands_for_two_things() -> None:
    names = Counter(
        name
        for path in PACKAGE.rglob("*.py")
        if "micropython" not in path.parts  # programs of another interpreter
        for name in re.findall(r"^ *class (\w+)[(:]", DOCSTRING.sub("", path.read_text("utf-8")), re.M)
    )
    assert len(names) > 800
    assert [name for name, count in names.items() if count > 1] == []
