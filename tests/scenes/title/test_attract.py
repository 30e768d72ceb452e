"""Every lesson and a whole round of attract mode run to the end, in both languages, without a failing scene."""

from pathlib import Path

import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.games.registry import games
from pigaming_app.scenes.app import Options, run
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.howto.lessons import LESSONS
from pigaming_app.scenes.howto.scene import HowTo
from pigaming_app.scenes.results.high_score_tables import high_score_tables
from pigaming_app.scenes.results.high_scores import HighScores
from pigaming_app.scenes.title.attract import Attract, DemoMatch, TimedPage
from pigaming_app.storage.scores import ScoreTable
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.controls import Controls
from tests.cases import one_in
from tests.scenes.arcade import Arcade

LONGEST = 12.0  # s; the longest animation, machine A, then B, repeats after 9.1 s
PHASES = 0.1  # s between two frames
FASTEST = 0.08  # s per frame at which a match still runs at full speed


@pytest.mark.parametrize("language", one_in(2, LANGUAGES))
@pytest.mark.parametrize("game", LESSONS)
def test_every_picture_of_a_lesson_is_drawn_in_all_its_phases(controls: Controls, game: str, language: str) -> None:
    arcade = Arcade(controls, language)
    lesson = HowTo(arcade.context, game)
    frames = set()
    for _ in range(round(LONGEST / PHASES)):
        lesson.update(PHASES)
        lesson.draw(arcade.screen)
        frames.add(arcade.screen.get_buffer().raw[::4099])
    assert len(frames) > LONGEST / PHASES / 2, "the pictures move"


@pytest.mark.long
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
