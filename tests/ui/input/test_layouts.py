"""Keys are called as printed: signs by the present layout, from SDL itself; the others by name in each language."""

import ctypes
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pygame
import pytest

from pigaming_app.ui.i18n import LANGUAGES, Words, texts
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.input.keyboard import CLUSTERS, FUNCTIONS, KEYPAD, key_label, usable
from tests.ui.input.virtual_pad import sdl_library

pytestmark = pytest.mark.usefixtures("controls")
ROOT = Path(__file__).resolve().parents[3]
PC_KEYS = [
    *range(pygame.KSCAN_A, pygame.KSCAN_KP_PERIOD + 1),
    *(pygame.KSCAN_LCTRL, pygame.KSCAN_LSHIFT, pygame.KSCAN_RCTRL, pygame.KSCAN_RSHIFT, pygame.KSCAN_RALT),
]
PRINTED = {
    "de": "LEERTASTE UMSCHALT STRG_RECHTS EINGABE ENTF POS1 BILD_AUF",
    "fr": "ESPACE MAJ CTRL_DROITE ENTRÉE SUPPR DÉBUT PAGE_PRÉC",
    "es": "ESPACIO MAYÚS CTRL_DER INTRO SUPR INICIO RE_PÁG",
    "pt": "ESPAÇO SHIFT CTRL_DIR ENTER DELETE HOME PAGE_UP",
    "en": "SPACE SHIFT R_CTRL ENTER DELETE HOME PAGE_UP",
}  # on the keyboards of these countries, or their names
LAYOUTS = {
    "fr": ("ZQSD", "!"),
    "de": ("WASD", "-"),
    "es": ("WASD", "-"),
    "ru": ("WASD", "."),
    "us": ("WASD", "/"),
}  # steering keys of the first player, and the key beside the right shift; "ru" has no letters of ours
CHILD = """
import json, subprocess, sys, time, pygame
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Device
from pigaming_app.ui.input.keyboard import key_label
pygame.display.init()
pygame.display.set_mode((200, 200))
controls, found = Controls(), {}
for layout in sys.argv[1:]:
    subprocess.run(["setxkbmap", layout], check=True)
    until = time.monotonic() + 1.0
    while time.monotonic() < until:
        controls.presses(pygame.event.get())
        time.sleep(0.02)
    found[layout] = controls.moves(Device("keys")), key_label(pygame.KSCAN_SLASH)
print(json.dumps(found))
"""


@pytest.mark.parametrize("language", LANGUAGES)
def test_keys_are_called_as_on_the_keyboards_of_a_country(language: str) -> None:
    codes = [
        getattr(pygame, f"KSCAN_{name}") for name in ["SPACE", "LSHIFT", "RCTRL", "RETURN", "DELETE", "HOME", "PAGEUP"]
    ]
    words = Words(language)
    assert [words.key_name(key_label(code)) for code in codes] == [
        name.replace("_", " ") for name in PRINTED[language].split()
    ]
    assert words.key_name("NUM ENTER") == f"NUM {words.key_name('ENTER')}"


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_key_that_can_be_chosen_has_a_name_of_its_own(language: str) -> None:
    words = Words(language)
    labels = [key_label(code) for code in PC_KEYS if usable("fire", code) or code in (pygame.KSCAN_ESCAPE,)]
    named = [label for label in labels if len(label.removeprefix("NUM ")) > 1]
    assert [label for label in named if f"keys.{label.removeprefix('NUM ')}" not in texts(language)] == []
    assert len({words.key_name(label) for label in labels}) == len({*labels})
    assert all(words.key_name(label) == label for label in labels if label not in named)


def test_the_signs_are_those_of_sdl(controls: Controls) -> None:
    """Of all keys with a sign, by SDL's own table of the layout."""
    for code in PC_KEYS:
        sign = sdl_library().SDL_GetKeyFromScancode(ctypes.c_int(code))
        if 32 < sign < 256 and sign != 127 and code not in KEYPAD:
            assert key_label(code).casefold() == chr(sign).casefold()
    assert [controls.moves(Device("keys", number)) for number in range(4)] == ["WASD", "← ↑ ↓ →", "IJKL", "8456"]


def test_keys_of_the_number_pad_are_told_from_those_above_the_letters() -> None:
    assert CLUSTERS[3].on_keypad
    assert not any(cluster.on_keypad for cluster in CLUSTERS[:3])
    assert {CLUSTERS[3].label(button)[:4] for button in FUNCTIONS.values()} == {"NUM "}
    assert (CLUSTERS[3].label(Button.FIRE), key_label(pygame.KSCAN_0)) == ("NUM 0", "0")


@pytest.mark.long
@pytest.mark.skipif(shutil.which("Xvfb") is None, reason="no Xvfb: apt-get install xvfb")
def test_letters_follow_the_layout_of_a_real_x_server() -> None:
    reading, writing = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-nolisten", "tcp", "-noreset"], pass_fds=[writing])
    os.close(writing)
    try:
        with open(reading) as line:
            surroundings = {**os.environ, "DISPLAY": f":{line.readline().strip()}", "SDL_VIDEODRIVER": "x11"}
        command = [sys.executable, "-c", CHILD, *LAYOUTS]
        done = subprocess.run(
            command, env=surroundings, cwd=ROOT, capture_output=True, text=True, timeout=60, check=True
        )
    finally:
        server.terminate()
        server.wait(30)
    assert {layout: tuple(found) for layout, found in json.loads(done.stdout.splitlines()[-1]).items()} == LAYOUTS
