"""The gallery: all arenas of a game as pictures, to be drawn, played, renamed, deleted and shared."""
