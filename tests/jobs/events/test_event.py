"""The job `event`: from a list of entrants to the table."""

import csv
import json
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from unittest.mock import Mock

import pytest

from pigaming_app.events import event_files
from pigaming_app.events.event import Event
from pigaming_app.events.event_files import load
from pigaming_app.events.spec import Entrant, EventSpec, Format
from pigaming_app.jobs.cli import main
from pigaming_app.jobs.events import play
from tests.cases import one_in
from tests.events.examples import ranked
from tests.jobs.test_hostile_options import ANY, POSIX, fault, furnish

ROOT = Path(__file__).resolve().parents[3]
SHORT = ["--minutes", "0.05"]
NEW = ["event", "new", "cup.json", "--format", "roundrobin", "--entrants", "AAA=level1,BBB=idle,CCC", *SHORT]


@pytest.fixture(autouse=True)
def _here(tmp_path, monkeypatch):
    for variable in ("SDL_VIDEODRIVER", "SDL_AUDIODRIVER"):  # `fault` changes them
        monkeypatch.setenv(variable, "dummy")
    monkeypatch.chdir(tmp_path)


def new(*words: str, form: str = "roundrobin", entrants: str = "AAA=level1,BBB=idle,CCC") -> int:
    return main([*NEW, "--format", form, "--entrants", entrants, *words])


def cup() -> Event:
    event, problems = load(Path("cup.json"))
    assert event is not None
    assert not problems
    return event


@pytest.fixture
def output(capsys: pytest.CaptureFixture[str]) -> Callable[..., str]:
    """A function that returns what a job prints, which has nothing to complain of."""

    def of(*words: str) -> str:
        capsys.readouterr()
        assert main(["event", *words]) == 0
        told = capsys.readouterr()
        assert told.err == ""
        return told.out

    return of


@pytest.mark.parametrize("form", list(Format))
def test_an_event_from_its_beginning_to_the_table(form, output):
    rounds = "2" if form == "swiss" else "3"
    assert new("--game", "race" if form == "timetrial" else "pitanks", "--rounds", rounds, form=form) == 0
    result = json.loads(output("run", "cup.json", "--headless", "--speed", "max", "--json"))
    assert sorted(row["entrant"] for row in result["standings"]) == ["AAA", "BBB", "CCC"]
    points = [row["points"] for row in result["standings"]]
    assert points == sorted(points, reverse=True)
    assert all(row["wins"] <= row["played"] for row in result["standings"])
    assert result["over"]
    assert json.loads(output("show", "cup.json", "--json"))["standings"] == result["standings"]


@pytest.mark.parametrize("form", list(Format))
def test_an_event_that_is_stopped_after_every_step_ends_as_one_that_is_not(form, output, monkeypatch):
    """Stopped when something has just been saved, again and again, and gone on with from the file."""
    words = ["--game", "race" if form == "timetrial" else "pitanks", "--rounds", "2"]
    entrants = "AAA=random,BBB=idle,CCC=random,DDD=random"
    assert new(*words, form=form, entrants=entrants) == 0
    fresh = Path("cup.json").read_text(encoding="utf-8")
    whole = json.loads(output("run", "cup.json", "--headless", "--json"))
    Path("cup.json").write_text(fresh, encoding="utf-8")
    update = event_files.update

    def stopped(*args):
        update(*args)
        raise KeyboardInterrupt

    steps = 0
    with monkeypatch.context() as patch:
        patch.setattr(event_files, "update", stopped)
        while not cup().over:
            with pytest.raises(KeyboardInterrupt):
                play.run(play.PlayEventOptions(file=Path("cup.json"), headless=True))
            steps += 1
            assert steps < 100
    assert steps >= 2
    shown = json.loads(output("show", "cup.json", "--json"))
    assert shown["standings"] == whole["standings"]
    assert shown["matches"] == whole["matches"]


def test_what_another_process_has_arranged_is_not_arranged_again():
    event = Event(EventSpec("L", Format.CHALLENGE, ("pitanks",), tuple(map(Entrant, "ABCD")))).continued()
    assert play._continued(event) is event
    while event.open:
        event = event.record(ranked(event.open[0], *event.open[0].entrants))
    assert play._continued(event).progress.closed == 1


