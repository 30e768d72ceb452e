"""A match with real robots is recorded, saved, and played again on the screen; `fidelity` reads the same file."""

import json
from pathlib import Path

import pytest

from pigaming_app.games.replay import ReplayError
from pigaming_app.hardware import recordings
from pigaming_app.hardware.control import match_recording
from pigaming_app.hardware.control.recorded_plant import RobotTrack
from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.session.robot_session import RobotSession
from pigaming_app.jobs import play as play_job
from pigaming_app.jobs.cli import Parser
from pigaming_app.jobs.terminal.options import declare_job
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.scenes.features.replays import timeline_of, verify
from pigaming_app.scenes.files import load_replay, save_replay
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.mat import replay_faults
from pigaming_app.scenes.mat.mat import SessionMat
from pigaming_app.scenes.mat.replay_faults import ReplayFaults
from pigaming_app.scenes.mat.replays import RealReplay
from pigaming_app.scenes.mat.robots.fault_page import FaultPage
from pigaming_app.scenes.mat.robots.match_scene import RealMatch
from pigaming_app.scenes.replays.watch import ReplayScene
from pigaming_app.sim.record import digest
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.widgets.caption import caption
from tests.hardware.mat import Mat
from tests.scenes.arcade import Arcade
from tests.scenes.mat.robots.test_real_match import begun, play, started, until

pytest.importorskip("cv2")


class MatSession(RobotSession):
    """A session on the simulated mat, whose robots begin at their places."""

    emulated, mm = True, 1.3

    def __init__(self) -> None:
        self.mat = Mat()

    def open(self) -> Rig:
        return self.mat.rig

    def advance(self, seconds: float) -> float:
        self.mat.pass_time(seconds)
        return seconds


@pytest.fixture
def played(arcade: Arcade) -> RealMatch:
    """A match of one real robot against a simulated one, with a fault that paused it."""
    session = MatSession()
    arcade.context.mat = SessionMat(arcade.context, session)
    match = begun(arcade, (0,))
    session.mat.robots[0].battery = 3.9
    until(arcade, FaultPage, 3.0)
    play(arcade, 1.0)
    session.mat.robots[0].battery = 5.0
    until(arcade, RealMatch)
    play(arcade, 2.4)
    return match


def test_a_recorded_match_ends_as_it_did_and_shows_its_faults(
    arcade: Arcade, played: RealMatch, tmp_path: Path
) -> None:
    save_replay(played.match, file := tmp_path / "a.replay")
    replay = load_replay(file)
    assert isinstance(replay, RealReplay)
    assert replay.length == played.match.state.tick > 50
    assert verify(replay)
    timeline = timeline_of(replay)
    timeline.explore(replay.length)
    assert digest(timeline.match_at(replay.length).state) == replay.digest
    fault = replay.recording.faults[0]
    assert (fault.name, fault.robot, fault.pauses) == ("empty", 0, True)
    assert fault.seconds > 1.0
    scene = ReplayScene(arcade.context, replay)
    scene.draw(arcade.screen)
    before = arcade.screen.get_at((960, 240))
    scene.jump(fault.tick)
    scene.draw(arcade.screen)
    assert arcade.screen.get_at((960, 180)) != before, "a plate over the arena"
    run = recordings.load(file)
    assert run.emulated
    assert 0 in run.courses

    parts = match_recording.unpack(file.read_bytes())
    known = json.loads(parts["incidents.json"])
    plain, track = parts["match.replay"], replay.recording.track
    for wrong in ({"robot": 4}, {"robot": "x"}, {"tick": -1}, {"tick": None}, {"seconds": float("nan")}, {"name": "x"}):
        parts["incidents.json"] = json.dumps(known | {"faults": [known["faults"][0] | wrong]}).encode()
        with pytest.raises(match_recording.MatchFileError):
            match_recording.recording_of(parts, replay.length)
    shorter = match_recording.MatchRecording(track.first(9))
    later = RobotTrack([*track._numbers[32:], *track._numbers[:32]])
    for name, raw in {
        "short": match_recording.pack(plain, shorter),
        "cut": file.read_bytes()[:-50],
        "other": match_recording.pack(b"{}", replay.recording),
    }.items():
        (bad := tmp_path / name).write_bytes(raw)
        with pytest.raises(ReplayError, match=f"^{name}: "):
            load_replay(bad)
    (edited := tmp_path / "edited").write_bytes(match_recording.pack(plain, match_recording.MatchRecording(later)))
    assert not verify(load_replay(edited))


def test_the_cause_is_among_the_faults_that_a_replay_shows(monkeypatch: pytest.MonkeyPatch, controls: Controls) -> None:
    """A frozen camera loses all robots at once; there is room for three plates."""
    arcade, shown = Arcade(controls), list[str]()
    monkeypatch.setattr(replay_faults, "plate", lambda name, *rest: shown.append(name) or caption("", (0, 0, 0)))  # type: ignore[func-returns-value]
    faults = ReplayFaults((), Words("en"))
    fault = match_recording.RecordedFault
    faults.faults = [fault("camera", None, 9, True), *(fault("lost", i, 9, True) for i in range(3))]
    faults.faults += [fault("deadman", i, 10, False) for i in range(3)]
    faults.draw(arcade.screen, 20)
    assert shown == ["camera", "lost", "lost"]
    for name in match_recording.NAMES:
        faults.faults = [fault(name, 3, 9, True, 60.0)]
        faults.draw(arcade.screen, 20)
        assert shown[-1] == name


def test_a_match_without_people_ends_at_a_fault_that_needs_them(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    session = MatSession()
    arcade.context.mat = SessionMat(arcade.context, session)

    def show(options: Options) -> int:
        """The arcade, in which somebody holds robot 1."""
        assert options.first_scene
        arcade.open(scene := options.first_scene(arcade.context))
        assert isinstance(scene, RealMatch)
        started(arcade, scene)
        monkeypatch.setattr(session.mat.robots[0], "roll", lambda: None)
        for _ in range(500):
            if options.should_close():
                return 0
            arcade.frame(1 / 50)
        raise AssertionError("it waits for ever")

    monkeypatch.setattr(play_job, "show", show)
    declare_job(parser := Parser(), play_job)
    line = f"pitanks --emulate --headless --real 1 --seats level3,level1 --minutes 2 --record {tmp_path / 'a.replay'}"
    found = parser.parse_args(line.split())
    with pytest.raises(Refusal, match="Robot 1 does not follow"):
        found.start(found)
    assert load_replay(tmp_path / "a.replay").length > 10
