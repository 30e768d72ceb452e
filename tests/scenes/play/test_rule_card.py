"""The rule card before a match: shown once, beside robots, captions and countdown."""

import pygame
import pytest

from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.game import Setup
from pigaming_app.games.registry import games
from pigaming_app.games.setup import make_setup
from pigaming_app.scenes.play.countdown import clear_of
from pigaming_app.scenes.play.rule_card import ARENA, CAPTION, ROOM, SIGN, free_place, in_two, rule_card
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.ui.draw import BODY, text_width
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from tests.cases import one_in
from tests.scenes.arcade import KEYS, Arcade, setup
from tests.scenes.measuring import measuring

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
            card, robots = rule_card(Words(language), chosen), starts(chosen)
            number = SIGN.copy()
            number.center = clear_of(robots)
            box = pygame.Rect(0, 0, card.width, card.height)
            box.center = free_place((card.width, card.height), robots, number.center)
            assert ARENA.contains(box)
            assert not box.colliderect(number), arena
            for x, y in robots:
                assert not box.colliderect(pygame.Rect(0, 0, CAPTION, 130).move(round(x) - CAPTION // 2, round(y) - 65))


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(("game", "variant"), RULE_SETS)
def test_the_sentence_fits_two_lines(controls: Controls, game: str, variant: str, language: str) -> None:
    lines = in_two(Words(language)(f"rules.{game}_{variant}"))
    assert 1 <= len(lines) <= 2
    assert all(text_width(line, BODY, "body") <= ROOM for line in lines)


def test_two_sentences_are_broken_between_them() -> None:
    pygame.font.init()
    assert in_two("One. Two three.") == ["One.", "Two three."]
    assert in_two("A: 1. B: 2. Catch them all!") == ["A: 1. B: 2.", "Catch them all!"]


def test_the_card_is_there_before_the_match_and_not_after_a_pause(
    controls: Controls, monkeypatch: pytest.MonkeyPatch
) -> None:
    arcade = Arcade(controls)
    line = in_two(arcade.context.words("rules.pitanks_plain"))[0]
    with measuring(monkeypatch) as screen:

        def shown() -> bool:
            screen.marks.clear()
            scene.draw(screen)
            return line in [mark.text for mark in screen.texts]

        scene = MatchScene(arcade.context, setup("human easy off off"), KEYS[:1])
        monkeypatch.setattr(scene.runner, "prewarm", lambda milliseconds: True)
        monkeypatch.setattr(scene.runner, "draw", lambda canvas: canvas.fill("black"))
        arcade.open(scene)
        arcade.wait(0.5)
        assert shown()
        arcade.until(lambda: scene.match.state.tick > 5)
        assert not shown()
        arcade.press(Button.START)
        arcade.press(Button.BACK)
        assert scene.countdown.locked
        assert not shown()
