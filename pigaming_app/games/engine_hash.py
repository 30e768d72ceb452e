"""The hash of the engine: of all sources that decide how a match plays out. Replays, ghosts and tables carry it."""

import ast
import hashlib
from collections.abc import Iterator
from functools import cache
from typing import Any

from pigaming_app.sim.kernel import PACKAGE

ENGINE = ("sim", "games")  # these decide how a match plays out, given the actions of the seats
_SKIPPED = ("ctx", "kind", "type_comment")  # fields of the syntax tree without a meaning of their own


@cache
def engine_hash() -> str:
    """SHA-256 over the syntax trees of the engine, the same on every system and every Python since 3.11.

    Comments, docstrings, layout, and where a module lies do not count; every name, constant, operator and annotation
    does.
    """
    sources = (path.read_bytes() for folder in ENGINE for path in (PACKAGE / folder).rglob("*.py"))
    return hashlib.sha256("".join(sorted(map(syntax_hash, sources))).encode()).hexdigest()


def syntax_hash(source: bytes) -> str:
    """SHA-256 over the syntax tree of one module."""
    return hashlib.sha256("\n".join(_tokens(ast.parse(source))).encode()).hexdigest()


def _tokens(node: Any) -> Iterator[str]:
    """A syntax tree as text. `ast.dump` is of no use here: it differs from one Python to the next.

    Empty fields are left out, since every new Python brings some. Imports from this package are too: they say where a
    module lies, and what they import is hashed itself.
    """
    match node:
        case list():
            for one in node:
                yield from _tokens(one) if one is not None else ("-",)
        case ast.Expr(value=ast.Constant()) | ast.ImportFrom(module="pigaming_app"):
            return
        case ast.ImportFrom(module=str(module)) if module.startswith("pigaming_app."):
            return
        case ast.AST():
            yield f"{type(node).__name__}("
            for name in node._fields:
                value = getattr(node, name, None)
                if name not in _SKIPPED and value is not None and value != []:
                    yield f"{name}="
                    yield from _tokens(value)
            yield ")"
        case _:
            yield repr(node)
