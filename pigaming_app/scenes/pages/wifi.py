"""Rows of settings for the school's Wi-Fi, which the phones' code and the boards of robots share."""

from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.pages.text_page import TextPage
from pigaming_app.ui.draw import BODY
from pigaming_app.ui.draw.layers import fit_text
from pigaming_app.ui.widgets.setting_row import SettingValue

WIFI = {"wifi": ("phones_wifi", 32), "wifi_key": ("phones_wifi_key", 63)}  # settings by row, and their longest text
LETTERS = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 -_.!?#$%&@*+=/,;:'\"()"
ROOM, STARS = 380, 12  # px of a value, and the most stars in place of a password


def wifi_value(page: SettingsPage, row: str) -> SettingValue:
    """The name of the Wi-Fi, or stars for its password."""
    typed = getattr(page.context.settings, WIFI[row][0])
    shown = "*" * min(STARS, len(typed)) if row == "wifi_key" else fit_text(typed, BODY, ROOM)[0]
    return SettingValue("action", (shown or page.context.words("phones.none_set"),))


def wifi_typing(page: SettingsPage, row: str) -> TextPage:
    """The page on which the name of the Wi-Fi, or its password, is typed."""
    settings, (field, most) = page.context.settings, WIFI[row]

    def keep(typed: str) -> str:
        setattr(settings, field, typed)
        page.save()
        page.rewarm()
        return ""

    return TextPage(page.context, page.label(row), getattr(settings, field), most, keep, True, LETTERS)
