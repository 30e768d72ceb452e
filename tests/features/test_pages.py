"""Each feature has a page, and its tests can be run alone."""

import re
from pathlib import Path

import pytest

from pigaming_app.jobs.bench.test import paths_of
from pigaming_app.jobs.features import every_feature
from pigaming_app.jobs.terminal.refusal import Refusal

ROOT = Path(__file__).resolve().parents[2]
NAMES = [feature.name for feature in every_feature()]


@pytest.mark.parametrize("feature", every_feature(), ids=NAMES)
def test_a_feature_has_a_short_page_with_its_rooms_and_its_command(feature) -> None:
    folder = ROOT / "pigaming_app"
    text = (folder / feature.rooms[0].replace(".", "/") / "README.md").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 40
    assert text.endswith(f"`python3 main.py test --feature {feature.name}`\n")
    rooms = re.findall(r"^\| (.*?) \|", text, re.M)[1:]
    named = {name for cell in rooms for name in re.findall(r"`(.*?)`", cell)}
    assert all((folder / name).exists() or (ROOT / name).exists() for name in named), named
    for room in feature.rooms:
        path = room.replace(".", "/")
        assert {path, f"{path}/", f"{path}.py"} & named, room


@pytest.mark.parametrize("name", NAMES)
def test_the_paths_of_a_feature_mirror_its_rooms(name: str) -> None:
    paths = paths_of(name)
    assert paths
    assert all((ROOT / path).exists() for path in paths)


def test_an_unknown_feature_is_refused() -> None:
    with pytest.raises(Refusal, match="no feature 'cheese'; there are attract, brain"):
        paths_of("cheese")
