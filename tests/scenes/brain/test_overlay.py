"""The brain overlay (F4): it cycles through the AIs, describes their actions, covers no robot and changes nothing."""

from itertools import pairwise

import pygame
import pytest

from pigaming_app.ai.brain.kind import BrainPlayer
from pigaming_app.ai.brain.thoughts import Thoughts
from pigaming_app.ai.explanations.percepts import SUBJECTS
from pigaming_app.ai.explanations.registry import thoughts_of
from pigaming_app.ai.networks.files import brain_of
from pigaming_app.ai.registry import make_brain, new_match
from pigaming_app.games.match import Match
from pigaming_app.games.setup import make_setup
from pigaming_app.scenes.attract.scene import Attract, DemoMatch
from pigaming_app.scenes.brain import floor_marks as marks
from pigaming_app.scenes.brain import panels as cards
from pigaming_app.scenes.brain.overlay import BrainOverlay
from pigaming_app.scenes.flow.scene import Home
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.record import digest
from pigaming_app.ui.draw import BODY, ICONS, LABEL, text_width
from pigaming_app.ui.draw.layers import fit_size
from pigaming_app.ui.i18n import LANGUAGES, texts
from pigaming_app.ui.input.events import Button, InputEvent
from tests.ai.networks.random_network import random_network
from tests.scenes.arcade import KEYS, Arcade, setup
from tests.ui.input.virtual_pad import NINTENDO, PLAYSTATION

SEATS = {"pitanks": ["level5", "level1", "random", "idle"], "race": ["level5", "level1", "random", "idle"]}
SEATS["factory"] = ["level5", "level3", "level1", "random"]
SEATS["football"] = ["level5", "net", "level1", "random"]
READABLE = 0.85  # minimum horizontal scale of readable text


def stage_of(arcade: Arcade, game: str, seed: int = 1) -> MatchRunner:
    brains = SEATS[game]
    wish = make_setup(game, brains, None, 1.0, seed, None, None, brains)
    return MatchRunner(arcade.context, new_match(wish), loud=False)


def overlay_of(runner: MatchRunner) -> BrainOverlay:
    assert isinstance(runner.brain, BrainOverlay)
    return runner.brain


def test_f4_cycles_through_the_ais_and_then_hides_the_overlay(arcade: Arcade) -> None:
    match = arcade.open(MatchScene(arcade.context, setup("human level1 off level5", 1.0), KEYS[:1]))
    shown = []
    for _ in range(4):
        arcade.key("F4")
        shown.append(overlay_of(match.runner).seat)
    assert shown == [1, 3, None, 1]
    assert arcade.stack.top is match, "no pause, and the match went on to its countdown"
    assert arcade.context.controls.last == KEYS[0], "a look at an AI says nothing about what one plays with"


def test_without_ais_a_notice_is_shown(arcade: Arcade) -> None:
    match = arcade.open(MatchScene(arcade.context, setup("human human off off", 1.0), KEYS[:2]))
    arcade.key("F4")
    assert overlay_of(match.runner).seat is None
    assert match.runner.notice.box


def test_alt_and_f4_is_for_the_window_manager(arcade: Arcade) -> None:
    event = pygame.Event(pygame.KEYDOWN, key=pygame.K_F4, scancode=pygame.KSCAN_F4, mod=pygame.KMOD_LALT, unicode="")
    assert arcade.context.controls.presses([event]) == []


def test_the_overlay_closes_when_a_person_takes_the_seat(arcade: Arcade) -> None:
    match = arcade.open(MatchScene(arcade.context, setup("human level1 off off", 1.0), [None]))
    arcade.key("F4")
    assert overlay_of(match.runner).seat == 0, "an AI drives for somebody"
    match.drivers.assign(0, KEYS[0])
    arcade.frame(draw=True)
    assert overlay_of(match.runner).seat is None
    arcade.key("F4")
    assert overlay_of(match.runner).seat == 1


def test_in_a_pause_it_leads_back_into_the_match(arcade: Arcade) -> None:
    match = arcade.open(MatchScene(arcade.context, setup("human level1 off off", 1.0), KEYS[:1]))
    arcade.wait(4.5)
    arcade.press(Button.START)
    page = arcade.shown(Pause)
    assert any("F4" in label for label, _ in page.prompts.labels)
    arcade.key("F4")
    assert arcade.shown(MatchScene) is match
    assert overlay_of(match.runner).seat == 1


