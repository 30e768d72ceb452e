"""Calibrates `people fit`: statistics of people with known traits, and what they tell of the traits.

    .venv/bin/python -m tests.bench.fit_people pitanks turn --write

writes assets/people/GAME_DRIVING.json and prints the table of docs/people.md: the error of each trait by minutes of
play, of people who are not among those of the regression. Needs numba; takes ten minutes on an idle core.
"""

import json
import sys

from pigaming_app.ai.people.fit.calibration import FitCalibration, calibrated, file_of
from pigaming_app.ai.people.fit.known import samples_of
from pigaming_app.storage.schema import to_plain

PEOPLE, MATCHES, SEED = 768, 8, 41  # of the regression
TESTED, COUNTS, TEST_SEED = 96, (1, 2, 4, 8, 16, 32), 51  # people, and matches after which the errors are measured


def measured(game: str, driving: str) -> FitCalibration:
    """The calibration of a game and driving style."""
    known = [(traits, found[MATCHES][1]) for traits, found in samples_of(game, driving, PEOPLE, (MATCHES,), SEED)]
    others = [*samples_of(game, driving, TESTED, COUNTS, TEST_SEED)]
    tested = {
        sum(found[count][0] for _, found in others) / len(others): [
            (traits, found[count][1]) for traits, found in others
        ]
        for count in COUNTS
    }
    return calibrated(known, tested)


def table(known: FitCalibration) -> list[str]:
    """Errors in %, or in points of a share."""
    head = ["| |", *(f" {minutes:.0f} min |" for minutes in known.minutes)]
    rows = [
        f"| {name} |" + "".join(f" {100 * error:.0f} |" for error in one.errors) for name, one in known.traits.items()
    ]
    return ["".join(head), "|---" * (len(known.minutes) + 1) + "|", *rows]


def main(game: str, driving: str, write: bool) -> None:
    found = measured(game, driving)
    if write:
        file_of(game, driving).parent.mkdir(exist_ok=True)
        file_of(game, driving).write_text(json.dumps(to_plain(found), indent=0) + "\n", encoding="utf-8")
    print("\n".join(table(found)))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], "--write" in sys.argv)
