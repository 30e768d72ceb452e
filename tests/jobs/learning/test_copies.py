"""Frozen copies of a training, their ratings, and the one that becomes the result."""

import csv
import json
import shutil
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import pytest

from pigaming_app.ai.learning.batch import matches as new_matches
from pigaming_app.ai.learning.ratings import Rating
from pigaming_app.ai.networks.files import BRAINS, brain_of, decode
from pigaming_app.ai.ppo import win_rates
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.ppo.training import Training
from pigaming_app.games.game import Setup
from pigaming_app.jobs.cli import main
from pigaming_app.jobs.learning.train import copies, ppo_training
from pigaming_app.jobs.learning.train.copies import FrozenCopies, RatedCopy, strongest
from pigaming_app.jobs.learning.train.tensorboard import TensorboardFile
from pigaming_app.storage.safe_files import NotSaved, write_all_atomic, write_atomic
from tests.ai.ppo.plain import SET, TASK, TINY, play_plain


@pytest.fixture
def met(monkeypatch):
    """Pairs that meet, by their weights: of three copies the second wins most. Matches are plain and short."""
    play_plain(monkeypatch)
    for measured in ("MEASURED", "MEASURED_AT_END"):
        monkeypatch.setattr(ppo_training, measured, 1)
    found = []

    def points(task, one, other, matches, threads):
        assert (task.game, matches) == ("pitanks", copies.MATCHES)
        found.append((one.tobytes(), other.tobytes()))
        return [(0.0, 2.0) if len(found) % 3 == 1 else (1.5, 0.5)] * (matches // 2)

    monkeypatch.setattr(copies, "points_between", points)
    return found


def network(path):
    return decode(path.read_bytes(), path.name)


def weights(path):
    return [matrix.tobytes() for matrix in network(path).matrices]


def test_each_pair_of_copies_meets_once_and_the_strongest_is_the_result(tmp_path, met, capsys):
    """0 loses to 1, and beats 2; 1 beats 2: so 1 is the strongest."""
    folder, out, table = tmp_path / "copies", tmp_path / "a.npz", tmp_path / "a.csv"
    job = ["train", "ppo", "pitanks", *SET, "--out", str(out), "--copies", str(folder), "--csv", str(table), "--json"]
    assert main([*job, "--updates", "2"]) == 0
    files = sorted(folder.iterdir())
    assert [file.stem for file in files] == [f"a_000000{k}" for k in range(3)]
    assert len({tuple(weights(file)) for file in files}) == 3
    packed = [brain_of(network(file)).weights(True).tobytes() for file in files]
    assert met == [(packed[0], packed[1]), (packed[0], packed[2]), (packed[1], packed[2])]
    result = json.loads(capsys.readouterr().out)
    assert [row["updates"] for row in result["copies"]] == [0, 1, 2]
    ratings = [row["rating"] for row in result["copies"]]
    assert ratings[1] > ratings[0] > ratings[2]
    assert sum(ratings) == pytest.approx(0.0, abs=1e-3)
    assert result["chosen"] == 1
    assert weights(out) == weights(files[1])
    assert network(out).name == "a"
    rows = list(csv.DictReader(table.read_text().splitlines()))
    assert [float(row["rating"]) for row in rows] == pytest.approx(ratings, abs=0.06)
    files[1].unlink()
    (folder / "a_0000099.npz").write_text("of a longer training")
    assert main([*job, "--updates", "2", "--resume"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert [row["updates"] for row in result["copies"]] == [0, 2]


def test_a_folder_that_vanishes_keeps_neither_a_copy_nor_the_result_from_being_saved(
    tmp_path, met, monkeypatch, capsys
):
    """TensorBoard's folder goes after the first update. The checkpoint is written after each, and so is the copy."""
    monkeypatch.setattr(ppo_training, "SAVED_EVERY", 0.0)
    runs, saved = tmp_path / "runs", []
    add = TensorboardFile.add

    def lost(events, step, numbers):
        if step == 2:
            shutil.rmtree(runs)
        add(events, step, numbers)

    def noted(files):
        saved.append([file.name for file in files])
        write_all_atomic(files)

    monkeypatch.setattr(TensorboardFile, "add", lost)
    monkeypatch.setattr(ppo_training, "write_all_atomic", noted)
    folder = tmp_path / "copies"
    job = ["train", "ppo", "pitanks", *SET, "--out", str(tmp_path / "a.npz"), "--updates", "2"]
    assert main([*job, "--copies", str(folder), "--tensorboard", str(runs)]) == 0
    assert [file.stem for file in sorted(folder.iterdir())] == [f"a_000000{k}" for k in range(3)]
    assert saved == [["a.npz", "a.checkpoint.npz"]] * 3, "after each update, and at the end"
    assert capsys.readouterr().err.count("was not written: No such file or directory") == 1


def test_the_last_network_is_rated_where_its_copy_finds_no_room(tmp_path, met, monkeypatch, capsys):
    def write(path, raw):
        if path.name == "a_0000002.npz":
            no_room(path, raw)
        write_atomic(path, raw)

    monkeypatch.setattr(copies, "write_atomic", write)
    monkeypatch.setattr(ppo_training, "strongest", lambda rated: max(rated, key=lambda copy: copy.updates))
    folder, out = tmp_path / "copies", tmp_path / "a.npz"
    job = ["train", "ppo", "pitanks", *SET, "--out", str(out), "--updates", "2", "--copies", str(folder), "--json"]
    assert main(job) == 0
    assert [file.stem for file in sorted(folder.iterdir())] == ["a_0000000", "a_0000001"]
    result = json.loads(capsys.readouterr().out)
    assert [row["updates"] for row in result["copies"]] == [0, 1, 2]
    assert result["chosen"] == network(out).updates == 2


def test_a_copy_that_is_due_is_tried_again_at_the_next_update(tmp_path, monkeypatch):
    """Of 20 updates each second one is a tenth: the copy of update 2 found no room, and update 3 takes its place."""
    training = Training(replace(TASK, hyper=TINY), 1, 20)
    frozen = FrozenCopies(training, tmp_path, "a")
    assert frozen.add()
    training.updates = 2
    with monkeypatch.context() as patch:
        patch.setattr(copies, "write_atomic", no_room)
        with pytest.raises(NotSaved):
            frozen.add()
    training.updates = 3
    assert frozen.add()
    assert not frozen.add()
    assert [int(file.stem[-7:]) for file in sorted(tmp_path.iterdir())] == [0, 3]


def no_room(path, raw):
    raise NotSaved(f"{path.name} was not written: no room.")


def test_of_equal_copies_the_latest_is_the_strongest():
    same = Rating(10.0, 0.0, 20.0)
    assert strongest([RatedCopy(2, 20, same), RatedCopy(9, 90, same), RatedCopy(5, 50, same)]).updates == 9


def test_copies_meet_on_seeds_that_no_training_plays_from_both_sides(monkeypatch):
    """A network and its copy have as many points; the seeds are those of measurements, two matches each."""
    play_plain(monkeypatch)
    seen: list[Setup] = []

    def noted(setups):
        seen.extend(setups)
        return new_matches(setups)

    monkeypatch.setattr(win_rates, "new_matches", noted)
    net, levels = (brain_of(network(BRAINS / f"{name}.npz")).weights(True) for name in ("champion", "pitanks"))
    with ThreadPoolExecutor(1) as threads:
        one, other = map(sum, zip(*win_rates.points_between(TASKS["pitanks"], net, net, 4, threads), strict=True))
        assert one == other == 2.0
        assert sorted(setup.seed for setup in seen) == [1_000_000, 1_000_000, 1_000_001, 1_000_001]
        task = replace(TASKS["pitanks"], minutes=(0.3,))
        forth = win_rates.points_between(task, net, levels, 4, threads)
        back = win_rates.points_between(task, levels, net, 4, threads)
    assert forth == [(right, left) for left, right in back]
    assert sum(left for left, _ in forth) >= 3.0, "the champion beats the network that it continued"
