"""A scripted open day, or a week of them: `python -m tests.bench.open_day [--week] [--hours 8] [--visitors 200] …`.

The arcade runs under its supervisor, with simulated time, virtual pads and real phone sockets; this script kills it.
Exit code 1 where a result was lost or counted twice, memory grew, somebody waited too long, or a log has a line.
`--keep DIR` keeps all files; `--page FILE` writes the outcome for the owner of the arcade.
"""

import argparse
import json
import os
import shutil
import sys
import tempfile
from pathlib import Path

from tests.bench.open_day.page import page
from tests.bench.open_day.plan import KILLS, ONLY
from tests.bench.open_day.run import outcome

OWN_MOUNTS = "PIGAMING_TEST_MOUNTS"  # variable of the environment
WEEK = {"hours": 4.0, "visitors": 1000}  # instead of those of a day


def main() -> int:
    """Play the day and print its figures. Returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.open_day", description="Scripted open days.")
    parser.add_argument("--week", action="store_true", help="five days with a fault of each kind")
    parser.add_argument("--hours", type=float, help="simulated hours of a day (8, in a week 4)")
    parser.add_argument("--visitors", type=int, help="of all days (200, in a week 1000)")
    parser.add_argument("--kills", type=int, default=KILLS, help=f"of a day alone, at most {KILLS}")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", choices=ONLY, default="", help="a part of a day")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="an empty folder for the files")
    parser.add_argument("--page", type=Path, metavar="FILE", help="write the outcome as a page (HTML)")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    if arguments.week and OWN_MOUNTS not in os.environ and shutil.which("unshare"):
        os.environ[OWN_MOUNTS] = "1"
        command = ["unshare", "-rm", sys.executable, "-m", "tests.bench.open_day", *sys.argv[1:]]
        os.execvp(command[0], command)
    usual = WEEK if arguments.week else {"hours": 8.0, "visitors": 200}
    wishes = {name: getattr(arguments, name) for name in ("hours", "visitors", "seed", "kills", "only", "week")}
    wishes |= {name: value for name, value in usual.items() if wishes[name] is None}
    with tempfile.TemporaryDirectory(prefix="pigaming-day-") as temporary:
        folder = arguments.keep or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        figures = outcome(folder, **wishes)
    if arguments.page:
        arguments.page.write_text(page(figures), encoding="utf-8")
    if arguments.json:
        print(json.dumps(figures))
    else:
        print("\n".join(f"{name}: {value}" for name, value in figures.items() if name != "problems"))
        print(f"{len(figures['problems'])} problems", *figures["problems"][:30], sep="\n  ")
    return int(bool(figures["problems"]))


if __name__ == "__main__":
    sys.exit(main())
