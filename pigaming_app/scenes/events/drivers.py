"""Who drives in a match of an event: the pads in the order of the people, and their names on a card."""

from pigaming_app.ai.registry import level_of
from pigaming_app.events.spec import Fixture
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.flow.device_words import steering
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Device


def people_of(running: RunningEvent, fixture: Fixture) -> list[int]:
    """Seats of the people who play a match themselves."""
    return [i for i, name in enumerate(fixture.entrants) if not running.brain(name)]


def stood_in(running: RunningEvent, fixture: Fixture) -> list[int]:
    """Seats of people for whom an AI drives."""
    return [i for i, name in enumerate(fixture.entrants) if running.brain(name) and running.is_person(name)]


def suggested(controls: Controls, people: list[int], seat: int) -> Device | None:
    """The device for the seat of a person: the first pad for the first one, and so on; then phones and keyboard."""
    players, index = controls.offered(), people.index(seat)
    return players[index] if index < len(players) else None


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
