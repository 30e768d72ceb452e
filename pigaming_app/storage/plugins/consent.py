"""Which plug-ins may run: the operator switches each on or off. A new one runs only once it was switched on."""

import json
import re
from pathlib import Path

from pigaming_app.storage.parsing import parse_json
from pigaming_app.storage.plugins.found import NAME, Plugin
from pigaming_app.storage.safe_files import read_or_restore, write_with_backup
from pigaming_app.storage.settings import NoHome, folders

FILE = "games.json"  # in the configuration folder: {"tag": true, "chess@their_package": false, …}
KEY = re.compile(rf"{NAME.pattern}(@[\w.]{{1,200}})?")


def is_on(plugin: Plugin) -> bool | None:
    """Whether a plug-in may run; None if nobody has decided. What belongs to this program may, unless switched off."""
    return _decisions().get(plugin.key, True if plugin.own else None)


def switch(key: str, on: bool) -> None:
    """Switch the plug-in with this key on or off, from the next start on. Raises NotSaved."""
    decisions = {**_decisions(), key: on}
    write_with_backup(_file(), json.dumps(decisions, indent=1, sort_keys=True) + "\n")


def _decisions() -> dict[str, bool]:
    try:
        found, _damage = read_or_restore(_file(), _parsed)
    except NoHome:
        return {}
    return found or {}


def _parsed(text: str) -> dict[str, bool]:
    """Raises ValueError."""
    table = parse_json(text)
    if not isinstance(table, dict):
        raise ValueError("not a table")
    return {key: on for key, on in table.items() if KEY.fullmatch(key) and isinstance(on, bool)}


def _file() -> Path:
    return folders().config / FILE
