"""Tournaments, Grand Prix, ladders, time trials and high scores. A file holds the whole event."""

from pigaming_app.jobs.events import changes, desk, export, new, play, show

WORDS = {
    "new": new,
    "run": play,
    "show": show,
    "result": changes.result,
    "correct": changes.correct,
    "enter": changes.enter,
    "withdraw": changes.withdraw,
    "swap": changes.swap,
    "seat": changes.seat,
    "call": changes.call,
    "arrange": changes.arrange,
    "close": changes.close,
    "break": changes.pause,
    "export": export,
    "desk": desk,
}
