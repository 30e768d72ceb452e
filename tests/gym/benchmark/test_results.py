"""Results that were changed by a single number, a network, a rival or another engine are refused in one line."""

import json
import random
from dataclasses import replace
from pathlib import Path

import pytest

from pigaming_app.ai.learning.league import wilson
from pigaming_app.ai.networks.files import BRAINS, encode
from pigaming_app.ai.ppo.training import start_of
from pigaming_app.gym.benchmark import results
from pigaming_app.gym.benchmark.protocol import MatchCounts
from pigaming_app.gym.benchmark.results import ResultsError, by_budget, measured, text_of, verify
from pigaming_app.gym.benchmark.tasks import RIVAL_DECISIONS
from tests.ai.networks.random_network import random_network

DOCS = Path(__file__).resolve().parents[3] / "docs"
FREE = {"method", "version"}  # texts that no match decides


@pytest.fixture
def played(tmp_path, monkeypatch):
    """A folder with results of two networks, whose matches are made up, but follow from agent, task and condition."""

    def made_up(task, agent, rival=""):
        ends = {}
        for name in task.conditions:
            dice = random.Random(f"{agent} {task.text} {name} {rival}")
            wins, ties = dice.randrange(80), dice.randrange(20)
            ends[name] = MatchCounts(wins, ties, 100 - wins - ties, f"{dice.getrandbits(256):064x}")
        return ends

    monkeypatch.setattr(results, "evaluate", made_up)
    for name, seed in (("one", 1), ("two", 2)):
        write(tmp_path, name, random_network(seed, name=name))
    return tmp_path


def write(folder, name, network):
    (folder / f"{name}.npz").write_bytes(encode(network))


def filed(folder, task="pitanks-duel", agents=("one.npz", "two.npz")):
    """The file of results, and its content."""
    path = folder / "results.json"
    path.write_text(text_of(measured(task, folder, agents, "a method", print)))
    return path, json.loads(path.read_text())


def leaves(node, place=()):
    """All places of numbers, texts and nothings."""
    if isinstance(node, dict | list):
        for key, value in node.items() if isinstance(node, dict) else enumerate(node):
            yield from leaves(value, (*place, key))
    else:
        yield place, node


def another(dice, value):
    """A value of the same kind, mostly near by."""
    match value:
        case str() if len(value) == 64:
            k = dice.randrange(64)
            return f"{value[:k]}{'0' if value[k] != '0' else '1'}{value[k + 1 :]}"
        case str():
            return dice.choice(["net", "two.npz", "pitanks-arenas", "level5", value + "x", "", "../one.npz"])
        case int():
            return value + dice.choice([1, -1, 100, -value, 10**9])
        case float():
            return round(dice.choice([value + 1e-6, 1.0, 0.0, value * 1.1]), 6)
        case _:
            return dice.choice([0, 1, "a", "0" * 64])


def test_results_verify_as_they_were_written(played):
    path, content = filed(played)
    assert verify(path, print) == measured("pitanks-duel", played, ["one.npz", "two.npz"], "a method", print)
    assert [(run["seed"], run["decisions"]) for run in content["runs"]] == [(1, 1000), (2, 1000)]
    ends = content["runs"][0]["conditions"]
    assert content["runs"][0]["score"] == sum(one["wins"] + one["ties"] / 2 for one in ends.values()) / 500


@pytest.mark.parametrize("tries", [40, pytest.param(3000, marks=[pytest.mark.long, pytest.mark.again])])
def test_no_random_change_passes(played, tries):
    """Whatever is changed, left out or doubled, but for the free texts, is refused in one line with its file."""
    dice, tried = random.Random(3), 0
    path, original = filed(played)
    places = [place for place, _ in leaves(original) if place[-1] not in FREE]
    while tried < tries:
        content = json.loads(json.dumps(original))
        *way, last = dice.choice(places)
        node = content
        for key in way:
            node = node[key]
        what = dice.random()
        if what < 0.8:
            node[last] = another(dice, node[last])
        elif what < 0.9:
            del node[last]
        else:
            content["runs"].append(dice.choice(content["runs"]))
        more = last == "decisions" and isinstance(node.get(last), int) and node[last] > 1000  # permitted
        if content == original or (last == "rival" and "rival" not in node) or more:
            continue
        path.write_text(json.dumps(content))
        with pytest.raises(ResultsError, match=r"^results.json: [^\n]+\Z"):
            verify(path, print)
        tried += 1


