"""Programs of your own that play as `bot:NAME`, each with a key. Without an option: a list."""

import json
from dataclasses import dataclass
from typing import ClassVar

from pigaming_app.ai.bots.brains import book
from pigaming_app.jobs.terminal.options import ONE_OF, Groups, JsonOption, option
from pigaming_app.jobs.terminal.refusal import Refusal


@dataclass(frozen=True, kw_only=True)
class BotsOptions(JsonOption):
    """What to change."""

    GROUPS: ClassVar[Groups] = {ONE_OF: ("add", "remove")}

    add: str | None = option("a new bot; for one that exists, a new key", metavar="NAME")
    remove: str | None = option("a bot that no longer plays", metavar="NAME")


def run(options: BotsOptions) -> int:
    """Change the book of bots and print it. Raises Refusal or NotSaved."""
    try:
        if options.add is not None:
            book().add(options.add)
        if options.remove is not None:
            book().remove(options.remove)
    except ValueError as reason:
        raise Refusal(f"bots: {reason}") from None
    keys = {name: key for name, key in book().keys.items() if options.add in (None, name)}  # others stay private
    if options.json:
        print(json.dumps({"keys": keys}))
    else:
        for name, key in sorted(keys.items()):
            print(f"bot:{name:12} key {key}")
        if not keys:
            print("no bots; main.py bots --add NAME makes one")
    return 0
