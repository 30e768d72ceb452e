"""The learning curve of a training, as numbers and as a picture."""

import csv
from collections.abc import Iterable, Sequence
from io import BytesIO, StringIO
from typing import Any


def csv_of(columns: Sequence[str], rows: Iterable[Sequence[Any]]) -> bytes:
    """A table as a CSV file."""
    text = StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(columns)
    writer.writerows(rows)
    return text.getvalue().encode()


def two_plots() -> tuple[Any, Any, Any]:
    """A figure of matplotlib with two plots, one above the other, over the same axis."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, (upper, lower) = pyplot.subplots(2, 1, figsize=(9, 7), sharex=True, layout="constrained")
    return figure, upper, lower


def with_plots(places: Sequence[Sequence[str]]) -> tuple[Any, Any]:
    """A figure of matplotlib with plots by name, over the same axis; `places`: their names by row and column."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, plots = pyplot.subplot_mosaic(
        [[*row] for row in places], figsize=(13, 9), sharex=True, layout="constrained"
    )
    return figure, plots


def png_of(figure: Any) -> bytes:
    """A figure as a PNG file; closes it."""
    from matplotlib import pyplot

    picture = BytesIO()
    figure.savefig(picture, dpi=110, format="png")
    pyplot.close(figure)
    return picture.getvalue()
