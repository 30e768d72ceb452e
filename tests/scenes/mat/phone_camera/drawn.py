"""The page with the code for a phone, without a network, for tests of its texts."""

import io
from types import SimpleNamespace
from typing import Any

from PIL import Image

from pigaming_app.hardware.vision.phone import PhoneFeed, PhonePicture
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.mat.phone_camera.page import PhoneCameraPage
from pigaming_app.ui.web.network import ServerUnavailable
from tests.scenes.arcade import Arcade

TROUBLES = ("missing", "no_certificate")


def code_page(arcade: Arcade, live: bool = False, age: float = 0.0, trouble: str = "") -> Scene:
    """The page. `live`: a phone sends; `age`: s for which it has been shown; `trouble`: why there is no code."""
    page: Any = PhoneCameraPage(arcade.context)
    feed = PhoneFeed(lambda: 0.0)
    if live:
        file = io.BytesIO()
        Image.new("L", (1920, 1080)).save(file, "JPEG")
        for _ in range(2):
            feed.put(PhonePicture("1" * 32, file.getvalue(), -0.1888))
    page.host = SimpleNamespace(
        url="" if trouble else "https://192.168.100.200:8790/abcdefghjk",
        port=8790,
        trouble=ServerUnavailable(trouble) if trouble else None,
        feed=feed,
        follow=lambda *_: None,
    )
    page.age = age
    scene: Scene = page
    return scene
