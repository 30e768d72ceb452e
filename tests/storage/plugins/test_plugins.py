"""Plug-in games: found, switched on, loaded by part; one that fails is left out with one line."""

import json
import re
from pathlib import Path

import pytest

from pigaming_app.jobs.new_game import write
from pigaming_app.storage.plugins import consent, found
from pigaming_app.storage.plugins.consent import is_on, switch
from pigaming_app.storage.plugins.found import Plugin, user_folder
from tests.plugins.packages import changed, install
from tests.processes import ROOT, Ended, program, python

LEFT_OUT = "PiGaming: The game tag in {folder} is left out: {reason}\n"


@pytest.fixture
def tag(home: Path) -> Path:
    """The package of a new game that is switched on."""
    folder = user_folder() / "tag"
    write(folder, "tag")
    switch("tag", True)
    return folder


def play() -> Ended:
    return program(
        "play", "tag", "--headless", "--speed", "max", "--minutes", "0.1", "--seats", "level5,level1", "--json"
    )


def test_a_new_game_plays_at_once(tag: Path) -> None:
    ended = play()
    assert (ended.returncode, ended.stderr) == (0, "")
    assert json.loads(ended.stdout)["game"] == "tag"


def test_games_are_found_in_the_users_folder_and_beside_the_program(tag: Path) -> None:
    plugins = {plugin.name: plugin for plugin in found.found()}
    assert plugins["tag"].folder == tag
    assert not plugins["tag"].own
    assert all(plugin.own == (plugin.folder.parent == ROOT) for plugin in plugins.values())


def test_a_package_without_a_proper_name_is_no_game(tag: Path) -> None:
    for name in ("Tag", "2tag", "tag-2", "x" * 25):
        write(user_folder() / name, "tag")
    (user_folder() / "notes").mkdir()
    assert [plugin.name for plugin in found.found() if not plugin.own] == ["tag"]


def test_a_new_plug_in_runs_no_code_before_it_is_switched_on(tag: Path) -> None:
    trace = tag.parent / "ran"
    source = tag / "__init__.py"
    source.write_text(f"open({str(trace)!r}, 'w').close()\n" + source.read_text())
    (user_folder().parent.parent / "config" / consent.FILE).unlink()
    ended = play()
    assert ended.returncode == 2
    assert ended.stderr == (f"PiGaming: the game tag in {tag} is new, and runs code of its own: main.py games on tag\n")
    assert "tag: new" in program("games").stdout
    assert not trace.exists()
    assert program("games", "on", "tag").returncode == 0
    assert play().returncode == 0
    assert trace.exists()


def test_one_that_is_switched_off_is_named(tag: Path) -> None:
    assert program("games", "off", "tag").stdout == "tag is off, from the next start on\n"
    assert f"the game tag in {tag} is switched off: main.py games on tag" in play().stderr


@pytest.mark.parametrize(
    ("file", "old", "new", "reason"),
    [
        ("rules.py", "REACH = 60.0", "REACH = 60.0 +", "rules.py, line {n}: SyntaxError: invalid syntax"),
        ("rules.py", "REACH = 60.0", "REACH = SIXTY", "rules.py, line {n}: NameError: name 'SIXTY' is not defined."),
        ("__init__.py", "GAME = ", "THIS = ", "__init__.py: GAME is missing."),
        ("__init__.py", 'name="tag"', 'name="tick"', "its game is named tick, not tag."),
        ("__init__.py", "GAME = Game(", "GAME = dict(", "GAME is no Game."),
        ("__init__.py", "GAME = ", "raise SystemExit(3)\nGAME = ", "__init__.py, line {n}: SystemExit: 3."),
    ],
)  # fmt: skip
def test_one_that_fails_is_left_out_with_file_and_reason(tag: Path, file: str, old: str, new: str, reason: str) -> None:
    reason = reason.format(n=changed(tag / file, old, new))
    ended = program("duel", "pitanks", "level1", "idle", "--matches", "2", "--minutes", "0.05")
    assert ended.returncode == 0
    assert ended.stderr.startswith(LEFT_OUT.format(folder=tag, reason=reason).rstrip("\n"))
    assert ended.stderr.count("\n") == 1
    ended = play()
    assert (ended.returncode, ended.stdout, ended.stderr.count("\n")) == (1, "", 1)


