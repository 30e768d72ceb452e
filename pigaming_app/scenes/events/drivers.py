"""Who drives in a match of an event: phones by their names, pads in the order of the people; their words on a card."""

from collections.abc import Collection, Mapping

from pigaming_app.ai.registry import level_of
from pigaming_app.events.spec import Fixture
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.flow.match_words import steering
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Device


def people_of(running: RunningEvent, fixture: Fixture) -> list[int]:
    """Seats of the people who play a match themselves."""
    return [i for i, name in enumerate(fixture.entrants) if not running.brain(name)]


def stood_in(running: RunningEvent, fixture: Fixture) -> list[int]:
    """Seats of people for whom an AI drives."""
    return [i for i, name in enumerate(fixture.entrants) if running.brain(name) and running.is_person(name)]


def suggested(controls: Controls, free: Mapping[int, str], taken: Collection[Device] = ()) -> dict[int, Device]:
    """The devices for free seats of people, by their names: the phones that are called; of the others, which are not
    `taken`, the first pad for the first one, and so on; then phones and keyboard.
    """
    called = phones_of(controls, free)
    others = [device for device in controls.offered() if device not in (*taken, *called.values())]
    return called | dict(zip((seat for seat in free if seat not in called), others, strict=False))


def phones_of(controls: Controls, free: Mapping[int, str]) -> dict[int, Device]:
    """The phones that are called to free seats of people, by their names."""
    numbers = {name: number for number, name in controls.phones.called.items()}
    return {seat: Device("phone", numbers[name]) for seat, name in free.items() if name in numbers}


def driver_label(words: Words, controls: Controls, device: Device | None, brain: str) -> tuple[str, str]:
    """Icon and name of who or what drives: a numbered pad, a phone, a part of the keyboard, an AI."""
    if brain:
        return "ai", words("events.ai" if level_of(brain) else "events.robot")
    pads = controls.pads()
    if device and device.kind == "pad":
        return "pad", words("events.pad", number=1 + pads.index(device) if device in pads else 1)
    if device and device.kind == "phone":
        return "phone", words("devices.Phone")
    if device is None:
        return "pad", words("events.pad", number=1 + len(pads))
    name = steering(words, controls, device)
    return controls.sign(device), name.replace(" ", "") if "←" in name else name
