"""Programs in the arcade: who may play, what they see, and what happens when they are silent."""

import json
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pigaming_app.ai.bots import brains, line
from pigaming_app.ai.bots.line import Serving
from pigaming_app.ai.bots.session import BotSession
from pigaming_app.ai.registry import find_brain, is_brain, new_match
from pigaming_app.events.event import Event
from pigaming_app.events.spec import Entrant, EventSpec, Format
from pigaming_app.games.match import Match
from pigaming_app.games.setup import ChoiceError
from pigaming_app.jobs.events.play import HeadlessRun
from pigaming_app.scenes.bots.feature import BotService
from pigaming_app.scenes.bots.host import BotHost
from pigaming_app.scenes.bots.page import BotsPage
from pigaming_app.scenes.flow.match_words import brain_name, rivals
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.pages.text_page import TextPage
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.ui.input.events import Button
from tests.matches import match_of, run, setup_of
from tests.scenes.arcade import Arcade
from tests.scenes.bots.client import Program

WAIT = 10.0  # s for what happens within milliseconds


@pytest.fixture
def host(arcade: Arcade) -> Iterator[BotHost]:
    host = BotHost()
    host.follow(True, False, "127.0.0.1", 0)
    assert host.trouble is None
    brains.book().add("ada")
    brains.serve(Serving.LIVE)
    yield host
    host.close()
    brains.serve(Serving.CLOSED)


def until(holds: Callable[[], Any]) -> None:
    end = time.monotonic() + WAIT
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.005)


def connected(host: BotHost, decide: Any = lambda tick: {}, name: str = "ada") -> Program:
    program = Program(host.url, name, brains.book().keys[name], decide)
    until(lambda: "welcome" in program.types())
    until(lambda: brains.line_of(name).connected)
    return program


def played(match: Match, seconds: float) -> None:
    """Ticks in real time."""
    end = time.monotonic()
    for _ in range(round(seconds * 50)):
        match.tick()
        end += 0.02
        time.sleep(max(0.0, end - time.monotonic()))


def test_a_program_sees_every_tick_and_drives_its_robot(host: BotHost) -> None:
    program = connected(host, lambda tick: {"linear": 1.0})
    match = match_of("race", ["bot:ada", "idle"])
    x, y = match.state.robots[0].x, match.state.robots[0].y
    played(match, 1.0)
    robot = match.state.robots[0]
    assert abs(robot.x - x) + abs(robot.y - y) > 150, "nearly a second at 325 px/s"
    ticks = [message for message in program.seen if message["type"] == "tick"]
    assert [message["tick"] for message in ticks] == list(range(50))
    assert ticks[0]["robots"][0]["x"] == round(x, 3)
    begin = next(message for message in program.seen if message["type"] == "begin")
    assert (begin["game"], begin["seat"], begin["width"], begin["hz"]) == ("race", 0, 1600, 50)
    assert len(begin["walls"]) == match.state.wall_count


def test_one_bot_on_two_seats_gets_and_gives_two_commands(host: BotHost) -> None:
    connected(host, lambda tick: {"linear": 1.0 if tick["seat"] else 0.0})
    match = match_of("race", ["bot:ada", "bot:ada"])
    before = [robot.x + robot.y for robot in match.state.robots]
    played(match, 0.6)
    moved = [abs(robot.x + robot.y - start) for robot, start in zip(match.state.robots, before, strict=True)]
    assert moved[0] < 1 < 40 < moved[1]


def test_a_robot_stops_within_a_third_of_a_second_of_silence_and_then_an_ai_has_it(
    host: BotHost, caplog: pytest.LogCaptureFixture
) -> None:
    connected(host, lambda tick: {"linear": 1.0} if tick["tick"] < 50 else None)
    match = match_of("race", ["bot:ada", "idle"])
    played(match, 1.0)
    assert match.state.actions[0].linear == 1.0
    played(match, 0.4)
    assert match.state.actions[0].linear == 0.0
    played(match, 3.1)
    assert "level3 takes its seat" in caplog.text
    x, y = match.state.robots[0].x, match.state.robots[0].y
    run(match, 100)
    assert abs(match.state.robots[0].x - x) + abs(match.state.robots[0].y - y) > 50


