"""What `test_commands` changes in a command before it runs, and which commands it only parses, each with its reason.

Commands are parsed as printed; lengths are limited afterwards. A row that fits no command fails the test.
"""

from dataclasses import dataclass

from pigaming_app import ROOT
from pigaming_app.ai.networks.files import BRAINS


@dataclass(frozen=True)
class Placeholder:
    """A part of a command, as a regular expression, and what stands in its place."""

    part: str
    instead: str
    reason: str


@dataclass(frozen=True)
class Elsewhere:
    """Commands that are parsed only. `proof`: the file that runs them, below the project's folder."""

    command: str  # a regular expression for the whole command
    reason: str
    proof: str


NAME, OPTION, VALUE = "a name to fill in", "an option that may be left out", "an option without its value"
EMPTY = "commands run in an empty folder"

PLACEHOLDERS = (
    Placeholder(r" \[(-[^\]]*)\]", r" \1", OPTION),
    Placeholder(r"\bGAME BRAIN BRAIN …", "pitanks idle random", NAME),
    Placeholder(r"\bNAME hand2|\bLEFT RIGHT", "hand1 hand2", NAME),
    Placeholder(r"\bnew-game NAME", "new-game hide", NAME),
    Placeholder(r"\bGAME\b", "pitanks", NAME),
    Placeholder(r"\bJOB\b", "duel", NAME),
    Placeholder(r"\bBRAIN\b", "net", NAME),
    Placeholder(r"path/to/file\.toml", "mine.toml", NAME),
    Placeholder(r"\bassets/brains/(?=\w)", f"{BRAINS.as_posix()}/", EMPTY),
    Placeholder(r"\bpigaming_football/brains/(?=\w)", f"{(ROOT / 'pigaming_football/brains').as_posix()}/", EMPTY),
    Placeholder(r"--hands HANDS\b", "--hands player", NAME),
    Placeholder(r"--seats LEVEL\b", "--seats level3", NAME),
    Placeholder(r"--variant V\b", "--variant party", NAME),
    Placeholder(r"--arena A\b", "--arena islands", NAME),
    Placeholder(r"\bB,B,B,B\b", "level3,level3,level3,level3", NAME),
    Placeholder(r"--seed S\b", "--seed 1", NAME),
    Placeholder(r"--matches N\b", "--matches 400", NAME),
    Placeholder(r"\bevent run (FILE|(?=--headless))", "event run cup.json ", NAME),
    Placeholder(r"\bpeople fit FILES", "people fit match.replay", NAME),
    Placeholder(r"\breplay FILE", "replay match.replay", NAME),
    Placeholder(r"--robots FILE", "--robots robots.toml", NAME),
    Placeholder(r"--csv FILE --curve FILE\.png", "--csv curve.csv --curve curve.png", NAME),
    Placeholder(r"^pigaming play …", "pigaming play --seats idle,idle --headless", "any options"),
    Placeholder(r"^pigaming train …", "pigaming train qlearning --out any.npz", "any options"),
    Placeholder(r"play --seats$", "play --seats level1,level2 --headless", VALUE),
    Placeholder(r"play --record$", "play --record match.replay --seats idle,idle --headless", VALUE),
    Placeholder(r"play --seed$", "play --seed 3 --seats idle,idle --headless", VALUE),
    Placeholder(r"ppo --from$", "ppo --from net --out other.npz", VALUE),
    Placeholder(r"robots --arena$", "robots --arena 4711", VALUE),
    Placeholder(r" --resume", "", "nothing to go on from; tests/jobs/learning/test_train.py resumes"),
    Placeholder(r"(qlearning --set .*=0)$", r"\1 --out readings.npz", "a file that the sentence leaves out"),
    Placeholder(r"bundle --out /media/stick", "bundle --out stick", "no stick is plugged in"),
)

