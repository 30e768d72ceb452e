"""Frame budget: missing sprites are built over several frames, while the last complete picture stays."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import pygame
import pytest

from pigaming_app.scenes import app as arcade
from pigaming_app.scenes.app import App
from pigaming_app.scenes.flow.scene import Push, StackOperation
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.start import opened
from pigaming_app.ui.draw import frame_budget
from pigaming_app.ui.draw.frame_budget import (
    FrameBudget,
    PrewarmQueue,
    Steps,
    Unfinished,
    budget,
    resumable,
    run_to_end,
)
from pigaming_app.ui.draw.surface_cache import SurfaceCache
from pigaming_app.ui.input.events import Button, InputEvent

PIECE = 0.004  # s to build a sprite
FRAME = 0.010  # s per frame for sprites


class Watch:
    """A clock advanced by work only."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now

    def work(self, seconds: float) -> None:
        self.now += seconds


@pytest.fixture
def watch(monkeypatch: pytest.MonkeyPatch) -> Watch:
    watch = Watch()
    monkeypatch.setattr(frame_budget, "clock", watch)
    monkeypatch.setattr(arcade, "clock", watch)
    return watch


def pieces(watch: Watch, seconds: float = PIECE) -> tuple[list[int], "partial[pygame.Surface]"]:
    """A cached function, and the arguments of its actual calls."""
    made: list[int] = []

    def make(number: int) -> pygame.Surface:
        watch.work(seconds)
        made.append(number)
        return pygame.Surface((8, 8))

    return made, partial(SurfaceCache(1 << 20).cached(make))


def test_without_a_limit_everything_is_made_at_once(watch: Watch) -> None:
    made, piece = pieces(watch)
    for number in range(100):
        piece(number)
    assert made == [*range(100)]


def test_a_page_of_many_pieces_comes_over_several_frames_and_no_piece_is_made_twice(watch: Watch) -> None:
    made, piece = pieces(watch)
    frames = 0
    for _ in range(100):
        began = watch.now
        try:
            with budget.until(watch.now + FRAME):
                for number in range(20):
                    piece(number)
            break
        except Unfinished:
            frames += 1
        assert watch.now - began <= FRAME + PIECE
    assert made == [*range(20)]
    assert frames == 6, "three pieces of 4 ms fit into 10 ms, the third begun in time"


def test_a_piece_longer_than_the_budget_is_still_made(watch: Watch) -> None:
    made, piece = pieces(watch, 5 * FRAME)

    def page() -> None:
        for number in range(4):
            piece(number)

    for _ in range(3):
        with pytest.raises(Unfinished), budget.until(watch.now + FRAME):
            page()
    assert made == [0, 1, 2]


def test_two_queues_share_the_time_of_a_frame(watch: Watch) -> None:
    made, piece = pieces(watch, 0.8 * FRAME)
    queues = [PrewarmQueue([partial(piece, 2 * number + k) for number in range(3)]) for k in (0, 1)]
    for _ in range(3):
        began = watch.now
        with budget.frame(False, began + FRAME):
            for queue in queues:
                queue.work(1000 * FRAME)
        assert watch.now - began < 2 * FRAME
    assert made[:2] == [0, 2], "the second one waits for the first"


def test_interrupted_work_goes_on_where_it_was(watch: Watch) -> None:
    done: list[int] = []

    @resumable
    def drawing(name: str) -> Steps[str]:
        for step in range(6):
            watch.work(PIECE)
            done.append(step)
            yield
        return name

    for _ in range(2):
        with pytest.raises(Unfinished), budget.until(watch.now + FRAME):
            drawing("a")
    with budget.until(watch.now + FRAME):
        assert drawing("a") == "a"
    assert done == [*range(6)]


def test_abandoned_work_is_dropped(watch: Watch) -> None:
    begun: list[int] = []

    @resumable
    def drawing(number: int) -> Steps[None]:
        begun.append(number)
        while watch.now < 1e9:
            watch.work(FRAME)
            yield

    for number in [*range(10), 9, 0]:
        with pytest.raises(Unfinished), budget.until(watch.now + FRAME):
            drawing(number)
    assert begun == [*range(10), 0], "9 went on, 0 had been dropped and began anew"