def test_groups_are_shown_each_with_its_table(output):
    assert new(form="groups", entrants=",".join(f"{name}=idle" for name in "ABCDEFGH")) == 0
    shown = output("show", "cup.json")
    assert [line for line in shown.splitlines() if line.startswith("group ")] == ["group A", "group B"]
    assert "group A)" in shown
    found = json.loads(output("show", "cup.json", "--json"))
    assert {name: [row["entrant"] for row in rows] for name, rows in found["groups"].items()} == {
        "A": ["A", "D", "E", "H"], "B": ["B", "C", "F", "G"]
    }  # fmt: skip


def test_a_challenge_is_arranged_entered_and_its_week_closed(output, refused):
    assert new(form="challenge", entrants="A,B,C") == 0
    assert "\n    1  " in output("arrange", "cup.json", "C", "A")
    assert sorted(cup().open[0].entrants) == ["A", "C"]
    assert "A has an open challenge" in refused("event", "arrange", "cup.json", "B", "A")
    output("result", "cup.json", "1", "C=3", "A=1")
    assert [row.entrant for row in cup().standings] == ["C", "A", "B"]
    output("close", "cup.json")
    assert cup().progress.closed == 1
    Path("cup.json").unlink()
    assert new(form="swiss", entrants="A,B,C") == 0
    assert "draws its matches itself" in refused("event", "arrange", "cup.json", "A", "B")
    assert "no day or week" in refused("event", "close", "cup.json")


def test_without_headless_the_arcade_opens_on_the_next_match(monkeypatch, controls):
    from pigaming_app.jobs import arcade
    from pigaming_app.scenes.events.next_page import NextMatch
    from tests.scenes.arcade import Arcade

    show = Mock(return_value=0)
    monkeypatch.setattr(arcade, "show", show)
    assert new("--game", "pitanks") == 0
    assert main(["event", "run", "cup.json"]) == 0
    page = show.call_args.args[0].first_scene(Arcade(controls).context)
    assert isinstance(page, NextMatch)
    assert page.running.path == Path("cup.json")


def test_games_take_turns_each_with_its_own_length_arena_and_rules(output):
    words = ["--game", "pitanks,race", "--arena", "race=kidney", "--rules", "party", "--json", "--seats", "2"]
    assert new(*words, "--minutes", "race=0.1,pitanks=0.05", entrants="AAA=random,BBB=idle,CCC=random") == 0
    event = cup()
    assert [one.game for one in event.fixtures] == ["pitanks", "race", "pitanks"]
    assert event.spec.minutes == {"race": 0.1, "pitanks": 0.05}
    assert event.spec.arenas == {"race": ("kidney",)}
    assert event.spec.variants == {"pitanks": "party", "race": "party"}
    assert "AAA" in output("run", "cup.json", "--headless")


def test_arenas_take_turns_in_the_order_that_is_chosen(tmp_path, output):
    (tmp_path / "own.toml").write_text(Path(ROOT / "assets/arenas/race/kidney.toml").read_text(encoding="utf-8"))
    words = ["--game", "race,pitanks", "--arena", "pitanks=islands+classic,race=own.toml+hairpin", "--rounds", "6"]
    assert new(*words, "--seats", "3", form="grandprix", entrants="AAA=random,BBB=idle,CCC=random") == 0
    output("run", "cup.json", "--headless")
    event = cup()
    own = str(tmp_path / "own.toml")
    assert [(one.game, one.arena) for one in event.fixtures] == [
        ("race", own), ("pitanks", "islands"), ("race", "hairpin"), ("pitanks", "classic"), ("race", own),
        ("pitanks", "islands"),
    ]  # fmt: skip
    assert event.over


def test_entrants_from_a_file(tmp_path, capsys):
    (tmp_path / "list.csv").write_text("name;ai;team\nAna;level1;Red\nBia;;Blue\nCarla;idle;Red\n", encoding="utf-8")
    assert new(entrants="@list.csv") == 0
    assert "Carla" in capsys.readouterr().out
    assert [entrant.team for entrant in cup().entrants] == ["Red", "Blue", "Red"]


