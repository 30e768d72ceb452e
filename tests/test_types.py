"""Types and names of the whole package, read from its sources."""

import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1] / "pigaming_app"


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
