"""Names of entrants in the match, at its end and on the pages, shortened where they are long."""

from collections.abc import Sequence

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Entrant, EventSpec, Format, Result
from pigaming_app.games.game import Outcome, Row
from pigaming_app.games.registry import games
from pigaming_app.scenes.events.names import places_line
from pigaming_app.scenes.events.next_page import EventMatch
from pigaming_app.scenes.events.setup.draft import BY_TURNS, Draft
from pigaming_app.scenes.events.setup.page import SetupPage
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.reconnect import Reconnect
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.headline import EndedMatch, headline
from pigaming_app.ui.draw import BODY, readable, text_width
from pigaming_app.ui.draw.glow import GlowCanvas
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets import setting_row
from pigaming_app.ui.widgets.dialog import FOOT, HEAD
from tests.cases import one_in
from tests.scenes.arcade import KEYS, Arcade, setup
from tests.scenes.events.drawn import running
from tests.scenes.measuring import empty_cache, faults, leave_black, measuring

NAMES = ("Ana", "Maximilian v. Hohenstein", "HAL", "Wolfgang Wimmersbacher")


def a_match(arcade: Arcade, game: str, seats: int, variant: str) -> MatchScene:
    """A match of three people and an AI, or of the first two of them."""
    entrants = tuple(Entrant(name, "level3" if name == "HAL" else "") for name in NAMES)
    run = running(
        Event(EventSpec("T", Format.GRAND_PRIX, (game,), entrants, seats=seats, variants={game: variant})), game
    )
    fixture = run.event.open[0]
    wanted = run.setup(fixture)
    assert wanted
    devices = [None if run.brain(name) else KEYS[i] for i, name in enumerate(fixture.entrants)]
    return MatchScene(arcade.context, wanted, devices, after=EventMatch(run, fixture))


@pytest.mark.parametrize("seats", [2, 4])
@pytest.mark.parametrize("game", one_in(2, games()))
def test_the_hud_has_the_name_of_everybody(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, game: str, seats: int
) -> None:
    """As the picture is drawn, before and after the countdown: whole, or with an ellipsis, and in large type."""
    written: list[tuple[str, int]] = []
    write = GlowCanvas.text

    def noted(ink: GlowCanvas, said: str, size: int, *rest: object, **named: object) -> object:
        written.append((said, size))
        return write(ink, said, size, *rest, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(GlowCanvas, "text", noted)
    leave_black(monkeypatch)
    with empty_cache():
        scene = a_match(arcade, game, seats, "party")
        scene.runner.view.draw(arcade.screen, scene.match.state, 1.0, 0.1)
        hud, captions = list(written), []
        written.clear()
        scene.runner.draw_captions(arcade.screen, scene.devices)
        captions = [said for said, _ in written]
    for name in scene.names:
        assert any(is_short_for(said, name) and size >= 34 for said, size in hud), (name, hud)
        assert any(is_short_for(said.split("  ·  ")[0], name) for said in captions), (name, captions)
    assert not {"P1", "You"} & {*captions, *(said for said, _ in hud)}


@pytest.mark.parametrize("language", LANGUAGES)
def test_pages_over_a_match_name_those_who_play(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    """Who paused, who chooses first, and whose pad is gone."""
    scene = a_match(arcade, "pitanks", 4, "party")
    seat = scene.names.index("Maximilian v. Hohenstein")
    paused, rejected = Pause(scene, KEYS[seat]), Pause(scene, KEYS[seat])
    rejected.handle(InputEvent(Button.FIRE, KEYS[(seat + 1) % 4]))
    for page in (paused, rejected, Reconnect(scene, seat)):
        with measuring(monkeypatch) as screen:
            page.draw(screen)
        named = [mark for mark in screen.texts if "Maximilian" in mark.text]
        assert (named[0].box[1] < HEAD, len(named)) == (True, 1 + (page is rejected))
        assert named[-1].box[1] > FOOT or page is not rejected
        assert [fault for fault in faults(screen) if "Maximilian" in fault] == []


def is_short_for(said: str, name: str) -> bool:
    """True for a name, or at least three letters of it and an ellipsis."""
    return said == name or (said.endswith("…") and len(said) > 3 and name.startswith(said[:-1]))


@pytest.mark.parametrize(
    ("winners", "names", "line"),
    [
        ((1,), ("Ana", "Bea"), "Bea wins!"),
        ((0, 2), ("Ana", "Bea", "Eva", "Zoë"), "Ana + Eva win!"),
        ((3,), ("Ana", "Bea", "Eva"), "AI 4 ★★★ wins!"),
    ],
)
def test_winners_are_named_in_teams_too(winners: tuple[int, ...], names: Sequence[str], line: str) -> None:
    """An AI that fills a seat has no name."""
    teams = (0, 1, 0, 1) if len(winners) > 1 else (0, 1, 2, 3)
    rows = tuple(Row(seat, team, 1, 0, {}, {}, ()) for seat, team in enumerate(teams))
    match = setup("human human human level3", teams=teams)
    pads = [Device("pad", seat) for seat in range(3)]
    ended = EndedMatch(match, Outcome(rows, winners, (), 60.0), [*pads, None], names)
    assert headline(Words("en"), ended) == line


def test_a_result_is_one_line_of_large_type() -> None:
    outcome = Result(1, tuple((name,) for name in NAMES))
    line = places_line(outcome, 1000)
    assert text_width(line, BODY) <= 1000
    assert line.startswith("1. Ana   2. Maxi")
    assert "3. HAL   4. Wolf" in line


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_order_of_the_games_is_legible(arcade: Arcade) -> None:
    """The row has what fits in type of 40 px, the line beside it the whole order."""
    draft = Draft(game=BY_TURNS)
    page = SetupPage(arcade.context, draft, lambda draft: "")
    for order in draft.options("order"):
        draft.choose("order", order)
        shown = page.value("order")
        names = [arcade.context.words(f"events.short_{game}") for game in draft.order]
        assert text_width(shown.options[shown.chosen], readable(BODY), "body") <= setting_row.VALUE_ROOM
        assert names[0] in shown.options[shown.chosen]
        assert page.line("order") == ", ".join(names)
