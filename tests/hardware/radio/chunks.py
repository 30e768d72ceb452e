"""Byte streams in chunks of any size."""


def in_pieces(data, sizes):
    """The data in chunks of these sizes, then the rest."""
    for size in sizes:
        yield data[:size]
        data = data[size:]
    yield data


def heard(decoder, data, sizes=()):
    return [found for piece in in_pieces(data, sizes) for found in decoder.feed(piece)]
