"""Scenes that leave the stack are closed; and a fixed timestep: as many ticks as real time holds, never a burst."""

import pytest

from pigaming_app.scenes.flow.scene import Home, Pop, Push, Quit, Stack, StackOperation, Swap
from pigaming_app.scenes.flow.timestep import MAX_TICKS, FixedTimestep
from pigaming_app.sim.world import DT
from tests.scenes.arcade import Floor


class Camera(Floor):
    """A scene that holds a camera."""

    def __init__(self, name: str, told: list[str]) -> None:
        self.name, self.told = name, told

    def on_leave(self) -> None:
        self.told.append(self.name)


@pytest.mark.parametrize("turn", [Pop(), Swap(Floor()), Home(), Home(Floor()), Quit()])
def test_removed_scenes_are_closed(turn: StackOperation) -> None:
    told: list[str] = []
    stack = Stack(Floor())
    stack.apply(Push(Camera("one", told)))
    assert told == []
    stack.apply(turn)
    assert told == ["one"]


def test_covered_scenes_stay_open_and_all_close_topmost_first() -> None:
    told: list[str] = []
    stack = Stack(Floor())
    stack.apply(Push(Camera("low", told)))
    stack.apply(Push(Camera("high", told)))
    stack.apply(None)
    assert told == []
    stack.clear()
    assert told == ["high", "low"]
    assert stack.scenes == []


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
