"""Task files: they say what the shipped networks say of themselves, and a network's own makes the same bits again."""

import json
import re
from concurrent.futures import ThreadPoolExecutor
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from pigaming_app.ai.networks.files import BRAINS, encode
from pigaming_app.ai.ppo.product import recorded_task, trained_network
from pigaming_app.ai.ppo.registry import TASKS, shipped_file
from pigaming_app.ai.ppo.task_file import (
    TaskFile,
    TaskFileError,
    check_names,
    file_of,
    parse_task_file,
    read_task,
    text_of,
    with_file,
)
from pigaming_app.ai.ppo.training import Training, in_threads, start_of
from pigaming_app.jobs.cli import main
from pigaming_app.storage.safe_files import write_atomic
from pigaming_football import __file__ as football
from tests.ai.ppo.plain import TASK, TINY, play_plain

PLAN = {"planned_updates": "updates", "match_minutes": "match_minutes", "cut": "cut", "sharpness": "sharpness"}
WEIGHTS = {  # of the recipes of the shipped networks, which are older than task files
    "pitanks": {
        "WIN": "win", "CARE": "first_care", "FULL_CARE": "care", "SHAPING": "first_shaping", "SHAPED": "shaping",
        "SHOT": "shot", "BLIND": "blind", "BORED": "bored", "CROWD": "crowd", "CLOSE": "close", "THRIFTY": "thrifty",
        "MOST_THRIFT": "most_thrift", "LATE": "late", "LATEST": "latest",
    },
    "race": {"STRIDE": "stride", "LEADING": "lead", "LONGEST": "longest", "FINISH": "place", "WIN": "win"},
    "football": {
        "POINT": "goal", "WIN": "win", "ADVANCE": "first_advance", "ADVANCED": "advance", "CHASE": "first_chase",
        "CHASED": "chase", "LATE": "late", "LATEST": "latest",
    },
}  # fmt: skip


def filed(game):
    path = shipped_file(game)
    assert path
    return path.read_text(encoding="utf-8")


def network_of(game):
    return (Path(football).parent / "brains" if game == "football" else BRAINS) / f"{game}.npz"


@pytest.mark.parametrize("game", WEIGHTS)
def test_a_shipped_file_says_what_its_network_says_of_its_training(game):
    """The head of the network was written by the training, by the rules of that time."""
    with np.load(network_of(game)) as parts:
        head = json.loads(str(parts["head"]))
    recipe, file = head["recipe"], parse_task_file(filed(game))
    assert (file.game, file.seed, file.updates) == (game, head["seed"], head["updates"])
    for theirs, ours in PLAN.items():
        assert json.loads(json.dumps(getattr(file, ours))) == recipe[theirs]
    for name, value in vars(TASKS[game].hyper).items():
        if name != "held":  # of networks that are continued
            assert recipe[name] == value, name
    numbers = {**(file.rewards or {}), **(file.habits or {})}
    assert {name: numbers[ours] for name, ours in WEIGHTS[game].items()}.items() <= recipe.items()
    assert list(TASKS[game].arenas) == recipe["arenas"]
    assert list(TASKS[game].variants) == recipe["variants"]
    assert [told(line_up) for line_up in TASKS[game].line_ups] == recipe["line_ups"]
    columns = [f"{rival}_{end}" for rival in file.rivals for end in ("wins", "ties", "losses")]
    assert head["curve"]["columns"][4:] == columns
    assert {*numbers} - {*WEIGHTS[game].values()} <= {"tie", "defeat"}
    check_names(TASKS[game])


@pytest.mark.parametrize(
    ("game", "network", "start"),
    [
        ("factory", BRAINS / "factory.npz", None),
        ("pitanks", BRAINS / "champion.npz", "pitanks"),
        ("football", Path(football).parent / "brains/champion.npz", "football"),
    ],
)
def test_a_network_learned_by_its_file_a_champion_from_the_first_of_its_game(game, network, start):
    task = read_task(network.with_suffix(".task.toml"), TASKS[game])
    assert recorded_task(network) == text_of(file_of(task))
    with np.load(network) as parts:
        head = json.loads(str(parts["head"]))
    assert (head["recipe"]["start"], head["updates"]) == (start, task.length.updates)


