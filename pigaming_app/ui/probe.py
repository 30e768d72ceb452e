"""Probe of pygame on this machine: displays, sound, pads, fonts. It opens no window.

The doctor runs this file in a separate process, because a display server or a sound driver may hang or crash. Each
check prints one line of JSON as soon as it is done: its name, the result, and the problem.
"""

import json
import os
from collections.abc import Callable

import pygame
from pygame._sdl2 import controller

from pigaming_app.ui.draw.theme import font
from pigaming_app.ui.sounds import Sounds

_MEMORY_DRIVERS = ("dummy", "offscreen")  # SDL drivers that render into memory only


def displays() -> tuple[str, str]:
    """The connected displays with size and refresh rate; else the reason for having none."""
    try:
        pygame.display.init()
    except pygame.error as error:
        return "", str(error)
    driver = pygame.display.get_driver()
    if driver in _MEMORY_DRIVERS:
        configured = "SDL_VIDEODRIVER" in os.environ
        return "", f"SDL_VIDEODRIVER asks for {driver}" if configured else "no screen is connected to this session"
    sizes, rates = pygame.display.get_desktop_sizes(), pygame.display.get_desktop_refresh_rates()
    each = (f"{w} × {h} at {rate} Hz" for (w, h), rate in zip(sizes, rates, strict=True))
    return f"{', '.join(each)} (by {driver})", ""


def sound() -> tuple[str, str]:
    """The availability of a sound device, or the reason for having none."""
    sounds = Sounds()
    available = sounds.wait()
    sounds.close()
    return ("there is a sound device", "") if available else ("", sounds.trouble)


def pads() -> tuple[str, str]:
    """The connected pads by name; as the problem, those without an SDL mapping."""
    pygame.joystick.init()
    controller.init()
    names = {index: pygame.joystick.Joystick(index).get_name() for index in range(pygame.joystick.get_count())}
    unmapped = [name for index, name in names.items() if not controller.is_controller(index)]
    return ", ".join(names.values()), f"not known to SDL: {', '.join(unmapped)}" if unmapped else ""


def fonts() -> tuple[str, str]:
    """Check that the fonts load and cover the letters of both languages."""
    try:
        faces = [font(face, 40) for face in ("head", "hero", "body")]
    except (OSError, pygame.error) as error:
        return "", str(error)
    whole = all(None not in face.metrics("Aéãçõ") for face in faces)
    return ("all there", "") if whole else ("", "letters are missing")


CHECKS: dict[str, Callable[[], tuple[str, str]]] = {"displays": displays, "sound": sound, "pads": pads, "fonts": fonts}


def main() -> None:
    """Run all checks; one that fails prints a line too."""
    print(json.dumps(["pygame", f"pygame-ce {pygame.ver}, SDL {'.'.join(map(str, pygame.get_sdl_version()))}", ""]))
    for name, check in CHECKS.items():
        try:
            result, problem = check()
        except Exception as error:  # run the other checks whatever a driver raises
            result, problem = "", str(error)
        print(json.dumps([name, result, problem]), flush=True)


if __name__ == "__main__":
    main()
