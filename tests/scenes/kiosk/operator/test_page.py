"""The operator's page: by pad, keyboard and mouse; changes apply at once and last."""

import json

import pygame
import pytest

from pigaming_app.scenes.flow.access import HOLD, HOLD_WITHOUT_PIN
from pigaming_app.scenes.kiosk import safe_start
from pigaming_app.scenes.kiosk.operator.desk import OperatorDesk
from pigaming_app.scenes.kiosk.operator.figures_page import (
    FOLDER,
    OTHERS,
    FiguresPage,
    _short,
    bars_of,
    games_of,
    step_of,
)
from pigaming_app.scenes.kiosk.operator.page import LIMITS, PIN, QUIET, ROWS, SAFE_START, OperatorPage
from pigaming_app.scenes.options.page import OptionsPage
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.title.scene import Title
from pigaming_app.storage.day_log import DayLog, PlayedMatch, now
from pigaming_app.storage.safe_mode import DEFAULTS, VARIABLE
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.draw.layers import fit_lines
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets import setting_row as dials
from tests.scenes.arcade import Arcade, setup
from tests.ui.input.virtual_pad import VirtualPad


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    arcade.context.day_log = DayLog(folders().data)


def focus(arcade: Arcade, row: str) -> OperatorPage:
    """Go to a row, on the page that has it."""
    if row in QUIET:
        focus(arcade, "quiet")
        arcade.press(Button.FIRE)
    page = arcade.shown(OperatorPage)
    arcade.press(*[Button.DOWN] * page.rows.index(row))
    assert page.focus.name == row
    return page


def saved() -> Settings:
    return Settings.load(folders().config)[0]


def test_the_options_open_it(arcade: Arcade) -> None:
    arcade.open(OptionsPage(arcade.context))
    page = arcade.shown(OptionsPage)
    while page.focus.name != "day":
        arcade.press(Button.DOWN)
    arcade.press(Button.FIRE)
    arcade.shown(OperatorPage)
    arcade.press(Button.BACK)
    arcade.shown(OptionsPage)


def test_quiet_hours_go_round_midnight_in_steps_of_half_an_hour(arcade: Arcade) -> None:
    arcade.open(OperatorPage(arcade.context))
    focus(arcade, "quiet_from")
    arcade.press(Button.LEFT)
    assert saved().quiet_from == "23:30"
    arcade.press(Button.RIGHT, Button.RIGHT)
    assert saved().quiet_from == "00:30"


def test_a_limit_is_chosen_with_the_mouse(arcade: Arcade) -> None:
    arcade.open(OperatorPage(arcade.context))
    page = arcade.shown(OperatorPage)
    box = page.focus.rect("group_minutes")
    arcade.click(box.right - 60, box.centery)
    assert saved().group_minutes == LIMITS[1]
    arcade.click(box.x + 20, box.centery)
    assert saved().group_minutes == LIMITS[1]


