"""The job `play`: one match, with or without a screen, at any speed, recorded if wished."""

import argparse
import json
import os
import sys
from collections.abc import Callable
from pathlib import Path
from time import perf_counter, sleep
from typing import Any

from pigaming_app.ai import BRAINS, seated
from pigaming_app.games.game import Setup
from pigaming_app.games.match import Match
from pigaming_app.games.replay import save
from pigaming_app.games.setup import choose
from pigaming_app.sim.drivetrain import DrivetrainError, parse
from pigaming_app.sim.plant import Plant, SimPlant
from pigaming_app.sim.world import DT, ROBOTS
from pigaming_app.storage.parsing import ParseError, read_text, reason, shown
from pigaming_app.storage.safe_files import NotSaved, check_target
from pigaming_app.storage.settings import Settings, folders

HELD_UP = 4.0  # s after which a picture is taken of what holds up real robots
FASTEST = 64.0  # times real time that a window shows
SLOWEST_RATE, FASTEST_RATE = 0.01, 10_000.0  # times real time that can be asked for
WATCHED = 150  # ticks before a picture in which shots, sparks and treads of it begin


def play(
    arguments: argparse.Namespace,
    goal: int | None,
    chosen: dict[str, Any],
    show: Callable[[Any], int],
    wrong: type[Exception],
) -> int:
    """Play what the command line asked for; `show` opens the arcade, `wrong` is raised for a bad value.

    `chosen`: settings of camera and radio.
    """
    teams = None
    if arguments.teams is not None:
        try:
            teams = [int(team) for team in arguments.teams.split(",")]
        except ValueError:
            raise wrong(f"--teams: {shown(arguments.teams)}; numbers such as 0,0,1,1 are needed") from None
    seats = [seat.strip() for seat in (arguments.seats or "human,normal").split(",")]
    names = list(BRAINS.get(arguments.game, {}))
    arena, minutes, seed, variant = arguments.arena, arguments.minutes, arguments.seed, arguments.variant
    setup = choose(arguments.game, seats, arena, minutes, seed, variant, teams, names, goal)
    speed = _speed(arguments.speed, wrong)
    real = _real(arguments, setup, speed, wrong)
    if real:
        _check_radio(chosen, wrong)
    plant = _plant(arguments, real, wrong)
    _check_targets(arguments.record, arguments.screenshot, wrong)
    if arguments.headless and not real:
        return _headless(arguments, setup, speed, plant)
    return _on_screen(arguments, setup, min(speed, FASTEST), real, plant, chosen, show, wrong)


def _check_targets(record: Path | None, screenshot: Path | None, wrong: type[Exception]) -> None:
    """Refuse before the match what could not be written after it. Raises `wrong` or NotSaved."""
    if screenshot is not None and screenshot.suffix.lower() != ".png":
        raise wrong(f"--screenshot: {screenshot}: the name of a picture ends in .png")
    if record is not None and screenshot is not None and os.path.realpath(record) == os.path.realpath(screenshot):
        raise wrong(f"--record: {record}: the picture has that name")
    for path in (record, screenshot):
        if path is not None:
            check_target(path)


def _plant(arguments: argparse.Namespace, real: list[int], wrong: type[Exception]) -> Callable[[Any], Plant]:
    """What makes the simulated robots: ideal ones, or with --robots FILE such as `fidelity` measured."""
    if arguments.robots is None:
        return SimPlant
    if real or arguments.record is not None:
        raise wrong("--robots: goes without --real and --record")
    try:
        drivetrains = parse(read_text(arguments.robots), arguments.robots.name)
    except DrivetrainError as error:
        raise wrong(str(error)) from None
    except (OSError, ParseError) as error:
        raise wrong(f"{arguments.robots}: cannot be read ({reason(error)})") from None
    return lambda world: SimPlant(world, drivetrains)


def _real(arguments: argparse.Namespace, setup: Setup, speed: float, wrong: type[Exception]) -> list[int]:
    """The seats with real robots, from 0 on; in an emulated arena all, if nothing else is said."""
    text = arguments.real if arguments.real is not None else "all" if arguments.emulate is not None else ""
    there = [i for i, seat in enumerate(setup.seats) if seat.brain != "off"]
    try:
        seats = there if text == "all" else sorted({int(one) - 1 for one in text.split(",") if one})
    except ValueError:
        raise wrong(f"--real: {shown(text)}; numbers such as 1,3, or all, are needed") from None
    if stray := [seat + 1 for seat in seats if seat not in there]:
        raise wrong(f"--real: nobody sits on seat {shown(stray[0])}")
    if seats and arguments.record is not None:
        raise wrong("--record: what real robots do cannot be played out again; record it with `fidelity record`")
    if seats and speed != 1.0 and not arguments.headless:
        raise wrong("--speed: real robots drive as fast as they drive")
    if seats and arguments.headless and arguments.emulate is None:
        raise wrong("--headless: real robots need the picture on their mat; add --emulate for emulated ones")
    return seats


def _check_radio(chosen: dict[str, Any], wrong: type[Exception]) -> None:
    """Refuse robots whose motors would not stop by themselves, whether the command line or the settings name them."""
    from pigaming_app.hardware.session.real import unfit

    settings, _ = Settings.load(folders().config)
    settings.radio = chosen.get("radio", settings.radio)
    if reason := unfit(settings):
        raise wrong(f"--radio: {reason}")