def test_a_refusal_names_the_place(played):
    path, content = filed(played)
    ends = content["runs"][1]["conditions"]["level3"]
    wins = ends["wins"]
    ends["wins"] += 1
    path.write_text(json.dumps(content))
    with pytest.raises(ResultsError, match=rf"json: runs\[1\].conditions.level3.wins: {wins + 1}, but it is {wins}\Z"):
        verify(path, print)
    content["runs"][1]["conditions"]["level9"] = ends
    path.write_text(json.dumps(content))
    with pytest.raises(ResultsError, match=r"conditions.level9: nothing of that name is played"):
        verify(path, print)


@pytest.mark.parametrize(
    ("place", "refusal"),
    [
        ((), "extra is not a key here; there are format, task, method, version, engine, runs"),
        (("runs", 1), r"runs\[1\].extra is not a key here; there are agent, sha256"),
        (("runs", 0, "conditions", "level2"), r"runs\[0\].conditions.level2.extra is not a key here; there are wins"),
    ],
)
def test_a_key_that_there_is_not_is_refused(played, place, refusal):
    path, content = filed(played)
    node = content
    for key in place:
        node = node[key]
    node["extra"] = 3
    path.write_text(json.dumps(content))
    with pytest.raises(ResultsError, match=rf"^results.json: {refusal}"):
        verify(path, print)


@pytest.mark.parametrize("method", ["", "  "])
def test_a_method_has_words(played, method):
    path, content = filed(played)
    path.write_text(json.dumps({**content, "method": method}))
    with pytest.raises(ResultsError, match=r"^results.json: method: it is empty"):
        verify(path, print)


def test_a_folder_without_a_name_is_named_as_it_was_given(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ResultsError, match=r"^\.: "):
        verify(Path("."), print)


def test_another_engine_is_refused_before_anything_is_played(played, monkeypatch):
    path, _ = filed(played)
    monkeypatch.setattr(results, "engine_hash", lambda *_: "f" * 64)
    monkeypatch.delattr(results, "evaluate")
    with pytest.raises(ResultsError, match=r"^results.json: engine: '.+', but it is 'ffff.+'\Z"):
        verify(path, print)


def test_another_network_is_refused(played):
    path, _ = filed(played)
    write(played, "two", replace(random_network(2, name="two"), decisions=999))
    with pytest.raises(ResultsError, match=r"runs\[1\].sha256"):
        verify(path, print)
    (played / "two.npz").unlink()
    with pytest.raises(ResultsError, match=r"results.json: two.npz: "):
        verify(path, print)


def test_a_rival_is_the_one_that_the_protocol_asks_for(played):
    with pytest.raises(
        ResultsError, match=r"rival_one.npz: No such file.+; train it by exploit one\.npz --decisions 1000000\Z"
    ):
        filed(played, "pitanks-exploit", ["one.npz"])
    write(played, "rival_one", random_network(1, name="rival_one"))
    with pytest.raises(ResultsError, match=r"train it by exploit one\.npz --decisions 1000000"):
        filed(played, "pitanks-exploit", ["one.npz"])
    write(played, "rival_one", replace(random_network(1, name="rival_one"), decisions=RIVAL_DECISIONS))
    path, content = filed(played, "pitanks-exploit", ["one.npz"])
    verify(path, print)
    content["runs"][0]["rival"] = content["runs"][0]["sha256"]
    path.write_text(json.dumps(content))
    with pytest.raises(ResultsError, match=r"runs\[0\].rival"):
        verify(path, print)


def test_whom_a_network_trained_with_is_no_unknown_partner(played):
    from pigaming_app.ai.ppo.registry import TASKS as TRAININGS
    from pigaming_app.ai.ppo.task_file import file_of
    from pigaming_app.ai.ppo.task_file import text_of as text_of_task

    network = random_network(1, name="one")
    by = text_of_task(file_of(TRAININGS["pitanks"]))
    write(played, "one", replace(network, recipe={**network.recipe, "task": by}))
    filed(played, "pitanks-duel", ["one.npz"])
    with pytest.raises(ResultsError, match=r"one.npz: it was trained with classic, whom this task holds back"):
        filed(played, "pitanks-partner", ["one.npz"])