def test_columns_that_are_not_known_are_named_in_one_line(tmp_path, capsys):
    (tmp_path / "list.csv").write_bytes("Klasse;Spieler;Größe\n5a;Jürgen;1,50\n5b;Bea;\n5c;Eva;\n".encode("mac_roman"))
    assert new(entrants="@list.csv") == 0
    assert capsys.readouterr().err == (
        "PiGaming: list.csv: columns that are not known are ignored: 'Größe'\n"
        "PiGaming: list.csv: with --teams class each class is a team\n"
    )
    assert [entrant.name for entrant in cup().entrants] == ["Jürgen", "Bea", "Eva"]


def test_classes_become_teams_and_the_seeding_is_drawn_by_lot(tmp_path, capsys):
    rows = "\n".join(
        f"5{'ab'[i % 2]};{name};Reis{i}" for i, name in enumerate(["Ana", "Bea", "Eva", "Ana", "Ida", "Ute"])
    )
    (tmp_path / "list.csv").write_text(f"Klasse;Vorname;Nachname\n{rows}\n", encoding="utf-8")
    assert new("--teams", "class", "--seeding", "random", entrants="@list.csv") == 0
    assert capsys.readouterr().err == "PiGaming: list.csv: equal first names are told apart: Ana Reis0, Ana Reis3\n"
    drawn = [(entrant.name, entrant.team) for entrant in cup().entrants]
    assert sorted(drawn) == sorted(
        [("Ana Reis0", "5a"), ("Bea", "5b"), ("Eva", "5a"), ("Ana Reis3", "5b"), ("Ida", "5a"), ("Ute", "5b")]
    )
    assert {row.entrant for row in cup().team_standings} == {"5a", "5b"}
    orders = set()
    for seed in range(6):
        Path("cup.json").unlink()
        new("--teams", "class", "--seeding", "random", "--seed", str(seed), entrants="@list.csv")
        orders.add(tuple(entrant.name for entrant in cup().entrants))
    assert len(orders) > 3


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--teams", "class"], "--teams class needs a list with a column of classes"),
        (["--teams", "age", "--entrants", "@list.csv"], "no choice for --teams: 'age'; there are class"),
        (["--teams", "class", "--entrants", "@list.csv"], "list.csv: the list has no column of classes"),
        (["--seeding", "luck"], "no seeding 'luck'; there are list, random"),
    ],
)
def test_teams_and_seedings_that_there_are_not(tmp_path, refused, words, reason):
    (tmp_path / "list.csv").write_text("Ana\nBea\nEva\n", encoding="utf-8")
    assert reason in refused(*NEW, *words)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("Ana\nBea=level9\nEva\n", "list.csv: line 2: no brain 'level9'"),
        ("name;ai\n\nAna;\n" + "x" * 25 + ";\n", "list.csv: line 4: 'xxxxxxxxxxxxxxxxxxxxxxxxx': a name has 1 to 24"),
        ('Ana\n"Bea\nEva\n', "list.csv: line 2: a quoted cell does not end with a quote"),
        ("Ana\nBea\n", "list.csv: line 2: the list ends with 2 entrants; an event has 3 to 64"),
    ],
)
def test_a_list_is_refused_with_file_and_line(tmp_path, refused, text, reason):
    (tmp_path / "list.csv").write_text(text, encoding="utf-8")
    assert reason in refused(*NEW, "--entrants", "@list.csv")


def test_a_knockout_of_robots_that_never_score_ends_by_lot(output):
    assert new("--title", "t", form="knockout", entrants="A=idle,B=idle,C=idle") == 0
    output("run", "cup.json", "--headless")
    shown = json.loads(output("show", "cup.json", "--json"))
    assert all(
        match["sudden_death"] == [[sorted(match["entrants"])]] * 3 and match["lots"] for match in shown["matches"]
    )
    assert [row["place"] for row in shown["standings"]] == [1, 2, 3]
    event = cup()
    assert [len(event.played[number]) for number in sorted(event.played)] == [4] * len(event.fixtures)


def test_exports(output):
    assert new() == 0
    output("run", "cup.json", "--headless")
    assert output("export", "cup.json", "--csv", "a.csv", "--matches", "b.csv", "--json", "a.json") == ""
    whole = json.loads(Path("a.json").read_text(encoding="utf-8"))
    with open("a.csv", newline="", encoding="utf-8-sig") as file:
        table = [*csv.DictReader(file)]
    assert [row["entrant"] for row in table] == [row["entrant"] for row in whole["standings"]]
    assert [float(row["points"]) for row in table] == [row["points"] for row in whole["standings"]]
    with open("b.csv", newline="", encoding="utf-8-sig") as file:
        matches = [*csv.DictReader(file)]
    assert [(int(row["match"]), row["entrant"]) for row in matches] == [
        (match["match"], name) for match in whole["matches"] for name in match["entrants"]
    ]


