"""The page of parts: its prices add up, and its sizes are those of the model."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "kit.md").read_text(encoding="utf-8")
MODEL = (ROOT / "docs" / "chassis" / "robot.scad").read_text(encoding="utf-8")


def test_the_parts_cost_about_forty_euros_and_add_up() -> None:
    table = PAGE.split("## Parts of one robot")[1].split("## Chassis")[0]
    prices = [int(price) for price in re.findall(r"\| (\d+) \|$", table, re.MULTILINE)]
    assert len(prices) > 10
    assert f"| **sum** | | **{sum(prices)}** |" in table
    assert sum(prices) <= 45


def test_the_sizes_are_those_of_the_model() -> None:
    numbers = {name: float(value) for name, value in re.findall(r"^(\w+) = ([\d.]+);", MODEL, re.MULTILINE)}
    axle = numbers["wheel_d"] / 2.0
    between = numbers["lid_top"] - numbers["thick"] - (axle + 5.0) - numbers["thick"]
    sizes = (numbers["base"], numbers["lid_top"], numbers["diameter"], between)
    rows = re.findall(r"\| (?:between|lid above|diameter)[^|]* \| (\d+) \|", PAGE)
    assert [float(row) for row in rows] == list(sizes)
