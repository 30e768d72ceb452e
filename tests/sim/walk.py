"""The numbers of a plain record, by a walk over its fields: what the packing of whole records is compared with."""

from collections.abc import Iterator

from pigaming_app.sim.record import fields_of


def numbers(state: object) -> Iterator[float]:
    """Every number, in memory order."""
    for field in fields_of(type(state)):
        for element in field.elements(state):
            yield from (element,) if field.code else numbers(element)
