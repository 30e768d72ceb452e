"""The figures of `bench robots`: the proof of the robot loop on the emulated arena, in two processes.

Robots are tracked at 0.35 m/s by a 1080p camera at 30 and at 60 frames/s with a total latency of 80 ms; every fault of
the table occurs once; twenty minutes of all games are played with random button mashing, one match of PiTanks and of
each plug-in by its best level, and 2 % of packets and frames lost; whole arcades fail or are killed (see
robots_arcade); and things on the mat are scanned, from above and by a tilted camera of 720p. Of several runs the worst
counts, except for times of computation, where the best counts: other programs can only add to them. `showing` and
`drivers` have figures of their own for each way of showing and each driver, see `proof.figures`.
"""

from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import replace
from importlib.util import find_spec
from typing import Any, NamedTuple, TypeVar

from pigaming_app.ai.registry import make_brain
from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.arenas import on_mat as on_mat_of
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane
from pigaming_app.hardware.commissioning.speed_trial import SpeedTrial
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.emulator.radio import RadioChannel
from pigaming_app.hardware.emulator.wifi.boards import NoMicroPython
from pigaming_app.hardware.proof import emergencies, figures, things
from pigaming_app.hardware.proof import trials as proving
from pigaming_app.hardware.proof.emergencies import EMERGENCIES, StopResult
from pigaming_app.hardware.proof.fleets import bed_of
from pigaming_app.hardware.proof.showings import SHOWINGS
from pigaming_app.hardware.proof.testbed import Testbed, one_core
from pigaming_app.hardware.proof.trials import ButtonMasher, FigureEight, MatchResult, TrackingResult
from pigaming_app.hardware.session.robot_session import RobotsUnavailable
from pigaming_app.jobs.bench import wifi
from pigaming_app.jobs.bench.processes import processes
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.plugins.parts import plugins
from pigaming_app.ui.i18n import english

Result = TypeVar("Result")
Figures = dict[str, Any]  # floats, and groups of them
Run = tuple[float, int]  # frames/s, seed
RATES = (30.0, 60.0)  # frames/s
SECONDS = 20.0  # of tracking
MATCHES, MINUTES = 10, 2.0
TRIED = 20.0  # s, a round of a test drive
BEST = "level5"
SCENES = {False: range(1, 9), True: range(1, 6)}  # seeds of the scenes of things, by a tilted camera
LOST = 0.02  # share of packets, and of frames, in a match
TARGETS = {  # upper limits, but for frames_complete
    "pose_rmse_mm": 2.0,
    "pose_rmse_deg": 1.0,
    "tracker_ms": 4.0,
    "frames_complete": 0.995,
    "calibration_mean_mm": 1.5,
    "calibration_max_mm": 3.0,
    "wall_entry_mm": 5.0,
    "worst_stop_ms": 300.0,
    "arcade_worst_stop_ms": 300.0,
    "wifi_worst_stop_ms": 300.0,
    "false_alarms": 0.0,
    "things_mean_mm": 3.0,
    "things_worst_mm": 7.0,
    "things_tilted_mean_mm": 6.0,
    "things_tilted_worst_mm": 12.0,
    "things_missed": 0.0,
    "things_false": 0.0,
    "things_seconds": 2.0,
    "things_stall_ms": 50.0,
    "false_robots": 0.0,
    "breakdown_ms": 600.0,
    "breakdown_mm": 120.0,
    "outside_mm": 60.0,
}
SHOWING, BY_DRIVER = "showing", "drivers"  # groups of figures


class Unproven(Exception):
    """A proof failed; the text is one sentence."""


class MatMatch(NamedTuple):
    """One match on the mat. `brain`: of all robots; None: random button mashing. `carried`: the robots are set down on
    their places, else they drive there. `variant`: None for the game's default. `driver`: theirs, of FLEETS. `late`: s
    by which they respond later than it declares; `tried`: they drove a test drive before.
    """

    game: str
    arena: str
    fps: float
    seed: int
    minutes: float = MINUTES
    brain: str | None = None
    carried: bool = False
    variant: str | None = None
    driver: str = "api2"
    late: float = 0.0
    tried: bool = False


