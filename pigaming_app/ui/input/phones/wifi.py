"""The code of a Wi-Fi network: phones that scan it offer to join."""

SPECIAL = '\\;,:"'  # characters that a backslash precedes


def wifi_text(name: str, password: str) -> str:
    """The text of the code for a network with WPA, or without a password for an open one.

    Source: "Barcode Contents", wiki of ZXing, section "Wi-Fi Network config"; WPA3 specification, section 7.
    """
    kind = "WPA" if password else "nopass"
    key = f"P:{escaped(password)};" if password else ""
    return f"WIFI:T:{kind};S:{escaped(name)};{key};"


def escaped(text: str) -> str:
    """A text within the code."""
    return "".join(f"\\{sign}" if sign in SPECIAL else sign for sign in text)
