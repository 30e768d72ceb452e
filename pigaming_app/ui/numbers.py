"""Numbers as shown on the screen: with a true minus sign, and never −0."""

MINUS = "−"


def numeral(value: float, digits: int = 0) -> str:
    """A number rounded to `digits` decimals."""
    return f"{value:z.{digits}f}".replace("-", MINUS)


def signed(value: float, digits: int = 0) -> str:
    """The same with its sign; none for what rounds to zero."""
    text = numeral(value, digits)
    return text if text[0] == MINUS or not any(digit in "123456789" for digit in text) else f"+{text}"
