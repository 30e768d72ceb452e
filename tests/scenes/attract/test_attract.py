"""Every lesson and a whole round of attract mode run to the end, in both languages, without a failing scene."""

from dataclasses import replace
from pathlib import Path

import pygame
import pytest

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.registry import new_match
from pigaming_app.games.arenas import arenas
from pigaming_app.games.moments import CLOSE, KINDS, LAST, Moment
from pigaming_app.games.registry import games
from pigaming_app.games.replay import Replay, recorded
from pigaming_app.games.setup import make_setup
from pigaming_app.scenes.attract.clip import Clip
from pigaming_app.scenes.attract.scene import Attract, DemoMatch, TimedPage
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.howto.scene import HowTo, taught
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.recordings import store
from pigaming_app.scenes.recordings.store import KEPT, Highlights, highlights
from pigaming_app.scenes.results.high_scores import HighScores, high_score_tables
from pigaming_app.scenes.start import run
from pigaming_app.storage.scores import ScoreTable
from pigaming_app.ui.i18n import LANGUAGES
from tests.cases import one_in
from tests.scenes.arcade import KEYS, Arcade, setup
from tests.scenes.measuring import lit_boxes

LONGEST = 12.0  # s; the longest animation, machine A, then B, repeats after 9.1 s
FASTEST = 0.08  # s per frame at which a match still runs at full speed


@pytest.mark.parametrize("phase", [0.4, pytest.param(0.1, marks=[pytest.mark.long, pytest.mark.again])])
@pytest.mark.parametrize("game", taught())
def test_every_picture_of_a_lesson_is_drawn_in_all_its_phases(arcade: Arcade, game: str, phase: float) -> None:
    """A phase, s, lies between two frames."""
    lesson = HowTo(arcade.context, game)
    frames = set()
    for _ in range(round(LONGEST / phase)):
        lesson.update(phase)
        lesson.draw(arcade.screen)
        frames.add(arcade.screen.get_buffer().raw[::4099])
    assert len(frames) > LONGEST / phase / 2, "the pictures move"


@pytest.mark.long
@pytest.mark.again
@pytest.mark.parametrize("language", LANGUAGES)
def test_attract_mode_shows_match_lesson_and_scores_of_every_game(
    home: Path, monkeypatch: pytest.MonkeyPatch, language: str
) -> None:
    shown: list[tuple[str, str]] = []
    follow = Attract._next

    def noted(attract: Attract) -> None:
        follow(attract)
        shown.append(named(attract.show))

    def first(context: Context) -> Attract:
        for game in games():
            scores_of(context, game)
        return Attract(context)

    monkeypatch.setattr(Attract, "_next", noted)
    monkeypatch.setattr("pigaming_app.scenes.attract.scene.MINUTES", 0.2)
    chosen = {"language": language}
    whole = 3 * len(games()) + 1
    options = Options(
        first_scene=first,
        headless=True,
        step=FASTEST,
        frames=8000,
        should_close=lambda: len(shown) == whole,
        changed_settings=chosen,
    )
    assert run(options) == 0
    assert "a scene failed" not in (home / "data" / "pigaming.log").read_text()
    assert shown[:3] == [(kind, shown[0][1]) for kind in ("DemoMatch", "HowTo", "HighScores")]
    assert {game for _, game in shown} == set(games())
    assert len(set(shown)) == whole - 1
    assert shown[-1] == shown[0], "and round again"


def named(show: object) -> tuple[str, str]:
    """Class and game of a show."""
    if isinstance(show, TimedPage):
        assert isinstance(show.page, HowTo | HighScores)
        return type(show.page).__name__, show.page.game
    assert isinstance(show, DemoMatch)
    return "DemoMatch", show.runner.match.setup.game


def scores_of(context: Context, game: str) -> None:
    """Add a score in a game's first arena."""
    rules = games()[game].default
    contest = ScoreTable(game, arenas(game)[0], "", rules=rules.name, length=rules.default_goal or 2, people=1)
    for board in high_score_tables(contest):
        context.scores.add(board.table, "ABC", 9)


def recording(game: str, seed: int = 1) -> Replay:
    """A short match with moments."""
    brains = ["level5", "level1", "level5", "level1"]
    match = new_match(make_setup(game, brains, None, 0.4, seed, None, None, LEVELS))
    while not match.over:
        match.tick()
    match.series[0].append((20.0, match.series[0][-1][1] + 1))
    return recorded(match)


