"""The frame of every page: head, fonts, the script that keeps it up to date, and the languages."""

from collections.abc import Iterable

from pigaming_app import ASSETS
from pigaming_app.ui.i18n import LANGUAGES, NAMES, Words
from pigaming_app.ui.web.markup import Markup, joined, tag

FILES = {  # what a page needs, by name: its source, and its kind
    "desk.css": ("desk/desk.css", "text/css"),
    "desk.js": ("desk/desk.js", "text/javascript"),
    "oxanium.woff2": ("fonts/oxanium-latin-700-normal.woff2", "font/woff2"),
    "lexend.woff2": ("fonts/lexend-latin-500-normal.woff2", "font/woff2"),
}


def contents() -> dict[str, bytes]:
    """The files of FILES by name."""
    return {name: (ASSETS / source).read_bytes() for name, (source, _) in FILES.items()}


def document(
    words: Words, title: str, main: Iterable[object], foot: Iterable[object] = (), every: float = 0, base: str = ""
) -> Markup:
    """A page. `every`: s after which it looks for news, 0: never; `base`: address of the folder of the files."""
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("title", title),
        tag("link", rel="icon", href="data:,"),
        tag("link", rel="stylesheet", href=f"{base}desk.css"),
        tag("script", src=f"{base}desk.js", defer=True),
    )
    body = tag("body", tag("main", *main), tag("footer", *foot), data_every=every or None)
    return Markup(f"<!doctype html>\n{tag('html', head, body, lang=words.language)}\n")


def languages(words: Words, address: str) -> Markup:
    """Links to the page in every language; `address` has {language}."""
    return tag(
        "nav",
        joined(
            tag(
                "a",
                NAMES[code],
                href=address.format(language=code),
                lang=code,
                aria_current="true" if code == words.language else None,
            )
            for code in LANGUAGES
        ),
        class_="languages",
    )
