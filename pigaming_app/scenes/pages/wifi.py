"""Rows of settings for the school's Wi-Fi, which the phones' code and the boards of robots share."""

from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.pages.text_page import TextPage
from pigaming_app.ui.draw import BODY
from pigaming_app.ui.draw.layers import fit_text
from pigaming_app.ui.web import wifi
from pigaming_app.ui.widgets.setting_row import SettingValue

WIFI = {"wifi": wifi.NAME, "wifi_key": wifi.LONGEST}  # rows, and their longest text
LETTERS = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 -_.!?#$%&@*+=/,;:'\"()"
ROOM, STARS = 380, 12  # px of a value, and the most stars in place of a password


def wifi_value(page: SettingsPage, row: str) -> SettingValue:
    """The name of the Wi-Fi, or stars for its password."""
    typed = _typed(page, row)
    shown = "*" * min(STARS, len(typed)) if row == "wifi_key" else fit_text(typed, BODY, ROOM)[0]
    return SettingValue("action", (shown or page.context.words("phones.none_set"),))


def wifi_line(page: SettingsPage, row: str) -> str:
    """The description of a row; that of the password has where it is kept."""
    words, settings = page.context.words, page.context.settings
    line = words(f"{page.table}.{row}_line")
    plain = settings.phones_wifi_key or not settings.phones_wifi or not wifi.has_keyring()
    return f"{line} {words('phones.plain' if plain else 'phones.keyring')}" if row == "wifi_key" else line


def wifi_typing(page: SettingsPage, row: str) -> TextPage:
    """The page on which the name of the Wi-Fi, or its password, is typed."""
    settings = page.context.settings

    def keep(typed: str) -> str:
        if row == "wifi":
            wifi.rename(settings, typed)
        elif not wifi.keep(settings, typed) and typed:
            page.show_message(page.context.words("phones.plain"))
        page.save(lambda: wifi.save(settings))
        page.rewarm()
        return ""

    return TextPage(page.context, page.label(row), _typed(page, row), WIFI[row], keep, True, LETTERS)


def _typed(page: SettingsPage, row: str) -> str:
    settings = page.context.settings
    return wifi.password(settings) if row == "wifi_key" else settings.phones_wifi