def test_a_poster_needs_no_display(output, refused, monkeypatch):
    pytest.importorskip("PIL")
    from PIL import Image

    monkeypatch.setenv("SDL_VIDEODRIVER", "none of these")
    assert new(form="knockout") == 0
    output("run", "cup.json", "--headless")
    output("export", "cup.json", "--poster", "a.png")
    output("export", "cup.json", "--poster", "b.pdf", "--csv", "b.csv")
    assert sorted(path.name for path in Path().glob("a*.png")) == ["a-2.png", "a-3.png", "a.png"]
    with Image.open("a.png") as picture:
        assert picture.size == (2480, 3508)
    assert Path("b.pdf").read_bytes().startswith(b"%PDF")
    assert Path("b.csv").is_file()
    refused("event", "export", "cup.json", "--poster", "a.jpg")
    refused("event", "export", "cup.json", "--poster", "a.png", "--csv", "a-2.png")


def test_in_a_kiosk_the_supervisor_marks_the_event_and_the_arcade_opens_what_is_marked(monkeypatch):
    from pigaming_app.events import resume
    from pigaming_app.jobs import arcade
    from pigaming_app.jobs.terminal import supervised as child
    from pigaming_app.storage.settings import folders

    show, supervised = Mock(return_value=0), Mock(return_value=0)
    monkeypatch.setattr(arcade, "show", show)
    monkeypatch.setattr(arcade, "supervised", supervised)
    assert new() == 0
    words = ["event", "run", "cup.json", "--kiosk", "--display", "2"]
    assert main(words) == 0
    assert [call.args[0].words for call in supervised.call_args_list] == [tuple(words)]
    assert resume.marked(folders().data) == Path("cup.json").absolute()
    monkeypatch.setenv(child.VARIABLE, "a file")
    assert main(words) == 0
    shown = show.call_args.args[0]
    assert (shown.kiosk, shown.display, shown.first_scene) == (True, 1, None)
    assert main([*words, "--headless"]) == 2


def test_a_cell_is_never_a_formula(refused):
    refused(*NEW, "--entrants", "=1+2,+1,CCC")
    refused(*NEW, "--entrants", "@x,-1,CCC")
    Path("list.txt").write_text("-1\n+2\n@x\n")
    assert new(entrants="@list.txt") == 0
    assert main(["event", "export", "cup.json", "--csv", "a.csv"]) == 0
    assert "'@x" in Path("a.csv").read_text(encoding="utf-8-sig")


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--game", "chess"], "no game 'chess'"),
        (["--format", "duel"], "no format 'duel'; there are knockout, roundrobin, swiss, grandprix"),
        (["--entrants", "A,B"], "an event has 3 to 64 entrants, not 2"),
        (["--entrants", "A,B,A"], "A is entered twice"),
        (["--entrants", "A=nobody,B,C"], "no brain 'nobody'"),
        (["--entrants", "A=no.npz,B,C"], "no.npz"),
        (["--entrants", "@nowhere.txt"], "cannot be read"),
        (["--entrants", "A" * 25 + ",B,C"], "1 to 24 printable characters"),
        (["--arena", "nowhere"], "nowhere: no such arena"),
        (["--arena", "classic+nowhere"], "nowhere: no such arena for pitanks"),
        (["--rules", "nothing"], "no variant 'nothing'"),
        (["--minutes", "x"], "'x' is not a number"),
        (["--minutes", "race=1"], "GAME=VALUE is needed, with one of pitanks"),
        (["--minutes", "200"], "200 minutes"),
        (["--seats", "5"], "5"),
        (["--advance", "all"], "no choice for --advance: 'all'"),
        (["--fill", "level1"], "AIs fill seats in grandprix, timetrial, highscore only"),
        (["--fill", "nobody", "--format", "grandprix"], "no brain 'nobody'"),
        (["--game", "factory", "--rules", "together"], "nobody wins"),
        (["--title", "x" * 61], "a title has 1 to 60 printable characters"),
    ],
)
def test_a_wrong_option_is_one_line(words, reason, refused):
    assert reason in refused(*NEW, *words)
    assert not Path("cup.json").exists()


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["run", "no.json", "--headless"], "no.json: no such event"),
        (["run", "broken.json", "--headless"], "cannot be read"),
        (["run", "cup.json", "--json"], "need --headless"),
        (["run", "cup.json", "--headless", "--speed", "fast"], "'fast' is not a number"),
        (["run", "cup.json", "--arcade", "left", "--headless"], "--arcade go without --headless"),
        (["run", "cup.json", "--arcade", "x" * 25], "1 to 24 printable characters"),
        (["show", "."], "cannot be read"),
        (["export", "cup.json"], "--csv, --matches, --json, --poster or --certificates"),
        (["export", "cup.json", "--certificates", "a.png"], "is not the name of a .pdf file"),
        (["export", "cup.json", "--certificates", "a.pdf"], "no match has been played"),
        (["export", "cup.json", "--csv", "a.csv", "--places", "3"], "--places goes with --certificates"),
        (["export", "cup.json", "--csv", "cup.json"], "a name of its own"),
        (["export", "cup.json", "--csv", "a", "--json", "./a"], "a name of its own"),
        (["export", "cup.json", "--csv", "."], "it is a folder"),
        (["draw"], "invalid choice"),
    ],
)
def test_a_wrong_file_is_one_line(words, reason, refused):
    assert new() == 0
    Path("broken.json").write_text("[]")
    assert reason in refused("event", *words)


