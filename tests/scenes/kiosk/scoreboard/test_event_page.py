"""The event on the second screen: who plays, who is next on which pad, everybody on a page, the podium at the end."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pygame
import pytest

from pigaming_app.events.match_setup import setup_of
from pigaming_app.events.spec import Format
from pigaming_app.scenes.app import App
from pigaming_app.scenes.events.arrange_page import ArrangePage
from pigaming_app.scenes.events.board.event_page import (
    CALL,
    FOOT,
    PODIUM,
    TURN,
    EventBoardPage,
    EventNow,
    event_now,
    next_line,
    now_line,
)
from pigaming_app.scenes.events.next_page import EventMatch, NextMatch
from pigaming_app.scenes.events.podium_page import EventPodiumPage
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.scenes.features.board_page import BoardPart
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.kiosk.operator.desk import OperatorDesk
from pigaming_app.scenes.kiosk.scoreboard.score_page import shown_match
from pigaming_app.scenes.kiosk.scoreboard.standby_page import StandbyPage
from pigaming_app.scenes.kiosk.scoreboard.window import SIZE, Board
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.snapshot import MatchSnapshot
from pigaming_app.scenes.walk import second_screen
from pigaming_app.ui.draw.surface_cache import surfaces
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button, Device
from tests.scenes.arcade import KEYS, Arcade, service_of
from tests.scenes.events.drawn import an_event, played, running

FIELDS = [
    (Format.KNOCKOUT, 3, 2, 1),
    (Format.KNOCKOUT, 8, 2, 5),
    (Format.KNOCKOUT, 16, 4, 2),
    (Format.KNOCKOUT, 64, 2, 70),
    (Format.ROUND_ROBIN, 5, 2, 3),
    (Format.SWISS, 12, 2, 7),
    (Format.SWISS, 64, 4, 20),
    (Format.GRAND_PRIX, 4, 4, 1),
    (Format.GROUPS, 23, 2, 9),
    (Format.CHALLENGE, 12, 2, 3),
]


class Clock:
    """A clock that stands."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def __call__(self) -> float:
        return self.seconds


def a_match(arcade: Arcade, run: RunningEvent, minutes: float = 1.0) -> MatchScene:
    """The scene of the next match of an event."""
    fixture = run.event.open[0]
    setup = replace(setup_of(run.event, fixture), minutes=minutes)
    return MatchScene(arcade.context, setup, KEYS[:2], after=EventMatch(run, fixture))


def every_page(page: EventBoardPage, clock: Clock, scenes: Sequence[Scene]) -> list[list[BoardPart]]:
    """The parts of every page, until the first one is shown again."""
    found: list[list[BoardPart]] = []
    while True:
        parts = page.parts(scenes)
        assert parts
        if found and [(part.box, part.content) for part in parts] == [(one.box, one.content) for one in found[0]]:
            return found
        found.append(list(parts))
        clock.seconds += TURN
        assert len(found) < 60


def of_match(arcade: Arcade, scene: MatchScene) -> MatchSnapshot:
    return shown_match(scene, arcade.context.words, True)


def the_event(arcade: Arcade, scenes: Sequence[Scene]) -> EventNow:
    now = event_now(arcade.context, scenes)
    assert now, f"nothing on the second screen during {type(scenes[-1]).__name__}"
    return now


def test_without_an_event_it_gives_way(arcade: Arcade) -> None:
    page = EventBoardPage(arcade.context)
    assert page.parts([arcade.title]) is None
    board = Board([StandbyPage(arcade.context), page])
    board.refresh("event", [arcade.title])
    assert board.page == "standby"


def test_every_page_of_an_event_belongs_to_it_and_so_do_its_matches(arcade: Arcade) -> None:
    run = running(played(an_event(count=4), 2))
    scene = arcade.open(a_match(arcade, run))
    arcade.until(lambda: scene.match.state.tick > 5)
    for scenes in (
        [NextMatch(arcade.context, run)],
        [NextMatch(arcade.context, run), TablePage(arcade.context, run)],
        [EventPodiumPage(arcade.context, run)],
        [scene],
        [scene, Pause(scene, KEYS[0])],
    ):
        now = the_event(arcade, [arcade.title, *scenes])
        assert now.running is run
        assert (now.playing is None) == (scene not in scenes)


