"""One match, with or without a window, at any speed; on request recorded."""

import argparse
import json
import os
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from dataclasses import replace
from math import inf
from pathlib import Path
from time import perf_counter, sleep
from typing import Any

from pigaming_app.ai.brain_files import display_name
from pigaming_app.ai.plugin_faults import bound, check
from pigaming_app.ai.registry import known_brains, new_match
from pigaming_app.games.game import Outcome, Setup
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.games.rounds import BEST_OF, Rounds
from pigaming_app.games.setup import ChoiceError, longest, make_setup
from pigaming_app.jobs.arcade import needs_supervisor, ros_options, ros_width, show, supervised
from pigaming_app.jobs.terminal.options import (
    DEFAULT_GAME,
    MATCH,
    SHARED,
    decimal,
    display,
    game_option,
    goal,
    integer,
    mat_options,
    mat_settings,
    path,
    shared,
)
from pigaming_app.jobs.terminal.refusal import Refusal, module_of, refused, require, require_for_brains
from pigaming_app.scenes.files import save_replay
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.drivetrain import DrivetrainError, parse
from pigaming_app.sim.plant import Plant, SimPlant
from pigaming_app.sim.rng import SEEDS
from pigaming_app.sim.world import DT, ROBOTS
from pigaming_app.storage.parsing import ParseError, describe_error, quote, read_text
from pigaming_app.storage.plugins.endless import overseer
from pigaming_app.storage.safe_files import NotSaved, require_writable
from pigaming_app.storage.safe_mode import is_safe
from pigaming_app.storage.settings import Settings, folders

PICTURE_TIMEOUT = 4.0  # s, timeout of the picture in a match delayed by real robots
FASTEST = 64.0  # times real time, maximum in a window
SLOWEST_RATE, FASTEST_RATE = 0.01, 10_000.0  # times real time, limits of --speed
WATCHED = 150  # ticks before a picture, for its shots, sparks and tread marks


def options(parser: ArgumentParser) -> None:
    game_option(parser)
    parser.add_argument("--game", dest="named_game", help=argparse.SUPPRESS)  # the only syntax up to 1.4.0
    parser.set_defaults(game=None)  # to notice a contradiction
    parser.add_argument("--seats", help="human, off, an AI or a trained one's file for each seat; default human,normal")
    parser.add_argument("--teams", help="a number for each seat, such as 0,0,1,1; default: the game's own")
    shared(parser, *MATCH)
    of_any_match = integer(-SEEDS, SEEDS - 1)
    parser.add_argument(
        "--seed", **SHARED["--seed"] | {"type": of_any_match, "help": "default 1; below 0: of a training"}
    )
    parser.add_argument(
        "--rounds", type=integer(), metavar="NUMBER", help="1, or 3: best of three rounds of one minute, in PiTanks"
    )
    parser.add_argument("--headless", action="store_true", help="no window, no sound")
    parser.add_argument("--speed", default="1", help="times real time, or max; default 1")
    parser.add_argument("--record", type=path, metavar="FILE", help="write a replay")
    parser.add_argument("--screenshot", type=path, metavar="FILE", help="save a picture (PNG)")
    parser.add_argument(
        "--at", type=decimal(0.0, 3600.0), metavar="SECONDS", default=5.0, help="time of the picture; default 5"
    )
    parser.add_argument("--robots", type=path, metavar="FILE", help="simulate these measured robots (see fidelity)")
    parser.add_argument("--real", metavar="SEATS", help="seats with real robots, such as 1,3, or all")
    mat_options(parser)
    ros_options(parser)
    shared(parser, "--kiosk", "--display", "--scoreboard", "--json")


def run(arguments: Namespace) -> int:
    """Play the match; the exit code. Raises Refusal or NotSaved."""
    if needs_supervisor(arguments) and not arguments.headless and not arguments.screenshot:
        return supervised(arguments)
    if arguments.kiosk and is_safe():  # the match may be what fails
        from pigaming_app.scenes.launch import Options

        return show(Options(kiosk=True))
    with refused(ChoiceError, ArenaError):
        return _play(arguments)


