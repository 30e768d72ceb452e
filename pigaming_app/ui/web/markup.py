"""HTML: every text is escaped here, and nowhere else."""

import html
from collections.abc import Iterable

EMPTY = frozenset(("meta", "link", "input", "br"))  # elements without content


class Markup(str):
    """Text that is HTML already."""

    __slots__ = ()


def escaped(content: object) -> Markup:
    """A text as HTML; nothing for None."""
    if isinstance(content, Markup):
        return content
    return Markup("" if content is None else html.escape(str(content)))


def tag(element: str, /, *contents: object, **attributes: object) -> Markup:
    """An element. `class_` is written class, `data_x` data-x; an attribute that is None or False is left out."""
    words = "".join(
        f" {escaped(key.rstrip('_').replace('_', '-'))}" + ("" if value is True else f'="{escaped(value)}"')
        for key, value in attributes.items()
        if value is not None and value is not False
    )
    return Markup(f"<{element}{words}>" + ("" if element in EMPTY else f"{joined(contents)}</{element}>"))


def joined(contents: Iterable[object]) -> Markup:
    """Elements and texts one after the other."""
    return Markup("".join(map(escaped, contents)))
