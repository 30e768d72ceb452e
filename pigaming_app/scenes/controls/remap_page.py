"""Page on which keys and buttons are changed, for each key cluster and each kind of pad there is.

FIRE on a row waits for the new key or button. One that is taken changes places with the old one, so that every function
keeps one.
"""

import pygame

from pigaming_app.scenes.controls import pictures
from pigaming_app.scenes.flow.scene import Context, StackOperation
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.ui.input import gamepads, keyboard
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.input.remap import Tables, assigned, differences
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.setting_row import SettingValue

WAIT = 8.0  # seconds for which a new key or button is awaited
DEFAULTS = {**keyboard.DEFAULTS, **gamepads.DEFAULTS}


class RemapPage(SettingsPage):
    """The page; `awaited`: the row that waits for a key or button, if any."""

    table, title = "remap", "remap.title"
    hints = ((Button.RIGHT, "remap.hint_device"), (Button.FIRE, "options.hint_ok"), (Button.BACK, "options.hint_back"))

    def __init__(self, context: Context) -> None:
        self.devices = [
            *keyboard.DEFAULTS,
            *dict.fromkeys(context.controls.name(pad) for pad in context.controls.pads()),
        ]
        last = context.controls.last
        own = f"keys{last.number + 1}" if last.kind == "keys" else context.controls.name(last)
        self.device = own if own in self.devices else self.devices[0]
        self.awaited, self.left = "", 0.0
        super().__init__(context, self._rows())

    def on_leave(self) -> None:
        self.context.controls.listen(None)

    def handle(self, event: InputEvent) -> StackOperation:
        """While a key or button is awaited, the mouse ends the waiting."""
        if not self.awaited:
            return super().handle(event)
        if event.button in (Button.CLICK, Button.LOST):
            self._stop_waiting()
        return None

    def advance(self, seconds: float) -> StackOperation:
        self.left -= seconds
        if self.awaited and self.left <= 0.0:
            self._stop_waiting()
        return None

    def draw_picture(self, screen: pygame.Surface, name: str, chosen: int) -> None:
        lit = not self.awaited or self.age % 1.0 < 0.5
        pictures.key(name, self._sign, lit).draw(screen, *dials.CENTRE)

    # ---- rows

    def _rows(self) -> list[str]:
        return ["device", *DEFAULTS[self.device], "normal"]

    def line(self, name: str) -> str:
        return super().line(name if name in ("device", "normal") else "function")

    def value(self, name: str) -> SettingValue:
        if name == "device":
            names = tuple(self._name(device) for device in self.devices)
            return SettingValue("arrows", names, self.devices.index(self.device), endless=True)
        if name in ("normal", self.awaited):
            return self.action("remap.restore" if name == "normal" else "remap.press")
        code = self.context.controls.tables()[self.device][name]
        return SettingValue("action", (self.context.words.key_name(self._printed(code)),))

    def step(self, name: str, by: int) -> None:
        """Left and right change the device on every row."""
        super().step("device", by)

    def apply(self, name: str, chosen: int) -> None:
        self.device = self.devices[chosen]
        self.show_rows(self._rows())

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Await a key or button, or restore the defaults."""
        if name == "normal":
            self._keep(self._others())
        else:
            self.awaited, self.left = name, WAIT
            self.context.controls.listen(self._assign)
            self.context.sounds.play("move")
        return None

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

    def _assign(self, device: Device, code: int) -> None:
        """Give the awaited function a key or button that went down; Escape and what cannot have it end the waiting."""
        name, words = self.awaited, self.context.words
        self._stop_waiting()
        keys = self.device in keyboard.DEFAULTS
        fits = keyboard.usable(name, code) if keys else gamepads.usable(self.device, code)
        own = device.kind == "keys" if keys else self.context.controls.name(device) == self.device
        if not own or not fits:
            if code != pygame.KSCAN_ESCAPE:
                self.show_message(words("remap.unusable"))
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
        self.rewarm()
        self.save()


def _cluster(device: str) -> Device:
    """The key cluster with this name in the settings."""
    return Device("keys", [*keyboard.DEFAULTS].index(device))