@pytest.fixture(scope="module")
def replays() -> dict[str, Replay]:
    return {game: recording(game) for game in games()}


def until_clip(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> tuple[Attract, Clip]:
    """Attract mode up to its next highlight, with short shows and without prewarming."""
    monkeypatch.setattr("pigaming_app.scenes.attract.scene.MINUTES", 0.02)
    monkeypatch.setattr("pigaming_app.scenes.attract.scene.PAGE", 0.1)
    monkeypatch.setattr(MatchRunner, "prewarm", lambda runner, milliseconds: True)
    attract = arcade.open(Attract(arcade.context))
    arcade.until(lambda: isinstance(attract.show, Clip), 60.0)
    assert isinstance(attract.show, Clip)
    return attract, attract.show


def test_a_highlight_follows_a_demonstration_match(
    arcade: Arcade, replays: dict[str, Replay], monkeypatch: pytest.MonkeyPatch
) -> None:
    arcade.context.shared(highlights).add(replays["pitanks"])
    attract, clip = until_clip(arcade, monkeypatch)
    assert clip.runner is not None
    assert clip.runner.match.state.tick <= clip.start + 2
    taken = 0.0
    while attract.show is clip:
        arcade.frame(1 / 30, draw=taken == 0.0)
        taken += 1 / 30
    normal = (clip.end - clip.start) / 50
    assert normal < taken < normal + 6.0, "the moment passes in slow motion"
    assert arcade.sounds.heard == [], "nobody is listening"


@pytest.mark.parametrize("language", one_in(2, LANGUAGES))
def test_the_caption_of_a_highlight_fits(
    arcade: Arcade, replays: dict[str, Replay], monkeypatch: pytest.MonkeyPatch
) -> None:
    for game, replay in replays.items():
        for kind in KINDS:
            clip = Clip(arcade.context, (replay, Moment(kind, 100, 3)))
            clip.runner = MatchRunner(arcade.context, clip.timeline.match_at(0))
            monkeypatch.setattr(clip.runner, "draw", lambda canvas: canvas.fill("black"))
            clip.draw(arcade.screen)
            boxes = lit_boxes(arcade.screen)
            assert pygame.Rect(160, 140, 1600, 130).contains(boxes[0].unionall(boxes)), (game, kind)


def test_each_kind_takes_its_turn_and_the_closest_finish_is_chosen(replays: dict[str, Replay], home: Path) -> None:
    pool = Highlights()
    assert pool.next() is None
    for lead in (0.9, 0.1, 0.5):
        pool.add(replace(replays["race"], moments=(Moment(CLOSE, 500, 1, lead), Moment(LAST, 600, 2))))
    shown = [pool.next() for _ in range(4)]
    assert [highlight[1].kind for highlight in shown if highlight] == [LAST, CLOSE, LAST, CLOSE]
    assert shown[1] is not None
    assert shown[1][1].lead == 0.1
    for _ in range(100):
        pool.add(replays["race"])
    assert len(pool.played) == KEPT


def test_saved_replays_are_shown_too_and_files_may_vanish(
    arcade: Arcade, replays: dict[str, Replay], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = store.save(replays["pitanks"])
    _, clip = until_clip(arcade, monkeypatch)
    assert clip.replay == replays["pitanks"]
    path.unlink()
    (store.folder() / "noise.replay").write_bytes(b"noise")
    listed = [path, store.folder() / "noise.replay"]
    monkeypatch.setattr(store, "paths", lambda: listed)
    for _ in range(6):
        assert arcade.context.shared(highlights).next() is None
    arcade.wait(3.0)


def test_a_match_just_played_is_kept_for_attract_mode(arcade: Arcade) -> None:
    scene = arcade.open(MatchScene(arcade.context, setup("human idle off off", 0.02), KEYS[:1]))
    scene.opening.countdown.seconds_left = 0.05
    scene.match.series[0].append((0.5, 1))
    arcade.until(lambda: scene.match.over)
    arcade.frame()
    (kept,) = arcade.context.shared(highlights).played
    assert kept.setup == scene.setup
    assert {moment.kind for moment in kept.moments} == {LAST}
