"""The driving style of each device: chosen by its player, remembered for its kind of device."""

from pigaming_app.ai.game_ai import HELPED_POINT, HELPED_TURN, ONE_BUTTON, POINT, TURN
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.input.events import Device

UNHELPED = {HELPED_TURN: TURN, HELPED_POINT: POINT}  # the same styles in games without help
PICTURES = {
    TURN: "wheel",
    POINT: "point",
    HELPED_TURN: "wheel",
    HELPED_POINT: "point",
    ONE_BUTTON: "button",
}  # icon of each style


class DrivingStyles:
    """Driving styles by device, each a name in `GameAI.driving`. A style belongs to the device, so it stays on a change
    of seat, in a rematch and in another game.
    """

    def __init__(self, settings: Settings) -> None:
        self.settings = settings
        self.chosen: dict[Device, str] = {}
        self.remembered: dict[Device, str] = {}  # as it was when each device came: later choices of others do not count

    def of(self, device: Device, game: str) -> str:
        """The style of a device in a game: its player's choice, the last choice on this kind of device, or the default.

        The default of pads and phones is to point.
        """
        styles = _styles(game)
        last = self.settings.pad_driving if device.has_stick else self.settings.keys_driving
        for style in (self.chosen.get(device, ""), self.remembered.setdefault(device, last)):
            for name in (style, UNHELPED.get(style, "")):
                if name in styles:
                    return name
        return POINT if device.has_stick else TURN

    def change(self, device: Device, game: str, delta: int) -> None:
        """Step a device through the game's styles, and remember the new one for its kind of device.

        One button is a need of one person, so it is not remembered for others.
        """
        names = _styles(game)
        style = names[(names.index(self.of(device, game)) + delta) % len(names)]
        self.chosen[device] = style
        if style == ONE_BUTTON:
            return
        if device.has_stick:
            self.settings.pad_driving = style
        else:
            self.settings.keys_driving = style

    def forget_one_button(self) -> None:
        """Give up one button on all devices: the next player may be another."""
        self.chosen = {device: style for device, style in self.chosen.items() if style != ONE_BUTTON}

    def inherit(self, device: Device, before: Device) -> None:
        """Give the style of the device that drove before to a device whose player has not chosen."""
        if before in self.chosen:
            self.chosen.setdefault(device, self.chosen[before])


def _styles(game: str) -> list[str]:
    """The styles of a game, in their order."""
    from pigaming_app.ai.registry import AIS  # late: the title does not wait for AIs

    return list(AIS[game].driving)
