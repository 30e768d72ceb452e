"""What pygame finds on this machine: displays, sound, pads. For the doctor; it opens no window."""

import os

import pygame


def displays() -> list[str]:
    """The sizes of the displays. Raises pygame.error where there is none."""
    if os.environ.get("SDL_VIDEODRIVER") is None and not _has_screen():
        raise pygame.error("no screen is connected to this session")
    pygame.display.init()
    return [f"{w} × {h}" for w, h in pygame.display.get_desktop_sizes()]


def sound() -> str:
    """The sound driver, "" where there is none: the arcade is silent then."""
    try:
        pygame.mixer.init()
    except pygame.error:
        return ""
    driver = os.environ.get("SDL_AUDIODRIVER", "the system's")
    pygame.mixer.quit()
    return driver


def pads() -> list[str]:
    """The names of the pads that are plugged in."""
    pygame.joystick.init()
    return [pygame.joystick.Joystick(i).get_name() for i in range(pygame.joystick.get_count())]


def fonts() -> bool:
    """Whether the fonts of the arcade can be read."""
    from pigaming_app.scenes.palette import font

    pygame.font.init()
    return all(font(face, 40).size("Aé")[0] > 0 for face in ("head", "hero", "body"))


def _has_screen() -> bool:
    if os.name == "nt" or os.uname().sysname == "Darwin":
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
