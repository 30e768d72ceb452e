"""Names that visitors give their phones: short, of letters that the screen can show, and kind.

A name is compared with the lists in `assets/phones/unkind.toml` as a reader would see it: without accents, signs and
doubled letters, with digits as the letters they resemble. Long words count anywhere in a name, short ones alone.
"""

import re
import unicodedata
from functools import cache

from pigaming_app import ASSETS
from pigaming_app.storage.parsing import parse_toml, read_text

MAX_NAME = 12  # letters
LOOKALIKES = str.maketrans("0134578@$!|+", "oieastbasiit")
_SHOWN = re.compile(r"[^A-Za-z0-9À-ÖØ-öø-ÿŒœŸ '.\-]")  # what it does not match is in the fonts


def kind_name(raw: str) -> str:
    """The name as it is shown; empty if nothing is left of it or it is unkind."""
    composed = unicodedata.normalize("NFKC", raw)
    name = " ".join(_SHOWN.sub("", composed).split())[:MAX_NAME].strip()
    return "" if not any(map(str.isalnum, name)) or unkind(name) or unkind(composed) else name


def unkind(name: str) -> bool:
    """True if a name has a word of the lists in it, however it is spelled."""
    anywhere, alone = _lists()
    words = re.split(r"[ .'\-]+", _bare(name))
    whole = "".join(words)
    spelled = {whole, _single(whole)}
    return any(word in one for word in anywhere for one in spelled) or any(
        form in alone for word in (*words, whole) for form in (word, _single(word))
    )


def _bare(name: str) -> str:
    """Small letters without accents, digits and signs as the letters they resemble."""
    apart = unicodedata.normalize("NFD", name.casefold()).replace("œ", "oe")
    letters = "".join(sign for sign in apart if not unicodedata.combining(sign))
    mixed = letters.translate(LOOKALIKES) if re.search("[a-z]", letters) else letters
    return re.sub(r"[^a-z0-9 .'\-]", "", mixed)


def _single(word: str) -> str:
    """A word without doubled letters."""
    return re.sub(r"(.)\1+", r"\1", word)


@cache
def _lists() -> tuple[frozenset[str], frozenset[str]]:
    """The words of all languages, for every language: those found anywhere, and those found alone."""
    table = parse_toml(read_text(ASSETS / "phones" / "unkind.toml"))
    found = [
        frozenset(form for words in table.values() for word in words[key] for form in (word, _single(word)))
        for key in ("anywhere", "alone")
    ]
    return found[0], found[1]
