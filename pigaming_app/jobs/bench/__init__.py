"""Measurements and checks of the program."""

JOBS = {"bench": "performance on this machine", "test": "linter, types and tests"}
