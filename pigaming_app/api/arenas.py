"""Arena files: reading and checking them, and making some. No pygame."""

from pigaming_app.games.drawing.gaps import Flaw, narrow_gaps
from pigaming_app.games.drawing.values import Drawing, Part, Value, text_of
from pigaming_app.games.starts import clear_starts
from pigaming_app.sim.arena import BUILT, Layout, build, raise_first, read_starts, read_walls, start_faults
from pigaming_app.sim.things.spec import read_things
from pigaming_app.sim.toml_table import FieldError, TomlTable

__all__ = [
    "BUILT",
    "Drawing",
    "FieldError",
    "Flaw",
    "Layout",
    "Part",
    "TomlTable",
    "Value",
    "build",
    "clear_starts",
    "narrow_gaps",
    "raise_first",
    "read_starts",
    "read_things",
    "read_walls",
    "start_faults",
    "text_of",
]