def _play(arguments: Namespace) -> int:
    arguments.game = _game(arguments.game, arguments.named_game)
    wanted = goal(arguments)
    chosen = mat_settings(arguments)
    seats = [seat.strip() for seat in (arguments.seats or "human,normal").split(",")]
    require_for_brains(seats)
    names = known_brains(arguments.game, seats)
    rounds = _rounds(arguments)
    arena, seed, variant = arguments.arena, arguments.seed, arguments.variant
    minutes = arguments.minutes
    if rounds and minutes is None:
        minutes = games()[arguments.game].round_minutes
    setup = make_setup(arguments.game, seats, arena, minutes, seed, variant, _teams(arguments.teams), names, wanted)
    speed = _speed(arguments.speed)
    real_seats = _real_seats(arguments, setup, speed)
    width = ros_width(arguments)
    if real_seats and width is None:
        _check_radio(chosen)
    plant = _plant(arguments, real_seats)
    _check_targets(arguments.record, arguments.screenshot)
    if real_seats or arguments.emulate is not None:
        require("hardware")
    if arguments.headless and not real_seats:
        return _headless(arguments, setup, speed, plant, rounds)
    return _on_screen(arguments, setup, min(speed, FASTEST), real_seats, plant, chosen, rounds, width)


def _game(game: str | None, named: str | None) -> str:
    """The game, by its position or by --game."""
    if game is not None and named is not None and game != named:
        raise Refusal(f"--game: {quote(named)} contradicts {quote(game)}")
    return next((name for name in (game, named) if name is not None), DEFAULT_GAME)


def _rounds(arguments: Namespace) -> Rounds | None:
    """The rounds, none of them played; None: the match has only one. Raises Refusal."""
    count = arguments.rounds
    offered = games()[arguments.game].rounds if arguments.game in games() else BEST_OF
    if count is None or (count == 1 and count in offered):
        return None
    if count not in offered:
        raise Refusal(f"--rounds: {count}; {arguments.game} has {' or '.join(map(str, offered))}")
    if arguments.record is not None:
        raise Refusal("--record: a replay is one round; leave out --rounds")
    return Rounds(count)


def _teams(text: str | None) -> list[int] | None:
    try:
        return None if text is None else [int(team) for team in text.split(",")]
    except ValueError:
        raise Refusal(f"--teams: {quote(text)}; numbers such as 0,0,1,1 are needed") from None


def _check_targets(record: Path | None, screenshot: Path | None) -> None:
    """Check before the match that its files will be writable. Raises Refusal or NotSaved."""
    if screenshot is not None and screenshot.suffix.lower() != ".png":
        raise Refusal(f"--screenshot: {screenshot}: the name of a picture ends in .png")
    if record is not None and screenshot is not None and os.path.realpath(record) == os.path.realpath(screenshot):
        raise Refusal(f"--record: {record}: the picture has that name")
    for target in (record, screenshot):
        if target is not None:
            require_writable(target)


def _plant(arguments: Namespace, real: list[int]) -> Callable[[Any], Plant]:
    """The factory of the simulated plant: ideal robots, or with --robots the drivetrains measured by `fidelity`."""
    if arguments.robots is None:
        return SimPlant
    if real or arguments.record is not None:
        raise Refusal("--robots: goes without --real and --record")
    try:
        drivetrains = parse(read_text(arguments.robots), arguments.robots.name)
    except DrivetrainError as error:
        raise Refusal(str(error)) from None
    except (OSError, ParseError) as error:
        raise Refusal(f"{arguments.robots}: cannot be read ({describe_error(error)})") from None
    return lambda world: SimPlant(world, drivetrains)


def _real_seats(arguments: Namespace, setup: Setup, speed: float) -> list[int]:
    """The seats with real robots, from 0; by default all in an emulated arena and with ROS."""
    usual = "all" if arguments.emulate is not None or arguments.plant == "ros" else ""
    text = usual if arguments.real is None else arguments.real
    taken = [i for i, seat in enumerate(setup.seats) if seat.brain != "off"]
    try:
        seats = taken if text == "all" else sorted({int(number) - 1 for number in text.split(",") if number})
    except ValueError:
        raise Refusal(f"--real: {quote(text)}; numbers such as 1,3, or all, are needed") from None
    if stray := [seat + 1 for seat in seats if seat not in taken]:
        raise Refusal(f"--real: nobody sits on seat {quote(stray[0])}")
    if arguments.plant == "ros" and (arguments.headless or arguments.robots):
        raise Refusal("--plant ros: goes without --headless and --robots")
    if seats and speed != 1.0 and not arguments.headless:
        raise Refusal("--speed: real robots drive in real time")
    if seats and arguments.headless and arguments.emulate is None:
        raise Refusal("--headless: real robots need the picture on their mat; add --emulate for emulated ones")
    return seats


