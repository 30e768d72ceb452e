"""Before a match: captions and the rule card, shown once, beside robots and countdown."""

import pygame
import pytest

from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.game import Setup
from pigaming_app.games.registry import games
from pigaming_app.games.setup import make_setup
from pigaming_app.scenes.play.countdown import clear_of
from pigaming_app.scenes.play.opening import ARENA, ROOM, SIGN, gap, in_lines, rule_card
from pigaming_app.scenes.play.runner import ARENA as CAPTIONS
from pigaming_app.scenes.play.runner import CAPTION_GAP, caption_boxes, robot_boxes
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.ui.draw import BODY, text_width
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from tests.cases import one_in
from tests.scenes.arcade import KEYS, Arcade, setup
from tests.scenes.measuring import measuring

CAPTION = 250, 68  # px, the usual size
RULE_SETS = [(game.name, variant) for game in games().values() for variant in game.variants]


def starts(chosen: Setup) -> list[tuple[float, float]]:
    """The robots at the start, on the canvas."""
    rules, state = games()[chosen.game], games()[chosen.game].state()
    rules.start(state, load(chosen.game, chosen.arena), chosen)
    return [(LEFT + robot.x, TOP + robot.y) for robot in state.robots]


@pytest.mark.parametrize(("game", "variant"), one_in(3, RULE_SETS))
def test_the_card_hides_no_robot_no_caption_and_no_number(controls: Controls, game: str, variant: str) -> None:
    pygame.font.init()
    for language in LANGUAGES:
        for arena in arenas(game):
            chosen = make_setup(game, ["idle"] * 4, arena, None, 1, variant, None, ["idle"])
            robots = starts(chosen)
            sign = clear_of(robots)
            occupied = [*robot_boxes(robots), *caption_boxes(robots, [CAPTION] * 4, [CAPTION_GAP] * 4)]
            card, centre = rule_card(Words(language), chosen, occupied, sign)
            box = pygame.Rect(0, 0, card.width, card.height)
            box.center = centre
            assert ARENA.contains(box)
            assert gap(box, sign) >= SIGN, arena
            assert box.collidelist(occupied) < 0, arena


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(("game", "variant"), RULE_SETS)
def test_the_sentence_fits_two_lines(controls: Controls, game: str, variant: str, language: str) -> None:
    lines = in_lines(Words(language)(f"rules.{game}_{variant}"), 2)
    assert 1 <= len(lines) <= 2
    assert all(text_width(line, BODY, "body") <= ROOM for line in lines)


def test_two_sentences_are_broken_between_them() -> None:
    pygame.font.init()
    assert in_lines("One. Two three.", 2) == ["One.", "Two three."]
    assert in_lines("A: 1. B: 2. Catch them all!", 2) == ["A: 1. B: 2.", "Catch them all!"]


def test_the_card_is_there_before_the_match_and_not_after_a_pause(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    line = in_lines(arcade.context.words("rules.pitanks_plain"), 2)[0]
    with measuring(monkeypatch) as screen:

        def shown() -> bool:
            screen.marks.clear()
            scene.draw(screen)
            return line in [mark.text for mark in screen.texts]

        scene = MatchScene(arcade.context, setup("human level1 off off"), KEYS[:1])
        monkeypatch.setattr(scene.runner, "prewarm", lambda milliseconds: True)
        monkeypatch.setattr(scene.runner, "draw", lambda canvas: canvas.fill("black"))
        arcade.open(scene)
        arcade.wait(0.5)
        assert shown()
        arcade.until(lambda: scene.match.state.tick > 5)
        assert not shown()
        arcade.press(Button.START, Button.BACK)
        assert scene.opening.countdown.locked
        assert not shown()


GRID = [(LEFT + x, TOP + y) for x, y in ((570, 55), (680, 55), (570, 150), (680, 150))]
CORNERS = [(LEFT + x, TOP + y) for x, y in ((40, 40), (1560, 40), (40, 860), (1560, 860))]


@pytest.mark.parametrize("robots", [GRID, CORNERS], ids=["grid", "corners"])
def test_no_caption_covers_another_caption_or_robot(robots: list[tuple[float, float]]) -> None:
    boxes, bodies = caption_boxes(robots, [CAPTION] * 4, [90.0] * 4), robot_boxes(robots)
    for i, box in enumerate(boxes):
        assert box.size == CAPTION
        assert CAPTIONS.contains(box)
        assert box.collidelist([*boxes[:i], *boxes[i + 1 :], *bodies]) < 0


def test_a_caption_with_room_is_above_or_below_its_robot_where_the_arena_has_more() -> None:
    robots = [(LEFT + 800.0, TOP + 100.0), (LEFT + 800.0, TOP + 800.0)]
    centres = [box.center for box in caption_boxes(robots, [CAPTION] * 2, [90.0] * 2)]
    assert centres == [(LEFT + 800, TOP + 190), (LEFT + 800, TOP + 710)]
