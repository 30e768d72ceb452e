"""The second screen: the right contents, painted in slices, on displays that come and go."""

from collections.abc import Hashable, Sequence
from typing import Any

import numpy as np
import pygame
import pytest

from pigaming_app.scenes.features import board_text as text
from pigaming_app.scenes.features.board_page import BoardPart
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.kiosk.operator.desk import OperatorDesk
from pigaming_app.scenes.kiosk.scoreboard.pages import Pages
from pigaming_app.scenes.kiosk.scoreboard.score_page import ScorePage, match_parts
from pigaming_app.scenes.kiosk.scoreboard.standby_page import StandbyPage, best_today
from pigaming_app.scenes.kiosk.scoreboard.window import PERIOD, SIZE, WINDOWED, Board, ScoreboardWindow, fit
from pigaming_app.scenes.mat.camera_page import CameraPage
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.snapshot import sides, snapshot
from pigaming_app.storage.scores import Scores, ScoreTable
from pigaming_app.ui.i18n import LANGUAGES, Words
from tests.scenes.arcade import KEYS, Arcade, Floor, setup


class Lamps:
    """A page of lamps, each with a content; counts how often each is painted."""

    name = "lamps"

    def __init__(self, contents: Sequence[Hashable]) -> None:
        self.contents: list[Hashable] = list(contents)
        self.painted = [0] * len(contents)

    def parts(self, scenes: Sequence[Scene]) -> Sequence[BoardPart] | None:
        def paint(i: int, surface: pygame.Surface) -> None:
            self.painted[i] += 1
            surface.fill("white")

        return [
            BoardPart((100 * i, 0, 90, 90), content, lambda surface, i=i: paint(i, surface))  # type: ignore[misc]
            for i, content in enumerate(self.contents)
        ]


def painted(board: Board, target: pygame.Surface, name: str, scenes: Sequence[Scene] = ()) -> int:
    """Paint to the end in slices; returns their number."""
    board.refresh(name, scenes)
    slices = 1
    while not board.paint(0.0, target):
        slices += 1
        assert slices < 1000
    return slices


def test_only_what_has_changed_is_painted_again() -> None:
    lamps, target = Lamps("abc"), pygame.Surface(SIZE)
    board = Board([lamps])
    assert painted(board, target, "lamps") == 3
    assert not board.refresh("lamps", ())
    lamps.contents[1] = "B"
    painted(board, target, "lamps")
    assert lamps.painted == [1, 2, 1]
    lamps.contents.pop()
    painted(board, target, "lamps")
    assert target.get_at((210, 10))[:3] == (0, 0, 0)
    assert target.get_at((110, 10))[:3] >= (250, 250, 250)


def test_a_page_without_contents_gives_way(arcade: Arcade) -> None:
    lamps = Lamps("a")
    board = Board([lamps, ScorePage(arcade.context)])
    board.refresh("scores", [])
    assert board.page == "lamps"


