"""Process in which the Lab's network learns, so that learning never delays a frame.

    python -m pigaming_app.ai.ppo.lab.process          trains: orders come on standard input, reports leave
                                                       on standard output
    python -m pigaming_app.ai.ppo.lab.process compile  compiles its loop into numba's cache

Messages are pickles. The process ends with the arcade, however that ends, since its standard input is closed then.
"""

import os
import pickle
import sys
from concurrent.futures import ThreadPoolExecutor
from threading import Condition, Thread
from time import monotonic
from typing import BinaryIO

from pigaming_app.ai.ppo.lab.messages import PATIENCE, Begin, Report, TrainingOrder
from pigaming_app.ai.reward_line import RewardProgram, points_of
from pigaming_app.ai.reward_quantities import QUANTITIES
from pigaming_app.storage.background import exit_with_parent

PAUSE = TrainingOrder()
REPORTS = 0.15  # s between two reports at least
UNUSED = 600.0  # s without an order after which the process ends


class Inbox:
    """The latest messages from the arcade, read by a thread."""

    def __init__(self, stream: BinaryIO) -> None:
        self._news = Condition()
        self._begin: Begin | None = None
        self._order, self._ordered = PAUSE, monotonic()
        Thread(target=self._read, args=(stream,), daemon=True).start()

    def wait(self) -> tuple[Begin, TrainingOrder]:
        """What to do now; waits during a pause. Ends the process when it is not used for long."""
        with self._news:
            while self._begin is None or not self._pace:
                if monotonic() - self._ordered > UNUSED:
                    os._exit(0)
                self._news.wait(1.0)
            return self._begin, self._order

    def rest(self, begin: Begin, order: TrainingOrder, until: float) -> None:
        """Wait, but not if there is something else to do."""
        with self._news:
            while (left := until - monotonic()) > 0.0 and self._begin is begin and self._pace == order.pace:
                self._news.wait(min(left, PATIENCE / 4))

    @property
    def _pace(self) -> float:
        return self._order.pace if monotonic() - self._ordered < PATIENCE else 0.0

    def _read(self, stream: BinaryIO) -> None:
        try:
            while True:
                message = pickle.load(stream)
                with self._news:
                    if isinstance(message, Begin):
                        self._begin = message
                    else:
                        self._order, self._ordered = message, monotonic()
                    self._news.notify_all()
        finally:
            os._exit(1)  # the arcade has ended


def serve(inbox: Inbox, reports: BinaryIO) -> None:
    """Train as ordered, for ever. Raises ImportError without numba, OSError when the arcade has ended."""
    from pigaming_app.ai.ppo.lab.lesson import LESSON, LabTraining

    def send(report: Report) -> None:
        pickle.dump(report, reports)
        reports.flush()

    lesson: LabTraining | None = None
    due = sent = 0.0
    with ThreadPoolExecutor(1) as threads:
        while True:
            begin, order = inbox.wait()
            if lesson is None or lesson.number != begin.number:
                lesson, due = LabTraining(begin, threads), monotonic()
                send(lesson.report())
            lesson.learn(order.recipe)
            if monotonic() - sent >= REPORTS:
                send(lesson.report())
                sent = monotonic()
            due = max(due + LESSON / order.pace, monotonic() - LESSON / order.pace)
            inbox.rest(begin, order, due)


def compile_lesson() -> None:
    """Compile or load the loop. Raises ImportError without numba."""
    import numpy as np

    from pigaming_app.ai.ppo.lab.lesson import LabTraining

    with ThreadPoolExecutor(1) as threads:
        LabTraining(Begin(0, 1), threads).report()
    points_of(RewardProgram(), np.zeros((0, len(QUANTITIES))), fast=True)


def main(arguments: list[str]) -> None:
    if arguments == ["compile"]:
        exit_with_parent()
        compile_lesson()
        return
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever prints must not print into the reports
    serve(Inbox(sys.stdin.buffer), output)


if __name__ == "__main__":
    main(sys.argv[1:])