def test_a_match_that_waits_does_not_wait_for_ever(host: BotHost, caplog: pytest.LogCaptureFixture) -> None:
    connected(host, lambda tick: {"linear": 1.0} if tick["tick"] < 20 else None)
    brains.serve(Serving.PATIENT)
    match = match_of("race", ["bot:ada", "idle"])
    for tick in range(20):
        match.tick()
        assert match.state.actions[0].linear == 1.0, tick
    began = time.monotonic()
    run(match, 9)
    assert not caplog.text
    run(match, 1)
    assert time.monotonic() - began < 6.0, "ten times 0.3 s"
    assert "bot ada is silent: level3 takes its seat" in caplog.text
    x, y = match.state.robots[0].x, match.state.robots[0].y
    run(match, 100)
    assert abs(match.state.robots[0].x - x) + abs(match.state.robots[0].y - y) > 50


def test_matches_wait_once_for_a_bot_that_is_gone_and_for_its_return(
    host: BotHost, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(brains, "RETURNS", 0.5)
    program = connected(host)
    brains.serve(Serving.PATIENT)
    match = match_of("race", ["bot:ada", "idle"])
    run(match, 5)
    program.leave()
    until(lambda: not brains.line_of("ada").connected)
    began = time.monotonic()
    for _ in range(20):
        run(match, 1)
        match = match_of("race", ["bot:ada", "idle"])
    assert time.monotonic() - began < 5.0, "twenty matches, half a second once"
    assert caplog.text.count("bot ada is gone: level3 takes its seat") == 20
    connected(host, lambda tick: {"linear": 1.0})
    match.tick()
    assert match.state.actions[0].linear == 1.0
    brains.serve(Serving.CLOSED)
    with pytest.raises(ChoiceError, match="plays in the arcade"):
        run(match_of("race", ["bot:ada", "idle"]), 1)


def test_an_event_goes_on_without_a_bot_that_falls_silent(host: BotHost, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(line, "BUDGET", 0.01)
    connected(host, lambda tick: None)
    brains.serve(Serving.PATIENT)
    entrants = tuple(Entrant(name, brain) for name, brain in (("Ada", "bot:ada"), ("Bo", "idle"), ("Cy", "idle")))
    event = Event(EventSpec("Cup", Format.ROUND_ROBIN, ("pitanks",), entrants, minutes={"pitanks": 0.5}))
    headless = HeadlessRun(event)
    while not event.over:
        for outcome in headless.play(event):
            event = event.record(outcome)
    assert len(event.outcomes) == 3
    assert [outcome.places[0] for outcome in event.outcomes.values() if ("Ada",) in outcome.places] == [("Ada",)] * 2


def test_a_command_for_a_tick_to_come_neither_counts_nor_blocks(host: BotHost) -> None:
    told: list[dict[str, Any]] = []

    def decide(tick: dict[str, Any]) -> dict[str, Any] | None:
        told.append(tick)
        return {"tick": 2**40, "linear": 1.0} if len(told) == 1 else {"linear": -0.5}

    connected(host, decide)
    match = match_of("race", ["bot:ada", "idle"])
    played(match, 0.8)
    assert match.state.actions[0].linear == -0.5


def test_a_slow_program_plays_without_falling_behind(host: BotHost) -> None:
    """It needs 60 ms for a decision, and is shown every third or fourth tick."""

    def decide(tick: dict[str, Any]) -> dict[str, Any]:
        time.sleep(0.06)
        return {"linear": 1.0}

    program = connected(host, decide)
    match = match_of("race", ["bot:ada", "idle"])
    played(match, 2.0)
    ticks = [message["tick"] for message in program.seen if message["type"] == "tick"]
    assert 15 <= len(ticks) <= 45
    assert ticks[-1] > 85, "the newest, not the oldest"
    assert match.state.actions[0].linear == 1.0


def test_a_bot_that_is_removed_is_cut_off_and_an_ai_has_its_seat_in_the_next_match(host: BotHost) -> None:
    program = connected(host, lambda tick: {"linear": 1.0})
    match = match_of("race", ["bot:ada", "idle"])
    setup = match.setup
    played(match, 0.2)
    brains.book().remove("ada")
    played(match, 0.5)
    program.join(WAIT)
    assert program.code == 4401
    assert match.state.actions[0].linear == 0.0
    again: Any = new_match(setup).brains[0]
    assert again.kind.name == "level3"
    brains.book().add("ada")


def test_a_new_key_ends_the_connection_with_the_old_one(host: BotHost) -> None:
    program = connected(host, lambda tick: {"linear": 1.0})
    brains.book().add("ada")
    played(match_of("race", ["bot:ada", "idle"]), 0.2)
    program.join(WAIT)
    assert program.code == 4401


def test_a_bot_that_returns_in_time_is_told_of_the_match_again(host: BotHost) -> None:
    program = connected(host, lambda tick: {"linear": 0.5})
    match = match_of("race", ["bot:ada", "idle"])
    played(match, 0.3)
    program.leave()
    until(lambda: not brains.line_of("ada").connected)
    played(match, 0.5)
    again = connected(host, lambda tick: {"linear": 0.5})
    played(match, 0.5)
    assert again.types().count("begin") == 1
    assert match.state.actions[0].linear == 0.5


def test_the_same_bot_again_takes_the_place_of_the_first(host: BotHost) -> None:
    first = connected(host)
    second = connected(host, lambda tick: {"linear": 1.0})
    first.join(WAIT)
    assert first.code == 4409
    match = match_of("race", ["bot:ada", "idle"])
    played(match, 0.3)
    assert match.state.actions[0].linear == 1.0
    assert second.is_alive()


@pytest.mark.parametrize("key", ["0" * 32, "", "x"])
def test_a_wrong_key_is_shut_out(host: BotHost, key: str) -> None:
    program = Program(host.url, "ada", key)
    program.join(WAIT)
    assert program.code == 4401
    assert not brains.line_of("ada").connected


def test_nobody_plays_without_signing_or_with_what_was_sent_before(host: BotHost) -> None:
    """A command of another connection, one without a sign, one under another name."""
    program = connected(host)
    match = match_of("race", ["bot:ada", "idle"])
    place = {"match": 0, "seat": 0, "tick": 0}
    texts = [
        program.signed({"type": "act", **place, "linear": 1.0}, nonce="0" * 32),
        json.dumps({"type": "act", **place, "linear": 1.0}),
    ]
    for text in texts:
        program.say(text)
        program.join(WAIT)
        assert program.code in (4400, 4401)
        program = connected(host)
    program.say(program.signed({"type": "play", "name": "eve"}))
    program.join(WAIT)
    assert program.code == 4400
    played(match, 0.1)
    assert match.state.actions[0].linear == 0.0


def test_an_older_command_does_not_replace_a_newer_one(host: BotHost) -> None:
    told: list[dict[str, Any]] = []

    def decide(tick: dict[str, Any]) -> None:
        told.append(tick)

    program = connected(host, decide)
    match = match_of("race", ["bot:ada", "idle"])
    played(match, 0.95)
    until(lambda: len(told) == 4)
    assert [tick["tick"] for tick in told] == [0, 15, 30, 45], "a silent program is shown a tick every 0.3 s"
    place = {"type": "act", "match": told[0]["match"], "seat": 0}
    program.say(program.signed({**place, "tick": 45, "linear": 1.0}))
    program.say(program.signed({**place, "tick": 30, "linear": -1.0}))
    time.sleep(0.1)
    match.tick()
    assert match.state.actions[0].linear == 1.0


@pytest.mark.parametrize(
    ("sent", "code"),
    [("x" * 2000, 1009), (b"\x00", 4400), ("", 4400), ("é" * 80, 4400), ("0" * 64 + " {}", 4400), ("[" * 900, 4400)],
)
def test_what_is_no_message_ends_the_connection(host: BotHost, sent: str | bytes, code: int) -> None:
    program = Program(host.url)
    until(lambda: program.types() == ["hello"])
    program.say(sent)
    program.join(WAIT)
    assert program.code == code


def test_a_flood_ends_the_connection_and_nothing_else(host: BotHost) -> None:
    flooder, other = connected(host), Program(host.url)
    text = flooder.signed({"type": "act", "match": 0, "seat": 0, "tick": 0})
    flooder.flood(text, 2000)
    flooder.join(WAIT)
    assert flooder.code == 4429
    assert other.is_alive()


@given(st.text(max_size=200), st.booleans())
def test_no_text_harms_a_session(text: str, signed: bool) -> None:
    sent: list[str] = []
    session = BotSession(sent.append, lambda code: None)
    assert session.receive(("0" * 64 + " " if signed else "") + text) in (4400, 4401)


def test_numbers_beyond_all_sense_are_refused_or_clamped(host: BotHost) -> None:
    program = connected(host, lambda tick: {"linear": 1e200, "angular": -1e200})
    match = match_of("race", ["bot:ada", "idle"])
    played(match, 0.2)
    assert (match.state.actions[0].linear, match.state.actions[0].angular) == (1.0, -1.0)
    program.say(program.signed({"type": "act", "match": 1, "seat": 9, "tick": 0}))
    program.join(WAIT)
    assert program.code == 4400


def test_observers_see_the_match_on_the_screen_without_a_key(arcade: Arcade, host: BotHost) -> None:
    observer = Program(host.url)
    until(lambda: len(host.sessions) == 1 and observer.types())
    setup = setup_of("pitanks", "level1 level1", "classic", 2)
    scene = MatchScene(arcade.context, setup, [None] * 4)
    for _ in range(30):
        scene.match.tick()
        host.show([scene])
    until(lambda: observer.types().count("tick") == 30)
    begin = observer.seen[1]
    assert (begin["type"], begin["game"], begin["arena"]) == ("begin", "pitanks", "classic")
    assert (begin["radius"], begin["mm"]) == (36.0, 1.32)
    assert [seat["brain"] for seat in begin["seats"]] == ["level1", "level1", "off", "off"]
    late = Program(host.url)
    until(lambda: len(host.sessions) == 2)
    scene.match.tick()
    host.show([scene])
    until(lambda: late.types() == ["hello", "begin", "tick"])
    assert late.seen[2]["tick"] == 31
    assert late.seen[2]["match"] == late.seen[1]["match"] == begin["match"]


def test_walls_that_break_are_told(host: BotHost) -> None:
    program = connected(host)
    match = match_of("pitanks", ["bot:ada", "level1"], "classic")
    played(match, 0.1)
    match.state.walls[0].health = 0
    played(match, 0.1)
    until(lambda: "layout" in program.types())
    layout = next(message for message in program.seen if message["type"] == "layout")
    assert len(layout["walls"]) == match.state.wall_count - 1


def test_the_lobby_offers_who_is_connected(arcade: Arcade, host: BotHost) -> None:
    assert "bot:ada" not in rivals("pitanks")
    assert is_brain("pitanks", "bot:ada")
    lobby = arcade.open(Lobby(arcade.context, "pitanks"))
    program = connected(host)
    assert rivals("pitanks")[-1] == "bot:ada"
    lobby.update(0.1)
    assert lobby.seats.rivals[-1] == "bot:ada"
    assert Lobby(arcade.context, "pitanks").seats.rivals[-1] == "bot:ada"
    assert brain_name(arcade.context.words, "pitanks", "bot:ada") == "ADA"
    assert find_brain("pitanks", "bot:ada").plain
    program.leave()
    until(lambda: not brains.line_of("ada").connected)
    lobby.update(0.1)
    assert "bot:ada" not in lobby.seats.rivals


def test_the_page_makes_a_bot_shows_its_key_and_removes_it(arcade: Arcade, host: BotHost) -> None:
    arcade.open(BotsPage(arcade.context))
    arcade.press(Button.DOWN, Button.DOWN, Button.FIRE)
    typing = arcade.shown(TextPage)
    arcade.wait(0.5)
    for letter in "Eve":
        typing.type(letter)
    arcade.press(Button.START)
    page = arcade.shown(BotsPage)
    assert brains.book().keys.keys() == {"ada", "eve"}
    assert page.focus.name == "bot:eve"
    assert page.rows == ("enabled", "vision", "new", "bot:ada", "bot:eve")
    assert page.line("bot:eve") == arcade.context.words("bots.away")
    page.held()
    assert brains.book().keys.keys() == {"ada"}


def test_the_service_follows_the_settings(arcade: Arcade) -> None:
    settings, service = arcade.context.settings, BotService(arcade.context)
    settings.phones_network = "127.0.0.1"
    service.update(0.1, arcade.stack)
    assert service.host.url == ""
    settings.bots = settings.bots_vision = True
    service.update(0.1, arcade.stack)
    observer = Program(service.host.url)
    until(lambda: observer.types() == ["hello"])
    settings.bots = False
    service.update(0.1, arcade.stack)
    observer.join(WAIT)
    assert observer.code == 1001
    service.close()


def test_another_network_ends_the_old_address(monkeypatch: pytest.MonkeyPatch) -> None:
    host = BotHost()
    host.follow(True, True, "127.0.0.1", 0)
    observer = Program(host.url)
    until(lambda: observer.types() == ["hello"])
    monkeypatch.setattr("pigaming_app.scenes.bots.host.CHECK_SECONDS", 0.0)
    host.follow(True, True, "127.0.0.2", 0)
    observer.join(WAIT)
    assert observer.code == 1001
    assert host.url.startswith("ws://127.0.0.2:")
    host.follow(True, True, "no such network", 0)
    assert (host.url, host.trouble and host.trouble.key) == ("", "network_gone")
    host.close()


@pytest.mark.parametrize("game", ["pitanks", "factory", "race", "football"])
def test_every_game_is_shown_without_what_nobody_sees(host: BotHost, game: str) -> None:
    program = connected(host)
    match = match_of(game, ["bot:ada", "level2"])
    played(match, 0.1)
    until(lambda: program.types().count("tick") == 5)
    tick = program.seen[-1]
    assert not {"random", "grid", "actions"} & tick.keys()
    assert len(json.dumps(tick)) < 10_000
    assert len(tick["robots"]) == 4
