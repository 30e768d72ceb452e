"""Files with a backup: whatever damages one, it is put aside, and the version before serves."""

import os
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import pytest

from pigaming_app.events import climb_files, event_files
from pigaming_app.events.ladder import Climb
from pigaming_app.events.spec import Format
from pigaming_app.storage import scores
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.scores import Scores, ScoreTable
from pigaming_app.storage.settings import FILE, Settings
from tests.events.examples import new_event

TABLE = ScoreTable("pitanks", "classic", "points", rules="plain", length=2, people=1)
Loaded = tuple[int | None, list[str]]


@dataclass(frozen=True)
class Kept:
    """A file of whose content there are numbered versions; None is what there is without a file."""

    file: str
    save: Callable[[Path, int], object]
    load: Callable[[Path], Loaded]


def load_settings(folder: Path) -> Loaded:
    settings, problems = Settings.load(folder)
    return None if settings == Settings() else settings.music, problems


def save_score(folder: Path, number: int) -> None:
    book = Scores.load(folder)[0]
    book.add(TABLE, "ABC", number)
    book.save(folder)


def load_scores(folder: Path) -> Loaded:
    book, problems = Scores.load(folder)
    return next((row.score for row in book.best(TABLE)), None), problems


def load_climb(folder: Path) -> Loaded:
    climbs, problems = climb_files.saved_climbs(folder)
    return next((one.climb.rung for one in climbs), None), problems


def load_event(folder: Path) -> Loaded:
    event, problems = event_files.load(folder / "a.json")
    return int(event.spec.title) if event else None, problems


KEPT = {
    "settings": Kept(FILE, lambda folder, number: Settings(music=number).save(folder), load_settings),
    "scores": Kept(scores.FILE, save_score, load_scores),
    "climbs": Kept(climb_files.FILE, lambda folder, n: climb_files.save(folder, 7, Climb("race", rung=n)), load_climb),
    "event": Kept(
        "a.json",
        lambda folder, number: event_files.save(folder / "a.json", new_event(Format.SWISS, 4).renamed(str(number))),
        load_event,
    ),
}
TEXTS = {
    "lists": "x = " + "[" * 2000 + "]" * 2000,
    "a header": "[" + ".".join("a" * 2000) + "]\n",
    "tables": "x = " + "{a=" * 2000 + "1" + "}" * 2000,
    "digits": f"format = {'9' * 5000}\n",
    "a key twice": "format = 1\nformat = 1\n",
    "half": '[[table]]\nrows = [ { initials = "AB',
    "bytes": "\x00\x01",
    "no UTF-8": "\udcff\x00",
    "another format": "format = 2\n",
    "no number": "format = true\n",
    "another file": "[pitanks]\n",
}


def huge(path: Path) -> None:
    path.touch()
    os.truncate(path, 100_000_000)


DAMAGES: dict[str, Callable[[Path], object]] = {
    **{name: partial(Path.write_text, data=text, errors="surrogateescape") for name, text in TEXTS.items()},
    "100 MB": huge,
    "a folder": Path.mkdir,
    "a pipe": os.mkfifo if hasattr(os, "mkfifo") else Path.mkdir,
}
LENIENT = ("another format", "no number", "another file")  # what settings ignore as single lines
CASES = [(kind, damage) for kind in KEPT for damage in DAMAGES if kind != "settings" or damage not in LENIENT]


@pytest.mark.parametrize("backup", [True, False])
@pytest.mark.parametrize(("kind", "damage"), CASES)
def test_a_damaged_file_is_put_aside_and_the_version_before_serves(
    tmp_path: Path, kind: str, damage: str, backup: bool
) -> None:
    kept = KEPT[kind]
    path = tmp_path / kept.file
    for number in (1, 2):
        kept.save(tmp_path, number)
    assert kept.load(tmp_path) == (2, [])
    path.unlink()
    if not backup:
        path.with_name(f"{path.name}.bak").unlink()
    DAMAGES[damage](path)
    found, (problem,) = kept.load(tmp_path)
    assert found == (1 if backup else None)
    assert problem.isprintable()
    assert len(problem) < 500
    assert problem.startswith(f"{path} cannot be read (")
    assert ("larger than" in problem) == (damage == "100 MB")
    if kind == "event" and not backup:
        assert path.exists(), "perhaps it is no event at all"
        return
    (aside,) = tmp_path.glob(f"{path.name}.broken-*")
    assert aside.name in problem
    assert problem.endswith("the previous version was restored." if backup else "there is no usable backup.")
    assert kept.load(tmp_path) == (found, []), "once"
    kept.save(tmp_path, 3)
    assert kept.load(tmp_path) == (3, [])


@pytest.mark.parametrize("kind", KEPT)
def test_a_file_in_place_of_the_folder_is_reported_and_unchanged(tmp_path: Path, kind: str) -> None:
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(NotSaved, match=f"{KEPT[kind].file} was not saved"):
        KEPT[kind].save(tmp_path / "file", 1)
    assert (tmp_path / "file").read_text() == "in the way"