MINUTES = 0.01  # of every match
LIMITS: dict[str, dict[str, object]] = {  # of parsed arguments, by the end of the program's name: less work
    "play": {"minutes": MINUTES, "at": 0.2},
    "duel": {"minutes": MINUTES, "matches": 2},
    "league": {"minutes": MINUTES, "matches": 2, "brains": 3},
    "people": {"minutes": MINUTES, "matches": 1},
    "fairness": {"minutes": MINUTES, "matches": 2},
    "exploits": {"minutes": MINUTES, "matches": 1},
    "train qlearning": {"minutes": 0.05, "matches": 1},
    "train ppo": {"minutes": None, "decisions": None, "updates": 1},
    "exploit": {"decisions": 16},
    "tests.bench.fairness": {"matches": 4},
    "tests.bench.network_wins": {
        "matches": 1,
        "minutes": MINUTES,
        "rivals": "idle",
        "arenas": "classic",
        "variants": "party",
    },
    "tests.bench.network_football": {"matches": 1},
    "tests.bench.ppo_profile": {"updates": 1},
}
MAY_MISS = r".*tests\.bench\..*"  # commands that end with 1 if a limit is missed, as few short matches may

EMULATED = ("calibrate", "robots")  # jobs that need robots or a camera: the emulated arena stands in,
WITHOUT_ROBOTS = ("arena", "microbit", "sheet", "wifi_config")  # but not with these options, which need neither

