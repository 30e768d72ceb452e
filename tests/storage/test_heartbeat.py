"""The heartbeat that two processes share."""

from pathlib import Path

import pytest

from pigaming_app.storage.heartbeat import PICTURE, Heartbeat


def test_beats_and_picture_are_seen_by_the_other_side(tmp_path: Path) -> None:
    path = tmp_path / "beat"
    path.touch()
    reader, writer = Heartbeat(path), Heartbeat(path)
    assert (reader.beats, reader.picture) == (0, None)
    for _ in range(3):
        writer.beat()
    writer.show((2, 2), bytes(range(12)))
    writer.beat()
    assert (reader.beats, reader.picture) == (4, ((2, 2), bytes(range(12))))
    w, h = PICTURE
    writer.show(PICTURE, b"\x07" * (3 * w * h))
    assert reader.picture == (PICTURE, b"\x07" * (3 * w * h))
    reader.close()
    writer.close()


def test_a_missing_file_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="No such file"):
        Heartbeat(tmp_path / "none")
