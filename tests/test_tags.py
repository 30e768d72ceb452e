"""What a tag wrote is read by its successors."""

import shutil

import pytest

from pigaming_app import __version__
from tests.tags import FOLDER, KINDS

TAGS = sorted(path.name for path in FOLDER.iterdir())


def test_the_present_version_has_files():
    assert __version__ in TAGS


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("tag", TAGS)
def test_a_file_of_each_kind_is_read(tag, kind, tmp_path):
    shutil.copytree(FOLDER / tag, tmp_path / tag)
    assert KINDS[kind].read(tmp_path / tag) == KINDS[kind].value


def test_the_files_are_small():
    assert sum(path.stat().st_size for path in (FOLDER / __version__).rglob("*.*")) < 40_000
