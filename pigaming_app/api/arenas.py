"""Arena files: reading and checking them, drawing some. No pygame."""

from pigaming_app.games.drawing.gaps import layout_faults
from pigaming_app.games.drawing.values import Drawing, Part
from pigaming_app.games.simple import read_layout
from pigaming_app.sim.arena import Layout
from pigaming_app.sim.toml_table import FieldError, TomlTable

__all__ = ["Drawing", "FieldError", "Layout", "Part", "TomlTable", "layout_faults", "read_layout"]
