"""The log: complete lines, even after a full disk, and never a traceback on the terminal."""

import logging
import os

import pytest

from pigaming_app.storage.log import FILE, append_line, log_file
from tests.disks import room_for

pytestmark = pytest.mark.skipif(os.name != "posix", reason="limits of POSIX")


def test_a_full_disk_costs_lines_and_nothing_else(tmp_path, capsys):
    handler = log_file(tmp_path)
    log = logging.Logger("test")
    log.addHandler(handler)
    log.warning("before")
    size = (tmp_path / FILE).stat().st_size
    with room_for(size + 40):
        for _ in range(3):
            log.warning("lost " * 20)
    log.warning("after")
    with room_for(0):
        log.warning("lost")
        handler.close()
    lines = (tmp_path / FILE).read_text().splitlines()
    assert [line.rpartition(" ")[2] for line in lines] == ["before", "after"]
    assert capsys.readouterr().err == ""


def test_a_rotation_on_a_full_disk_keeps_the_log_before(tmp_path, capsys):
    (tmp_path / FILE).write_text("old\n" * 125_000)
    with room_for(10):
        append_line(tmp_path, "lost")
    append_line(tmp_path, "kept")
    kept = (tmp_path / FILE).read_text()
    assert kept.endswith("kept\n")
    assert kept.count("\n") == 1
    assert (tmp_path / f"{FILE}.1").read_text() == "old\n" * 125_000
    assert capsys.readouterr().err == ""


def test_a_pipe_in_place_of_the_log_does_not_block(tmp_path):
    os.mkfifo(tmp_path / FILE)
    with pytest.raises(OSError, match="not a file"):
        log_file(tmp_path)
    append_line(tmp_path, "lost")


def test_a_mistake_in_a_message_is_still_reported(tmp_path, capsys):
    handler = log_file(tmp_path)
    handler.handle(logging.LogRecord("test", logging.WARNING, __file__, 0, "%d", ("text",), None))
    handler.close()
    assert "TypeError" in capsys.readouterr().err