MINUTES_LONG = "it takes minutes"
ELSEWHERE = (
    Elsewhere(r".*robots update.*", "it needs a robot on Wi-Fi", "tests/hardware/emulator/test_board_update.py"),
    Elsewhere(r".*robots setup.*", "it needs a board on USB", "tests/jobs/mat/test_usb_setup.py"),
    Elsewhere(r"openscad .*", "it needs OpenSCAD", "tests/hardware/test_chassis.py"),
    Elsewhere(r"python3 examples/bots/.*", "it needs the arcade beside it", "tests/jobs/bots/test_bots.py"),
    Elsewhere(r".*bot:ada level1.*", "it waits for a program", "tests/jobs/bots/test_bots.py"),
    Elsewhere(r".*tests\.pages\.api --write", "it writes a page of this tree", "tests/api/test_face.py"),
    Elsewhere(r"(python3 main\.py )?(test|bundle)\b.*", MINUTES_LONG, ".ci/run"),
    Elsewhere(r"(python3 main\.py )?bench robots\b.*", MINUTES_LONG, "tests/jobs/bench/test_robots.py"),
    Elsewhere(r"(python3 main\.py )?bench (?!robots|phones).*", MINUTES_LONG, "tests/jobs/bench/test_yardsticks.py"),
    Elsewhere(r".*(--plant ros|main\.py ros)\b.*|roscore &", "it needs ROS", "tests/hardware/ros/test_ros.py"),
    Elsewhere(r".* --ray .*|ray start .*|.*ray_speedup", "it needs Ray", "tests/ai/ppo/test_ray_workers.py"),
    Elsewhere(r"python3 main\.py kiosk pin", "a PIN is typed", "tests/jobs/kiosk/test_pin.py"),
    Elsewhere(r".*--radio udp\b.*", "boards run MicroPython", "tests/hardware/emulator/test_boards.py"),
    Elsewhere(r".*robots check udp\b.*", "boards run MicroPython", "tests/hardware/drivers/test_conformance.py"),
    Elsewhere(r".*(games on|robots check) lines", "a plug-in is copied first", "tests/storage/plugins/test_drivers.py"),
    Elsewhere(r".*robots --radio-setup .*", "a radio on a cable", "tests/jobs/mat/test_robots.py"),
    Elsewhere(
        r".*robots\b.*--(pair|latency|wheels|drive).*", "half a minute of driving", "tests/jobs/mat/test_robots.py"
    ),
    Elsewhere(r".*fidelity (record|identify|replay)\b.*", "a minute of driving", "tests/jobs/mat/test_robots.py"),
    Elsewhere(r".*calibrate --emulate .*--json.*", "half a minute of pictures", "tests/jobs/mat/test_calibrate.py"),
    Elsewhere(r".*play pitanks --real .*", "robots take their places first", "tests/jobs/bench/test_robots.py"),
    Elsewhere(r".*assets\.sounds\.render", "it writes into the project", "tests/sounds"),
    Elsewhere(r".*tests\.tags --write VERSION", "it writes into the tests' data", "tests/test_tags.py"),
    Elsewhere(r".*tests\.golden( --write)?", "a minute; it may change what tests compare with", "tests/test_golden.py"),
    Elsewhere(r".*tests\.bench\.open_day.*", MINUTES_LONG, "tests/bench/test_open_day.py"),
    Elsewhere(
        r".*tests\.bench\.(detection|makespan|reference_lap|network_races|levels|lab_rate)\b.*",
        MINUTES_LONG,
        "tests/bench",
    ),
    Elsewhere(r".*tests\.bench\.phone_camera.*", "aiortc", "tests/scenes/mat/phone_camera/test_browser.py"),
    Elsewhere(r".*tests\.bench\.marker_ids.*", MINUTES_LONG, "tests/hardware/calibration/test_quality.py"),
    Elsewhere(r".*tests\.bench\.reproduce_table.*", MINUTES_LONG, "tests/bench/test_reproduce_table.py"),
    Elsewhere(r".*tests\.bench\.figures.*", MINUTES_LONG, "tests/pages/test_figures.py"),
    Elsewhere(r".*event run http:.*", "another computer has the event", "tests/jobs/events/test_joining.py"),
    Elsewhere(r".*event desk .*", "it serves until Ctrl-C", "tests/jobs/events/test_desk.py"),
    Elsewhere(r".*people fit\b.*", "a replay with people", "tests/jobs/balance/test_fit.py"),
    Elsewhere(r".*tests\.bench\.fit_people.*", MINUTES_LONG, "tests/ai/people/fit/test_known_people.py"),
    Elsewhere(r".*tests\.pages\.pictures", "it writes into the project", "tests/pages/test_pictures.py"),
    Elsewhere(r".*tests\.pages\.lessons .*", "it writes into the project", "tests/pages/test_lessons.py"),
    Elsewhere(r".*tests\.constraints", "it needs uv, and writes into the project", "tests/boot/test_main.py"),
    Elsewhere(r"python3 examples/torchrl_ppo\.py .*", "it needs TorchRL", "tests/gym/test_torchrl.py"),
    Elsewhere(
        r".*(exploit ppo-1|race-1|docs/benchmark/ppo\.task).*",
        "a training to compile",
        "tests/gym/benchmark/test_baselines.py",
    ),
    Elsewhere(r".*tests\.bench\.benchmark_baselines.*", "most need PyTorch", "tests/gym/benchmark/test_baselines.py"),
    Elsewhere(
        r".*tests\.bench\.benchmark_curves.*", "it writes into the project", "tests/gym/benchmark/test_baselines.py"
    ),
    Elsewhere(r".* --copies .*", "a training to compile", "tests/jobs/learning/test_copies.py"),
    Elsewhere(r".* --task team\.task\.toml .*", "a training to compile", "tests/ai/ppo/test_team_critic.py"),
    Elsewhere(r"python3 examples/ppo_torch\.py .*", "it needs PyTorch", "examples/ppo_torch.py"),
    Elsewhere(r"(pip|pipx|uvx|uv|.*-m pip) .*", "packages are fetched", "tests/test_package.py"),
    Elsewhere(r".*-m venv .*|.*jupyter .*", "Jupyter is fetched, and opens a browser", "tests/pages/test_lessons.py"),
    Elsewhere(r"sudo .*", "packages of the system", ".ci/run"),
    Elsewhere(r"cd pigaming_app/hardware/firmware|make.*", "a compiler and a robot", "tests/hardware/firmware"),
    Elsewhere(r"mpremote .*", "a board on a cable", "tests/hardware/emulator/test_boards.py"),
)

FORMULAS = ("expected = ", "Q(s, a) += ")  # beginnings of lines set off like commands
