"""The real session's camera: frames of another size than the calibrated one are dropped."""

import numpy as np

from pigaming_app.hardware.session.real import SizedCamera
from pigaming_app.hardware.signals import CameraFrame
from pigaming_app.storage.messages import OperatorMessage
from tests.hardware.grounds import nominal
from tests.hardware.sentences import sentence


class Eye:
    """A fake camera with one frame of each of these sizes."""

    fault: OperatorMessage | None = None

    def __init__(self, *sizes: tuple[int, int]) -> None:
        self.frames = [CameraFrame(np.zeros((h, w), np.uint8), 0.1 * i, i) for i, (w, h) in enumerate(sizes)]

    def newest(self) -> CameraFrame | None:
        return self.frames.pop(0) if self.frames else None

    def close(self) -> None:
        self.frames.clear()


def test_pictures_of_another_size_are_withheld_with_a_sentence_until_the_right_ones_come():
    eye = SizedCamera(Eye((640, 480), (1280, 720), (640, 480)), nominal((1280, 720)))
    assert eye.newest() is None
    assert sentence(eye.fault) == (
        "The calibration is for camera images of 1280 x 720 px, not 640 x 480: calibrate again."
    )
    frame = eye.newest()
    assert frame is not None
    assert frame.number == 1
    assert eye.fault is None
    eye.newest()
    assert "640 x 480" in sentence(eye.fault)


def test_what_the_camera_itself_says_comes_first():
    camera = Eye((640, 480))
    eye = SizedCamera(camera, nominal((1280, 720)))
    eye.newest()
    camera.fault = OperatorMessage("stopped", number=0)
    assert eye.fault == camera.fault
    eye.close()
    assert not camera.frames