def _check_radio(chosen: dict[str, Any]) -> None:
    """Raises Refusal for robots without a deadman, whether the command line or the settings name them."""
    from pigaming_app.ui.i18n import english

    settings_problem = module_of("mat.sessions", "mat").settings_problem
    settings, _ = Settings.load(folders().config)
    settings.radio = chosen.get("radio", settings.radio)
    if reason := settings_problem(settings):
        raise Refusal(f"--radio: {english().long_sentence(reason)}")


def _speed(text: str) -> float:
    """Times real time; infinity for "max"."""
    if text == "max":
        return float("inf")
    try:
        speed = float(text)
    except ValueError:
        speed = 0.0
    if not SLOWEST_RATE <= speed <= FASTEST_RATE:
        raise Refusal(f"--speed: {quote(text)}; a number from {SLOWEST_RATE:g} to {FASTEST_RATE:g}, or max, is needed")
    return speed


def _headless(
    arguments: Namespace,
    setup: Setup,
    speed: float,
    plant: Callable[[Any], Plant],
    rounds: Rounds | None,
) -> int:
    match = new_match(setup, plant)
    if any(seat.brain == "human" for seat in setup.seats):
        print("PiGaming: human seats need a window; without one their robots stand still", file=sys.stderr)
    began = perf_counter()
    photographer = Photographer(match, arguments.screenshot, arguments.at) if arguments.screenshot else None
    played = 0.0  # s of the rounds before this one
    most = bound(setup.game, longest(setup)) if overseer.is_overseen(setup.game) else inf
    while True:
        ticks = 0
        while not match.over and ticks < most:
            match.tick()
            ticks += 1
            if photographer:
                photographer.watch()
            ahead = (played + match.seconds) / speed - (perf_counter() - began)
            if ahead > 0.0:
                sleep(ahead)
        check(setup.game, [match.state])
        if rounds is None:
            break
        rounds.add(match.outcome())
        if rounds.done:
            break
        played += match.seconds
        match = new_match(replace(setup, seed=setup.seed + rounds.number - 1), plant)
    try:
        if arguments.record:
            save_replay(match, arguments.record)
    finally:
        _print(match, arguments.json, perf_counter() - began, rounds)
    if photographer and photographer.trouble:
        raise photographer.trouble
    return 0


class Photographer:
    """Takes one picture of a match at `at` s, or of its end if that comes first. `trouble`: why it was not saved."""

    def __init__(self, match: Match, path: Path, at: float) -> None:
        self.match, self.path, self.due = match, path, round(at / DT)
        self.trouble: NotSaved | None = None
        self._camera: Any = None
        self._taken = False
        if self.due == 0:
            self._take()

    def watch(self) -> None:
        """Call it after every tick."""
        tick, over = self.match.state.tick, self.match.over
        if self._taken or (tick < self.due - WATCHED and not over):
            return
        self._camera = self._camera or _camera(self.match)
        self._camera.watch()
        if tick >= self.due or over:
            self._take()

    def _take(self) -> None:
        self._taken = True
        self._camera = self._camera or _camera(self.match)
        try:
            self._camera.picture(self.path)
        except NotSaved as trouble:
            self.trouble = trouble