def told(line_up):
    """A line-up as those recipes have it."""
    teams = ["teams", *map(str, line_up.teams)] if line_up.teams else []
    return " ".join([str(line_up.share), *line_up.seats, *teams, *line_up.variants, *line_up.arenas])


def trained(training, updates=2):
    with ThreadPoolExecutor(1) as threads:
        for _ in range(updates):
            training.update(in_threads(training, threads), threads)
    return training


@pytest.mark.parametrize("kind", ["fresh", "population", "wider", "rival"])
def test_the_file_in_a_network_makes_the_same_bits_again(kind, tmp_path, monkeypatch):
    play_plain(monkeypatch)
    task, start = TASK, None if kind == "fresh" else start_of("pitanks", "net")
    if kind == "population":
        task = TASK.populated()
    if kind == "rival":
        (tmp_path / "net.npz").write_bytes((BRAINS / "champion.npz").read_bytes())
        task = TASK.against(str(tmp_path / "net.npz"), "party")
    task = replace(task, hyper=replace(TINY, held=1, rate=0.05), units=72 if kind == "wider" else 64)
    first = trained(Training(task, 5, 2, start=start))
    network = trained_network(first, "mine")
    write_atomic(tmp_path / "mine.npz", encode(network))
    write_atomic(tmp_path / "mine.task.toml", recorded_task(tmp_path / "mine.npz").encode())
    assert str(tmp_path) not in str(network), "no folder of this machine"
    again = read_task(tmp_path / "mine.task.toml", TASKS["pitanks"])
    assert again.length.updates == 2
    second = trained(Training(again, again.length.seed, again.length.updates, start=start))
    for one, other in zip(first.learner.policy.weights, second.learner.policy.weights, strict=True):
        assert one.tobytes() == other.tobytes()
    assert network.matrices[0].shape[1] == task.units
    if start:
        changed = [np.array_equal(a, b) for a, b in zip(first.layers().matrices, start.layers.matrices, strict=True)]
        assert not all(changed)


@pytest.mark.parametrize("game", ["factory", *WEIGHTS])
def test_a_file_is_written_as_it_is_read(game):
    check_names(TASKS[game])
    file = file_of(TASKS[game])
    assert parse_task_file(text_of(file)) == file
    assert vars(with_file(TASKS[game], file)) == vars(TASKS[game])


def test_the_page_lists_every_key():
    page = (Path(__file__).parents[3] / "docs" / "networks.md").read_text(encoding="utf-8")
    table = page.partition("## Task files")[2].partition("| key | content |")[2].partition("\n\n")[0]
    listed = [
        key for row in table.splitlines() for key in re.findall(r"`(\w+)`", row.partition("|")[2].partition("|")[0])
    ]
    assert sorted(listed) == sorted(field.name for field in fields(TaskFile))


