"""Arenas without the editor."""

JOBS = {"arena": "arenas of your own: list, export, import, check"}
