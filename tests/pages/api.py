"""docs/api.md, written from the package: `.venv/bin/python -m tests.pages.api --write`."""

import ast
import importlib
import inspect
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pigaming_app.api as api

PAGE = Path(__file__).resolve().parents[2] / "docs" / "api.md"
MODULES = [api, *(importlib.import_module(f"{api.__name__}.{name}") for name in api.MODULES)]


FACE = {name for module in MODULES for name in module.__all__}
HEAD = """# What a plug-in may import

`pigaming_app.api` is version {version} of the face towards games and drivers from elsewhere: {names} names.
A package names the version that it was written for, `API = 1` in its `__init__.py`; another one is refused in one line.
[add-a-game.md](add-a-game.md) shows how they play together.

`.venv/bin/python -m tests.pages.api --write` writes this page.
"""


def page() -> str:
    """The text of docs/api.md."""
    names = sum(len(module.__all__) for module in MODULES)
    return "\n".join([HEAD.format(version=api.API, names=names), *map(section, MODULES)])


def section(module: ModuleType) -> str:
    """The names of a module, in the order of the alphabet."""
    summary, _, more = (module.__doc__ or "").partition("\n\n")
    entries = [entry(module, name) for name in sorted(module.__all__, key=str.lower)]
    return "\n".join([f"## {module.__name__}\n", summary, *([f"\n{more.strip()}"] if more else []), "", *entries])


def entry(module: ModuleType, name: str) -> str:
    """Heading, docstring and declaration of a name, and of the records that it holds."""
    place, statement = definition(module, name)
    said = docstring(statement)
    code = "\n\n".join("\n".join(declared(*one)) for one in ((place, statement), *held(place, statement)))
    return "\n".join([f"### {name}\n", *([f"{said}\n"] if said else []), f"```python\n{code}\n```\n"])


def definition(module: ModuleType, name: str) -> tuple[ModuleType, ast.stmt]:
    """The module in which a name is defined, and the statement that defines it."""
    body = ast.parse(inspect.getsource(module)).body
    for one in body:
        if isinstance(one, ast.ImportFrom) and one.module:
            names, source = {alias.name for alias in one.names}, importlib.import_module(one.module)
            if name in names or ("*" in names and hasattr(source, name)):
                return definition(source, name)
    return module, next(one for one in body if name in defined(one))


def defined(statement: ast.stmt) -> set[str]:
    """The names that a statement defines."""
    match statement:
        case ast.ClassDef(name=name) | ast.FunctionDef(name=name):
            return {name}
        case ast.Assign(targets=targets):
            return {node.id for target in targets for node in ast.walk(target) if isinstance(node, ast.Name)}
    return set()


def docstring(statement: ast.stmt) -> str:
    return (ast.get_docstring(statement) if isinstance(statement, ast.ClassDef | ast.FunctionDef) else "") or ""


def held(module: ModuleType, statement: ast.stmt) -> list[tuple[ModuleType, ast.stmt]]:
    """The classes that a record is derived from, and whose records it has, or of which a value is; none of the face."""
    names = {node.id for node in ast.walk(statement) if isinstance(node, ast.Name)}
    found: list[tuple[ModuleType, ast.stmt]] = []
    if isinstance(statement, ast.Assign) and isinstance(statement.value, ast.Call):
        return [definition(module, ast.unparse(statement.value.func))]
    if isinstance(statement, ast.ClassDef) and "record" in {ast.unparse(one) for one in statement.decorator_list}:
        for name in sorted(names - FACE):
            kind = getattr(module, name, None)
            if isinstance(kind, type) and kind.__module__.startswith("pigaming_app."):
                inner = definition(module, name)
                found += [one for one in (inner, *held(*inner)) if one[1].lineno and one not in found]
    return found


def declared(module: ModuleType, statement: ast.stmt) -> Iterator[str]:
    """The lines that declare a name: a signature, fields and methods with what is said about them, or a value."""
    lines = inspect.getsource(module).splitlines()
    match statement:
        case ast.FunctionDef():
            yield signature(statement)
        case ast.ClassDef():
            bases = ", ".join(ast.unparse(base) for base in statement.bases)
            yield f"class {statement.name}({bases})".removesuffix("()")
            for inner in statement.body:
                yield from members(lines, inner)
        case _:
            yield from lines[statement.lineno - 1 : statement.end_lineno]


def members(lines: list[str], inner: ast.stmt) -> Iterator[str]:
    """A field with its comment, or a public method with the first line of its docstring."""
    match inner:
        case ast.FunctionDef(name=name) if not name.startswith("_"):
            yield f"    {signature(inner)}"
            if said := docstring(inner).partition("\n")[0]:
                yield f"        # {said}"
        case ast.AnnAssign() | ast.Assign():
            yield from (line.rstrip() for line in lines[inner.lineno - 1 : inner.end_lineno])


def signature(function: ast.FunctionDef) -> str:
    result = f" -> {ast.unparse(function.returns)}" if function.returns else ""
    return f"def {function.name}({ast.unparse(function.args)}){result}"


if __name__ == "__main__":
    if "--write" in sys.argv:
        PAGE.write_text(page(), encoding="utf-8")
    else:
        print(page())
