"""Compiled loops are cached by the sources, wherever a copy of the program lies."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from pigaming_app.sim import kernel as kernel_module
from pigaming_app.sim.kernel import can_compile

pytestmark = pytest.mark.skipif(not can_compile(), reason="numba is not installed")

STEP = """
from pigaming_app.sim.kernel import kernel


@kernel
def step(x):
    return x + {amount}
"""
PROGRAM = """
import numpy
from pigaming_app.sim.kernel import compiled
from pigaming_app.sim.step import step


def make_loop(times, step):
    def twice(x):
        return step(step(x))

    from pigaming_app.sim.kernel import kernel
    kernel(twice)

    def loop(values):
        for i in range(len(values)):
            for _ in range(times):
                values[i] = twice(values[i])

    return loop


for times in (1, 2):
    values = numpy.zeros(2)
    compiled(make_loop(times, step))(values)
    print("result", values[0])
"""


def copy_of_the_program(folder: Path, amount: int) -> Path:
    """A small program with the kernels of this one."""
    sim = folder / "pigaming_app" / "sim"
    sim.mkdir(parents=True)
    shutil.copy(kernel_module.__file__, sim)
    for package in (sim.parent, sim):
        (package / "__init__.py").touch()
    (sim / "step.py").write_text(STEP.format(amount=amount))
    (folder / "program.py").write_text(PROGRAM)
    return folder


def run(folder: Path, home: Path, **variables: str) -> tuple[list[str], int, int]:
    """Results, and the numbers of loops that were compiled and loaded."""
    environment = {**os.environ, "PIGAMING_HOME": str(home), "NUMBA_DEBUG_CACHE": "1", **variables}
    environment.pop("NUMBA_CACHE_DIR", None)
    done = subprocess.run(
        [sys.executable, "program.py"], cwd=folder, env=environment, capture_output=True, text=True, check=True
    )
    lines = done.stdout.splitlines()
    results = [line.removeprefix("result ") for line in lines if line.startswith("result")]
    return results, done.stdout.count("data saved"), done.stdout.count("data loaded")


def test_every_copy_of_a_program_loads_what_the_first_has_compiled(tmp_path: Path) -> None:
    home = tmp_path / "home"
    first, other, edited = (
        copy_of_the_program(tmp_path / name, amount) for name, amount in (("one", 1), ("a/longer/way", 1), ("new", 5))
    )
    assert run(first, home) == (["2.0", "4.0"], 2, 0)
    assert run(other, home, PYTHONDONTWRITEBYTECODE="1") == (["2.0", "4.0"], 0, 2)
    assert run(first, home) == (["2.0", "4.0"], 0, 2), "from bytecode as from source"
    assert run(edited, home) == (["10.0", "20.0"], 2, 0), "an edit in a function that the loop calls"
