"""Arena number and radio network of the robots: options of the job `robots` that write settings and XBees."""

import json
from argparse import ArgumentParser, Namespace
from typing import Any

from pigaming_app.hardware.radio.packets import LAST_ARENA, ROBOTS
from pigaming_app.hardware.radio.xbee_frames import CHANNELS
from pigaming_app.hardware.robot_files import set_up_command
from pigaming_app.hardware.session.robot_session import RobotsUnavailable
from pigaming_app.jobs.mat.sessions import new_session
from pigaming_app.jobs.terminal.options import hexadecimal, integer
from pigaming_app.jobs.terminal.refusal import Refusal, refused
from pigaming_app.storage.messages import OperatorError
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import Settings, folders


def options(parser: ArgumentParser) -> None:
    group = parser.add_argument_group("arena and radio", "The values are saved in the settings.")
    group.add_argument("--arena", type=integer(1, LAST_ARENA), metavar="NUMBER", help="arena number of this computer")
    group.add_argument(
        "--radio-setup",
        type=integer(0, ROBOTS),
        metavar="NUMBER",
        help="write the XBee in the USB carrier: 0 for this computer, 1 to 4 for a robot",
    )
    group.add_argument(
        "--channel",
        type=hexadecimal(CHANNELS[0], CHANNELS[-1]),
        metavar="HEX",
        help="channel of the XBees, B to 1A; default: by the arena number",
    )
    group.add_argument(
        "--pan", type=hexadecimal(1, 0xFFFE), metavar="HEX", help="PAN of the XBees; default: by the arena number"
    )


def save_arena(arguments: Namespace) -> Settings:
    """Save the given arena number, channel and PAN; returns the settings. Raises Refusal."""
    settings, _ = Settings.load(folders().config)
    given = {"arena_id": arguments.arena, "radio_channel": arguments.channel, "radio_pan": arguments.pan}
    given = {name: value for name, value in given.items() if value is not None}
    if given and arguments.emulate is not None:
        raise Refusal("the emulated arena has a number and radios of its own: leave out --emulate")
    for name, value in given.items():
        settings.choose(name, value)
    if given:
        with refused(NotSaved):
            settings.save(folders().config)
    return settings


def set_up(arguments: Namespace, settings: Settings) -> int:
    """Write one XBee and read it back. Raises Refusal."""
    from pigaming_app.hardware.radio.xbee_setup import XBeeSetup, network_of, parameters

    if settings.radio not in ("api2", "api1", "transparent"):
        raise Refusal(f"radio mode {settings.radio} uses no XBee")
    number = arguments.radio_setup
    with refused(OperatorError, RobotsUnavailable, ValueError):
        session = new_session(arguments.emulate, None, arguments.port)
        try:
            arena = session.arena_id
            network = network_of(arena, settings.radio_channel, settings.radio_pan)
            wanted = parameters(number, network, settings.radio, settings.baud)
            for _ in XBeeSetup(session.carrier(number), wanted, settings.baud).steps():
                session.tick()
        finally:
            session.end()
    result: dict[str, Any] = {"radio": number, "arena": arena, **wanted}
    if arguments.json:
        print(json.dumps(result))
    else:
        whose = "this computer" if number == 0 else f"robot {number}"
        print(f"The radio of {whose}: {', '.join(f'{name} {value:X}' for name, value in wanted.items())}, saved.")
        if number:
            print(f"Its robot: {set_up_command(number, arena, settings.radio)}")
    return 0
