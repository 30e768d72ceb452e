"""Arenas as values for an editor: drawings and their text, and the places at which they cannot be played."""
