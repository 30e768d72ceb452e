"""The jobs `robots` and `fidelity`, without hardware and on the emulated arena."""

import json
import socket
import sys
from math import cos, sin
from typing import cast

import pytest

from pigaming_app.hardware.calibration.quality import CameraQuality
from pigaming_app.hardware.emulator.xbee import EmulatedCarrier as EmulatedCarrier
from pigaming_app.hardware.emulator.xbee import Module
from pigaming_app.hardware.radio.packets import DEADMAN, EMPTY, PARKED, RESTARTED
from pigaming_app.hardware.radio.protocol import LinkQuality
from pigaming_app.hardware.radio.xbee_setup import Carrier
from pigaming_app.hardware.session.robot_session import RobotSession
from pigaming_app.hardware.session.store import save_pairing
from pigaming_app.hardware.signals import ExposureState
from pigaming_app.jobs.cli import main
from pigaming_app.jobs.mat import robots, sessions
from pigaming_app.sim.drivetrain import MM, NOMINAL, Drivetrain, Wheel, parse, to_toml
from pigaming_app.storage.settings import Settings, folders
from tests.hardware.mat import TRUE, Mat
from tests.hardware.wire import Time


@pytest.fixture(autouse=True)
def _heard_for_a_moment(monkeypatch):
    monkeypatch.setattr(robots, "LISTEN", 0.3)


