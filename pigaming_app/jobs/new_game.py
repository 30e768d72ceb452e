"""A new game: a working package of about 100 lines in the user's folder of games, which plays at once."""

import re
import shutil
from dataclasses import dataclass
from keyword import iskeyword
from pathlib import Path

from pigaming_app import ASSETS
from pigaming_app.games.registry import OURS
from pigaming_app.jobs.terminal.options import argument
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.storage.parsing import describe_error, quote
from pigaming_app.storage.plugins.consent import switch
from pigaming_app.storage.plugins.found import NAME, found, user_folder
from pigaming_app.storage.safe_files import NotSaved

TEMPLATE = ASSETS / "new_game"


@dataclass(frozen=True, kw_only=True)
class NewGameOptions:
    """The game's name."""

    name: str = argument("lower-case letters, digits and _, at most 24, such as tag", metavar="NAME")


def run(options: NewGameOptions) -> int:
    """Write the package and switch it on. Raises Refusal, NotSaved."""
    name = options.name
    if not NAME.fullmatch(name):
        raise Refusal(f"{quote(name)} is no name: lower-case letters, digits and _, at most 24, a letter first")
    if name in (*OURS, *(plugin.name for plugin in found())):
        raise Refusal(f"there is a game {name} already")
    folder = user_folder() / name
    write(folder, name)
    switch(name, True)
    print(f"{folder}\nplay it: main.py play {name}; test it: main.py test --quick tests/test_every_game.py -k {name}")
    return 0


def write(folder: Path, name: str) -> None:
    """Write the package of a game. Raises NotSaved; then there is no folder."""
    title = " ".join(word.capitalize() for word in name.split("_") if word)
    state = title.replace(" ", "")
    try:
        files = [path for path in sorted(TEMPLATE.rglob("*")) if path.is_file() and path.suffix in (".py", ".toml")]
        texts = {path.relative_to(TEMPLATE): path.read_text(encoding="utf-8") for path in files}
        if iskeyword(state) or any(re.search(rf"\b{state}\b", text) for text in texts.values()):
            state += "State"
        names = {"new_game": name, "NewGame": state, "New Game": title}
        for path, text in texts.items():
            target = folder / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(re.sub("|".join(names), lambda found: names[found[0]], text), encoding="utf-8")
    except OSError as error:
        shutil.rmtree(folder, ignore_errors=True)
        raise NotSaved(f"{folder} was not written: {describe_error(error)}.") from error
