"""Messages for the operator: a key with values. The sentences are in `assets/text`, table `hardware`."""

from collections.abc import Mapping


class OperatorMessage:
    """A key of the text table `hardware` and the values of its placeholders. `str` serves logs without texts."""

    __slots__ = ("key", "values")

    def __init__(self, key: str, **values: object) -> None:
        self.key = key
        self.values: Mapping[str, object] = values

    def __eq__(self, other: object) -> bool:
        return isinstance(other, OperatorMessage) and (self.key, self.values) == (other.key, other.values)

    def __hash__(self) -> int:
        return hash(self.key)

    def __str__(self) -> str:
        return " ".join([self.key, *(f"{name}={value}" for name, value in self.values.items())])

    def __repr__(self) -> str:
        return f"OperatorMessage({self})"


class OperatorError(Exception):
    """Unusable hardware; `message` is for the operator."""

    def __init__(self, message: OperatorMessage) -> None:
        super().__init__(message)
        self.message = message