def test_it_follows_a_match_through_its_end_to_the_next_one(arcade: Arcade) -> None:
    run = running(an_event(count=4, brains="level1"))
    scene = a_match(arcade, run, 0.02)
    first, second = run.event.open[:2]
    arcade.open(scene)
    now = the_event(arcade, arcade.stack.scenes)
    assert now.playing == first
    assert now.coming[0] == second
    seen = set()

    def recorded() -> bool:
        the_event(arcade, arcade.stack.scenes)
        seen.add(type(arcade.stack.top).__name__)
        return isinstance(arcade.stack.top, NextMatch)

    arcade.until(recorded, timeout=120.0)
    assert {"MatchScene", "WinnersMoment", "NextMatch"} <= seen
    now = the_event(arcade, arcade.stack.scenes)
    assert now.playing is None
    assert now.coming[0] == second


def test_who_plays_and_who_is_next_on_which_device(arcade: Arcade) -> None:
    run = running(an_event(count=4))
    words, scene = arcade.context.words, NextMatch(arcade.context, run)
    first, second = run.event.open[:2]
    now = the_event(arcade, [scene])
    one, other = first.entrants
    assert (now_line(words, now), next_line(words, now)) == ("", f"Next: {one} (WASD)  –  {other} (Arrows)")
    playing = the_event(arcade, [a_match(arcade, run)])
    assert now_line(words, playing) == f"Now: {one} – {other}"
    assert [called.name for called in playing.called] == [*second.entrants]


def test_a_seat_that_is_taken_shows_its_own_device(arcade: Arcade) -> None:
    run = running(an_event(count=4))
    scene = arcade.open(NextMatch(arcade.context, run))
    arcade.wait(1.0)
    arcade.press(Button.FIRE, device=KEYS[2])
    scene.seats.claims[1] = Device("phone", 0)
    now = the_event(arcade, arcade.stack.scenes)
    assert [(one.sign, one.device) for one in now.called] == [("keys", "IJKL"), ("phone", "Phone")]
    run.change(lambda event: event.substitute(event.open[0].entrants[0], "level3"))
    now = the_event(arcade, arcade.stack.scenes)
    assert (now.called[0].sign, now.called[0].brain) == ("ai", "★★★☆☆")


@pytest.mark.parametrize(("form", "count", "seats", "matches"), FIELDS)
def test_everybody_is_on_a_page_and_the_pages_turn_by_themselves(
    arcade: Arcade, form: Format, count: int, seats: int, matches: int
) -> None:
    run, clock = running(played(an_event(form, count, seats), matches)), Clock()
    page = EventBoardPage(arcade.context, clock)
    found = every_page(page, clock, [NextMatch(arcade.context, run)])
    shown = page._overview
    assert shown
    assert len(found) == 1 + len(shown.pages)
    text = repr([part.content for parts in found[1:] for part in parts])
    assert all(f"'{entrant.name}'" in text for entrant in run.event.entrants)
    assert all(f"Box(number={fixture.number}," in text for fixture in run.event.fixtures)
    calls = [part.content for part in found[0] if part.box[2] < 500]
    assert [call.name for call in calls] == [*run.event.open[0].entrants]  # type: ignore[attr-defined]


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("field", [1, 3, 5, 7])
@pytest.mark.long
def test_no_part_leaves_the_canvas_hides_another_or_is_cut_off(arcade: Arcade, field: int) -> None:
    form, count, seats, matches = FIELDS[field]
    run, clock = running(played(an_event(form, count, seats, title="A" * 30), matches)), Clock()
    for scenes in ([NextMatch(arcade.context, run)], [a_match(arcade, run)]):
        for parts in every_page(EventBoardPage(arcade.context, clock), clock, scenes):
            boxes = [pygame.Rect(part.box) for part in parts]
            assert all(pygame.Rect((0, 0), SIZE).contains(box) for box in boxes)
            assert all(box.collidelist(boxes[i + 1 :]) == -1 for i, box in enumerate(boxes))
            for part in parts:
                surface = pygame.Surface(part.box[2:])
                part.paint(surface)
                top = [surface.get_at((x, 0))[:3] for x in range(0, part.box[2], 4)]
                bottom = [surface.get_at((x, part.box[3] - 1))[:3] for x in range(0, part.box[2], 4)]
                assert max(max(color) for color in top + bottom) < 120, f"{part.content} is cut off"


def test_at_the_end_there_is_the_podium(arcade: Arcade) -> None:
    run, clock = running(played(an_event(Format.KNOCKOUT, 8))), Clock()
    page = EventBoardPage(arcade.context, clock)
    parts = page.parts([EventPodiumPage(arcade.context, run)])
    assert parts
    now = the_event(arcade, [EventPodiumPage(arcade.context, run)])
    assert page._overview
    kinds = [kind for kind, _ in page._pages(now, page._overview)]
    assert kinds[0] == PODIUM
    assert CALL not in kinds
    best = run.event.standings[0].entrant
    (podium,) = [part for part in parts if (1, best) in tuple(part.content or ())]  # type: ignore[arg-type]
    surface = pygame.Surface(podium.box[2:])
    podium.paint(surface)
    assert surface.get_bounding_rect().h > 500
    foot = next(part for part in parts if part.box == FOOT)
    assert foot.content == (False,)


