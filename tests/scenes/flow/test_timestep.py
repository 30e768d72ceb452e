"""Fixed timestep: as many ticks as real time holds, never a burst."""

import pytest

from pigaming_app.scenes.flow.timestep import MAX_TICKS, FixedTimestep
from pigaming_app.sim.world import DT


@pytest.mark.parametrize("fps", [24, 30, 50, 60, 75, 144, 240])
def test_ten_seconds_are_five_hundred_ticks_at_any_frame_rate(fps: int) -> None:
    pace = FixedTimestep()
    assert sum(pace.due(1 / fps) for _ in range(10 * fps)) == pytest.approx(500, abs=1)


def test_a_second_of_sleep_is_dropped() -> None:
    pace = FixedTimestep()
    assert pace.due(1.0) == MAX_TICKS
    assert pace.blend == 0.0
    assert sum(pace.due(1 / 50) for _ in range(50)) == 50


def test_a_machine_of_five_frames_a_second_plays_slowly() -> None:
    pace = FixedTimestep()
    assert sum(pace.due(1 / 5) for _ in range(10)) == 10 * MAX_TICKS


def test_four_times_the_speed_is_four_times_the_ticks() -> None:
    pace = FixedTimestep()
    assert sum(pace.due(1 / 60, 4.0) for _ in range(120)) == pytest.approx(400, abs=1)


def test_the_picture_lies_between_two_ticks() -> None:
    pace = FixedTimestep()
    pace.due(1.5 * DT)
    assert pace.blend == pytest.approx(0.5)
