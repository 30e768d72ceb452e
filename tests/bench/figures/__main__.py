"""Prints the blocks of the pages, or writes them: all of them take about two hours on two idle cores."""

import argparse
import sys

from tests.bench.figures import Derived, Measured, on_page, write
from tests.bench.figures.registry import DERIVED, MEASURED


def main() -> int:
    """Print or write; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.figures", description=__doc__)
    parser.add_argument("--write", action="store_true", help="into the pages; else they are printed")
    parser.add_argument("--only", nargs="+", choices=[*DERIVED, *MEASURED], default=[*DERIVED, *MEASURED])
    parser.add_argument("--share", type=float, default=1.0, help=argparse.SUPPRESS)
    words = parser.parse_args()
    for name in words.only:
        block: Derived | Measured = DERIVED.get(name) or MEASURED[name]
        text = block.text() if isinstance(block, Derived) else block.text(words.share)
        if words.write:
            write(block.page, name, text)
            print(f"{block.page}: {name}", flush=True)
        elif text != on_page(block.page, name):
            print(f"{block.page}: {name}\n{text}\n", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
