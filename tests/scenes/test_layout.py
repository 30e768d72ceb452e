"""Layout: no text overlaps another, crosses a frame or leaves the picture, with the longest values, in any size."""

from collections.abc import Callable, Iterator
from typing import Any

import pygame
import pytest

from pigaming_app.games.arenas import shipped_arenas
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.match_words import limits_line
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.howto.scene import HowTo
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.ui.draw import BODY, read_large, readable
from pigaming_app.ui.draw.glow import GlowCanvas
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.button_prompts import type_size
from tests.cases import one_in
from tests.matches import setup_of
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.measuring import Mark, empty_cache, faults, forget, leave_black, measuring
from tests.scenes.screens import SCREENS, seats

# Capitals of 25 px, type of 36 px: legible at three metres.
LARGE = ("event", "widest event", "next match", "widest next", "entrants", "correction", "sudden death")
# Drawn with larger text, too.
READ_LARGE = (
    *("options", "operator", "lobby", "robots menu", "ladder", "how to play", "setup"),
    *("calibration of", "calibration t"),
)
# Each row of these is checked.
LISTS = ("options", "operator", "robots menu", "setup", "added games", "arena and radio")


RULES = [(game, variant) for game in games() for variant in games()[game].variants]


@pytest.fixture
def _large() -> Iterator[None]:
    with empty_cache():
        read_large(True)
        yield
        read_large(False)


def drawn_in_all_states(arcade: Arcade, monkeypatch: pytest.MonkeyPatch, name: str) -> Iterator[list[Mark]]:
    """The texts of a screen, without a fault, with each of its rows in focus."""
    with measuring(monkeypatch) as screen:
        scene = SCREENS[name](arcade)
        for _ in range(12 if name.startswith(LISTS) else 1):
            scene.update(0.4)
            screen.marks.clear()
            scene.draw(screen)
            assert len(screen.texts) >= 3, "it is measured"
            assert relevant(name, faults(screen)) == []
            yield screen.texts
            scene.handle(InputEvent(Button.DOWN, KEYS[0]))


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", SCREENS)
def test_texts_keep_off_each_other_and_off_frames(arcade: Arcade, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    for texts in drawn_in_all_states(arcade, monkeypatch, name):
        if name.startswith(LARGE) and name != "correction in own words":
            assert [mark.text for mark in texts if mark.text[1:] and mark.box[3] - mark.box[1] < 25] == []


@pytest.mark.usefixtures("_large")
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", one_in(2, [name for name in SCREENS if name.startswith(READ_LARGE)]))
def test_larger_texts_keep_off_each_other(arcade: Arcade, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    assert list(drawn_in_all_states(arcade, monkeypatch, name))


def relevant(name: str, found: list[str]) -> list[str]:
    """Without the lesson numbers, which lie in discs on the frames."""
    numbers = {f"'{number}' crosses its frame" for number in range(1, 5)} if name.startswith("how to") else set()
    return [fault for fault in found if fault not in numbers]


def sizes(monkeypatch: pytest.MonkeyPatch, draw: Callable[[], object], large: bool) -> dict[str, int]:
    """The type size of each text that is rendered, px."""
    found: dict[str, int] = {}
    plain = GlowCanvas.text

    def noted(ink: GlowCanvas, said: str, size: int, *rest: Any, **named: Any) -> GlowCanvas:
        found[said] = max(size, found.get(said, 0))
        return plain(ink, said, size, *rest, **named)

    with empty_cache(), monkeypatch.context() as patch:
        forget()
        leave_black(patch)
        patch.setattr(GlowCanvas, "text", noted)
        read_large(large)
        draw()
    read_large(False)
    forget()
    return found


def drawn(scene: Scene) -> Callable[[], object]:
    return lambda: scene.draw(pygame.Surface((1920, 1080)))


@pytest.mark.parametrize(("game", "variant"), one_in(2, RULES))
def test_hud_and_rules_of_a_match_are_larger(
    controls: Controls, monkeypatch: pytest.MonkeyPatch, game: str, variant: str
) -> None:
    """Of every game: the score or place, the clock, the drivers, and the card of the rule set."""
    arcade, rules = Arcade(controls, "de"), games()[game].variants[variant]
    brains = "human human level3 level3"
    setup = setup_of(game, brains, shipped_arenas(game)[0], rules.default_minutes, 3, variant)

    def play() -> None:
        scene = MatchScene(arcade.context, setup, KEYS[:2])
        scene.match.state.tick = 40  # a second of race has no clock
        drawn(scene)()
        scene.match.state.tick = 0
        scene.runner.view.skip()  # the ceremony, which hides the rules
        drawn(scene)()

    usual, larger = (sizes(monkeypatch, play, large) for large in (False, True))
    words = arcade.context.words
    number, driver = "1" if game == "race" else "0", "WASD + LEERTASTE"
    for text in (number, ":", driver, words(f"setup.{game}_{variant}")):
        assert larger[text] > usual[text], text
    lines = set(words(f"rules.{game}_{variant}").split())
    assert lines <= set(" ".join(larger).split())
    assert max(larger[text] for text in larger if lines & {*text.split()}) > BODY


def size_of(sentence: str, found: dict[str, int]) -> int:
    """The type size in which a sentence was set, on one line or more, px."""
    plain = " ".join(sentence.split())
    return found[max((text for text in found if " ".join(text.split()) in plain), key=len)]


@pytest.mark.parametrize("language", ["de", "pt"])
def test_how_to_play_and_rule_texts_are_larger(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    words = arcade.context.words
    for game in games():
        page, rules = HowTo(arcade.context, game), words(f"rules.{game}_{games()[game].default.name}")
        limits = limits_line(words, game, page.minutes(), page._variant())
        captions = [words(f"howto.{name}") for name, _ in page.lessons()]
        usual, larger = (sizes(monkeypatch, drawn(page), large) for large in (False, True))
        assert size_of(limits, larger) > size_of(limits, usual)
        before, after = ([size_of(caption, found) for caption in captions] for found in (usual, larger))
        assert all(one <= other for one, other in zip(before, after, strict=True))
        assert sum(after) > sum(before)

        def setup(game: str = game) -> None:
            drawn(MatchSetupPage(arcade.context, game, seats(game)))()

        usual, larger = (sizes(monkeypatch, setup, large) for large in (False, True))
        assert size_of(rules, larger) > size_of(rules, usual)
    assert readable(BODY) == BODY, "by default"


@pytest.mark.usefixtures("_large")
def test_texts_are_larger_where_they_fit() -> None:
    assert readable(BODY) > BODY
    assert type_size((("A", "Ready"),), 800) == readable(BODY)
    assert type_size((("A", "Ready for the next match"),), 620) == BODY
