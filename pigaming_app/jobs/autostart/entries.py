"""The file with which each system starts a program when the user's session begins."""

import plistlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

LABEL = "pt.pigaming.kiosk"


@dataclass(frozen=True)
class StartEntry:
    """A file that makes the system start a program."""

    path: Path
    content: bytes


def start_entry(platform: str, home: Path, variables: Mapping[str, str], command: Sequence[str]) -> StartEntry:
    """The file for a platform (of `sys.platform`), the user's home and environment. Raises ValueError.

    The error is a phrase; no system can start a file with a control character in its name.
    """
    if not all(word.isprintable() for word in command):
        raise ValueError("the folder of the program has an unprintable character in its name")
    if platform == "win32":
        return _windows(home, variables, command)
    if platform == "darwin":
        return _macos(home, command)
    return _linux(home, variables, command)


def _linux(home: Path, variables: Mapping[str, str], command: Sequence[str]) -> StartEntry:
    """A desktop entry in the autostart folder of the XDG specification."""
    given = Path(variables.get("XDG_CONFIG_HOME", ""))
    folder = (given if given.is_absolute() else home / ".config") / "autostart"  # relative ones do not count
    lines = (
        "[Desktop Entry]",
        "Type=Application",
        "Name=PiGaming",
        f"Exec={' '.join(map(_quoted_for_exec, command))}",
        "Terminal=false",
        "X-GNOME-Autostart-enabled=true",
    )
    return StartEntry(folder / "pigaming.desktop", "\n".join([*lines, ""]).encode())


def _quoted_for_exec(word: str) -> str:
    """A word of the key Exec: escaped within quotes, then by the rules of all texts, with % doubled."""
    for special in '\\"`$':
        word = word.replace(special, f"\\{special}")
    return '"{}"'.format(word.replace("\\", "\\\\").replace("%", "%%"))


def _windows(home: Path, variables: Mapping[str, str], command: Sequence[str]) -> StartEntry:
    """A batch file in the start-up folder."""
    roaming = Path(variables.get("APPDATA") or home / "AppData" / "Roaming")
    folder = roaming / "Microsoft" / "Windows" / "Start Menu" / "Programs" / "Startup"
    words = " ".join('"{}"'.format(word.replace("%", "%%")) for word in command)
    lines = ("@echo off", "chcp 65001 >nul", f'start "PiGaming" /min {words}')
    return StartEntry(folder / "PiGaming.bat", "\r\n".join([*lines, ""]).encode())


def _macos(home: Path, command: Sequence[str]) -> StartEntry:
    """A launch agent of the user's graphical sessions."""
    agent = {
        "Label": LABEL,
        "ProgramArguments": list(command),
        "RunAtLoad": True,
        "ProcessType": "Interactive",
        "LimitLoadToSessionType": "Aqua",
    }
    return StartEntry(home / "Library" / "LaunchAgents" / f"{LABEL}.plist", plistlib.dumps(agent))