def measure(note: Callable[[str], None] = lambda line: None) -> Figures:
    """All figures by name, those of a group by its names; `note` receives a line for each finding. Raises Unproven."""
    with processes(2, one_core) as pool:
        followed = {(fps, seed): pool.submit(follow_alone, seed, fps) for seed in (1, 2) for fps in RATES}
        stopped = {fps: pool.submit(all_emergencies, int(fps), fps) for fps in RATES}
        calibrated = [pool.submit(calibration, seed) for seed in (1, 2, 3)]
        scanned = {tilted: pool.submit(things.trial, seeds, tilted) for tilted, seeds in SCENES.items()}
        shown = {name: pool.submit(figures.of_showing, name) for name in SHOWINGS}
        driven = {name: pool.submit(figures.of_driver, name) for name in figures.DRIVERS}
        on_wifi = wifi.submit(pool, note)
        played = [(job, pool.submit(on_mat, job)) for job in jobs()]
        tracks = _tracks(followed, note)
        stops = _stops(stopped, note)
        scans = _scans(scanned, note)
        matches = [_match(job, future, note) for job, future in played]
        boards = [_result(future, "calibrating") for future in calibrated]
        by_showing, by_driver = _group(SHOWING, shown, note), _group(BY_DRIVER, driven, note)
    try:
        wifi_stops = wifi.collect(on_wifi, note)
    except RuntimeError as reason:
        raise Unproven(f"Wi-Fi robots: {reason}") from reason
    serial, wifi_arcades = stops_outside(note)
    wifi_stops |= wifi_arcades
    return {
        "pose_rmse_mm": max(run.rmse_mm for run in tracks.values()),
        "pose_rmse_deg": max(run.rmse_deg for run in tracks.values()),
        "tracker_ms": max(min(run.tracker_ms for (rate, _), run in tracks.items() if rate == fps) for fps in RATES),
        "frames_complete": min(run.complete for run in tracks.values()),
        "calibration_mean_mm": max(board.mean_mm for board in boards),
        "calibration_max_mm": max(board.max_mm for board in boards),
        "wall_entry_mm": max(run.deepest_mm for run in matches),
        "worst_stop_ms": 1e3 * max(stops.values()),
        "false_alarms": float(sum(run.alarms for run in matches)),
        **arcade_figures(serial, wifi_arcades),
        **scans,
        **({"wifi_worst_stop_ms": 1e3 * max(wifi_stops.values())} if wifi_stops else {}),
        SHOWING: by_showing,
        BY_DRIVER: by_driver,
    }


def reached(found: Mapping[str, Any], group: str = "") -> dict[str, bool]:
    """True for each figure that meets its target; those of a group are named `GROUP.NAME.FIGURE`."""
    result = dict[str, bool]()
    for key, value in found.items():
        if isinstance(value, Mapping):
            result |= reached(value, f"{group}{key}.")
        else:
            limit = TARGETS[key]
            result[group + key] = value >= limit if key == "frames_complete" else value <= limit
    return result


def jobs() -> list[MatMatch]:
    """Twenty minutes of matches: all games, many arenas, both frame rates; PiTanks by its default and party rules.

    The last match of PiTanks and of each plug-in is played by its best level, all others by random button mashing.
    """
    result, with_best = [], {"pitanks", *(plugin.name for plugin in plugins())}
    count = max(MATCHES, len(games()))
    for i in range(count):
        game = list(games())[i % len(games())]
        places = arenas(game)
        round_ = i // len(games())
        variant = "party" if game == "pitanks" and round_ % 2 else None
        brain = BEST if game in with_best and i + len(games()) >= count else None
        result.append(
            MatMatch(game, places[round_ % len(places)], RATES[i % 4 == 3], i + 1, brain=brain, variant=variant)
        )
    return result