@pytest.mark.parametrize(
    ("brains", "reason"),
    [
        ("{}", "kinds: level1, level2, level3, level4, level5 missing"),
        ('KINDS | {"net": think}', "kinds: net is no BrainKind"),
        ('KINDS, rivals=("level1", "net")', "rivals: not all of level1, net are in kinds"),
        ('KINDS, driving={"fly": 1}', "driving: no set of styles: fly"),
    ],
)
def test_brains_that_the_lobby_could_not_offer(tag: Path, brains: str, reason: str) -> None:
    kinds = 'levels(BrainKind("collector", Mind, think))'
    n = changed(tag / "ai.py", f"AI = GameAI({kinds})", f"AI = GameAI({brains.replace('KINDS', kinds)})")
    ended = python("from pigaming_app.ai.registry import AIS; print(*AIS['tag'].kinds)")
    assert ended.stdout.split() == ["level1", "level2", "level3", "level4", "level5"], "random ones"
    assert f"is left out: ai.py, line {n}: ValueError: {reason}" in ended.stderr
    assert ended.stderr.count("\n") == 1


def test_a_brain_that_the_lobby_offers_has_a_name(tag: Path) -> None:
    file = tag / "ai.py"
    kinds = 'levels(BrainKind("collector", Mind, think))'
    file.write_text(file.read_text().replace(kinds, f'{kinds} | {{"ace": BrainKind("ace", Mind, think)}}, ("ace",)'))
    ended = python("from pigaming_app.scenes.views.registry import shown_games; print(*shown_games())")
    assert "tag" not in ended.stdout.split()
    assert "is left out: text/en.toml lacks lobby.ace, match.ace." in ended.stderr


@pytest.mark.parametrize(
    ("file", "old", "new", "reason"),
    [
        ("screens.py", "SCREENS = ", "SCREENS = 1 or ", "SCREENS is no GameScreens"),
        ("text/en.toml", 'arena_tag = "Arena"', "", "text/en.toml lacks setup.arena_tag"),
        ("text/en.toml", "[games]", "[games", "text/en.toml: "),
        ("text/en.toml", "[games]", f"[{'a.' * 100}b]\n[games]", "text/en.toml: nested more than 32 deep"),
        ("text/en.toml", '"Most coins win."', '"Most {coins win."', "text/en.toml: rules.tag_standard: expected '}'"),
        (
            "text/en.toml",
            '"Most coins win."',
            '"{0.__class__}"',
            "text/en.toml: rules.tag_standard: {0.__class__} is no",
        ),
        (
            "text/en.toml",
            '"Most coins win."',
            '"{n} wins."',
            "text/en.toml: rules.tag_standard: no value has the name n",
        ),
        ("text/en.toml", '= "Tag"', '= "Ta\\u0000g"', "text/en.toml: games.tag: more than 500 letters, or a control"),
        ("text/en.toml", '= "Tag"', f'= "{"Tag" * 200}"', "text/en.toml: games.tag: more than 500 letters"),
        ("text/en.toml", "[howto]", "[howto]\npress = 5", ""),
    ],
)
def test_one_that_cannot_be_shown_is_not_on_the_screens(tag: Path, file: str, old: str, new: str, reason: str) -> None:
    source = tag / file
    assert old in source.read_text()
    source.write_text(source.read_text().replace(old, new, 1))
    code = "from pigaming_app.scenes.views.registry import shown_games; print(*shown_games())"
    ended = python(code)
    assert ("tag" in ended.stdout.split()) == (not reason)
    assert {"pitanks", "factory", "race"} <= {*ended.stdout.split()}
    assert (f"The game tag in {tag} is left out: {reason}" in ended.stderr) == bool(reason)
    assert ended.stderr.count("\n") == int(bool(reason))


def test_a_translation_has_the_values_of_the_english_text(tag: Path) -> None:
    (tag / "text" / "pt.toml").write_text('[rules]\ntag_standard = "Ganha {quem}."\n')
    code = "from pigaming_app.ui.i18n import Words; w = Words('pt'); print('rules.tag_standard' in w, w('games.race'))"
    ended = python(code)
    assert ended.stdout.startswith("False ")
    reason = "text/pt.toml: rules.tag_standard: {quem} is not in the English text"
    assert ended.stderr == LEFT_OUT.format(folder=tag, reason=f"{reason}.")


