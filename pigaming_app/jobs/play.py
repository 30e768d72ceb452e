"""One match, with or without a window, at any speed; on request recorded."""

import json
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
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
from pigaming_app.jobs.arcade import RobotOptions, needs_supervisor, show, supervised
from pigaming_app.jobs.terminal.options import (
    GameOption,
    JsonOption,
    MatchOptions,
    decimal,
    flag,
    integer,
    option,
    path,
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


@dataclass(frozen=True, kw_only=True)
class PlayOptions(RobotOptions, MatchOptions, JsonOption, GameOption):
    """The match, and what to keep of it."""

    seats: str = option(
        "human, off, an AI or a trained one's file for each seat; default human,level3", default="human,level3"
    )
    teams: str | None = option("a number for each seat, such as 0,0,1,1; default: the game's own")
    seed: int = option("default 1; below 0: of a training", integer(-SEEDS, SEEDS - 1), 1, metavar="NUMBER")
    rounds: int | None = option("1, or 3: best of three rounds of one minute, in PiTanks", integer(), metavar="NUMBER")
    headless: bool = flag("no window, no sound")
    speed: str = option("times real time, or max; default 1", default="1")
    record: Path | None = option("write a replay", path, metavar="FILE")
    screenshot: Path | None = option("save a picture (PNG)", path, metavar="FILE")
    at: float = option("time of the picture; default 5", decimal(0.0, 3600.0), 5.0, metavar="SECONDS")
    robots: Path | None = option("simulate these measured robots (see fidelity)", path, metavar="FILE")
    real: str | None = option("seats with real robots, such as 1,3, or all", metavar="SEATS")


def run(options: PlayOptions) -> int:
    """Play the match; the exit code. Raises Refusal or NotSaved."""
    if needs_supervisor(options) and not options.headless and not options.screenshot:
        return supervised(options)
    if options.kiosk and is_safe():  # the match may be what fails
        from pigaming_app.scenes.launch import Options

        return show(Options(kiosk=True))
    with refused(ChoiceError, ArenaError):
        return _play(options)


def _play(options: PlayOptions) -> int:
    wanted = options.goal(options.game)
    chosen = options.mat_settings()
    seats = [seat.strip() for seat in options.seats.split(",")]
    require_for_brains(seats, play=options.headless)
    names = known_brains(options.game, seats)
    rounds = _rounds(options)
    arena, seed, variant = options.arena, options.seed, options.variant
    minutes = options.minutes
    if rounds and minutes is None:
        minutes = games()[options.game].round_minutes
    setup = make_setup(options.game, seats, arena, minutes, seed, variant, _teams(options.teams), names, wanted)
    speed = _speed(options.speed)
    real_seats = _real_seats(options, setup, speed)
    width = options.ros_width()
    if real_seats and width is None:
        _check_radio(chosen)
    plant = _plant(options, real_seats)
    _check_targets(options.record, options.screenshot)
    if real_seats or options.emulate is not None:
        require("hardware")
    if options.headless and not real_seats:
        return _headless(options, setup, speed, plant, rounds)
    return _on_screen(options, setup, min(speed, FASTEST), real_seats, plant, chosen, rounds, width)


def _rounds(options: PlayOptions) -> Rounds | None:
    """The rounds, none of them played; None: the match has only one. Raises Refusal."""
    count = options.rounds
    offered = games()[options.game].rounds if options.game in games() else BEST_OF
    if count is None or (count == 1 and count in offered):
        return None
    if count not in offered:
        raise Refusal(f"--rounds: {count}; {options.game} has {' or '.join(map(str, offered))}")
    if options.record is not None:
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


def _plant(options: PlayOptions, real: list[int]) -> Callable[[Any], Plant]:
    """The factory of the simulated plant: ideal robots, or with --robots the drivetrains measured by `fidelity`."""
    if options.robots is None:
        return SimPlant
    if real or options.record is not None:
        raise Refusal("--robots: goes without --real and --record")
    try:
        drivetrains = parse(read_text(options.robots), options.robots.name)
    except DrivetrainError as error:
        raise Refusal(str(error)) from None
    except (OSError, ParseError) as error:
        raise Refusal(f"{options.robots}: cannot be read ({describe_error(error)})") from None
    return lambda world: SimPlant(world, drivetrains)


def _real_seats(options: PlayOptions, setup: Setup, speed: float) -> list[int]:
    """The seats with real robots, from 0; by default all in an emulated arena and with ROS."""
    usual = "all" if options.emulate is not None or options.plant == "ros" else ""
    text = usual if options.real is None else options.real
    taken = [i for i, seat in enumerate(setup.seats) if seat.brain != "off"]
    try:
        seats = taken if text == "all" else sorted({int(number) - 1 for number in text.split(",") if number})
    except ValueError:
        raise Refusal(f"--real: {quote(text)}; numbers such as 1,3, or all, are needed") from None
    if stray := [seat + 1 for seat in seats if seat not in taken]:
        raise Refusal(f"--real: nobody sits on seat {quote(stray[0])}")
    if options.plant == "ros" and (options.headless or options.robots):
        raise Refusal("--plant ros: goes without --headless and --robots")
    if seats and speed != 1.0 and not options.headless:
        raise Refusal("--speed: real robots drive in real time")
    if seats and options.headless and options.emulate is None:
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
    options: PlayOptions, setup: Setup, speed: float, plant: Callable[[Any], Plant], rounds: Rounds | None
) -> int:
    match = new_match(setup, plant)
    if any(seat.brain == "human" for seat in setup.seats):
        print("PiGaming: human seats need a window; without one their robots stand still", file=sys.stderr)
    began = perf_counter()
    photographer = Photographer(match, options.screenshot, options.at) if options.screenshot else None
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
        if options.record:
            save_replay(match, options.record)
    finally:
        _print(match, options.json, perf_counter() - began, rounds)
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
    options: PlayOptions,
    setup: Setup,
    speed: float,
    real: list[int],
    plant: Callable[[Any], Plant],
    chosen: dict[str, Any],
    rounds: Rounds | None,
    width: float | None,
) -> int:
    """Play in a window; with --headless and emulated robots without one, as fast as possible."""
    from pigaming_app.ai.registry import new_match
    from pigaming_app.scenes.flow.scene import Context, Scene
    from pigaming_app.scenes.launch import Options
    from pigaming_app.scenes.lobby.scene import game_choice
    from pigaming_app.scenes.play.scene import MatchScene, match_of
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
            first = MatchScene(context, setup, seats, speed, game_choice, rounds, make=partial(new_match, plant=plant))
        if isinstance(first, MatchScene):
            scenes.append(first)
        return first

    def due() -> bool:
        """True when the picture is due, or when missing real robots have delayed it too long."""
        nonlocal shot
        if scenes and not scenes[0].robots.blocked:
            shot = bool(scenes[0].match.over or scenes[0].match.seconds >= options.at)
        else:
            shot = perf_counter() - began > options.at + PICTURE_TIMEOUT
        return shot

    def over() -> bool:
        if not options.headless:
            return False
        return not scenes or bool(_latched(scenes[0].match)) or (rounds.done if rounds else scenes[0].match.over)

    code = show(
        Options(
            first_scene=scene,
            kiosk=options.kiosk,
            display=options.display,
            scoreboard=options.scoreboard,
            screenshot=options.screenshot,
            screenshot_due=due,
            headless=options.headless,
            without_title=options.headless,  # nobody is there to go on after a failure
            step=DT if options.headless else None,
            should_close=over,
            emulator_seed=options.emulate,
            emulated_things=options.things,
            ros_width=width,
            changed_settings=chosen,
        )
    )
    if scenes and options.headless and not options.screenshot:
        played = rounds if rounds and rounds.outcomes else None
        match = scenes[0].match
        _print(match, options.json, played.outcome().seconds if played else match.seconds, played)
    if scenes and options.record:
        save_replay(scenes[0].match, options.record)
    if scenes and options.headless and (fault := _latched(scenes[0].match)):
        raise Refusal(f"The match did not end: nobody is there to help. {fault}")
    if code == 0 and options.screenshot and not shot:
        raise Refusal("--screenshot: the match was left before its time, so there is no picture")
    return code if scenes or not options.headless else 2  # no match: the reason has been printed


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
