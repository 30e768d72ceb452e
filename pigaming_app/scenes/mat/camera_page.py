"""The page with the picture of the camera over the mat."""

from collections.abc import Sequence
from typing import Any

import pygame

from pigaming_app.scenes.features.board_page import BoardPart, Box
from pigaming_app.scenes.flow.scene import Scene

BOX: Box = (60, 34, 1800, 1012)


class CameraPage:
    """Has something to show in matches with real or emulated robots, whose scenes have a `camera_image`."""

    name = "camera"

    def parts(self, scenes: Sequence[Scene]) -> Sequence[BoardPart] | None:
        """The newest picture."""
        scene = next((scene for scene in reversed(scenes) if hasattr(scene, "camera_image")), None)
        image: Any = getattr(scene, "camera_image", None)
        return None if image is None else [BoardPart(BOX, Picture(image), lambda surface: _picture(image, surface))]


class Picture:
    """Equal for the same picture only, which it keeps: the address of one that is gone is soon that of another."""

    def __init__(self, image: Any) -> None:
        self.image = image

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Picture) and other.image is self.image

    def __hash__(self) -> int:
        return id(self.image)


def _picture(image: Any, surface: pygame.Surface) -> None:
    """Draw the picture as large as fits, without smoothing: that takes a third of the time."""
    from pigaming_app.ui.draw.pixels import grey_surface

    step = max(1, image.shape[1] // 640)
    small = grey_surface(image[::step, ::step])
    w, h = surface.get_size()
    factor = min(w / small.get_width(), h / small.get_height())
    size = round(small.get_width() * factor), round(small.get_height() * factor)
    surface.blit(pygame.transform.scale(small, size), ((w - size[0]) // 2, (h - size[1]) // 2))
