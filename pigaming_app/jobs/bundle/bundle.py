"""Build the program for this system as a folder that runs without Python and without network."""

import json
import sys
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from pigaming_app import FROZEN, INSTALLED
from pigaming_app.jobs.terminal.options import JsonOption, option, path
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require


@dataclass(frozen=True, kw_only=True)
class BundleOptions(JsonOption):
    """Where to build it."""

    out: Path = option("default dist: dist/pigaming", path, Path("dist"), metavar="DIR")


def run(options: BundleOptions) -> int:
    """Build the bundle and print where it is. Raises Refusal."""
    from pigaming_app.jobs.bundle.build import BuildFailed, build

    if FROZEN or INSTALLED:
        raise Refusal("bundle: it is built from a clone of the project, not from an installed program")
    require("bundle")
    if not find_spec("numba"):
        print("PiGaming: numba is not installed; learning will be slow in this bundle.", file=sys.stderr)
    print("PiGaming: building takes a minute or two.", file=sys.stderr)
    with refused(BuildFailed):
        built = build(options.out.absolute())
    if options.json:
        print(json.dumps({"program": str(built.program), "bytes": built.size}))
    else:
        print(f"{built.program}: {built.size / 1e6:.0f} MB")
    return 0