def test_of_two_texts_with_one_key_the_first_counts(tag: Path) -> None:
    write(user_folder() / "zap", "zap")
    switch("zap", True)
    other = user_folder() / "zap" / "text" / "en.toml"
    other.write_text(other.read_text().replace("[games]", '[games]\ntag = "Zapped"'))
    code = "from pigaming_app.ui.i18n import Words; w = Words('en'); print(w('games.tag'), w('games.zap'))"
    assert python(code).stdout == "Tag Zap\n"


@pytest.mark.parametrize("file", ["__init__.py", "ai.py"])
def test_an_import_that_does_not_end_is_ended(tag: Path, file: str) -> None:
    source = tag / file
    source.write_text(
        f"while True:\n    try:\n        len('')\n    except Exception:\n        pass\n{source.read_text()}"
    )
    ended = python(
        "from pigaming_app.storage.plugins import parts; parts.LOADING = 0.3\n"
        "from pigaming_app.ai.registry import AIS; from pigaming_app.games.registry import games; print(*games(), *AIS)"
    )
    assert {"pitanks", "factory", "race"} <= {*ended.stdout.split()}
    assert f"The game tag in {tag} is left out: {file}, line " in ended.stderr
    assert "TimeoutError: not done after 0.3 s." in ended.stderr
    assert ended.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        ("robot.score += 1", "robot.score += 0.5", r"Tag\.robots\[\d\]\.score is \d+\.\d, no whole number\."),
        ("steer(match, k, 1.0)", "steer(match, k, 1e999 * 0)", r"Tag\.robots\[\d\]\.x is nan, no number\."),
        ("match.tick += 1", "raise SystemExit(0)", r"rules\.py, line \d+: SystemExit: 0\."),
    ],
)
def test_wrong_numbers_are_named_and_an_exit_is_a_failure(tag: Path, before: str, after: str, reason: str) -> None:
    rules = tag / "rules.py"
    assert before in rules.read_text()
    rules.write_text(rules.read_text().replace(before, after))
    ended = program("play", "tag", "--headless", "--speed", "max", "--minutes", "0.5", "--seats", "level5,level5")
    assert ended.returncode == 1
    assert re.fullmatch(rf"PiGaming: The game tag in \S+ is left out: {reason}\n", ended.stderr)


@pytest.mark.parametrize(
    "words", ["play tag --headless", "duel tag level5 idle --matches 2", "league tag level5 idle --matches 2"]
)
def test_one_that_fails_in_a_match_ends_the_job_with_one_line(tag: Path, words: str) -> None:
    rules = tag / "rules.py"
    rules.write_text(rules.read_text().replace("    match.tick += 1\n", "    match.tick += 1\n    match.tick //= 0\n"))
    ended = program(*words.split(), "--minutes", "0.1", *(("--seats", "level5,level1") if "play" in words else ()))
    assert ended.returncode == 1
    line = rules.read_text().splitlines().index("    match.tick //= 0") + 1
    reason = f"rules.py, line {line}: ZeroDivisionError: integer division or modulo by zero."
    assert ended.stderr == LEFT_OUT.format(folder=tag, reason=reason)


def test_one_that_fails_in_another_process_is_named(tag: Path) -> None:
    rules = tag / "rules.py"
    rules.write_text(rules.read_text().replace("    drop_coin(match)\n\n", "    drop_coin(match)\n    1 // 0\n\n", 1))
    ended = python(
        "from concurrent.futures import ProcessPoolExecutor\nfrom multiprocessing import get_context\n"
        "from pigaming_app.ai.plugin_faults import blame\nfrom pigaming_app.ai.registry import new_match\n"
        "from pigaming_app.games.game import Seat, Setup\nfrom pigaming_app.games.registry import games\n"
        "seats, _ = tuple(Seat('level5', k) for k in range(4)), games()\n"
        "with ProcessPoolExecutor(1, get_context('fork')) as pool:\n"
        "    error = pool.submit(new_match, Setup('tag', 'classic', seats, 1.0, 1, 'standard')).exception()\n"
        "print(blame(error).name)"
    )
    assert ended.stdout.split()[-1:] == ["tag"], ended.stderr
    line = rules.read_text().splitlines().index("    1 // 0") + 1
    assert f"left out: rules.py, line {line}: ZeroDivisionError" in ended.stderr


