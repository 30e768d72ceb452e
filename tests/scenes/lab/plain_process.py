"""The process of the Lab's network with a small, uncompiled training: python -m tests.scenes.lab.plain_process."""

from dataclasses import replace

import pytest

from pigaming_app.ai.ppo.lab import lesson
from pigaming_app.ai.ppo.lab.process import main
from pigaming_app.ai.ppo.lab.task import HYPER, TASK
from tests.ai.ppo.plain import play_plain


def shrink(monkeypatch: pytest.MonkeyPatch) -> None:
    """Few, short, uncompiled matches."""
    play_plain(monkeypatch)
    monkeypatch.setattr(lesson, "HYPER", replace(HYPER, matches=8, decisions=4))
    monkeypatch.setattr(lesson, "TASK", replace(TASK, minutes=(0.05,)))
    monkeypatch.setattr(lesson, "LESSON", 0.4)
    monkeypatch.setattr(lesson, "MINUTES", 0.05)
    monkeypatch.setattr(lesson, "MATCHES", 2)


if __name__ == "__main__":
    shrink(pytest.MonkeyPatch())
    main([])