def test_the_cap_limits_music_and_sounds(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    heard: list[tuple[int, int]] = []
    monkeypatch.setattr(arcade.sounds, "volume", lambda *volumes: heard.append(volumes))
    arcade.context.settings.music, arcade.context.settings.volume_cap = 3, 10
    arcade.open(OperatorPage(arcade.context))
    focus(arcade, "volume_cap")
    arcade.press(*[Button.LEFT] * 5)
    assert heard[-1] == (3, 5)
    assert saved().volume_cap == 5


def test_holding_fire_on_a_pad_ends_all_matches_and_stops_robots_first(arcade: Arcade) -> None:
    stopped: list[int] = []
    with VirtualPad() as pad:
        match = arcade.open(MatchScene(arcade.context, setup("level1 level1 off off")))
        arcade.until(lambda: match.match.state.tick > 10)
        arcade.context.emergency_stops.append(lambda: stopped.append(len(arcade.stack.scenes)))
        arcade.open(OperatorPage(arcade.context, tuple(arcade.stack.scenes)))
        focus(arcade, "end_all")
        pad.press("a")
        arcade.wait(OperatorPage.hold / 2)
        pad.release("a")
        arcade.wait(1.0)
        assert isinstance(arcade.stack.top, OperatorPage)
        pad.press("a")
        arcade.wait(OperatorPage.hold + 0.2)
        pad.release("a")
    assert stopped == [4]  # all scenes were still there
    assert arcade.stack.top is arcade.title
    assert match.sequel.noted


def test_a_match_below_stands_still_and_goes_on(arcade: Arcade) -> None:
    match = arcade.open(MatchScene(arcade.context, setup("level1 level1 off off")))
    arcade.until(lambda: match.match.state.tick > 10)
    tick = match.match.state.tick
    arcade.open(OperatorPage(arcade.context, tuple(arcade.stack.scenes)))
    arcade.wait(1.0)
    assert match.match.state.tick == tick
    arcade.context.idle = OperatorPage.idle + 1.0
    arcade.frame()
    assert arcade.stack.top is match
    arcade.context.idle = 0.0
    arcade.until(lambda: match.match.state.tick > tick)


def key(kind: int, code: int) -> pygame.Event:
    return pygame.Event(kind, key=code, scancode=0, mod=0)


@pytest.mark.parametrize(("kiosk", "hold"), [(False, HOLD), (True, HOLD_WITHOUT_PIN)])
def test_f10_opens_it_once_over_any_screen_when_held(arcade: Arcade, kiosk: bool, hold: float) -> None:
    arcade.context.kiosk = kiosk
    desk = OperatorDesk(arcade.context, None, True)
    desk.filter([key(pygame.KEYDOWN, pygame.K_F10)], arcade.stack.scenes)
    desk.update(hold - 0.1, arcade.stack)
    desk.filter([key(pygame.KEYUP, pygame.K_F10)], arcade.stack.scenes)
    desk.update(1.0, arcade.stack)
    assert arcade.stack.top is arcade.setup
    for _ in range(2):
        desk.filter([key(pygame.KEYDOWN, pygame.K_F10)], arcade.stack.scenes)
        desk.update(hold + 0.1, arcade.stack)
    assert [type(scene) for scene in arcade.stack.scenes[2:]] == [OperatorPage]


def test_the_desk_returns_a_group_to_the_title_only_if_there_is_one(arcade: Arcade) -> None:
    arcade.context.settings.group_minutes = 1
    for limited, left in ((False, 2), (True, 1)):
        desk = OperatorDesk(arcade.context, None, limited)
        for _ in range(120):
            desk.update(1.0, arcade.stack)
            desk.draw(arcade.screen)
        assert len(arcade.stack.scenes) == left


def test_title_music_stops_in_the_quiet_hours(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    turned: list[str | None] = []
    monkeypatch.setattr(arcade.sounds, "music", turned.append)
    settings = arcade.context.settings
    title = Title(arcade.context)
    title.on_enter()
    settings.quiet_from, settings.quiet_until = "00:00", "23:59"
    monkeypatch.setattr("pigaming_app.scenes.flow.scene.now", lambda: now().replace(hour=12))
    title.update(0.1)
    title.update(0.1)
    settings.quiet_until = "11:00"
    title.update(0.1)
    assert turned == ["title", None, "title"]


# ---- figures


def play(log: DayLog, hour: int, game: str) -> None:
    log.add(PlayedMatch(now().replace(hour=hour), game, 90.0, 2, 2))


def test_the_figures_are_exported(arcade: Arcade) -> None:
    for hour in (9, 9, 10):
        play(arcade.context.day_log, hour, "race")
    arcade.open(FiguresPage(arcade.context))
    page = arcade.shown(FiguresPage)
    assert page.report.busiest_hour == 9
    arcade.press(Button.FIRE)
    files = list((folders().data / FOLDER).iterdir())
    assert len(files[0].read_text().splitlines()) == 4
    arcade.shown(FiguresPage)
    arcade.press(Button.BACK)
    assert arcade.stack.top is arcade.setup


def test_an_export_that_fails_is_a_sentence(arcade: Arcade) -> None:
    folders().data.mkdir(parents=True)
    (folders().data / FOLDER).write_text("in the way")
    arcade.open(FiguresPage(arcade.context))
    arcade.press(Button.FIRE)
    assert arcade.shown(FiguresPage).message == arcade.context.words("app.unsaved")


def test_a_log_that_cannot_be_read_is_no_failure(arcade: Arcade) -> None:
    (folders().data / "days" / f"{now():%Y-%m-%d}.jsonl").mkdir(parents=True)
    arcade.open(FiguresPage(arcade.context))
    assert arcade.shown(FiguresPage).trouble


def test_other_days_are_a_click_away(arcade: Arcade) -> None:
    file = folders().data / "days" / "2026-01-05.jsonl"
    file.parent.mkdir(parents=True)
    file.write_text('{"kind":"program","what":"start","at":"2026-01-05T09:00:00"}\n')
    arcade.open(FiguresPage(arcade.context))
    page = arcade.shown(FiguresPage)
    arcade.click(*page.arrows[Button.LEFT])
    assert (page.report.starts, str(page.report.day)) == (1, "2026-01-05")
    arcade.press(Button.LEFT, Button.RIGHT)
    assert page.report.day == now().date()


@pytest.mark.parametrize("hours", [[], [0], [23], [11, 12], [0, 23], [7, 16]])
def test_bars_cover_all_matches_in_at_least_eight_hours(arcade: Arcade, hours: list[int]) -> None:
    for hour in hours:
        play(arcade.context.day_log, hour, "pitanks")
    bars = bars_of(FiguresPage(arcade.context).report, ["pitanks", "race"])
    shown = [hour for hour, _ in bars]
    assert len(bars) >= 8
    assert shown == list(range(shown[0], shown[-1] + 1))
    assert set(shown) <= set(range(24))
    assert sum(sum(counts) for _, counts in bars) == len(hours)


def test_a_chart_of_many_games_has_the_most_played_ones_and_a_removed_one_by_name(arcade: Arcade) -> None:
    log = arcade.context.day_log
    for game, count in {"gone_game": 3, "race": 2, "tag": 1}.items():
        for _ in range(count):
            play(log, 10, game)
    page = FiguresPage(arcade.context)
    assert games_of(page.report, ["race", "tag"]) == ("race", "tag", "gone_game")
    many = games_of(page.report, ["pitanks", "factory", "race", "football", "tennis", "golf", "tag"])
    assert many == ("pitanks", "factory", "race", "tag", "gone_game", OTHERS)
    assert dict(bars_of(page.report, many))[10] == (0, 0, 2, 1, 3, 0)
    arcade.open(page)
    arcade.wait(0.2, draw=True)
    assert _short(arcade.context.words, "gone_game") == "Gone Game"


@pytest.mark.parametrize(("most", "step"), [(1, 1), (5, 1), (6, 2), (11, 5), (26, 10), (1000, 200)])
def test_a_chart_has_at_most_five_lines(most: int, step: int) -> None:
    assert step_of(most) == step


# ---- after failed starts


def after_failed_starts(*names: str) -> None:
    folder = folders().config / safe_start.TRIED
    folder.mkdir(parents=True)
    (folder / safe_start.NOTE).write_text(json.dumps(names))


def test_it_names_what_was_taken_back_until_the_operator_agrees(arcade: Arcade) -> None:
    after_failed_starts("scoreboard", "display", "games.race.arena", "plugins", "camera_mm")
    arcade.open(OperatorPage(arcade.context))
    page = arcade.shown(OperatorPage)
    assert page.focus.name == SAFE_START
    assert page.line(SAFE_START).endswith("Second screen, Display, …")
    arcade.press(Button.FIRE)
    assert arcade.shown(OperatorPage).rows == (*ROWS, PIN)
    assert OperatorPage(arcade.context).rows == (*ROWS, PIN)


def test_in_safe_mode_it_keeps_the_defaults_if_the_operator_wants_them(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    arcade.context.settings.choose("scoreboard", 2)
    arcade.context.settings.choose("display", 1)
    arcade.context.settings.choose("music", 3)
    arcade.context.settings.save(folders().config)
    monkeypatch.setenv(VARIABLE, "1")
    settings = arcade.context.settings = saved()
    settings.use_defaults(DEFAULTS)
    settings.choose("sounds", 1)
    settings.save(folders().config)
    assert (settings.scoreboard, saved().scoreboard, saved().display, saved().sounds) == (0, 2, 1, 1)
    arcade.open(OperatorPage(arcade.context))
    assert arcade.shown(OperatorPage).line(SAFE_START) == arcade.context.words("operator.defaults_line")
    arcade.press(Button.FIRE)
    assert (saved().scoreboard, saved().display, saved().music) == (0, 0, 3)


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_it_tells_fits_the_panel(arcade: Arcade, monkeypatch: pytest.MonkeyPatch, language: str) -> None:
    longest = {"es": ("scoreboard", "fullscreen"), "pt": ("keep_choices", "group_minutes")}
    after_failed_starts(*longest.get(language, ("phones_network", "quiet_until")), "display")
    lines = [OperatorPage(arcade.context).line(SAFE_START), arcade.context.words("operator.keep_choices_line")]
    monkeypatch.setenv(VARIABLE, "1")
    lines.append(OperatorPage(arcade.context).line(SAFE_START))
    assert not [line for line in lines if "_" in line], "names of settings as on their pages"
    for line in lines:
        assert len(fit_lines(line, dials.PANEL.w - 80, 3)[1]) <= 3, line