@pytest.mark.parametrize("size", [(1366, 768), (1024, 768), (960, 540), (3840, 2160), (10, 1)])
def test_it_fits_any_window_undistorted(size: tuple[int, int]) -> None:
    area, target = fit(size), pygame.Surface(size)
    assert pygame.Rect((0, 0), size).contains(area)
    board = Board([Lamps("ab")])
    painted(board, target, "lamps")
    board.redraw(target)
    if area.w > 100:  # smoothly scaled
        assert target.get_at((area.x + area.w * 145 // 1920, area.y + area.h * 45 // 1080))[:3] >= (250, 250, 250)
        assert target.get_at((area.x + area.w // 2, area.y + area.h // 2))[:3] == (0, 0, 0)


class Filmed(Floor):
    """A scene with a camera."""

    camera_image: Any = None


def test_every_new_picture_of_the_camera_is_painted() -> None:
    scene, board, target = Filmed(), Board([CameraPage()]), pygame.Surface(SIZE)
    board.refresh("camera", [scene])
    assert board.page == "", "without a picture it gives way"
    for level in range(40, 240, 10):
        for _ in range(8):  # the second screen looks at every eighth or so
            scene.camera_image = np.full((540, 960), level, np.uint8)
        painted(board, target, "camera", [scene])
        assert target.get_at((960, 540))[0] == level
    assert not board.refresh("camera", [scene])


def test_the_leader_is_first_and_a_tie_has_none(arcade: Arcade) -> None:
    scene = MatchScene(arcade.context, setup("human level1 level1 off"), [KEYS[0]])
    assert [side.leads for side in sides(scene, arcade.context.words)] == [False] * 3
    for seat, points in enumerate((3, 7, -2)):
        scene.match.state.robots[seat].score = points
    found = sides(scene, arcade.context.words)
    assert [(side.seats, side.score, side.leads) for side in found] == [
        ((1,), "7", True),
        ((0,), "3", False),
        ((2,), "−2", False),
    ]
    assert [side.signs for side in found] == [("ai",), ("keys",), ("ai",)]


def test_teams_are_one_row_with_their_sum(arcade: Arcade) -> None:
    scene = MatchScene(arcade.context, setup("level1 level1 level1 level1", teams=(0, 1, 0, 1)))
    for seat, points in enumerate((3, 7, 5, 4)):
        scene.match.state.robots[seat].score = points
    found = sides(scene, arcade.context.words)
    assert [(side.seats, side.score) for side in found] == [((1, 3), "11"), ((0, 2), "8")]


def test_the_clock_counts_down_and_a_page_above_is_noted(arcade: Arcade) -> None:
    scene = arcade.open(MatchScene(arcade.context, setup("level1 level1 off off", minutes=2.0)))
    words = arcade.context.words
    assert (snapshot(scene, words, True).clock, snapshot(scene, words, True).state) == ("2:00", "waiting")
    arcade.until(lambda: scene.match.seconds >= 1.0)
    assert (snapshot(scene, words, True).clock, snapshot(scene, words, True).state) == ("1:59", "")
    assert snapshot(scene, words, False).state == "paused"


def test_the_result_stays_until_the_next_match_but_not_that_of_a_match_left(arcade: Arcade) -> None:
    page = ScorePage(arcade.context)
    scene = MatchScene(arcade.context, setup("level1 level1 off off", minutes=0.02))
    assert page.parts([arcade.title, scene])
    arcade.open(scene)
    arcade.until(lambda: scene.match.over)
    assert page.parts([arcade.title, scene])
    assert page.parts([arcade.title])
    assert page.last
    assert page.last.state == "over"
    page.parts([arcade.title, MatchScene(arcade.context, setup("level1 level1 off off"))])
    assert page.parts([arcade.title]) is None


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_part_can_be_painted_and_lies_on_the_canvas(arcade: Arcade) -> None:
    scene = MatchScene(arcade.context, setup("human level1 q1 fsm"), [KEYS[0]])
    pages = [match_parts(arcade.context, snapshot(scene, arcade.context.words, False))]
    pages.append(list(StandbyPage(arcade.context).parts([])))
    for parts in pages:
        boxes = [pygame.Rect(part.box) for part in parts]
        assert all(pygame.Rect((0, 0), SIZE).contains(box) for box in boxes)
        assert all(box.collidelist(boxes[i + 1 :]) == -1 for i, box in enumerate(boxes))
        for part in parts:
            surface = pygame.Surface(part.box[2:])
            part.paint(surface)
            border = [surface.get_at((0, y))[:3] for y in range(0, part.box[3], 4)]
            assert max(max(color) for color in border) < 120, f"{part.content} is cut off"


def test_texts_have_a_cache_of_their_own(arcade: Arcade) -> None:
    from pigaming_app.ui.draw.surface_cache import surfaces

    before = len(surfaces)
    text.line("never seen before", 60, (255, 255, 255), "head")
    assert len(surfaces) == before
    assert text.CACHE.bytes > 0


def test_the_best_of_today_come_from_the_table_with_the_most_of_them() -> None:
    scores = Scores()
    few = ScoreTable("pitanks", "classic", "points", False, "plain", 3.0, 2)
    many = ScoreTable("pitanks", "cross", "points", False, "plain", 3.0, 2)
    scores.add(few, "AAA", 50)
    for initials, points in (("BBB", 5), ("CCC", 9)):
        scores.add(many, initials, points)
    assert best_today(scores, "pitanks", Words("en")) == ("points", (("CCC", "9"), ("BBB", "5")))
    assert best_today(scores, "race", Words("en")) == ("", ())


def test_the_window_is_painted_in_frames_with_room_and_at_last_without(arcade: Arcade) -> None:
    lamps = Lamps("abc")
    window = ScoreboardWindow(1, 0, [lamps], headless=True)
    try:
        for _ in range(20):
            window.update(0.016, 0.0, "lamps", [])
        assert lamps.painted == [0, 0, 0]
        for _ in range(20):
            window.update(0.016, 0.010, "lamps", [])
        assert lamps.painted == [1, 1, 1]
        lamps.contents[0] = "A"
        for _ in range(400):
            window.update(0.016, 0.0, "lamps", [])
        assert lamps.painted == [2, 1, 1]
        assert window.window
        assert window.window.get_surface().get_at((10, 10))[:3] >= (250, 250, 250)
    finally:
        window.close()


def test_pages_are_read_a_few_times_a_second(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    lamps, reads = Lamps("a"), []
    parts = lamps.parts
    monkeypatch.setattr(lamps, "parts", lambda scenes: reads.append(1) or parts(scenes))  # type: ignore[func-returns-value]
    window = ScoreboardWindow(1, 0, [lamps], headless=True)
    try:
        for _ in range(600):
            window.update(1 / 60, 0.010, "lamps", [])
    finally:
        window.close()
    assert len(reads) <= 10 / PERIOD + 1


def test_its_mouse_is_not_that_of_the_arcade_and_it_closes_alone(arcade: Arcade) -> None:
    desk = OperatorDesk(arcade.context, 1, True)
    assert desk.window
    assert desk.window.window
    theirs = pygame.Event(pygame.MOUSEMOTION, pos=(5, 5), rel=(0, 0), buttons=(0, 0, 0), window=desk.window.window)
    ours = pygame.Event(pygame.MOUSEMOTION, pos=(5, 5), rel=(0, 0), buttons=(0, 0, 0), window=None)
    assert desk.filter([theirs, ours], []) == [ours]
    assert not desk.close_if_requested(pygame.Event(pygame.WINDOWCLOSE, window=None))
    assert desk.close_if_requested(pygame.Event(pygame.WINDOWCLOSE, window=desk.window.window))
    assert desk.window.window is None
    desk.show(0.1, 0.01, arcade.stack.scenes)
    desk.close()


def test_without_a_second_window_the_arcade_prints_a_reason_and_goes_on(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise pygame.error("windows are sold out")

    monkeypatch.setattr(pygame, "Window", refuse)
    desk = OperatorDesk(arcade.context, 2, True)
    desk.show(1.0, 0.01, arcade.stack.scenes)
    assert "no second screen" in capsys.readouterr().err
    assert list(arcade.context.notices.waiting) == [arcade.context.words("scoreboard.none")]


def test_f2_goes_through_the_pages_that_have_something_to_show(arcade: Arcade) -> None:
    desk = OperatorDesk(arcade.context, 1, True)
    key = pygame.Event(pygame.KEYDOWN, key=pygame.K_F2, scancode=0, mod=0)
    seen = []
    scene = MatchScene(arcade.context, setup("level1 level1 off off"))
    for _ in range(3):
        desk.filter([key], [arcade.title, scene])
        seen.append(arcade.context.shared(Pages).chosen)
    desk.close()
    assert seen == ["standby", "scores", "standby"]


def test_the_setting_opens_and_closes_it_while_the_arcade_runs(arcade: Arcade) -> None:
    desk = OperatorDesk(arcade.context, None, True)
    assert desk.window is None
    arcade.context.settings.scoreboard = 1
    desk.show(0.1, 0.01, arcade.stack.scenes)
    assert desk.window
    assert desk.window.window
    arcade.context.settings.scoreboard = 0
    desk.show(0.1, 0.01, arcade.stack.scenes)
    assert desk.window is None


def test_the_pages_of_features_stand_behind_those_of_the_kiosk(arcade: Arcade) -> None:
    assert [page.name for page in arcade.context.shared(Pages).pages] == ["standby", "scores", "event", "camera"]


def test_a_paused_match_is_shown_as_such(arcade: Arcade) -> None:
    page = ScorePage(arcade.context)
    scene = arcade.open(MatchScene(arcade.context, setup("human level1 off off"), [KEYS[0]]))
    arcade.until(lambda: scene.match.state.tick > 5)
    arcade.open(Pause(scene, KEYS[0]))
    page.parts(arcade.stack.scenes)
    assert page.last
    assert page.last.state == "paused"


DUMMY = (1024, 768)  # px, the display of SDL's dummy driver


class Displays:
    """Sizes of the connected displays, and those asked for the windows that were opened. The arcade is on another one
    than the dummy driver's, where all windows of the second screen open.
    """

    def __init__(self, monkeypatch: pytest.MonkeyPatch, count: int) -> None:
        self.sizes = [(1920, 1080), (1366, 768), (1280, 800)][:count]
        self.opened: list[tuple[int, int]] = []
        monkeypatch.setattr(pygame.display, "get_desktop_sizes", lambda: list(self.sizes))
        opened = self.opened

        class Noted(pygame.Window):
            def __init__(self, title: str, size: tuple[int, int], *rest: Any, **options: Any) -> None:
                opened.append(size)
                super().__init__(title, size, *rest, **options)

        monkeypatch.setattr(pygame, "Window", Noted)
        pygame.display.set_window_position((-4000, 0))


def a_desk(arcade: Arcade, number: int | None, arena: int = 0) -> OperatorDesk:
    canvas = arcade.context.canvas
    canvas.headless, canvas.display = False, arena
    return OperatorDesk(arcade.context, number, True)


def seconds_later(desk: OperatorDesk, arcade: Arcade, frames: int = 130) -> None:
    for _ in range(frames):
        desk.show(1 / 60, 0.010, arcade.stack.scenes)


def test_a_display_that_is_unplugged_closes_it_and_plugged_again_brings_it_back(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    displays = Displays(monkeypatch, 2)
    desk = a_desk(arcade, 2)
    seconds_later(desk, arcade)
    assert displays.opened == [(1366, 768)]
    displays.sizes.pop()
    seconds_later(desk, arcade)
    assert desk.window
    assert desk.window.window is None
    assert list(desk.notices.waiting) == [arcade.context.words("scoreboard.none")]
    displays.sizes.append((1280, 800))
    seconds_later(desk, arcade)
    assert desk.window.window
    assert displays.opened == [(1366, 768), (1280, 800)]
    assert desk.window.board.picture.get_bounding_rect().w > 0
    desk.close()


def test_a_display_that_appears_during_play_is_filled(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    displays = Displays(monkeypatch, 1)
    desk = a_desk(arcade, 2)
    seconds_later(desk, arcade)
    assert displays.opened == [WINDOWED]
    displays.sizes.append((1366, 768))
    seconds_later(desk, arcade)
    assert displays.opened == [WINDOWED, (1366, 768)]
    desk.close()


def test_an_unplugged_arena_is_not_covered_and_returns_to_its_display(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    displays, moves = Displays(monkeypatch, 2), []
    desk = a_desk(arcade, 1, arena=1)
    monkeypatch.setattr(arcade.context.canvas, "show", lambda display, full: moves.append(display))
    gone = displays.sizes.pop()
    seconds_later(desk, arcade)
    assert desk.window
    assert desk.window.window is None
    assert moves == []
    displays.sizes.append(gone)
    seconds_later(desk, arcade)
    assert desk.window.window
    assert moves == [1]
    desk.close()


def test_one_closed_by_hand_stays_closed_until_f2(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    displays = Displays(monkeypatch, 2)
    desk = a_desk(arcade, 2)
    assert desk.window
    assert desk.close_if_requested(pygame.Event(pygame.WINDOWCLOSE, window=desk.window.window))
    displays.sizes.append((1280, 800))
    seconds_later(desk, arcade)
    assert desk.window.window is None
    page = arcade.context.shared(Pages).chosen
    desk.filter([pygame.Event(pygame.KEYDOWN, key=pygame.K_F2, scancode=0, mod=0)], arcade.stack.scenes)
    assert desk.window.window
    assert arcade.context.shared(Pages).chosen == page
    assert displays.opened == [(1366, 768)] * 2
    desk.close()


def test_a_window_that_breaks_during_play_is_given_up_with_a_notice(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    Displays(monkeypatch, 2)
    desk = a_desk(arcade, 2)
    assert desk.window
    assert desk.window.window
    desk.window.window.destroy()
    seconds_later(desk, arcade)
    assert desk.window.window is None
    assert "was lost" in capsys.readouterr().err
    assert list(desk.notices.waiting) == [arcade.context.words("scoreboard.none")]


@pytest.mark.parametrize(
    ("number", "arena_display", "own"),
    [(2, 0, True), (1, 0, False), (3, 0, False), (1, 1, True), (2, 1, False), (16, 63, False), (1, 2, False)],
)
def test_it_fills_a_display_of_its_own_and_is_small_elsewhere(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, number: int, arena_display: int, own: bool
) -> None:
    displays = Displays(monkeypatch, 2)
    shown = ScoreboardWindow(number, arena_display, [])
    assert shown.window
    assert shown.fills == own
    assert displays.opened == [displays.sizes[number - 1] if own else WINDOWED]
    assert (shown.window.position, shown.window.size) == (((0, 0), DUMMY) if own else ((24, 24), WINDOWED))
    shown.close()


def test_on_a_mirrored_display_it_would_cover_the_arcade_and_is_small(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    Displays(monkeypatch, 2)
    pygame.display.set_window_position((0, 0))
    shown = ScoreboardWindow(2, 0, [])
    assert shown.window
    assert (shown.fills, shown.window.size) == (False, WINDOWED)
    shown.close()
