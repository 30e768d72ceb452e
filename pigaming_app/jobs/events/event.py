"""Tournaments and Grand Prix: knock-out, round robin, Swiss. A file holds the whole event."""

from pigaming_app.jobs.events import export, new, play, show

WORDS = {"new": new, "run": play, "show": show, "export": export}
