"""How to play: the pages of every game, short captions, and lessons that show what their captions promise."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pygame
import pytest

from pigaming_app.games.factory.state import BY_WORKER, DONE, HALF, MACHINE_SLOTS
from pigaming_app.games.registry import games
from pigaming_app.scenes.howto import scene as howto
from pigaming_app.scenes.howto.clip import Cutout, LessonClip, lesson_match
from pigaming_app.scenes.howto.feature import show
from pigaming_app.scenes.howto.keys import draw_keys
from pigaming_app.scenes.howto.scene import HowTo, taught
from pigaming_app.scenes.views.game_screens import LESSONS_PER_PAGE
from pigaming_app.scenes.views.lesson import Actor, Lesson
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.world import HZ, Action
from pigaming_app.storage.settings import Choice
from pigaming_app.ui.draw import BODY, FOCUS, TITLE, button_width, text_width
from pigaming_app.ui.draw.layers import LEFT, span, wrap
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent
from tests.scenes.arcade import KEYS, Arcade


def test_left_and_right_turn_all_pages_of_all_games(arcade: Arcade) -> None:
    scene = HowTo(arcade.context)
    seen = []
    for _ in range(sum(SCREENS[game].page_count for game in taught()) + 1):
        seen.append((scene.game, scene.page, tuple(name for name, _ in scene.lessons())))
        scene.handle(InputEvent(Button.RIGHT, KEYS[0]))
    assert seen[0] == seen[-1]
    shown = [name for _, _, names in seen[:-1] for name in names]
    assert shown == [name for game in taught() for name in SCREENS[game].lessons]
    scene.handle(InputEvent(Button.LEFT, KEYS[0]))
    assert (scene.game, scene.page) == seen[0][:2]


def test_a_game_without_lessons_has_no_page(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(SCREENS, "football", replace(SCREENS["football"], lessons={}))
    scene = HowTo(arcade.context, "football")
    assert scene.game == "pitanks"
    scene.draw(arcade.screen)
    scene.handle(InputEvent(Button.LEFT, KEYS[0]))
    assert scene.game == "race"
    assert show(arcade.context, "football") is None
    assert show(arcade.context, "race")


@pytest.mark.parametrize("wide", [0, 420])
def test_as_many_names_of_games_are_shown_as_have_room(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, wide: int
) -> None:
    """`wide`: px of a name; 0: as it is."""
    if wide:
        monkeypatch.setattr(howto, "chip_width", lambda word: wide)
    for game in taught():
        names = HowTo(arcade.context, game)._names()
        shown = [name for name, _ in names]
        assert game in shown
        assert ", ".join(shown) in ", ".join(taught()), "neighbours"
        assert (shown == taught()) is not bool(wide)
        arrows = names[0][1].left - howto.GAP - button_width("<>")
        assert arrows - howto.GAP >= LEFT + text_width(arcade.context.words("title.howto"), TITLE)


def test_a_page_names_the_minutes_of_its_rule_set(arcade: Arcade) -> None:
    scene = HowTo(arcade.context, "factory")
    minutes = []
    for page in range(SCREENS["factory"].page_count):
        scene.page = page
        minutes.append(scene.minutes())
    assert minutes == [variant.default_minutes for variant in games()["factory"].variants.values()]
    arcade.context.settings.games["factory"] = Choice("hall", 2, "party")
    assert scene.minutes() == minutes[2]
    scene.page = 1
    assert scene.minutes() == 2


LESSONS = [(game, name) for game in taught() for name in SCREENS[game].lessons]
ROOM = pygame.Rect(0, 0, 406, 384)


def scores(*points: int) -> Callable[[Any], bool]:
    """True once the first robots have these points."""
    return lambda state: [robot.score for robot in state.robots[: len(points)]] == [*points]


PROMISES: dict[str, Callable[[Any], object]] = {
    "drive": lambda state: state.robots[0].y > 500.0,
    "shoot": scores(1, -1),
    "walls": lambda state: any(wall.initial_health == 5 and not wall.health for wall in state.walls),
    "pickups": lambda state: sum(left > 0 for left in state.tanks[0].powers) == 3 and state.bullets[0].alive,
    "knockout": lambda state: scores(1, 0)(state) and state.tanks[1].knocked_out,
    "light": lambda state: state.tanks[0].lit,
    "bounty": lambda state: state.robots[0].score == 2,
    "finale": lambda state: state.robots[0].score == 2,
    "lift": lambda state: state.loads[0].pallet,
    "work": lambda state: state.slots[MACHINE_SLOTS + 5].pallet and state.pallets[0].state == DONE,
    "deliver": lambda state: state.delivered[0] == 1 and state.robots[0].score == 1,
    "people": lambda state: state.loads[0].frozen,
    "rush": lambda state: state.points[0] == 2,
    "loose": lambda state: state.loads[0].pallet and state.pallets[state.loads[0].pallet - 1].loose,
    "claim": lambda state: state.loads[0].stolen,
    "fast": lambda state: state.machines[0].fast and state.pallets[0].state == HALF,
    "allies": lambda state: all(load.pallet for load in state.loads),
    "stars": lambda state: state.tick > state.rules.three_stars,
    "tasks": lambda state: state.loads[1].aim,
    "clear": lambda state: state.pallets[0].place == BY_WORKER,
    "laps": lambda state: state.robots[0].score == 1,
    "lines": lambda state: state.racers[0].passed == 4,
    "finish": lambda state: state.robots[0].score == 1,
    "mud": lambda state: not state.racers[0].place.on and state.robots[1].x < state.robots[0].x - 100.0,
    "draft": lambda state: state.racers[0].slip and state.robots[0].turbo > 0.8,
    "pads": lambda state: state.racers[0].surge,
    "items": lambda state: state.racers[1].spin,
    "recover": lambda state: state.actions[0].fire and state.robots[0].y < 220.0,
    "football_push": scores(1, 0),
    "football_shoot": lambda state: state.players[0].shots and state.robots[0].score == 1,
    "football_pass": lambda state: state.players[0].assists and state.players[2].goals,
    "football_golden": scores(2, 0),
}


def variant_of(game: str, name: str) -> str:
    """The rule set of the page of a lesson."""
    names = SCREENS[game].lesson_pages
    return names[list(SCREENS[game].lessons).index(name) // LESSONS_PER_PAGE] if names else "standard"


@pytest.mark.parametrize(("game", "name"), LESSONS)
def test_a_lesson_shows_what_its_caption_promises(game: str, name: str) -> None:
    lesson = SCREENS[game].lessons[name]
    match = lesson_match(game, lesson, variant_of(game, name))
    assert not PROMISES[name](match.state), "from the beginning"
    for _ in range(round(lesson.seconds * HZ)):
        match.tick()
        if PROMISES[name](match.state):
            return
    pytest.fail(f"not within {lesson.seconds} s")


@pytest.mark.parametrize("does", ["drive 3 4", "go 3", "wait 1 2", "go 3 4 fire", "jump go 1 2", "go 1 2; wait 1"])
def test_a_wrong_step_is_refused(does: str) -> None:
    with pytest.raises(ValueError, match="no step of a lesson"):
        Lesson((Actor(100, 100, 0, does),))


def test_a_clip_shows_its_box_only_and_begins_anew(controls: Controls) -> None:
    canvas, screen = Cutout((1920, 1080)), pygame.Surface(ROOM.size)
    lesson = SCREENS["football"].lessons["football_push"]
    clip = LessonClip(Arcade(controls).context, "football", "football_push", lesson, "standard", canvas)
    clip.update(1.0)
    assert clip.runner.match.state.tick == 0, "not before its first picture"
    looks, ticks, points = set(), [], []
    for step in range(round(lesson.seconds * HZ) + 25):
        if step % 10 == 0:
            clip.draw(screen, ROOM)
            looks.add(pygame.image.tobytes(screen, "RGB"))
        clip.update(0.02)
        ticks.append(clip.runner.match.state.tick)
        points.append(clip.runner.match.state.robots[0].score)
    assert len(looks) > 8
    assert canvas.get_at((300, 600)) == pygame.Color("black"), "outside of the box"
    assert max(ticks) > ticks[-1], "begun anew"
    assert (max(points), points[-1]) == (1, 0)


@pytest.mark.parametrize("device", [Device("keys", 0), Device("keys", 1), Device("pad", 0)])
def test_keys_are_lit_while_they_are_pressed(arcade: Arcade, controls: Controls, device: Device) -> None:
    controls.last = device
    scene = HowTo(arcade.context, "pitanks")
    box = pygame.Rect(96 + 3 * 146 + 4, 610, 406, 100)  # of the keys of the second lesson: shoot

    def lit() -> int:
        scene.draw(arcade.screen)
        return pygame.mask.from_threshold(arcade.screen.subsurface(box), FOCUS, (40, 40, 40)).count()

    before = lit()
    while not scene.clips[1].action.fire:
        scene.update(0.02)
    assert lit() > before + 200


@pytest.mark.parametrize("device", [Device("keys", 0), Device("keys", 1), Device("pad", 0)])
def test_keys_of_every_lesson_stay_in_its_frame(controls: Controls, device: Device) -> None:
    """In all languages: what is drawn, as on the page, is narrower than the frame."""
    controls.last, room = device, pygame.Rect(100, 200, span(0, 3)[1] - 24, 0)
    scripts = {one.actors[0].does for game in taught() for one in SCREENS[game].lessons.values()}
    for language in LANGUAGES:
        context = Arcade(controls, language).context
        for script in scripts:
            screen = pygame.Surface((1920, 400))
            draw_keys(screen, context, script, Action(), room)
            drawn = pygame.mask.from_threshold(screen, (255, 255, 255), (200, 200, 200)).get_bounding_rects()
            for rect in drawn:
                assert room.left - 4 <= rect.left < rect.right <= room.right + 4, (language, script)


CAPTION = span(0, 3)[1] - 48  # px for a caption


@pytest.mark.parametrize("game", taught())
def test_every_page_is_full_and_named_by_a_rule_set(game: str) -> None:
    names = SCREENS[game].lesson_pages
    assert len(SCREENS[game].lessons) == LESSONS_PER_PAGE * max(1, len(names))
    assert {*names} <= {*games()[game].variants}


@pytest.mark.parametrize("language", LANGUAGES)
def test_captions_have_at_most_two_lines(language: str) -> None:
    words = Words(language)
    for game in taught():
        for name in SCREENS[game].lessons:
            assert len(wrap(words(f"howto.{name}"), BODY, CAPTION)) <= 2, name