def test_one_that_prints_does_not_print_into_outcomes_from_another_process(tag: Path) -> None:
    for file, before in (("__init__.py", "GAME ="), ("rules.py", "    match.tick += 1")):
        source = tag / file
        after = f"{'    ' * before.startswith(' ')}print('tick')\n{before}"
        source.write_text(source.read_text().replace(before, after))
    ended = python(
        "from time import sleep\nfrom pigaming_app.events.event import Event\n"
        "from pigaming_app.events.spec import Entrant, EventSpec, Format\n"
        "from pigaming_app.scenes.events.quick_match import QuickMatches\n"
        "entrants = tuple(Entrant(name, 'level5') for name in ('A', 'B', 'C'))\n"
        "event = Event(EventSpec('Day', Format.ROUND_ROBIN, ('tag',), entrants, minutes={'tag': 0.1}))\n"
        "quick = QuickMatches(event, event.open[:1])\n"
        "while quick.next_outcome() is None and not quick.over: sleep(0.01)\n"
        "print('left', quick.left)"
    )
    assert ended.stdout == "left 0\n", ended.stderr


def test_two_of_one_name_and_one_of_our_names(tag: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    twin = install(tmp_path / "site", "tag", "robot_tag")
    write(twin, "tag")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "site"))
    for name in ("pitanks", "football"):
        write(user_folder() / name, name)
        switch(name, True)
    switch("tag@robot_tag", True)
    ended = program("duel", "pitanks", "level1", "idle", "--matches", "2", "--minutes", "0.05")
    assert ended.returncode == 0
    assert sorted(line.partition(" in ")[0] for line in ended.stderr.splitlines()) == [
        "PiGaming: The game football",
        "PiGaming: The game pitanks",
        "PiGaming: The game tag",
    ]
    assert f"The game tag in {twin} is left out: there is one in {tag} already." in ended.stderr
    assert "left out: there is a game pitanks already." in ended.stderr
    assert json.loads(play().stdout)["game"] == "tag"


def test_an_installed_one_runs_nothing_before_it_is_switched_on_nor_its_parents(
    home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "site"))
    write(install(tmp_path / "site", "tag", "robot_tag.game"), "tag")
    (tmp_path / "site" / "robot_tag" / "__init__.py").write_text("raise SystemExit('a parent')\n")
    switch("tag", True)  # another place's decision
    assert "is new, and runs code of its own" in play().stderr
    assert "tag: new" in program("games").stdout
    assert program("games", "on", "tag").returncode == 0
    assert "is left out: SystemExit: a parent." in play().stderr
    (tmp_path / "site" / "robot_tag" / "__init__.py").write_text("")
    assert json.loads(play().stdout)["game"] == "tag"


