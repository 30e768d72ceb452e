"""The password of the Wi-Fi that robots and phones share: in the system's keyring, where there is one.

There it stands under the name of the network. Without a keyring it is a setting, as plain text, and whoever lets it be
typed tells that. A keyring may wait for somebody to unlock it, so every request has an end.
"""

import logging
from collections.abc import Callable
from functools import cache
from importlib.util import find_spec
from threading import Thread
from typing import Any

from pigaming_app.storage.settings import Settings, folders

SERVICE = "PiGaming Wi-Fi"
NAME, LONGEST = 32, 63  # characters of a name and a password, at most
BRIEF, PATIENT = 1.0, 60.0  # s for an answer: on a page, and for somebody who unlocks the keyring

log = logging.getLogger("pigaming")
_found: dict[str, str] = {}  # passwords by network, of this run
_asked: dict[str, Thread] = {}


def has_keyring() -> bool:
    """True if the system has a keyring, and the library of that name is installed."""
    return _keyring() is not None


def password(settings: Settings, seconds: float = 0.0) -> str:
    """The password of the Wi-Fi of the settings; empty if none is known within so many seconds.

    With 0 only the first request for a network waits, and briefly: pages ask again and again.
    """
    name = settings.phones_wifi
    if settings.phones_wifi_key or not name or not has_keyring():
        return settings.phones_wifi_key
    if name not in _asked:
        _asked[name] = _begun(lambda: _read(name))
        seconds = max(seconds, BRIEF)
    _asked[name].join(seconds)
    return _found.get(name, "")


def keep(settings: Settings, typed: str) -> bool:
    """Keep the password of the Wi-Fi of the settings, or forget it if empty: in the keyring, else as plain text.

    True if it is in the keyring. The settings are to be saved.
    """
    name, kept = settings.phones_wifi, False
    if name and has_keyring():
        done: list[bool] = []
        thread = _begun(lambda: done.append(_write(name, typed)))
        thread.join(PATIENT)
        kept = done == [True]
        _asked[name], _found[name] = thread, typed if kept else ""
    settings.phones_wifi_key = "" if kept else typed
    return kept


def rename(settings: Settings, name: str) -> None:
    """Name another Wi-Fi; its password is the one that is known for it, else the present one."""
    before = password(settings)
    settings.phones_wifi = name
    if name and before and (settings.phones_wifi_key or not password(settings)):
        keep(settings, before)


def save(settings: Settings) -> None:
    """Save the settings; a password that went into the keyring is in no backup, either. Raises NotSaved."""
    moved = not settings.phones_wifi_key and Settings.load(folders().config)[0].phones_wifi_key
    for _ in range(2 if moved else 1):
        settings.save(folders().config)


@cache
def _keyring() -> Any:
    """The system's keyring, or None. Those that the library does not recommend are files of their own."""
    if not find_spec("keyring"):
        return None
    try:
        from keyring import core

        core.init_backend(core.recommended)
        chosen = core.get_keyring()
        return chosen if core.recommended(chosen) else None
    except Exception as error:  # of any backend
        log.warning("No keyring: %s", error)
        return None


def _begun(request: Callable[[], object]) -> Thread:
    thread = Thread(target=request, name="keyring", daemon=True)
    thread.start()
    return thread


def _read(name: str) -> None:
    try:
        _found[name] = (_keyring().get_password(SERVICE, name) or "")[:LONGEST]
    except Exception as error:  # locked, or gone
        log.warning("The keyring does not answer: %s", error)


def _write(name: str, typed: str) -> bool:
    """Store a password, or delete an empty one; True if it is as it was typed."""
    try:
        if typed:
            _keyring().set_password(SERVICE, name, typed)
        elif _keyring().get_password(SERVICE, name) is not None:
            _keyring().delete_password(SERVICE, name)
        return (_keyring().get_password(SERVICE, name) or "") == typed
    except Exception as error:  # locked, or gone
        log.warning("The keyring has not kept it: %s", error)
        return False