OPTIONS = (
    "--game", "--format", "--entrants", "--rounds", "--seats", "--minutes", "--arena", "--rules", "--advance", "--fill",
    "--title", "--seed",
)  # fmt: skip


@POSIX
@pytest.mark.parametrize("seed", one_in(2, range(2)))
def test_every_value_is_used_or_refused_in_one_line(tmp_path, monkeypatch, seed):
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    furnish(tmp_path / "here")
    basic = ["event", "new", "cup.json", "--format", "swiss", "--entrants", "A,B,C", *SHORT]
    cases = [[*basic, option, value] for option in OPTIONS for value in ANY]
    cases += [["event", *words, value] for words in (["show"], ["run", "--headless"], [], ["export"]) for value in ANY]
    cases += [["event", "new", value, *basic[3:]] for value in ANY]
    assert main(["event", "new", "kept.json", *basic[3:]]) == 0
    targets = ("--csv", "--matches", "--json", "--poster")
    cases += [["event", "export", "kept.json", option, value] for option in targets for value in ANY]
    faults = {}
    for case in random.Random(seed).sample(cases, 120):
        Path("cup.json").unlink(missing_ok=True)
        if wrong := fault(case):
            faults[repr(case)] = wrong
    assert not faults


def test_neither_a_folder_is_created_nor_an_event_overwritten(refused):
    assert "nowhere" in refused("event", "new", "nowhere/cup.json", *NEW[3:])
    assert not Path("nowhere").exists()
    assert new() == 0
    before = Path("cup.json").read_bytes()
    assert "exists already" in refused(*NEW)
    assert Path("cup.json").read_bytes() == before


@pytest.mark.long
@POSIX
def test_a_killed_run_goes_on_where_it_stopped(output):
    def begin():
        assert new("--rounds", "8", entrants="A=random,B=idle,C=random,D=idle") == 0

    begin()
    command = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), "event", "run", "cup.json", "--headless"]
    done = 0
    for _ in range(3):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        while process.poll() is None and len(cup().outcomes) < done + 3:
            time.sleep(0.02)
        process.send_signal(signal.SIGKILL)
        process.wait()
        event = cup()
        assert len(event.outcomes) >= done + 3 or event.over
        done = len(event.outcomes)
    result = json.loads(output("run", "cup.json", "--headless", "--json"))
    assert len(result["matches"]) == 48
    assert all(match["played"] for match in result["matches"])
    assert not [*Path().glob(".pigaming-*")]
    resumed = cup()
    Path("cup.json").unlink()
    begin()
    output("run", "cup.json", "--headless")
    assert cup() == resumed
