"""A scripted open day: `python -m tests.bench.open_day [--hours 8] [--visitors 200] [--seed 1] [--json]`.

The arcade runs under its supervisor, with simulated time, virtual pads and real phone sockets; this script kills it.
Exit code 1 where a result was lost or counted twice, memory grew, or a log has a line. `--keep DIR` keeps all files.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

from tests.bench.open_day.plan import ONLY
from tests.bench.open_day.run import KILLS, outcome_of_day


def main() -> int:
    """Play the day and print its figures. Returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.open_day", description="A scripted open day.")
    parser.add_argument("--hours", type=float, default=8.0, help="simulated hours (8)")
    parser.add_argument("--visitors", type=int, default=200)
    parser.add_argument("--kills", type=int, default=KILLS, help=f"at most {KILLS}")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", choices=ONLY, default="", help="a part of a day")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="an empty folder for the files of the day")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    wishes = {name: getattr(arguments, name) for name in ("hours", "visitors", "seed", "kills", "only")}
    with tempfile.TemporaryDirectory(prefix="pigaming-day-") as temporary:
        folder = arguments.keep or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        figures = outcome_of_day(folder, **wishes)
    if arguments.json:
        print(json.dumps(figures))
    else:
        print("\n".join(f"{name}: {value}" for name, value in figures.items() if name != "problems"))
        print(f"{len(figures['problems'])} problems", *figures["problems"][:30], sep="\n  ")
    return int(bool(figures["problems"]))


if __name__ == "__main__":
    sys.exit(main())
