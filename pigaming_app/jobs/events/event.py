"""Tournaments, Grand Prix, ladders, time trials and high scores. A file holds the whole event."""

from pigaming_app.jobs.events import arrange, close, desk, export, new, play, show
from pigaming_app.jobs.events.changes import call, correct, enter, pause, result, seat, swap, withdraw

WORDS = {
    "new": new,
    "run": play,
    "show": show,
    "result": result,
    "correct": correct,
    "enter": enter,
    "withdraw": withdraw,
    "swap": swap,
    "seat": seat,
    "call": call,
    "arrange": arrange,
    "close": close,
    "break": pause,
    "export": export,
    "desk": desk,
}