def on_mat(job: MatMatch, ground: GroundPlane | None = None) -> MatchResult:
    """Play a match on its own emulated mat, which is calibrated first unless a `ground` is given."""
    rules = games()[job.game].variants[job.variant] if job.variant else games()[job.game].default
    one, two, three, four = (Seat(job.brain or "random", team) for team in rules.teams)
    goal = max(rules.goals, default=0)
    setup = Setup(job.game, job.arena, (one, two, three, four), job.minutes, job.seed, rules.name, goal)
    channel = RadioChannel(loss=LOST, duplicates=LOST / 2, broken=LOST / 4)
    channel = replace(channel, soonest=channel.soonest + job.late, latest=channel.latest + job.late)
    bed = bed_of(job.driver, job.seed, ground, job.fps, LOST, channel)
    if job.tried:
        try_speeds(bed)
    arena = on_mat_of(job.game, load(job.game, job.arena), (), bed.rig.radius_in_play(range(ROBOTS)))
    match = Match(setup, lambda world: RealPlant(world, bed.rig), arena)
    for seat in range(ROBOTS):
        seed = ROBOTS * job.seed + seat
        match.sit(seat, make_brain(job.game, job.brain, seed) if job.brain else ButtonMasher(seed))
        if job.carried:
            robot = match.state.robots[seat]
            bed.arena.place(seat, (robot.x, robot.y, robot.heading))
    return proving.play(bed, match, 60.0 * job.minutes)


def try_speeds(bed: Testbed) -> None:
    """A test drive of all robots, as the wizard asks for. Raises RuntimeError if they are too late at any speed."""
    bed.session.find()
    drive = SpeedTrial(bed.rig, range(ROBOTS), TRIED)
    while not drive.tick():
        bed.tick()
    if drive.late or drive.held_up:
        raise RuntimeError(f"the test drive failed: {drive.late}")
    bed.lighting.show(busy=False)


def follow_alone(seed: int, fps: float) -> TrackingResult:
    """Track robots on figures of eight, on one core."""
    return proving.follow(FigureEight(Testbed(seed, fps)), SECONDS)


def calibration(seed: int) -> GroundPlane:
    """A calibration with its errors on the held-out board."""
    return Testbed(seed, RATES[0]).ground


def all_emergencies(seed: int, fps: float) -> dict[str, StopResult]:
    """All faults, one after the other, on different robots."""
    trail = FigureEight(Testbed(seed, fps))
    stops = {name: emergencies.stop(trail, name, i % ROBOTS) for i, name in enumerate(EMERGENCIES)}
    return {
        **stops,
        "program hangs": StopResult(emergencies.hang(trail), True),
        "program ends": StopResult(emergencies.leave(trail), True),
    }


def _tracks(followed: Mapping[Run, Future[TrackingResult]], note: Callable[[str], None]) -> dict[Run, TrackingResult]:
    tracks = {}
    for (fps, seed), future in followed.items():
        run = _result(future, f"tracking at {fps:.0f} fps, seed {seed}")
        tracks[fps, seed] = run
        note(
            f"tracked at {fps:.0f} fps, seed {seed}: {run.rmse_mm:.2f} mm, {run.rmse_deg:.2f} deg, "
            f"{run.tracker_ms:.2f} ms a frame, {100 * run.complete:.2f} % complete"
        )
    return tracks


def _stops(stopped: dict[float, Future[dict[str, StopResult]]], note: Callable[[str], None]) -> dict[str, float]:
    """Stopping times by fault, s. Raises Unproven where the game did not report the fault."""
    stops = {}
    for fps, future in stopped.items():
        for name, run in _result(future, f"emergencies at {fps:.0f} fps").items():
            note(f"{name} at {fps:.0f} fps: motors stood after {1e3 * run.seconds:.0f} ms")
            if not run.reported:
                raise Unproven(f"{name}: the fault was not reported")
            stops[f"{name} {fps}"] = run.seconds
    return stops


