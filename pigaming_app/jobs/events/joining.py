"""The event of another computer: its copy here, which the arcade keeps up to date while it runs."""

import sys
from dataclasses import replace
from pathlib import Path

from pigaming_app.events import event_files
from pigaming_app.events.network import mirror
from pigaming_app.events.network.link import Exchange, Offline, Unwelcome, log_in
from pigaming_app.events.network.mirror import Host
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.jobs.terminal.typed import typed
from pigaming_app.storage.settings import folders


def joined(host: Host, arcade: str) -> Path:
    """The copy of the event at a desk, after its PIN if that has not been asked yet; without a connection the latest.

    Raises Refusal or NotSaved.
    """
    folder = folders().data / mirror.FOLDER
    before = mirror.latest(folder, host)
    if before and (known := mirror.host_of(before)):
        host = known
    try:
        try:
            event = Exchange(host, arcade).fetch()
        except Unwelcome:
            pin = typed(f"PIN of the operator at {host.url}: ", "event run")
            if not pin:  # a kiosk without a keyboard
                raise Offline(f"{host.url} needs the PIN of its operator") from None
            host = replace(host, token=log_in(host, pin))
            event = Exchange(host, arcade).fetch()
    except Unwelcome as reason:
        raise Refusal(f"event run: {host.url}: {reason}") from None
    except Offline as reason:
        if before is None:
            raise Refusal(f"event run: {reason}") from None
        print(f"PiGaming: {reason}; the arcade goes on with its copy.", file=sys.stderr)
        return before
    path = mirror.path_of(folder, host, event)
    mirror.note(path, host)
    if not path.exists():
        event_files.save(path, event)
    return path
