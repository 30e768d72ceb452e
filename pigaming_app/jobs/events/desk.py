"""The event as pages in a browser: results and calls for the operator, table and bracket for everybody."""

import time
from dataclasses import dataclass

from pigaming_app.jobs.events.files import FileOption, loaded
from pigaming_app.jobs.terminal.options import integer, option, word
from pigaming_app.jobs.terminal.refusal import Refusal, require
from pigaming_app.storage.pin import PinFile
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.i18n import english
from pigaming_app.ui.web import PORT

LOOPBACK = "127.0.0.1"


@dataclass(frozen=True, kw_only=True)
class DeskOptions(FileOption):
    """The event and where its pages are served."""

    port: int = option(f"default {PORT}; 0: a free one", integer(0, 65535), PORT, metavar="NUMBER")
    network: str | None = option(
        "name or address of a network whose devices may see the pages; without a value: the first one",
        word,
        nargs="?",
        const="",
    )


def run(options: DeskOptions) -> int:
    """Serve the pages until Ctrl-C. Raises Refusal without a PIN, a network or the port."""
    loaded(options.file)
    require("phones")
    pin = PinFile(folders().config)
    if not pin.is_set:
        raise Refusal("event desk: the operator has no PIN; `python3 main.py kiosk pin` sets one")
    from pigaming_app.scenes.events.desk.desk import Desk
    from pigaming_app.ui.web.network import ServerUnavailable, chosen, networks
    from pigaming_app.ui.web.server import PageServer

    settings, _ = Settings.load(folders().config)
    try:
        network = LOOPBACK if options.network is None else options.network
        address = network if network == LOOPBACK else chosen(network, networks()).address
        server = PageServer(Desk(options.file, pin, settings.language), address, options.port)
        server.start()
    except ServerUnavailable as trouble:
        raise Refusal(english()(f"phones.{trouble.key}", **trouble.values)) from None
    except ValueError as reason:
        raise Refusal(str(reason)) from None
    try:
        print(f"everybody: {server.url}\noperator:  {server.url}desk", flush=True)
        print(f"another arcade: event run {server.url} --arcade NAME\nCtrl-C ends it.", flush=True)
        while True:
            time.sleep(3600.0)
    finally:
        server.stop()