RACE = (BRAINS / "race.task.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("cut = 0.03", "cat = 0.03", "cat is not a key here; there are game, seed, updates, "),
        ("cut = 0.03", "cut = 1.5", "cut: expected a number <= 1.0"),
        ("cut = 0.03", 'cut = "a"', "cut: expected a number, got a text"),
        ("cut = 0.03", "cut = nan", "cut: expected a number"),
        ("updates = 2000", "updates = 2000\nminutes = 1.0", "updates, decisions, minutes: one of them at most"),
        ("updates = 2000", "updates = 0", "updates: expected a whole number >= 1"),
        ("units = 64", "units = 60", "units: expected a multiple of 8 from 8 to 128, got 60"),
        ("units = 64", "units = 136", "units: expected a multiple of 8 from 8 to 128, got 136"),
        ("updates = 2000", 'updates = "many"', "updates: expected a whole number, got a text"),
        ('pool = "uniform"', 'pool = "some"', "pool: expected one of uniform, pfsp"),
        ('pool = "uniform"', 'pool = "pfsp"', "pool: pfsp needs line-ups of learner and exploiter"),
        ("trace = 0.9", "lambda = 0.9", "training.lambda is not a key here; there are matches, decisions, epochs"),
        ("trace = 0.9", "trace = 9.0", "training: trace is 9; possible are 0 to 1"),
        ("win = 0.5", "", "rewards.win is missing"),
        ("win = 0.5", "won = 0.5", "rewards.won is not a key here; there are stride, lead, longest, place, win"),
        ("win = 0.5", "win = inf", "rewards.win: expected a number <= 1000000.0"),
        ("[rewards]", "[habits]\nlate = 0.5\n[rewards]", "habits: the game has no numbers there"),
        ('game = "race"', 'game = "pitanks"', "game: it is for 'pitanks', not race"),
        ('["learner"] }', '["learner", "somebody"] }', "line_ups[0].seats: no brain 'somebody'; "),
        ('["learner"] }', '["learner"], team = 1 }', "line_ups[0].team is not a key here; there are share, seats"),
        ('["learner"] }', '["learner"], teams = [0] }', "line_ups[0]: teams: 4 numbers are needed"),
        ('"hairpin"', '"hairpen"', "arenas: no arena 'hairpen'; there are classic, "),
        ('"party"', '"chess"', "variants: no variant 'chess'; there are standard, "),
        ('rivals = ["hand3"]', 'rivals = ["hand9"]', "rivals: no brain 'hand9'"),
        ("line_ups = [", "line_ups = [ 3,", "line_ups[0]: expected a table, got a whole number"),
        ("seed = 1", "seed = ", "Invalid value"),
        ('rivals = ["hand3"]', f"rivals = {['hand3'] * 6}", "rivals: expected a list of length <= 5"),
        (
            RACE[RACE.index("line_ups") : RACE.index("[training]")],
            'line_ups = [{ share = 1, seats = ["pool"] }]\n',
            "line_ups: ",
        ),
    ],
)
def test_a_wrong_file_is_refused_in_one_line_with_file_key_and_what_is_possible(tmp_path, old, new, reason):
    assert RACE.count(old) == 1
    path = tmp_path / "mine.task.toml"
    path.write_text(RACE.replace(old, new), encoding="utf-8")
    with pytest.raises(TaskFileError) as refusal:
        read_task(path, TASKS["race"])
    assert str(refusal.value).startswith(f"mine.task.toml: {reason}")
    assert "\n" not in str(refusal.value)


def test_the_command_trains_by_a_file_and_prints_those_of_games_and_networks(tmp_path, capsys, monkeypatch):
    play_plain(monkeypatch)
    for measured in ("MEASURED", "MEASURED_AT_END"):
        monkeypatch.setattr(f"pigaming_app.jobs.learning.train.ppo_training.{measured}", 1)
    assert main(["train", "task", "pitanks"]) == 0
    assert capsys.readouterr().out == filed("pitanks")
    mine = (
        text_of(file_of(replace(TASK, hyper=TINY))).replace("units = 64", "units = 16").replace("seed = 1", "seed = 9")
    )
    (tmp_path / "mine.toml").write_text(mine, encoding="utf-8")
    out = tmp_path / "a.npz"
    job = ["train", "ppo", "pitanks", "--task", str(tmp_path / "mine.toml"), "--updates", "1", "--out", str(out)]
    assert main(job) == 0
    capsys.readouterr()
    assert main(["train", "task", str(out)]) == 0
    file = parse_task_file(capsys.readouterr().out)
    assert (file.units, file.seed, file.updates, file.training) == (16, 9, 1, TINY)
    assert main([*job, "--resume", "--set", "rate=0.1"]) == 2
    assert capsys.readouterr().err.splitlines()[-1].endswith("it is from a training with another training")
    assert main(["train", "task", str(network_of("race"))]) == 2
    assert "race.npz: it does not tell" in capsys.readouterr().err
