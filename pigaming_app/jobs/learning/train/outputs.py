"""The files that a training writes: checked before it begins, written at its end."""

import csv
from argparse import ArgumentParser, Namespace
from collections.abc import Iterable, Sequence
from io import BytesIO, StringIO
from os.path import realpath
from pathlib import Path
from typing import Any

from pigaming_app.jobs.terminal.options import path
from pigaming_app.jobs.terminal.refusal import Refusal, require
from pigaming_app.storage.safe_files import require_writable


def output_options(parser: ArgumentParser, noun: str) -> None:
    """Declare the files. `noun`: what is learned."""
    parser.add_argument("--out", type=path, metavar="FILE", required=True, help=f"{noun} (.npz)")
    parser.add_argument("--resume", action="store_true", help="continue from that file")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=NUMBER", help="change a hyperparameter")
    parser.add_argument("--curve", type=path, metavar="FILE", help="learning curve (PNG; extra `plots`)")
    parser.add_argument("--csv", type=path, metavar="FILE", help="learning curve as numbers")


def check_outputs(arguments: Namespace, noun: str, beside: Sequence[Path] = ()) -> None:
    """Check before a training whatever would fail after it. `beside`: further files. Raises Refusal or NotSaved."""
    if arguments.out.suffix != ".npz":
        raise Refusal(f"--out: {arguments.out}: the name of a {noun} ends in .npz")
    if arguments.curve and arguments.curve.suffix.lower() != ".png":
        raise Refusal(f"--curve: {arguments.curve}: the name of a picture ends in .png")
    outputs = [("out", arguments.out), *(("out", one) for one in beside)]
    outputs += [("csv", arguments.csv), ("curve", arguments.curve)]
    taken: set[str] = set()
    for option, file in outputs:
        if file is None:
            continue
        if file.is_dir() or not file.absolute().parent.is_dir():
            raise Refusal(f"--{option}: {file}: there is no such folder, or it is one itself")
        if realpath(file) in taken:
            raise Refusal(f"--{option}: {file}: another file of this training has that name")
        taken.add(realpath(file))
        require_writable(file)
    if arguments.curve:
        require("plots")


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


def png_of(figure: Any) -> bytes:
    """A figure as a PNG file; closes it."""
    from matplotlib import pyplot

    picture = BytesIO()
    figure.savefig(picture, dpi=110, format="png")
    pyplot.close(figure)
    return picture.getvalue()