def output(capsys, *arguments):
    """The JSON object that a job prints."""
    assert main([*arguments, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_without_hardware_everything_that_is_missing_is_said(capsys):
    found = output(capsys, "robots", "--port", "/dev/nowhere")
    assert "/dev/nowhere" in found["radio"]
    assert found["eyes"]
    assert [one["heard"] for one in found["robots"]] == [False] * 4
    assert main(["robots", "--port", "/dev/nowhere"]) == 0
    assert "robot 1   no reports" in capsys.readouterr().out


def test_the_arena_number_is_drawn_once_and_changed_on_request(capsys):
    drawn = output(capsys, "robots", "--port", "/dev/nowhere")["arena"]
    assert 1 <= drawn <= 16383
    assert Settings.load(folders().config)[0].arena_id == drawn
    assert main(["robots", "--port", "/dev/nowhere", "--arena", "4711", "--channel", "C"]) == 0
    assert "arena     4711 (make flash ADDRESS=1 ARENA=4711)" in capsys.readouterr().out
    assert Settings.load(folders().config)[0].radio_channel == 0x0C


class Radios:
    """A session with the emulated XBee of robot 3 in the carrier."""

    arena_id = 4711

    def __init__(self):
        self.time, self.module = Time(), Module(0, 0, 9600, top_channel=0x17)

    def carrier(self, number):
        return Carrier(EmulatedCarrier(self.module, self.time).open, self.time, "COM3")

    def tick(self):
        self.time.now += 0.02

    def end(self):
        pass


def test_a_radio_is_written_and_refusals_are_one_line(capsys, monkeypatch, refused):
    session = Radios()
    monkeypatch.setattr(sessions, "new_session", lambda *_: session)
    written = output(capsys, "robots", "--radio-setup", "3", "--channel", "D", "--pan", "ABC")
    assert written == {"radio": 3, "arena": 4711, "CH": 13, "ID": 0xABC, "MY": 3, "DH": 0, "DL": 0, "BD": 6, "AP": 0}
    assert session.module.saved[b"ID"] == 0xABC
    assert "refuses CH 1A" in refused("robots", "--radio-setup", "0", "--channel", "1A")


@pytest.mark.parametrize(
    "words",
    [
        *(["--robot", "2"], ["--robot", "1"], ["--on-blocks"], ["--network", "X"], ["--password"]),
        *(["--board", "relay"], ["--no-wait"], ["update", "--robot", "2"], ["check", "api2", "--board", "esp32"]),
    ],
)
def test_what_belongs_to_setup_is_refused_without_it(refused, words):
    option = next(word for word in words if word.startswith("--"))
    assert f"{option} goes with setup" in refused("robots", *words)


@pytest.mark.parametrize("wish", ["--pair", "--latency", "--drive"])
def test_robots_that_nobody_sees_are_not_moved(refused, wish):
    line = refused("robots", wish)
    assert "calibrat" in line or "opencv" in line.lower()


def test_a_check_of_nothing_names_what_else_there_is(refused):
    assert "setup, update, or check" in refused("robots", "check")


def test_robots_are_updated_over_the_air_only_while_no_arcade_has_the_port(refused, monkeypatch):
    monkeypatch.setattr("pigaming_app.jobs.mat.robots.wifi_setup.APPEARS", 0.1)
    assert "update 2" in refused("robots", "update", "5")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as arcade:
        arcade.bind(("", 0))
        monkeypatch.setattr(
            "pigaming_app.hardware.radio.wifi.WifiNetwork.__init__.__defaults__", (arcade.getsockname()[1], "")
        )
        assert "end the arcade first" in refused("robots", "update")
    assert "No robot on Wi-Fi calls" in refused("robots", "update")


@pytest.mark.parametrize("job", [["robots"], ["fidelity", "record", "run.jsonl"]])
def test_without_opencv_there_is_no_emulated_arena_and_one_sentence(refused, monkeypatch, job):
    monkeypatch.setitem(sys.modules, "cv2", None)
    assert "opencv" in refused(*job, "--emulate").lower()


@pytest.mark.long
@pytest.mark.again
def test_the_emulated_robots_hold_at_full_speed(capsys, monkeypatch):
    pytest.importorskip("cv2")
    monkeypatch.setattr("pigaming_app.hardware.commissioning.speed_trial.ROUND", 6.0)
    assert main(["robots", "--emulate", "--drive", "--json"]) == 0
    drive = json.loads(capsys.readouterr().out)["drive"]
    assert drive == [{"robot": robot, "top_mm_s": None, "late": False} for robot in (1, 2, 3, 4)]
    assert not Settings.load(folders().config)[0].tops, "those of emulated robots are not kept"


@pytest.mark.long
def test_the_emulated_robots_are_heard_and_seen_and_paired(capsys):
    pytest.importorskip("cv2")
    found = output(capsys, "robots", "--emulate", "--pair")
    assert found["radio"] is None
    assert found["picture"] is None
    for one in found["robots"]:
        assert one["heard"]
        assert one["seen"]
        assert 4.8 < one["battery"] < 5.5
    assert [(one["radio"], one["marker"], one["case"]) for one in found["pairing"]] == [
        (i, i, "fits") for i in range(1, 5)
    ]


@pytest.mark.parametrize(
    ("words", "kept"),
    [
        (["--radio", "udp"], ("udp", "")),
        (["--radio", "thymio", "--port", "/dev/nowhere"], ("thymio", "/dev/nowhere")),
        (["--radio", "stock"], ("api2", "")),  # plays no match
        (["--radio", "udp", "--emulate", "--arena", "5"], ("api2", "")),
    ],
)
def test_radio_and_port_that_are_given_once_are_kept(capsys, monkeypatch, words, kept):
    monkeypatch.setattr(robots, "look", lambda options: {})
    monkeypatch.setattr(robots, "_print", lambda status: None)
    main(["robots", *words])
    settings, _ = Settings.load(folders().config)
    assert (settings.radio, settings.port) == kept


def test_the_pairing_is_remembered():
    save_pairing([0, 2, 1, 3], 0.05)
    settings, text = Settings.load(folders().config)
    assert settings.radios == [1, 3, 2, 4]
    assert text == []


class Session:
    """A session with the robots of a simulated mat."""

    quality, network = CameraQuality(detection=0.6, anyway=True), None

    def __init__(self, *_):
        self.mat = Mat()
        self.rig, self.mm, self.tick = self.mat.rig, MM, self.mat.pass_time
        self.end = self.rig.close

    def open(self):
        return self.rig


@pytest.mark.parametrize(
    ("exposure", "warning"),
    [(1 / 60, "Calibrated anyway: about 60 % of the markers are found."), (1 / 30, "smear at 1/30\u00a0s")],
)
def test_flags_of_reports_and_a_warning_about_the_picture_are_printed(monkeypatch, capsys, exposure, warning):
    session, wished = Session(), robots.RobotsOptions()
    mat = session.mat
    monkeypatch.setattr(mat, "exposure", ExposureState(exposure), raising=False)
    monkeypatch.setattr(mat, "quality", lambda robot: LinkQuality(1.0, None, None))
    for robot, flags in zip(mat.robots, (EMPTY, PARKED, DEADMAN, DEADMAN | RESTARTED), strict=True):
        robot.flags = flags
    status = robots._full_status(cast(RobotSession, session), wished)
    assert warning in status["picture"]
    assert [[name for name in robots.STATES if one[name]] for one in status["robots"]] == [
        ["empty"],
        ["parked"],
        ["deaf"],
        ["deaf", "restarted"],
    ]
    robots._print({"ports": (), "cameras": (), "arena": 7, **status})
    printed = capsys.readouterr().out
    assert warning in printed
    for state in robots.STATES.values():
        assert f", {state}" in printed


@pytest.mark.long
def test_robots_are_recorded_identified_and_replayed(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(sessions, "new_session", Session)
    run, out = tmp_path / "run.jsonl", tmp_path / "robots.toml"
    assert output(capsys, "fidelity", "record", str(run), "--seconds", "24")["robots"] == [1, 2, 3, 4]
    found = output(capsys, "fidelity", "identify", str(run), "--out", str(out))
    for one in found["robots"].values():
        assert one["after_mm"][0] < 0.1 * one["before_mm"][0]
    for train in parse(out.read_text(), "robots.toml"):
        assert train.left.speed == pytest.approx(TRUE.left.speed, rel=0.01)
    again = output(capsys, "fidelity", "replay", str(run), "--robots", str(out))
    assert all(one["5"] < 40.0 for one in again["robots"].values())


def test_an_earlier_run_stays_where_no_robot_can_drive(tmp_path, refused, monkeypatch):
    class Nobody(Session):
        def __init__(self, *_):
            super().__init__()
            monkeypatch.setattr(self.rig, "telemetry", lambda robot: None)

    monkeypatch.setattr(sessions, "new_session", Nobody)
    run = tmp_path / "run.jsonl"
    run.write_text("kept")
    assert "seen and heard" in refused("fidelity", "record", str(run))
    assert run.read_text() == "kept"


def test_drivetrains_of_emulated_robots_are_kept_apart_from_real_ones(tmp_path, capsys):
    run = tmp_path / "run.jsonl"
    head = {"kind": "head", "format": "pigaming-run-1", "mm": 1.3, "emulated": True}
    sent = {"kind": "sent", "time": 0.0, "seq": 1, "wheels": [[0.3, 0.2], None, None, None]}
    seen = []
    for i in range(450):  # wheels 62 px apart at 0.3 and 0.2 of 758 px/s: 189 px/s and 1.22 rad/s
        turn = 1.22 * 0.05 * i
        at = [0, 800.0 + 155.0 * sin(turn), 450.0 - 155.0 * cos(turn), turn]
        seen.append({"kind": "seen", "captured": 0.5 + 0.05 * i, "time": 0.6 + 0.05 * i, "fixes": [at]})
    run.write_text("".join(json.dumps(line) + "\n" for line in [head, sent, *seen]))
    found = output(capsys, "fidelity", "identify", str(run))
    assert found["out"].endswith("robots-emulated.toml")
    assert found["robots"]["1"]["after_mm"][2] < 20.0


@pytest.mark.parametrize(
    "arguments",
    [
        ["fidelity", "identify", "nowhere.jsonl"],
        ["fidelity", "replay", "nowhere.jsonl"],
        ["fidelity", "dance", "run.jsonl"],
        ["fidelity", "record", "run.jsonl"],
        ["robots", "--emulate", "-1"],
        ["calibrate", "--emulate", "-1", "--json"],
        ["fidelity", "record", "run.jsonl", "--emulate", "--seconds", "-3"],
        ["robots", "--camera", "-5"],
        ["robots", "--arena", "16384"],
        ["robots", "--channel", "1B"],
        ["robots", "--pan", "x"],
        ["robots", "--radio-setup", "5"],
        ["robots", "--radio-setup", "1", "--port", "/dev/nowhere"],
        ["robots", "--arena", "3", "--emulate"],
        ["calibrate", "--camera", "99", "--json"],
        ["fidelity", "record", "run.jsonl", "--emulate", "--seconds", "nan"],
    ],
)
def test_what_cannot_be_done_is_one_line(arguments, refused):
    refused(*arguments)


def test_simulated_robots_drive_like_measured_ones_on_request(tmp_path, capsys):
    slow = Drivetrain(Wheel(60.0, 0.0), Wheel(60.0, 0.0), 62.0, 0.2, 0.1)
    file = tmp_path / "robots.toml"
    file.write_text(to_toml([slow] * 4))
    race = ["play", "race", "--seats", "level5,level5", "--headless", "--speed", "max", "--minutes", "0.4"]
    ideal, measured = output(capsys, *race), output(capsys, *race, "--robots", str(file))
    assert max(row["laps"] for row in ideal["rows"]) >= 1
    assert max(row["laps"] for row in measured["rows"]) == 0


@pytest.mark.parametrize(
    ("text", "more"), [("", []), ("[[robot]]\nleft = 3", []), (None, []), (to_toml([NOMINAL]), ["--real", "1"])]
)
def test_robots_that_cannot_be_read_are_one_line(tmp_path, refused, text, more):
    file = tmp_path / "robots.toml"
    if text is not None:
        file.write_text(text)
    refused("play", "--headless", "--robots", str(file), *more)


def test_the_configuration_of_a_wifi_robot_has_the_arena_and_a_key_drawn_once(capsys):
    printed = []
    for _ in range(2):
        assert main(["robots", "--wifi-config", "2", "--arena", "77"]) == 0
        printed.append(capsys.readouterr().out)
    assert printed[0] == printed[1]
    values: dict[str, object] = {}
    exec(printed[0], values)
    settings, _ = Settings.load(folders().config)
    assert (values["ROBOT"], values["ARENA"], values["NAME"]) == (2, 77, "Robot 2")
    assert values["KEY"] == settings.wifi_key
    assert len(bytes.fromhex(settings.wifi_key)) == 16


@pytest.mark.parametrize("option", ["--wifi-config", "--microbit"])
def test_no_file_of_a_robot_is_printed_with_numbers_that_are_lost(refused, home, option):
    home.mkdir()
    (home / "config").touch()
    assert "cannot be saved" in refused("robots", option, "2")


@pytest.mark.parametrize("wanted", [["--wifi-config", "2"], ["--microbit", "0"], ["--microbit", "2"]])
def test_a_file_of_a_robot_is_written_in_utf_8_and_its_predecessor_kept(capsys, tmp_path, wanted):
    assert main(["robots", *wanted, "--arena", "77"]) == 0
    printed = capsys.readouterr().out
    file = tmp_path / "folder" / "config.py"
    file.parent.mkdir()
    for _ in range(2):
        assert main(["robots", *wanted, "--out", str(file)]) == 0
        assert capsys.readouterr().out == f"{file}\n"
        assert file.read_bytes() == printed.encode()
        file.write_text(mine := f"{printed}PASSWORD = 'mine'\n")
    assert main(["robots", *wanted, "--out", str(file)]) == 0
    assert file.with_name("config.py.bak").read_text() == mine


@pytest.mark.parametrize(
    "words",
    [
        ["--out", "config.py"],
        ["--wifi-config", "2", "--out", "."],
        ["--wifi-config", "2", "--out", "nowhere/config.py"],
    ],
)
def test_a_file_of_no_robot_or_without_a_place_is_one_line(refused, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    refused("robots", *words)
    assert [found.name for found in tmp_path.iterdir()] == ["home"]


def test_the_programs_of_micro_bits_have_the_number_of_the_arena(capsys):
    for number, line in ((0, "ARENA = 77  #"), (2, "ROBOT, ARENA = 2, 77  #")):
        assert main(["robots", "--microbit", str(number), "--arena", "77"]) == 0
        text = capsys.readouterr().out
        compile(text, "main.py", "exec")
        assert line in text