@pytest.mark.parametrize(
    ("kind", "usb", "label"),
    [
        ("Xbox", (0x045E, 0x028E), "Y"),
        ("PlayStation", PLAYSTATION, "Triangle"),
        ("Nintendo", NINTENDO, "Y"),
        ("Joystick", (1, 1), "4"),
    ],
)
def test_a_pause_names_the_pads_own_button_for_it(arcade: Arcade, kind: str, usb: tuple[int, int], label: str) -> None:
    plain = kind == "Joystick"
    pad, device = arcade.plug(f"{kind} pad", usb, plain=plain)
    match = MatchScene(arcade.context, setup("human level1 off off", 1.0), [device])
    arcade.open(match)
    arcade.wait(4.5)
    pad.tap("start" if not plain else 9)
    arcade.wait(0.2)
    page = arcade.shown(Pause)
    assert (label, "AI thoughts") in page.prompts.labels
    pad.tap("y" if not plain else 3)
    arcade.wait(0.2)
    assert arcade.shown(MatchScene) is match
    assert overlay_of(match.runner).seat == 1


def test_f4_does_not_end_attract_mode(arcade: Arcade) -> None:
    show = Attract(arcade.context)
    assert isinstance(show.show, DemoMatch)
    arcade.open(show)
    for seat in (0, 1):
        arcade.key("F4")
        assert overlay_of(show.show.runner).seat == seat
        assert arcade.stack.top is show
    show._next()
    assert isinstance(show.handle(InputEvent(Button.BRAIN, KEYS[0])), Home), "over a page it counts like any other key"


@pytest.mark.parametrize("game", SEATS)
def test_every_brain_is_drawn_and_the_match_plays_out_alike(arcade: Arcade, game: str) -> None:
    watched, alone = stage_of(arcade, game), stage_of(arcade, game)
    for frame in range(210):
        if frame % 40 == 0:
            overlay_of(watched).next()
        watched.advance(1 / 60)
        alone.advance(1 / 60)
        if frame % 7 == 0:
            watched.draw(arcade.screen)
    assert watched.match.state.tick > 150
    assert digest(watched.match.state) == digest(alone.match.state)


@pytest.mark.parametrize("game", SEATS)
def test_the_overlay_is_visible_and_disappears_again(arcade: Arcade, game: str) -> None:
    """Light round the robot, texts in place of the panels, an unchanged clock; all of it disappears again."""
    stage = stage_of(arcade, game)
    for _ in range(120):
        stage.advance(1 / 60)
    stage.draw(arcade.screen)
    robot, clock = stage.match.state.robots[0], stage.view.clock
    around = pygame.Rect(0, 0, 210, 210)
    around.center = 160 + round(robot.x), 140 + round(robot.y)
    places = around.clip(arcade.screen.get_rect()), pygame.Rect(160, 0, 600, 130), clock.inflate(-60, -20)
    before = [pygame.image.tobytes(arcade.screen.subsurface(place), "RGB") for place in places]
    overlay_of(stage).next()
    stage.view.undrawn = 0.0
    stage.draw(arcade.screen)
    now = [pygame.image.tobytes(arcade.screen.subsurface(place), "RGB") for place in places]
    assert [old != new for old, new in zip(before, now, strict=True)] == [True, True, False]
    for _ in range(4):
        overlay_of(stage).next()
    stage.draw(arcade.screen)
    assert [pygame.image.tobytes(arcade.screen.subsurface(place), "RGB") for place in places[1:]] == before[1:]


def test_no_light_of_it_lies_on_a_robot(arcade: Arcade) -> None:
    """Neither on its own robot nor on others in the rose and across the lines of sight."""
    stage = stage_of(arcade, "pitanks")
    state, overlay = stage.match.state, overlay_of(stage)
    for _ in range(30):
        stage.advance(1 / 60)
    for robot, (x, y) in zip(state.robots, ((800, 450), (880, 450), (800, 540), (1100, 450)), strict=True):
        robot.x, robot.y = float(x), float(y)
    stage.view.record_poses(state)
    stage.view.record_poses(state)
    overlay.next()
    screen = pygame.Surface((1920, 1080))
    for _ in range(30):
        screen.fill((0, 0, 0))
        overlay.draw(screen, 1.0, 1 / 60)
    for robot in state.robots:
        box = pygame.Rect(0, 0, 50, 50)
        box.center = 160 + round(robot.x), 140 + round(robot.y)
        brightest = max(screen.get_at((x, y)).r for x in range(box.left, box.right) for y in range(box.top, box.bottom))
        assert brightest <= 24, "a glow at most"
    assert screen.get_bounding_rect().w > 100