def _speed(text: str, wrong: type[Exception]) -> float:
    """How many times real time; infinity for "max"."""
    if text == "max":
        return float("inf")
    try:
        speed = float(text)
    except ValueError:
        speed = 0.0
    if not SLOWEST_RATE <= speed <= FASTEST_RATE:
        raise wrong(f"--speed: {shown(text)}; a number from {SLOWEST_RATE:g} to {FASTEST_RATE:g}, or max, is needed")
    return speed


def _headless(
    arguments: argparse.Namespace,
    setup: Setup,
    speed: float,
    plant: Callable[[Any], Plant],
) -> int:
    match = seated(setup, plant)
    if any(seat.brain == "human" for seat in setup.seats):
        print("PiGaming: nobody can steer without a window; the human seat stands still", file=sys.stderr)
    began = perf_counter()
    photographer = Photographer(match, arguments.screenshot, arguments.at) if arguments.screenshot else None
    while not match.over:
        match.tick()
        if photographer:
            photographer.watch()
        ahead = match.seconds / speed - (perf_counter() - began)
        if ahead > 0.0:
            sleep(ahead)
    try:
        if arguments.record:
            save(match, arguments.record)
    finally:
        _tell(match, arguments.json, perf_counter() - began)
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
        """A tick has been played."""
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
    arguments: argparse.Namespace,
    setup: Setup,
    speed: float,
    real: list[int],
    plant: Callable[[Any], Plant],
    chosen: dict[str, Any],
    show: Callable[[Any], int],
    wrong: type[Exception],
) -> int:
    """In a window; or, with emulated robots, without one and as fast as this machine can."""
    from pigaming_app.scenes.app import Options
    from pigaming_app.scenes.flow.context import Context
    from pigaming_app.scenes.flow.stack import Scene
    from pigaming_app.scenes.lobby.scene import game_choice
    from pigaming_app.scenes.play.scene import MatchScene
    from pigaming_app.scenes.robots.start_match import match_of
    from pigaming_app.ui.input.events import Device

    made: list[MatchScene] = []
    began, shot = perf_counter(), False

    def scene(context: Context) -> Scene:
        """People take the pads that are there, then the key clusters."""
        nonlocal began
        began = perf_counter()
        free = [*context.controls.pads(), *(Device("keys", k) for k in range(ROBOTS))]
        people = [i for i, seat in enumerate(setup.seats) if seat.brain == "human"]
        devices = dict(zip(people, free, strict=False))
        seats = [devices.get(i) for i in range(ROBOTS)]
        if real:
            shown = match_of(context, setup, seats, real, speed, game_choice)
        else:
            shown = MatchScene(context, setup, seats, speed, plant, game_choice)
        if isinstance(shown, MatchScene):
            made.append(shown)
        return shown

    def due() -> bool:
        """The time of the picture has come, or will not come because real robots are missing."""
        nonlocal shot
        if made and not made[0].stuck:
            shot = bool(made[0].match.over or made[0].match.seconds >= arguments.at)
        else:
            shot = perf_counter() - began > arguments.at + HELD_UP
        return shot

    def over() -> bool:
        return bool(arguments.headless and (not made or made[0].match.over))

    code = show(
        Options(
            first=scene,
            kiosk=arguments.kiosk,
            display=None if arguments.display is None else arguments.display - 1,
            shot=arguments.screenshot,
            shot_due=due,
            headless=arguments.headless,
            step=DT if arguments.headless else None,
            over=over,
            emulate=arguments.emulate,
            chosen=chosen,
        )
    )
    if made and arguments.headless and not arguments.screenshot:
        _tell(made[0].match, arguments.json, made[0].match.seconds)
    if made and arguments.record:
        save(made[0].match, arguments.record)
    if code == 0 and arguments.screenshot and not shot:
        raise wrong("--screenshot: the match was left before its time, so there is no picture")
    return code if made or not arguments.headless else 2  # no match: why not has been said


def _camera(match: Match) -> Any:
    """A camera that needs no window."""
    os.environ["SDL_VIDEODRIVER"] = os.environ["SDL_AUDIODRIVER"] = "dummy"
    from pigaming_app.scenes.views.screenshot import Screenshot

    return Screenshot(match)


def _tell(match: Match, as_json: bool, seconds: float) -> None:
    """The table of results."""
    outcome = match.outcome()
    if as_json:
        rows = [
            {
                "seat": row.seat + 1,
                "place": row.place,
                "team": row.team,
                "score": row.score,
                **row.facts,
                "times": row.times,
            }
            for row in outcome.rows
        ]
        told = {"game": match.setup.game, "arena": match.setup.arena, "winners": [seat + 1 for seat in outcome.winners]}
        print(json.dumps({**told, "rows": rows, "match_seconds": outcome.seconds, "seconds": seconds}))
        return
    for row in outcome.rows:
        brain = match.setup.seats[row.seat].brain
        facts = "  ".join(
            f"{name} {value:.0%}" if name == "aim" else f"{name} {round(value, 2):g}"
            for name, value in row.facts.items()
        )
        print(f"{row.place}.  P{row.seat + 1} {brain:8} {row.score:+4d}   {facts}")
