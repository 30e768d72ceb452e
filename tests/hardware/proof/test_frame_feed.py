"""Camera frames through a file in memory."""

import pytest

pytest.importorskip("cv2")

import numpy as np

from pigaming_app.hardware.proof.frame_feed import FrameFeed, FrameWriter
from pigaming_app.hardware.signals import CameraFrame
from pigaming_app.hardware.vision.markers import opencv


def test_a_reader_gets_each_frame_once_with_its_time_and_the_newest_of_several(tmp_path, monkeypatch):
    monkeypatch.setattr("pigaming_app.hardware.proof.frame_feed.PATIENCE", 0.0)
    writer, page = FrameWriter(tmp_path / "frames"), np.zeros((1080, 1920), np.uint8)
    writer.write(CameraFrame(page, 1.0, 1))
    feed = FrameFeed(tmp_path / "frames")
    assert feed.read() == (False, None), "it was there before"
    monkeypatch.setattr("pigaming_app.hardware.proof.frame_feed.PATIENCE", 5.0)
    for number in (2, 3, 4):
        page[:] = number
        writer.write(CameraFrame(page, float(number), number))
    good, image = feed.read()
    assert good
    assert image.min() == image.max() == 4
    assert feed.get(opencv().CAP_PROP_POS_MSEC) == 4000.0
    monkeypatch.setattr("pigaming_app.hardware.proof.frame_feed.PATIENCE", 0.0)
    assert feed.read() == (False, None)