def _scans(scanned: Mapping[bool, Future[things.ThingsResult]], note: Callable[[str], None]) -> dict[str, float]:
    """Outlines of things from above at 1080p, and from a tilted camera with 720p. A mean is that of the worst thing."""
    figures: dict[str, float] = {}
    runs = {tilted: _result(future, "scanning things") for tilted, future in scanned.items()}
    for tilted, run in runs.items():
        name = "things_tilted" if tilted else "things"
        figures |= {f"{name}_mean_mm": max(run.means), f"{name}_worst_mm": max(run.worsts)}
        note(
            f"{'720p, tilted' if tilted else '1080p'}: {len(run.means)} things found, {run.missed} missed, {run.false} "
            f"false, outlines {sum(run.means) / len(run.means):.2f} mm on average, {max(run.worsts):.1f} mm at most, "
            f"computed in {run.seconds:.1f} s"
        )
    return figures | {
        "things_missed": float(sum(run.missed for run in runs.values())),
        "things_false": float(sum(run.false for run in runs.values())),
        "things_seconds": min(run.seconds for run in runs.values()),
        "things_stall_ms": 1e3 * min(run.stall for run in runs.values()),
    }


def _match(job: MatMatch, future: Future[MatchResult], note: Callable[[str], None]) -> MatchResult:
    """The result of a match. Raises Unproven."""
    run = _result(future, f"{job.game} in {job.arena}, seed {job.seed}")
    note(
        f"{job.game} in {job.arena} at {job.fps:.0f} fps: played to its end in {run.seconds:.0f} s, "
        f"{run.paused:.1f} s of them paused, places taken in {run.places:.0f} s, {run.deepest_mm:.1f} mm into a wall, "
        f"{run.alarms} false alarms"
    )
    return run


def stops_outside(note: Callable[[str], None]) -> tuple[dict[str, float], dict[str, float]]:
    """Stopping times by failure of a whole arcade, s: by a serial line, and on Wi-Fi; {} if it cannot be tried.

    Raises Unproven.
    """
    from pigaming_app.jobs.bench import robots_arcade

    serial, on_wifi = dict[str, float](), dict[str, float]()
    try:
        if find_spec("serial") is not None:
            serial = robots_arcade.by_serial_line(note)
        else:
            note("whole arcades were not tried: pyserial is not installed")
    except OSError as reason:
        note(f"whole arcades were not tried: {reason}")
    except (RuntimeError, CalibrationError) as reason:
        raise Unproven(f"arcade: {reason}") from reason
    try:
        on_wifi = robots_arcade.by_wifi(note)
    except NoMicroPython as reason:
        note(f"whole arcades with Wi-Fi robots were not tried: {reason}")
    except (OSError, RuntimeError, CalibrationError) as reason:
        raise Unproven(f"arcade on Wi-Fi: {reason}") from reason
    return serial, on_wifi


def arcade_figures(serial: Mapping[str, float], on_wifi: Mapping[str, float]) -> dict[str, float]:
    """The figure of the worst failure of a whole arcade, from stopping times in s; none without any."""
    stops = [*serial.values(), *on_wifi.values()]
    return {"arcade_worst_stop_ms": 1e3 * max(stops)} if stops else {}


def _group(
    group: str, submitted: Mapping[str, Future[figures.Figures]], note: Callable[[str], None]
) -> dict[str, figures.Figures]:
    """Figures of each way of showing, or each driver; those without MicroPython are left out. Raises Unproven."""
    found = dict[str, figures.Figures]()
    for name, future in submitted.items():
        try:
            found[name] = _result(future, f"{group}, {name}")
        except RobotsUnavailable as reason:
            note(f"{name} was not tried: {english().sentence(reason.message)}")
            continue
        except NoMicroPython as reason:
            note(f"{name} was not tried: {reason}")
            continue
        note(f"{name}: " + ", ".join(f"{key} {value:.4g}" for key, value in found[name].items()))
    return found


def _result(future: Future[Result], name: str) -> Result:
    """The result of a process. Raises Unproven."""
    try:
        return future.result()
    except CalibrationError as reason:
        raise Unproven(f"{name}: {english().long_sentence(reason.message)}") from reason
    except RuntimeError as reason:
        raise Unproven(f"{name}: {reason}") from reason