def test_a_result_repaints_only_what_it_changes(arcade: Arcade) -> None:
    run, clock = running(played(an_event(Format.KNOCKOUT, 64), 40)), Clock()
    page, scene = EventBoardPage(arcade.context, clock), NextMatch(arcade.context, run)
    page.parts([scene])
    clock.seconds += TURN
    before = page.parts([scene])
    assert before
    run.change(lambda event: played(event, 1))
    page.parts([scene])
    clock.seconds += TURN
    after = page.parts([scene])
    assert after
    contents = {part.box: part.content for part in before}
    assert {part.box for part in after} == contents.keys()
    unchanged = [part for part in after if contents[part.box] == part.content]
    assert 0 < len(unchanged) < len(after)


def test_boxes_rows_and_cards_evict_no_sprite_of_a_match(arcade: Arcade) -> None:
    run, clock = running(played(an_event(Format.SWISS, 24, title="never painted"), 5)), Clock()
    pages = every_page(EventBoardPage(arcade.context, clock), clock, [a_match(arcade, run)])
    for part in pages[0]:
        part.paint(pygame.Surface(part.box[2:]))  # robots: a match has them too
    before = surfaces.bytes
    for parts in pages[1:]:
        for part in parts:
            part.paint(pygame.Surface(part.box[2:]))
    assert surfaces.bytes - before < 2 << 20


def test_scores_of_an_event_show_names_devices_and_the_round(arcade: Arcade) -> None:
    run = running(played(an_event(Format.SWISS, 4), 2))
    fixture = run.event.open[0]
    shown = of_match(arcade, a_match(arcade, run))
    assert shown.round == "Round 2  ·  Match 3 of 4"
    assert {side.name for side in shown.sides} == {*fixture.entrants}
    assert [side.signs for side in shown.sides] == [("keys",), ("keys",)]
    assert all(side.driver for side in shown.sides)


def test_teams_of_an_event_show_the_names_of_both(arcade: Arcade) -> None:
    run = running(played(an_event(Format.GRAND_PRIX, 4, 4), 1))
    shown = of_match(arcade, a_match(arcade, run))
    assert shown.game == "factory"
    entrants = run.event.open[0].entrants
    assert [side.name.split() for side in shown.sides] == [[entrants[i] for i in side.seats] for side in shown.sides]


def test_standby_shows_who_is_next_while_an_event_runs(arcade: Arcade) -> None:
    run, page = running(an_event(count=4)), StandbyPage(arcade.context)
    without, during = page.parts([arcade.title]), page.parts([NextMatch(arcade.context, run)])
    assert len(during) == len(without) + 1
    assert any(run.event.open[0].entrants[0] in repr(part.content) for part in during)
    boxes = [pygame.Rect(part.box) for part in during]
    assert all(box.collidelist(boxes[i + 1 :]) == -1 for i, box in enumerate(boxes))


@pytest.mark.long
@pytest.mark.again
def test_its_cost_is_measured_over_all_of_its_pages(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[tuple[str, bool]] = []
    whole = second_screen.frame

    def frame(app: App, shown: bool) -> float:
        spent = whole(app, shown)
        window = service_of(app, OperatorDesk).window
        assert window
        assert window.window
        seen.append((window.board.page, shown))
        return spent

    monkeypatch.setattr(second_screen, "frame", frame)
    for name, value in (("FPS", 10), ("WARM", 60), ("BLOCK", 40), ("BLOCKS", 6)):  # FPS: a slow machine paints in time
        monkeypatch.setattr(second_screen, name, value)
    ratios = second_screen.compare()
    assert ratios.keys() == {"median", "p99"}
    assert min(ratios.values()) > 0.0
    assert {page for page, shown in seen[60:] if shown} == {*second_screen.PAGES}
    assert [shown for _, shown in seen[60:]] == ([True] * 40 + [False] * 40) * 3


def test_between_two_tries_the_second_screen_shows_the_table(arcade: Arcade) -> None:
    run, clock = running(played(an_event(Format.TIME_TRIAL, 5, 1), 5)), Clock()
    assert not run.event.open
    found = every_page(EventBoardPage(arcade.context, clock), clock, [ArrangePage(arcade.context, run)])
    text = str(found)
    assert all(entrant.name in text for entrant in run.event.entrants)
    assert "Tries: 5" in text
