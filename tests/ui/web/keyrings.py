"""Keyrings for the library `keyring`, which finds a class by PYTHON_KEYRING_BACKEND."""

import json
import os
import time
from pathlib import Path

from keyring.backend import KeyringBackend
from keyring.errors import KeyringLocked, PasswordDeleteError


class Drawer(KeyringBackend):
    """One that is a file, KEYRING_DRAWER, so that several processes share it."""

    priority = 5.0

    def get_password(self, service: str, username: str) -> str | None:
        return self._content().get(f"{service}/{username}")

    def set_password(self, service: str, username: str, password: str) -> None:
        self._write(self._content() | {f"{service}/{username}": password})

    def delete_password(self, service: str, username: str) -> None:
        content = self._content()
        if content.pop(f"{service}/{username}", None) is None:
            raise PasswordDeleteError
        self._write(content)

    @staticmethod
    def _content() -> dict[str, str]:
        path = Path(os.environ["KEYRING_DRAWER"])
        return dict(json.loads(path.read_text())) if path.exists() else {}

    @staticmethod
    def _write(content: dict[str, str]) -> None:
        Path(os.environ["KEYRING_DRAWER"]).write_text(json.dumps(content))


class NotRecommended(Drawer):
    """One that is a plain file of its own, such as those of keyrings.alt."""

    priority = 0.5


class Locked(Drawer):
    """One that nobody unlocks."""

    def get_password(self, service: str, username: str) -> str | None:
        raise KeyringLocked

    set_password = get_password  # type: ignore[assignment]


class Silent(Drawer):
    """One that waits for somebody who does not come."""

    def get_password(self, service: str, username: str) -> str | None:
        time.sleep(2.0)
        return None

    def set_password(self, service: str, username: str, password: str) -> None:
        time.sleep(2.0)
