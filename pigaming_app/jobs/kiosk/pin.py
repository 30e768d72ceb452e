"""The operator's PIN of a kiosk: typed twice, or one line on standard input. `--remove` takes it away."""

import json
import sys
from dataclasses import dataclass

from pigaming_app.jobs.terminal.options import JsonOption, flag
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.jobs.terminal.typed import typed
from pigaming_app.storage.pin import LONGEST, SHORTEST, PinFile, is_easy
from pigaming_app.storage.settings import folders


@dataclass(frozen=True, kw_only=True)
class PinOptions(JsonOption):
    """Whether there is to be a PIN."""

    remove: bool = flag("without a PIN from now on")
    show: bool = flag("print whether there is one, and change nothing")


def run(options: PinOptions) -> int:
    """Set or remove the PIN. Raises Refusal or NotSaved."""
    file = PinFile(folders().config)
    if options.remove and options.show:
        raise Refusal("kiosk pin: --remove or --show, not both")
    if options.remove:
        file.remove()
    elif not options.show:
        _set(file)
    if options.json:
        print(json.dumps({"set": file.is_set, "file": str(file.path)}))
    else:
        print(f"a PIN is set: {file.path}" if file.is_set else "no PIN is set")
    return 0


def _set(file: PinFile) -> None:
    pin = typed(f"New PIN, {SHORTEST} to {LONGEST} digits: ", "kiosk pin")
    if sys.stdin.isatty() and pin != typed("Once more: ", "kiosk pin"):
        raise Refusal("kiosk pin: those were two different ones; nothing was changed")
    try:
        file.set(pin)
    except ValueError as reason:
        raise Refusal(f"kiosk pin: {reason}") from None
    if is_easy(pin):
        print("PiGaming: this PIN is easy to guess.", file=sys.stderr)
