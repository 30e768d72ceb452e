"""Arena number and radio network of the robots: options of the job `robots` that write settings and XBees."""

import json
from dataclasses import dataclass
from typing import Any, ClassVar

from pigaming_app.hardware.drivers.fitness import match_problem
from pigaming_app.hardware.radio.packets import LAST_ARENA, ROBOTS
from pigaming_app.hardware.radio.xbee_frames import CHANNELS
from pigaming_app.hardware.robot_kinds import set_up_command
from pigaming_app.jobs.mat.sessions import require_driver, robots_of
from pigaming_app.jobs.terminal.options import Groups, JsonOption, RadioOptions, hexadecimal, integer, option
from pigaming_app.jobs.terminal.refusal import Refusal, refused
from pigaming_app.storage.messages import OperatorError
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import Settings, folders


@dataclass(frozen=True, kw_only=True)
class RadioSetupOptions(RadioOptions, JsonOption):
    """Numbers of the arena and its radios."""

    GROUPS: ClassVar[Groups] = {
        ("arena and radio", "The values are saved in the settings."): ("arena", "radio_setup", "channel", "pan"),
    }

    arena: int | None = option("arena number of this computer", integer(1, LAST_ARENA), metavar="NUMBER")
    radio_setup: int | None = option(
        "write the XBee in the USB carrier: 0 for this computer, 1 to 4 for a robot",
        integer(0, ROBOTS),
        metavar="NUMBER",
    )
    channel: int | None = option(
        "channel of the XBees, B to 1A; default: by the arena number",
        hexadecimal(CHANNELS[0], CHANNELS[-1]),
        metavar="HEX",
    )
    pan: int | None = option("PAN of the XBees; default: by the arena number", hexadecimal(1, 0xFFFE), metavar="HEX")


def save_arena(options: RadioSetupOptions) -> Settings:
    """Save the given arena number, channel, PAN, port and radio mode; returns the settings. Raises Refusal.

    A radio mode that plays no match is for one command alone, and emulated robots change nothing.
    """
    settings, _ = Settings.load(folders().config)
    asked = {"arena_id": options.arena, "radio_channel": options.channel, "radio_pan": options.pan}
    given: dict[str, object] = {name: value for name, value in asked.items() if value is not None}
    if given and options.emulate is not None:
        raise Refusal("the emulated arena has a number and radios of its own: leave out --emulate")
    if options.emulate is None:
        given |= {"port": options.port} if options.port is not None else {}
        if options.radio and match_problem(require_driver(options.radio)) is None:
            given["radio"] = options.radio
    for name, value in given.items():
        settings.choose(name, value)
    if given:
        with refused(NotSaved):
            settings.save(folders().config)
    return settings


def set_up(options: RadioSetupOptions, number: int, settings: Settings) -> int:
    """Write one XBee and read it back. Raises Refusal."""
    from pigaming_app.hardware.radio.xbee_setup import MODES, XBeeSetup, network_of, parameters

    if settings.radio not in MODES:
        raise Refusal(f"radio mode {settings.radio} uses no XBee")
    with refused(OperatorError, ValueError), robots_of(options) as session:
        arena = session.arena_id
        network = network_of(arena, settings.radio_channel, settings.radio_pan)
        wanted = parameters(number, network, settings.radio, settings.baud)
        for _ in XBeeSetup(session.carrier(number), wanted, settings.baud).steps():
            session.tick()
    result: dict[str, Any] = {"radio": number, "arena": arena, **wanted}
    if options.json:
        print(json.dumps(result))
    else:
        whose = "this computer" if number == 0 else f"robot {number}"
        print(f"The radio of {whose}: {', '.join(f'{name} {value:X}' for name, value in wanted.items())}, saved.")
        if number:
            print(f"Its robot: {set_up_command(number, arena, settings.radio)}")
    return 0
