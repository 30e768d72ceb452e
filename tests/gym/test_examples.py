"""The example that needs no other package plays as well as it should."""

import runpy
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def test_the_tank_written_by_hand_beats_the_weakest_machine():
    agent = runpy.run_path(str(EXAMPLES / "hand_written_agent.py"))
    result = agent["play"](seed=1, minutes=0.5, compiled=False)
    assert result["win"] == 1.0
    assert result["lead"] > 10.0
    assert result["hits"] > result["taken"]
