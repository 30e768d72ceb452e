"""Page on which keys and buttons are changed, for each key cluster and each kind of pad there is.

FIRE on a row waits for the new key or button. One that is taken changes places with the old one, so that every function
keeps one.
"""

import logging

import pygame

from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.navigation import Navigation
from pigaming_app.scenes.flow.stack import StackOperation
from pigaming_app.scenes.options import pictures
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import LABEL
from pigaming_app.ui.draw.layers import backdrop
from pigaming_app.ui.input import gamepads, keyboard
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.input.remap import Tables, assigned, differences
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.focus import Focus
from pigaming_app.ui.widgets.labels import black_out, call_to_action, frame, heading
from pigaming_app.ui.widgets.setting_row import SettingValue

IDLE = 90.0  # seconds without input until the title
SENTENCE_SECONDS = 3.0  # seconds for which a sentence is shown
WAIT = 8.0  # seconds for which a new key or button is awaited
DEFAULTS = {**keyboard.DEFAULTS, **gamepads.DEFAULTS}
HINTS = [(Button.RIGHT, "remap.hint_device"), (Button.FIRE, "remap.hint_ok"), (Button.BACK, "remap.hint_back")]
log = logging.getLogger("pigaming")


class RemapPage:
    """The page; `awaited`: the row that waits for a key or button, if any."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.devices = [
            *keyboard.DEFAULTS,
            *dict.fromkeys(context.controls.name(pad) for pad in context.controls.pads()),
        ]
        last = context.controls.last
        own = f"keys{last.number + 1}" if last.kind == "keys" else context.controls.name(last)
        self.device = own if own in self.devices else self.devices[0]
        self.awaited, self.left, self.clock = "", 0.0, 0.0
        self.focus = Focus(dials.spots(self._rows()))
        self.navigation = Navigation(context, self.focus, HINTS, IDLE, SENTENCE_SECONDS)

    def on_enter(self) -> None:
        pass

    def on_leave(self) -> None:
        self.context.controls.listen(None)

    def handle(self, event: InputEvent) -> StackOperation:
        """Left and right change the device, FIRE awaits a key or button, or restores the defaults."""
        if self.awaited:
            if event.button in (Button.CLICK, Button.LOST):
                self._stop_waiting()
            return None
        event = self.navigation.prompts.as_button(event)
        match event.button:
            case Button.LEFT | Button.RIGHT:
                self._change_device(1 if event.button is Button.RIGHT else -1)
            case Button.FIRE | Button.START:
                self._do(self.focus.name)
            case Button.CLICK:
                self.focus.handle(event)
                if name := self.focus.spot_at(event):
                    self._do(name)
            case _:
                return self.navigation.handle(event)
        return None

    def update(self, seconds: float) -> StackOperation:
        self.clock += seconds
        self.left -= seconds
        if self.awaited and self.left <= 0.0:
            self._stop_waiting()
        return self.navigation.update(seconds)

    def draw(self, screen: pygame.Surface) -> None:
        words, focus = self.context.words, self.focus.name
        screen.blit(backdrop(), (0, 0))
        heading(words("remap.title")).draw(screen)
        black_out(screen, dials.PANEL)
        dials.draw(screen, words, self.focus, "remap", {name: self._value(name) for name in self._rows()})
        frame(*dials.PANEL.size).draw(screen, *dials.PANEL.topleft)
        line = focus if focus in ("device", "normal") else "function"
        dials.describe(screen, words(f"remap.{focus}"), words(f"remap.{line}_line"))
        lit = not self.awaited or self.clock % 1.0 < 0.5
        pictures.key(focus, self._sign, lit).draw(screen, *dials.CENTRE)
        if self.navigation.sentence:
            call_to_action(self.navigation.sentence, "", LABEL).draw(screen, 960, 926)
        self.navigation.prompts.draw(screen)

    # ---- rows

    def _rows(self) -> list[str]:
        return ["device", *DEFAULTS[self.device], "normal"]

    def _value(self, name: str) -> SettingValue:
        words, controls = self.context.words, self.context.controls
        if name == "device":
            return SettingValue("arrows", tuple(self._name(device) for device in self.devices), self._place)
        if name == "normal":
            return SettingValue("deed", (words("remap.restore"),))
        if name == self.awaited:
            return SettingValue("deed", (words("remap.press"),))
        code = controls.tables()[self.device][name]
        return SettingValue("deed", (words.key_name(self._printed(code)),))

    @property
    def _place(self) -> int:
        return self.devices.index(self.device)

    @property
    def _sign(self) -> str:
        """The icon of the device."""
        return self.context.controls.sign(_cluster(self.device)) if self.device in keyboard.DEFAULTS else "pad"

    def _name(self, device: str) -> str:
        if device not in keyboard.DEFAULTS:
            return self.context.words(f"devices.{device}")
        cluster = _cluster(device)
        kind = self.context.controls.name(cluster)
        name = self.context.words(f"devices.{kind}")
        return name if kind == "Keypad" else f"{name} {cluster.number + 1}"

    def _printed(self, code: int) -> str:
        known = self.device in keyboard.DEFAULTS
        return keyboard.key_label(code) if known else gamepads.button_label(self.device, code)

    def _change_device(self, by: int) -> None:
        self.device = self.devices[(self._place + by) % len(self.devices)]
        self.focus.set_spots(dials.spots(self._rows()))
        self.context.sounds.play("move")

    def _do(self, name: str) -> None:
        if name == "device":
            self._change_device(1)
        elif name == "normal":
            self._keep(self._others())
        else:
            self.awaited, self.left = name, WAIT
            self.context.controls.listen(self._assign)
            self.context.sounds.play("move")

    def _assign(self, device: Device, code: int) -> None:
        """Give the awaited function a key or button that went down; Escape and what cannot have it end the waiting."""
        name, words = self.awaited, self.context.words
        self._stop_waiting()
        keys = self.device in keyboard.DEFAULTS
        fits = keyboard.usable(name, code) if keys else gamepads.usable(self.device, code)
        own = device.kind == "keys" if keys else self.context.controls.name(device) == self.device
        if not own or not fits:
            if code != pygame.KSCAN_ESCAPE:
                self.navigation.show_message(words("remap.unusable"))
            self.context.sounds.play("back")
            return
        tables = self.context.controls.tables()
        after = assigned({device: tables[device] for device in self._group()}, self.device, name, code)
        self._keep({**self._others(), **differences(after, DEFAULTS)})

    def _stop_waiting(self) -> None:
        self.awaited = ""
        self.context.controls.listen(None)

    def _group(self) -> list[str]:
        """The devices that share keys or buttons with this one: all of the keyboard, or one kind of pad."""
        return [*keyboard.DEFAULTS] if self.device in keyboard.DEFAULTS else [self.device]

    def _others(self) -> Tables:
        """The changes of all other devices."""
        return {
            device: codes for device, codes in self.context.settings.controls.items() if device not in self._group()
        }

    def _keep(self, changed: Tables) -> None:
        """Apply and save the changes; on failure, show a sentence."""
        context = self.context
        context.settings.controls = changed
        context.controls.remap(changed)
        context.sounds.play("accept")
        try:
            context.settings.save(folders().config)
        except NotSaved as trouble:
            log.warning("%s", trouble)
            self.navigation.show_message(context.words("app.unsaved"))


def _cluster(device: str) -> Device:
    """The key cluster with this name in the settings."""
    return Device("keys", [*keyboard.DEFAULTS].index(device))