def test_a_network_counts_the_decisions_and_partners_of_those_that_it_continues(played):
    """1000 decisions each. The start of an older file lies beside it; a newer one has both in its recipe."""
    task, fair = (BRAINS / "champion.task.toml").read_text(), (DOCS / "benchmark/ppo.task.toml").read_text()
    old = {"learner": "ppo", "start": "first", "task": fair}
    write(played, "one", random_network(1, name="one", recipe=old))
    with pytest.raises(ResultsError, match=r"one.npz: it continues first, whose .+; first.npz belongs beside it\Z"):
        filed(played, agents=["one.npz"])
    write(played, "first", random_network(3, recipe={"learner": "ppo", "start": None, "task": task}))
    assert filed(played, agents=["one.npz"])[1]["runs"][0]["decisions"] == 2000
    with pytest.raises(ResultsError, match=r"one.npz: it was trained with classic, whom"):
        filed(played, "pitanks-partner", ["one.npz"])
    new = {**old, "start_decisions": 5, "start_met": ["q2"], "start_recorded": True}
    write(played, "one", random_network(1, name="one", recipe=new))
    assert filed(played, agents=["one.npz"])[1]["runs"][0]["decisions"] == 1005
    with pytest.raises(ResultsError, match=r"one.npz: it was trained with q2, whom"):
        filed(played, "pitanks-partner", ["one.npz"])
    write(played, "one", random_network(1, name="one", recipe={**new, "start_met": ["level1"]}))
    filed(played, "pitanks-partner", ["one.npz"])


@pytest.mark.parametrize("unknown", [{"task": None}, {"start_recorded": False}])
def test_a_network_of_which_nothing_records_whom_it_met_plays_with_no_unknown_partner(played, unknown):
    """Those of other libraries cannot, and it is their author's word."""
    known = {"learner": "ppo", "start": "x", "start_decisions": 5, "start_met": [], "start_recorded": True}
    known["task"] = (DOCS / "benchmark/ppo.task.toml").read_text()
    recipe = {**known, **unknown}
    write(played, "one", random_network(1, name="one", recipe=recipe))
    filed(played, agents=["one.npz"])
    with pytest.raises(ResultsError, match=r"one.npz: nothing records with whom it was trained"):
        filed(played, "pitanks-partner", ["one.npz"])
    write(played, "one", random_network(1, name="one", recipe=known))
    filed(played, "pitanks-partner", ["one.npz"])
    write(played, "one", random_network(1, name="one", recipe={"learner": "sb3"}))
    filed(played, "pitanks-partner", ["one.npz"])


def test_an_author_may_know_of_more_decisions_than_the_file_but_not_of_fewer(played):
    path, content = filed(played)
    for decisions, good in ((1001, True), (999, False)):
        content["runs"][0]["decisions"] = decisions
        path.write_text(json.dumps(content))
        if good:
            assert verify(path, print).runs[0].decisions == decisions
            continue
        with pytest.raises(ResultsError, match=r"runs\[0\].decisions: 999, but it is 1000\Z"):
            verify(path, print)


def test_the_network_of_a_name_has_its_history_too():
    """Of the files of the arcade: 155,344,502 decisions on top of 77,334,103, of which nobody recorded the partners."""
    history = start_of("pitanks", "net").history
    assert (history.decisions, history.recorded) == (155_344_502 + 77_334_103, False)
    assert history.met >= {"hand3", "classic", "q1", "q2", "idle"}


def test_an_ai_of_the_program_needs_no_file(played):
    path, content = filed(played, agents=["level3"])
    assert content["runs"][0]["sha256"] is content["runs"][0]["decisions"] is None
    verify(path, print)
    with pytest.raises(ResultsError, match="no brain 'level9'"):
        filed(played, agents=["level9"])


def test_scores_are_grouped_by_budget_with_an_interval_over_trainings(played):
    """Student's t with two degrees of freedom: 4.303 standard errors."""
    found = measured("pitanks-duel", played, ["one.npz", "two.npz", "level3"], "a method", print)
    one, two, ai = found.runs
    runs = (
        replace(one, score=0.4),
        replace(two, score=0.5),
        replace(one, score=0.6),
        replace(two, decisions=10**7 + 1),
    )
    spread = by_budget(replace(found, runs=(*runs, ai)))
    assert spread[10**6][:3] == pytest.approx((0.5, 0.5 - 0.2484, 0.5 + 0.2484), abs=1e-4)
    assert spread[10**6][3] == 3
    assert spread[10**8] == (two.score, *wilson(500 * two.score, 500), 1)
    assert spread[None][3] == 1
