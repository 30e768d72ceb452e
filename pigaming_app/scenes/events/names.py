"""Names of entrants in a sentence or a row: long ones are shortened, never set in small type."""

from collections.abc import Sequence

from pigaming_app.events.spec import Result
from pigaming_app.ui.draw import BODY, LABEL, text_width
from pigaming_app.ui.draw.layers import fit_text

ROOM = 300  # px, of a name in a sentence


def shortened(name: str, room: float = ROOM, size: int = LABEL, face: str = "head") -> str:
    """A name of at most `room` px, in type of `size` px."""
    return fit_text(name, size, room, face, size)[0]


def versus(names: Sequence[str]) -> str:
    """Those who play a match."""
    return " – ".join(shortened(name) for name in names)


def places_line(outcome: Result, room: float) -> str:
    """A result in one line of at most `room` px at BODY size, with names as long as possible."""
    line = ""
    for most in range(480, 60, -20):
        line = "   ".join(
            f"{place}. {' = '.join(shortened(name, most, BODY) for name in names)}"
            for place, names in places_of(outcome)
        )
        if text_width(line, BODY) <= room:
            break
    return line


def places_of(outcome: Result) -> list[tuple[int, tuple[str, ...]]]:
    """Each place with those who share it: after two second ones comes a fourth."""
    found, ahead = [], 0
    for names in outcome.places:
        found.append((1 + ahead, names))
        ahead += len(names)
    return found