def _on_screen(
    arguments: Namespace,
    setup: Setup,
    speed: float,
    real: list[int],
    plant: Callable[[Any], Plant],
    chosen: dict[str, Any],
    rounds: Rounds | None,
    width: float | None,
) -> int:
    """Play in a window; with --headless and emulated robots without one, as fast as possible."""
    from pigaming_app.scenes.flow.context import Context
    from pigaming_app.scenes.flow.stack import Scene
    from pigaming_app.scenes.launch import Options
    from pigaming_app.scenes.lobby.scene import game_choice
    from pigaming_app.scenes.play.scene import MatchScene
    from pigaming_app.scenes.play.start_match import match_of
    from pigaming_app.ui.input.events import Device

    scenes: list[MatchScene] = []
    began, shot = perf_counter(), False

    def scene(context: Context) -> Scene:
        """People take the connected pads first, then the key clusters."""
        nonlocal began
        began = perf_counter()
        free = [*context.controls.pads(), *(Device("keys", k) for k in range(ROBOTS))]
        people = [i for i, seat in enumerate(setup.seats) if seat.brain == "human"]
        devices = dict(zip(people, free, strict=False))
        seats = [devices.get(i) for i in range(ROBOTS)]
        if real:
            first = match_of(context, setup, seats, real, speed, game_choice, rounds)
        else:
            first = MatchScene(context, setup, seats, speed, plant, game_choice, rounds)
        if isinstance(first, MatchScene):
            scenes.append(first)
        return first

    def due() -> bool:
        """True when the picture is due, or when missing real robots have delayed it too long."""
        nonlocal shot
        if scenes and not scenes[0].blocked:
            shot = bool(scenes[0].match.over or scenes[0].match.seconds >= arguments.at)
        else:
            shot = perf_counter() - began > arguments.at + PICTURE_TIMEOUT
        return shot

    def over() -> bool:
        if not arguments.headless:
            return False
        return not scenes or bool(_latched(scenes[0].match)) or (rounds.done if rounds else scenes[0].match.over)

    code = show(
        Options(
            first_scene=scene,
            kiosk=arguments.kiosk,
            display=display(arguments),
            scoreboard=arguments.scoreboard,
            screenshot=arguments.screenshot,
            screenshot_due=due,
            headless=arguments.headless,
            without_title=arguments.headless,  # nobody is there to go on after a failure
            step=DT if arguments.headless else None,
            should_close=over,
            emulator_seed=arguments.emulate,
            emulated_things=arguments.things,
            ros_width=width,
            changed_settings=chosen,
        )
    )
    if scenes and arguments.headless and not arguments.screenshot:
        played = rounds if rounds and rounds.outcomes else None
        match = scenes[0].match
        _print(match, arguments.json, played.outcome().seconds if played else match.seconds, played)
    if scenes and arguments.record:
        save_replay(scenes[0].match, arguments.record)
    if scenes and arguments.headless and (fault := _latched(scenes[0].match)):
        raise Refusal(f"The match did not end: nobody is there to help. {fault}")
    if code == 0 and arguments.screenshot and not shot:
        raise Refusal("--screenshot: the match was left before its time, so there is no picture")
    return code if scenes or not arguments.headless else 2  # no match: the reason has been printed


def _latched(match: Match) -> str:
    """A fault of a real robot that waits for an operator, in one sentence, or nothing."""
    from pigaming_app.ui.i18n import english

    safety: Any = getattr(match.plant, "safety", None)
    faults = [fault for fault in safety.faults if fault.robot in safety.latched] if safety and not match.over else []
    return english()(f"faults.{faults[0].name}", robot=faults[0].robot + 1, button="the button") if faults else ""


def _camera(match: Match) -> Any:
    """A camera that needs no window."""
    os.environ["SDL_VIDEODRIVER"] = os.environ["SDL_AUDIODRIVER"] = "dummy"
    from pigaming_app.scenes.views.screenshot import Screenshot

    return Screenshot(match)


def _print(match: Match, as_json: bool, seconds: float, rounds: Rounds | None = None) -> None:
    """Print the results: a table, or one JSON object; of several rounds the standings, and each round."""
    outcome = rounds.outcome() if rounds else match.outcome()
    if as_json:
        result = {"game": match.setup.game, "arena": match.setup.arena, **_standings(outcome)}
        if rounds:
            result["rounds"] = [_standings(one) for one in rounds.outcomes]
        print(json.dumps({**result, "match_seconds": outcome.seconds, "seconds": seconds}))
        return
    for row in outcome.rows:
        brain = display_name(match.setup.seats[row.seat].brain)
        facts = "  ".join(
            f"{name} {value:.0%}" if name == "aim" else f"{name} {round(value, 2):g}"
            for name, value in row.stats.items()
        )
        print(f"{row.place}.  P{row.seat + 1} {brain:8} {row.score:+4d}   {facts}")


def _standings(outcome: Outcome) -> dict[str, Any]:
    """Winners and rows of an outcome for JSON; seats are numbered from 1."""
    rows = [
        {
            "seat": row.seat + 1,
            "place": row.place,
            "team": row.team,
            "score": row.score,
            **row.stats,
            "times": row.times,
        }
        for row in outcome.rows
    ]
    return {"winners": [seat + 1 for seat in outcome.winners], "rows": rows}
