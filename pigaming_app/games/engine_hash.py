"""Hash of the sources that determine how a match plays out, stored in replays, ghosts and trained weights."""

import ast
import hashlib
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

from pigaming_app.sim.kernel import PACKAGE
from pigaming_app.storage.plugins.parts import rule_sources

ENGINE = ("sim", "games")  # rooms that determine how a match plays out, given the actions of the seats
_SKIPPED = ("ctx", "kind", "type_comment")  # fields of the syntax tree without meaning for the program


def engine_hash(game: str = "") -> str:
    """SHA-256 over the syntax trees of the engine, the same on every system and every Python since 3.11.

    `game`: a plug-in's rules count for its own game only; all games of this package have the same hash. Comments,
    docstrings, formatting and module paths do not count; every name, constant, operator and annotation does.
    """
    return _hash(rule_sources(game))


@cache
def _hash(added: tuple[Path, ...]) -> str:
    """Hash of the engine and of added modules."""
    ours = (path for folder in ENGINE for path in (PACKAGE / folder).rglob("*.py"))
    hashes = sorted(syntax_hash(path.read_bytes()) for path in (*ours, *added))
    return hashlib.sha256("".join(hashes).encode()).hexdigest()


def syntax_hash(source: bytes) -> str:
    """SHA-256 over the syntax tree of one module."""
    return hashlib.sha256("\n".join(_tokens(ast.parse(source))).encode()).hexdigest()


def _tokens(node: Any) -> Iterator[str]:
    """A syntax tree as text tokens. `ast.dump` is not used since its output differs between Python versions.

    Empty fields are skipped, since new Python versions add some. So are imports from this package: they contain module
    paths, and the imported modules are hashed themselves.
    """
    match node:
        case list():
            for child in node:
                yield from _tokens(child) if child is not None else ("-",)
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
