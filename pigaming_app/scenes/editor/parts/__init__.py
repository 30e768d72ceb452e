"""Kinds of parts that several games have in their arenas."""
