"""Calibrates `people fit`: statistics of people with known traits, and what they tell of the traits.

    .venv/bin/python -m tests.bench.fit_people pitanks turn --people 256 --write

writes assets/people/GAME_DRIVING.json and prints the table of docs/people.md: the error of each trait by minutes of
play, of people who are not among those of the regression. Needs numba; takes a quarter of an hour on an idle core.
"""

import argparse
import json
from collections.abc import Sequence

from pigaming_app.ai.people.fit.calibration import FitCalibration, TraitCalibration, calibrated, file_of
from pigaming_app.storage.schema import to_plain
from tests.ai.people.fit.known import samples_of

MATCHES, SEED, TEST_SEED = 8, 41, 51  # of each person of the regression; seeds


def measured(game: str, driving: str, people: int, tested: int, matches: int) -> FitCalibration:
    """The calibration of a game and driving style. `matches`: of each person who is tested, a power of two."""
    known = [(traits, found[MATCHES][1]) for traits, found in samples_of(game, driving, people, (MATCHES,), SEED)]
    counts = [2**i for i in range(matches.bit_length())]
    others, by_minutes = [*samples_of(game, driving, tested, counts, TEST_SEED)], {}
    for count in counts:
        minutes = sum(found[count][0] for _, found in others) / len(others)
        by_minutes[minutes] = [(traits, found[count][1]) for traits, found in others]
    return calibrated(known, by_minutes)


def table(known: FitCalibration) -> list[str]:
    """Errors in %, or in points of a share."""
    head = ["| |", *(f" {minutes:.0f} min |" for minutes in known.minutes)]
    return ["".join(head), "|---" * (len(known.minutes) + 1) + "|", *(row(*one) for one in known.traits.items())]


def row(name: str, trait: TraitCalibration) -> str:
    """The errors of a trait."""
    return f"| {name} |" + "".join(f" {100 * error:.0f} |" for error in trait.errors)


def main(words: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("game")
    parser.add_argument("driving", choices=("turn", "point"))
    parser.add_argument("--people", type=int, default=512)
    parser.add_argument("--tested", type=int, default=48)
    parser.add_argument("--matches", type=int, default=16)
    parser.add_argument("--write", action="store_true")
    chosen = parser.parse_args(words)
    found = measured(chosen.game, chosen.driving, chosen.people, chosen.tested, chosen.matches)
    if chosen.write:
        file = file_of(chosen.game, chosen.driving)
        file.parent.mkdir(exist_ok=True)
        file.write_text(json.dumps(to_plain(found), separators=(",", ":")) + "\n", encoding="utf-8")
    print("\n".join(table(found)))


if __name__ == "__main__":
    main()