def test_one_for_another_api_is_refused_at_every_place(
    home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Installed, in one line, before any of its code runs, and though its imports fit no more."""
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "site"))
    folder = install(tmp_path / "site", "tag", "robot_tag")
    write(folder, "tag")
    switch("tag@robot_tag", True)
    package = folder / "__init__.py"
    package.write_text(package.read_text().replace("API = 1 ", "API = 2 ").replace("import Game,", "import Play,"))
    reason = f"The game tag in {folder} is left out: it was written for API 2, but this is API 1."
    ended = play()
    assert (ended.returncode, ended.stdout, ended.stderr) == (1, "", f"PiGaming: {reason}\n")
    assert f"note     added game               {reason}" in program("doctor").stdout
    assert "tag: on, left out, in" in program("games").stdout
    page = (
        "from pigaming_app.scenes.options.games_page import why\nfrom pigaming_app.storage.plugins.found import found\n"
    )
    page += "print(*[why(plugin) for plugin in found() if plugin.name == 'tag'])"
    assert python(page).stdout.splitlines()[-1] == "it was written for API 2, but this is API 1"
    package.write_text(package.read_text().replace("API = 2 ", "THIS = 2 "))
    assert (
        "is left out: __init__.py: API = 1 is missing, the number of the API that it was written for." in play().stderr
    )


def test_a_module_instead_of_a_package_is_left_out(home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "site"))
    install(tmp_path / "site", "tag", "robot_tag").with_suffix(".py").write_text("raise SystemExit\n")
    assert "tag: new, left out" in program("games").stdout
    switch("tag@robot_tag", True)
    assert "is left out: robot_tag is no package." in play().stderr


def test_folders_that_are_links_or_cannot_be_read(tag: Path, tmp_path: Path) -> None:
    elsewhere = tag.rename(tmp_path / "elsewhere")
    tag.symlink_to(elsewhere, target_is_directory=True)
    (user_folder() / "gone").symlink_to(tmp_path / "nowhere")
    (user_folder() / "round").symlink_to(user_folder() / "round")
    (user_folder() / "chess" / "__init__.py").mkdir(parents=True)
    (user_folder() / "notes.txt").write_text("no game")
    switch("chess", True)
    ended = play()
    assert json.loads(ended.stdout)["game"] == "tag"
    reason = f"The game chess in {user_folder() / 'chess'} is left out: it cannot be read (Is a directory)."
    assert ended.stderr == f"PiGaming: {reason}\n"


def test_only_a_plug_ins_own_replays_depend_on_its_rules(tag: Path) -> None:
    code = "from pigaming_app.games.engine_hash import engine_hash as h; print(h('pitanks'), h('tag'))"

    def hashes() -> list[str]:
        return python(code).stdout.split()

    before = hashes()
    assert before[0] != before[1]
    rules, brain = tag / "rules.py", tag / "ai.py"
    brain.write_text(brain.read_text().replace("PERIOD = 5", "PERIOD = 6"))
    assert hashes() == before
    rules.write_text(rules.read_text().replace("REACH = 60.0", "REACH = 61.0"))
    after = hashes()
    assert after[0] == before[0]
    assert after[1] != before[1]


def test_a_replay_names_a_game_that_is_not_here_and_rules_that_are_others(tag: Path, tmp_path: Path) -> None:
    words = ["play", "tag", "--headless", "--speed", "max", "--minutes", "0.1", "--seats", "level5,level1"]
    assert program(*words, "--record", str(tmp_path / "one.replay")).returncode == 0
    replay = program("replay", str(tmp_path / "one.replay"), "--verify")
    assert (replay.returncode, replay.stderr) == (0, "")
    rules = tag / "rules.py"
    rules.write_text(rules.read_text().replace("REACH = 60.0", "REACH = 90.0"))
    assert "another version of the engine" in program("replay", str(tmp_path / "one.replay"), "--verify").stderr
    assert program("games", "off", "tag").returncode == 0
    replay = program("replay", str(tmp_path / "one.replay"), "--verify")
    reason = f"one.replay: the game tag in {tag} is switched off: main.py games on tag"
    assert (replay.returncode, replay.stderr) == (2, f"PiGaming: {reason}\n")


@pytest.mark.parametrize("text", ["", "[]", "{", '{"tag": 1}', '{"../tag": true}', "\x00"])
def test_damaged_decisions_switch_nothing_on(home: Path, text: str) -> None:
    file = home / "config" / consent.FILE
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    assert is_on(Plugin("tag", "tag", home)) is None
    assert is_on(Plugin("football", "pigaming_football", home, own=True)) is True


def test_a_new_game_may_have_a_name_that_its_files_use(home: Path) -> None:
    names = ["any", "game", "mind", "new_game_2", "none", "rules", "setup", "world"]
    for name in names:
        write(user_folder() / name, name)
        switch(name, True)
    ended = python(
        "from pigaming_app.ai.registry import AIS\nfrom pigaming_app.scenes.views.registry import shown_games\n"
        "from pigaming_app.games.registry import games\nfrom pigaming_app.games.game import Seat, Setup\n"
        "from pigaming_app.ai.registry import new_match\nseats = tuple(Seat('level5', k) for k in range(4))\n"
        f"for name in {names}: new_match(Setup(name, 'classic', seats, 1.0, 1, 'standard')).tick()\n"
        "print(*shown_games())"
    )
    assert (ended.stdout.split()[-len(names) :], ended.stderr) == (names, "")


@pytest.mark.parametrize("name", ["Tag", "2", "a-b", "x" * 25, "", "../x", "pitanks"])
def test_a_new_game_needs_a_new_name(home: Path, name: str) -> None:
    ended = program("new-game", name)
    assert ended.returncode == 2
    assert ended.stderr.count("\n") == 1
    assert not user_folder().exists()
