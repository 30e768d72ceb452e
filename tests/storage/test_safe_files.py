"""A file is complete at any time: after a full disk, a failed system call, or a kill at any moment."""

import os
import random
import subprocess
import sys
import time
from pathlib import Path

import pytest

from pigaming_app.storage.safe_files import (
    AtomicFile,
    NotSaved,
    delete_temporary_files,
    require_writable,
    write_atomic,
    write_with_backup,
)
from tests.disks import content, failing_at, room_for

ROOT = Path(__file__).resolve().parents[2]
POSIX = pytest.mark.skipif(os.name != "posix", reason="limits, locks and signals of POSIX")
OLD, NEW = "the old text\n" * 1000, "the new text\n" * 2000
WRITER = """
import sys
from pathlib import Path
from pigaming_app.storage.safe_files import write_atomic
texts = [letter * 3_000_000 for letter in (b"a", b"b")]
print("begun", flush=True)
while True:
    for text in texts:
        write_atomic(Path(sys.argv[1]), text)
"""


@POSIX
@pytest.mark.parametrize("size", [0, 1, 4096, len(OLD), len(NEW) - 1])
def test_a_full_disk_leaves_the_old_file(tmp_path, size):
    path = tmp_path / "file"
    path.write_text(OLD)
    with room_for(size), pytest.raises(NotSaved, match="file was not saved"):
        write_atomic(path, NEW.encode())
    assert content(tmp_path) == {"file": OLD.encode()}


def test_whichever_call_fails_there_is_the_old_file_or_the_new_one(tmp_path):
    path = tmp_path / "file"
    path.write_text(OLD)
    for step in range(100):
        refused = False
        with failing_at(step) as made:
            try:
                write_atomic(path, NEW.encode())
            except NotSaved:
                refused = True
        assert content(tmp_path) == {"file": (OLD if refused else NEW).encode()}
        path.write_text(OLD)
        if len(made) <= step:
            break
    assert {"open", "fsync", "chmod", "replace"} <= set(made)
    assert made[-2:] == ["open", "fsync"], "the folder is synced last"


def test_whichever_call_fails_a_kept_file_and_its_backup_are_whole(tmp_path):
    whole = {OLD.encode(), NEW.encode(), b"first"}
    for step in range(100):
        folder = tmp_path / str(step)
        write_with_backup(folder / "file", "first")
        write_with_backup(folder / "file", OLD)
        with failing_at(step) as made:
            try:
                write_with_backup(folder / "file", NEW)
                expected = NEW
            except NotSaved:
                expected = OLD
        assert (folder / "file").read_text() == expected
        assert set(content(folder)) == {"file", "file.bak"}
        assert set(content(folder).values()) <= whole
        if len(made) <= step:
            break
    assert len(made) > 8


def test_a_draft_replaces_the_file_only_when_it_is_finished_and_leaves_nothing_else(tmp_path):
    path = tmp_path / "file"
    path.write_text(OLD)
    dropped, draft = AtomicFile(path), AtomicFile(path)
    for part in (b"half", b" and half"):
        dropped.write(part)
        draft.write(part)
        assert path.read_text() == OLD
    dropped.discard()
    draft.finish()
    for one in (draft, dropped):
        one.discard()
    assert content(tmp_path) == {"file": b"half and half"}


@POSIX
def test_a_killed_process_leaves_a_complete_file_and_its_temporary_file_is_deleted(tmp_path):
    path, chance = tmp_path / "file", random.Random(4)
    path.write_bytes(b"a" * 3_000_000)
    left = 0
    for _ in range(6):
        with subprocess.Popen([sys.executable, "-c", WRITER, path], cwd=ROOT, stdout=subprocess.PIPE) as writer:
            assert writer.stdout
            assert writer.stdout.readline() == b"begun\n"
            time.sleep(chance.uniform(0.0, 0.03))
            writer.kill()
        text = path.read_bytes()
        assert len(text) == 3_000_000
        assert len(set(text)) == 1
        left += len(os.listdir(tmp_path)) - 1
        delete_temporary_files(tmp_path)
        assert os.listdir(tmp_path) == ["file"]
    assert left, "no kill came while a file was being written"


def test_a_file_that_another_instance_is_writing_is_not_deleted(tmp_path):
    draft = AtomicFile(tmp_path / "file")
    draft.write(b"in the middle")
    delete_temporary_files(tmp_path)
    draft.finish()
    assert content(tmp_path) == {"file": b"in the middle"}


def test_temporary_files_are_deleted_and_no_others(tmp_path):
    left = {".pigaming-0123abcd.tmp"}
    others = {"settings.toml", ".hidden", "pigaming-0123abcd.tmp", ".pigaming-notes.txt", ".settings.toml-abcd_123"}
    for name in left | others:
        (tmp_path / name).write_text("")
    (tmp_path / ".pigaming-89abcdef.tmp").mkdir()
    delete_temporary_files(tmp_path, tmp_path / "nowhere")
    assert set(os.listdir(tmp_path)) == others | {".pigaming-89abcdef.tmp"}


def test_a_link_stays_a_link_and_a_file_keeps_its_mode(tmp_path):
    (tmp_path / "there").mkdir()
    (tmp_path / "there" / "file").write_text(OLD)
    (tmp_path / "there" / "file").chmod(0o640)
    (tmp_path / "link").symlink_to(tmp_path / "there" / "file")
    write_atomic(tmp_path / "link", b"new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "there" / "file").read_bytes() == b"new"
    assert (tmp_path / "there" / "file").stat().st_mode & 0o777 == 0o640


@POSIX
def test_devices_and_pipes_are_never_replaced(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    for path in (tmp_path / "pipe", tmp_path, tmp_path / "loop", Path("/dev/full"), Path("/dev/null")):
        for attempt in (require_writable, lambda target: write_atomic(target, b"x")):
            with pytest.raises(NotSaved, match=r" (was not saved|cannot be written): .*\.$"):
                attempt(path)
    assert Path("/dev/full").is_char_device()
    assert (tmp_path / "pipe").is_fifo()


@pytest.mark.parametrize("name", ["x" * 256, "a\0b", "no/such/folder"])
def test_an_invalid_file_name_is_an_error_of_one_line(tmp_path, name):
    with pytest.raises(NotSaved) as refused:
        require_writable(tmp_path / name)
    assert str(refused.value).isprintable()
    assert content(tmp_path) == {}


def test_checking_a_target_changes_nothing(tmp_path):
    (tmp_path / "file").write_text(OLD)
    require_writable(tmp_path / "file")
    require_writable(tmp_path / "another")
    assert content(tmp_path) == {"file": OLD.encode()}