def test_uninterrupted_work_returns_what_it_made() -> None:
    def steps() -> Steps[int]:
        yield
        yield
        return 7

    assert run_to_end(steps()) == 7


def test_work_ahead_ends_in_time_and_takes_up_an_interrupted_job_again(watch: Watch) -> None:
    made, piece = pieces(watch)

    def two() -> None:
        piece(1)
        piece(2)

    ahead = PrewarmQueue([partial(piece, 0), two, partial(piece, 3)])
    assert not ahead.work(1000 * PIECE)
    assert made == [0]
    assert not ahead.work(1000 * PIECE)
    assert made == [0, 1], "the second half of the job has to wait"
    while not ahead.work(1000 * PIECE):
        pass
    assert made == [0, 1, 2, 3]
    ahead.append([partial(piece, 4)])
    assert ahead.work(1000 * PIECE)
    assert made[-1] == 4


def test_nothing_is_made_ahead_while_a_picture_is_behind(watch: Watch) -> None:
    made, piece = pieces(watch)
    ahead = PrewarmQueue([partial(piece, 0)])
    with budget.frame(behind=True):
        assert not ahead.work(100.0)
    assert made == []
    with budget.frame(behind=False):
        assert ahead.work(100.0)


def test_what_was_made_ahead_in_a_frame_counts_for_its_picture(watch: Watch) -> None:
    made, piece = pieces(watch)
    own = FrameBudget()
    assert not own.behind
    with budget.frame(behind=False):
        PrewarmQueue([partial(piece, 0)]).work(1.0)
        with pytest.raises(Unfinished), budget.until(watch.now):
            piece(1)
    assert made == [0]


class Slow:
    """A page of thirty sprites in the colour (30, 0, 0), drawn over the whole screen as it grows."""

    def __init__(self, watch: Watch) -> None:
        self.made, self.piece = pieces(watch)
        self.heard: list[Button] = []

    def on_enter(self) -> None:
        pass

    def handle(self, event: InputEvent) -> StackOperation:
        self.heard.append(event.button)
        return None

    def update(self, seconds: float) -> StackOperation:
        return None

    def draw(self, screen: pygame.Surface) -> None:
        screen.set_clip((0, 0, 100, 100))
        for number in range(30):
            self.piece(number)
            screen.fill((number + 1, 0, 0))
        screen.set_clip(None)
        screen.fill((30, 0, 0))


@pytest.fixture
def app(home: object, watch: Watch) -> Iterator[App]:
    with opened(Options(headless=True)) as app:
        while not app.compose(1 / 60):
            pass
        yield app


def test_the_last_picture_stays_until_the_next_one_is_whole(app: App, watch: Watch) -> None:
    shown: list[tuple[int, ...]] = []
    app.context.canvas.watchers.append(lambda window: shown.append(tuple(window.get_at((600, 600)))[:3]))
    page = Slow(watch)
    app.stack.apply(Push(page))
    frames = 0
    while not shown:
        began = watch.now
        app._frame(1 / 60)
        frames += 1
        assert watch.now - began <= arcade.PREWARM_UNTIL + PIECE
    assert shown == [(30, 0, 0)]
    assert frames > 5
    assert page.made == [*range(30)]


def test_a_tap_while_a_picture_is_incomplete_counts(app: App, watch: Watch) -> None:
    page = Slow(watch)
    app.stack.apply(Push(page))
    assert not app.compose(1 / 60)
    for kind in (pygame.KEYDOWN, pygame.KEYUP):
        pygame.event.post(pygame.Event(kind, key=pygame.K_SPACE, scancode=pygame.KSCAN_SPACE, mod=0, unicode=""))
    assert not app.compose(1 / 60)
    assert page.heard == [Button.FIRE]


def test_a_picture_that_never_gets_ready_is_completed_after_a_while(
    app: App, watch: Watch, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(arcade, "MAX_UNFINISHED", 3)
    app.stack.apply(Push(Slow(watch)))
    assert [app.compose(1 / 60) for _ in range(4)] == [False, False, False, True]


def test_in_simulated_time_every_frame_has_its_picture(app: App, watch: Watch) -> None:
    app.options = replace(app.options, step=1 / 60)
    app.stack.apply(Push(Slow(watch)))
    assert app.compose(1 / 60)
