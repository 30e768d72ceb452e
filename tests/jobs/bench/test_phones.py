"""The bench of phones, for a moment."""

import os
import subprocess
import sys

import pytest


@pytest.mark.usefixtures("controls", "_no_threads_stay")
def test_every_move_of_four_phones_is_measured() -> None:
    from pigaming_app.jobs.bench.phones import measure

    figures = measure(0.8)
    assert (figures["phones"], figures["phones_waiting"]) == (4, 27)
    assert figures["moves"] >= 4
    assert (
        0.0 < figures["stick_to_tick_ms_median"] <= figures["stick_to_tick_ms_99"] <= figures["stick_to_tick_ms_worst"]
    )
    assert figures["messages_per_second_a_phone"] <= 65.0


def test_it_measures_without_a_window() -> None:
    program = "from pigaming_app.jobs.bench.phones import measure; print(measure(0.8)['phones'])"
    environment = {key: value for key, value in os.environ.items() if not key.startswith("SDL_")}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, timeout=60)
    assert done.stdout.split()[-1:] == ["4"], done.stderr