def test_the_petals_of_a_rose_turn_with_the_robot() -> None:
    """A rose with the wish to go ahead is lit in front of the robot."""
    pygame.display.init()
    pygame.display.set_mode((1920, 1080))
    ahead = [1.0] + [0.0] * 15
    for heading, (dx, dy) in ((0.0, (1, 0)), (1.5708, (0, 1)), (3.1416, (-1, 0))):
        drawn = marks.FloorMarks((960.0, 540.0, heading), [], (60, 160, 255), 0.0)
        drawn.rose(ahead, [])
        screen = pygame.Surface((1920, 1080))
        screen.fblits(drawn.light, pygame.BLEND_RGB_ADD)
        at = 82
        lit = screen.get_at((960 + at * dx, 540 + at * dy))
        dark = screen.get_at((960 - at * dx, 540 - at * dy))
        assert lit.b > 100 > dark.b + 40


def test_bars_follow_wishes_and_do_not_jump(arcade: Arcade) -> None:
    stage = stage_of(arcade, "pitanks")
    for _ in range(60):
        stage.advance(1 / 60)
    overlay = overlay_of(stage)
    overlay.next()
    seen = []
    for _ in range(90):
        overlay.draw(arcade.screen, 1.0, 1 / 60)
        seen.append(max(overlay.wishes.values()))
    steps = [b - a for a, b in pairwise(seen)]
    assert max(steps) < 0.2
    assert overlay.wishes == pytest.approx(dict(overlay.thoughts.utilities), abs=0.01)


def test_brains_are_queried_a_few_times_a_second_and_never_within_a_tick(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    stage = stage_of(arcade, "pitanks")
    asked = []

    def asking(match: Match, seat: int) -> Thoughts | None:
        asked.append(match.state.tick)
        return thoughts_of(match, seat)

    monkeypatch.setattr("pigaming_app.scenes.brain.overlay.thoughts_of", asking)
    overlay_of(stage).next()
    for _ in range(120):
        stage.advance(1 / 60)
        stage.draw(arcade.screen)
    assert 18 <= len(asked) <= 22


def test_seats_without_an_explaining_brain_are_skipped(arcade: Arcade) -> None:
    stage = stage_of(arcade, "pitanks")
    stage.match.sit(0, make_brain("pitanks", "idle", 1))
    kind = stage.match.brains[0].kind  # type: ignore[attr-defined]
    object.__setattr__(stage.match.brains[0], "kind", type(kind)("mute", kind.mind, lambda *_: None, kind.reset))
    overlay = BrainOverlay(stage.match, stage.view, arcade.context.words)
    assert overlay.seats == [1, 2, 3]


@pytest.mark.usefixtures("_glow")
def test_a_network_shows_what_matters_to_it_and_the_probabilities_of_its_choices(arcade: Arcade) -> None:
    stage = stage_of(arcade, "pitanks")
    stage.match.sit(0, BrainPlayer(brain_of(random_network()), 1))
    overlay = overlay_of(stage)
    overlay.next()
    for _ in range(60):
        stage.advance(1 / 60)
        stage.draw(arcade.screen)
    assert overlay.thoughts.heads.keys() == overlay.heads.keys() == {"drive", "turn", "shoot", "turbo"}
    box = arcade.screen.subsurface((1108, 24, 652, 106)).copy()
    aside = round(cards.heads_width(overlay.heads))
    for part in (pygame.Rect(0, 0, 652 - aside, 106), pygame.Rect(652 - aside, 0, aside, 106)):
        assert max(box.get_at((x, 30)).b for x in range(part.left + 8, part.right - 8)) > 100
    assert all(has_sign("pitanks", name) for name in overlay.heads)
    assert all(has_sign(game, topic) for game, subject in SUBJECTS.items() for topic in subject.topics)


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_text_fits_its_box(language: str) -> None:
    pygame.font.init()
    small = {}
    for key, text in texts(language).items():
        if key.startswith("brain.") and key not in ("brain.nobody", "brain.sure"):
            said = text.format(player=4, count=12345, machine="A")
            size, face = (BODY, "body") if "because" in key else (LABEL, "head")
            room = 652 - cards.TEXT - 20
            if fit_size(said, size, room, face) < READABLE * size:
                small[key] = text_width(said, size, face)
    assert small == {}


@pytest.mark.usefixtures("_glow")
def test_every_wish_of_every_brain_has_a_sign(arcade: Arcade) -> None:
    for game in SEATS:
        stage = stage_of(arcade, game)
        for _ in range(60):
            stage.advance(1 / 60)
        for seat in range(4):
            told = thoughts_of(stage.match, seat)
            assert told
            assert all(has_sign(game, name) for name in told.utilities if not told.moves)


def has_sign(game: str, name: str) -> bool:
    """True for a wish or topic that a game's overlay shows by more than the circle of what is unknown."""
    name = SCREENS[game].signs.get(name, name)
    known = {*cards.SIGNS, *cards.CRATES, *cards.PAIRS, *ICONS, "walls"}
    return name in known and cards.sign(name, (255, 255, 255)).image.get_width() > 20
