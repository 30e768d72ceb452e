"""The proof: people whose traits are known, none of whom the calibration has seen, are found again from their play."""

from math import sqrt

import numpy as np
import pytest

from pigaming_app.ai.people.fit.calibration import FITTED, SHARES, FitCalibration, calibration, plain, raw_of
from pigaming_app.ai.people.fit.people import FittedPerson, mean_of
from tests.ai.people.fit.known import samples_of

PEOPLE, SEED = 24, 2026
MATCHES = {"pitanks": 16, "race": 16, "football": 8, "factory": 16}  # about half an hour
WITHIN = 0.15  # of a trait, or of its whole range where it is a share
FOUND = {  # traits that half an hour of play tells so well
    ("pitanks", "turn"): tuple(name for name in FITTED if name != "stick"),
    ("pitanks", "point"): FITTED,
    ("race", "turn"): ("decisions", "timing", "tactics"),
    ("football", "turn"): ("reaction", "decisions", "timing", "tactics"),
    ("football", "point"): ("reaction", "decisions", "timing", "stick", "tactics"),
    ("factory", "turn"): ("decisions", "timing", "tactics"),
    ("factory", "point"): ("decisions", "timing", "stick", "tactics"),
}
UNUSED = {"football": ("prediction",), "factory": ("aim", "prediction")}  # traits that change nothing in the game


def calibration_of(game: str, driving: str) -> FitCalibration:
    known = calibration(game, driving)
    assert known
    return known


@pytest.mark.long
@pytest.mark.again
@pytest.mark.parametrize(("game", "driving"), FOUND)
def test_known_people_are_found_within_15_percent(game: str, driving: str) -> None:
    known = calibration_of(game, driving)
    off: dict[str, list[float]] = {name: [] for name in known.traits}
    outside: dict[str, list[float]] = {name: [] for name in known.traits}
    count = MATCHES[game]
    for traits, found in samples_of(game, driving, PEOPLE, (count,), SEED):
        minutes, numbers = found[count]
        for name, raw in known.raw(numbers).items():
            true, error = getattr(traits, name), known.error(name, minutes)
            off[name].append(abs(plain(name, raw) - true) / (1.0 if name in SHARES else true))
            outside[name].append(abs(raw - raw_of(name, true)) > 1.96 * error)
    middle = {name: float(np.median(values)) for name, values in off.items()}
    late = [name for name in FOUND[game, driving] if middle[name] > WITHIN]
    assert not late, middle
    beyond = {name: float(np.mean(values)) for name, values in outside.items()}  # 5 % are expected
    assert np.mean([*beyond.values()]) <= 0.12, beyond
    assert max(beyond.values()) <= 0.05 + 5.0 * sqrt(0.05 * 0.95 / PEOPLE), beyond


@pytest.mark.parametrize(("game", "driving"), [(game, driving) for game in UNUSED for driving in ("turn", "point")])
def test_of_traits_that_change_nothing_in_the_game_nothing_is_told(game: str, driving: str) -> None:
    """Neither of one person after very long play nor of many."""
    one = FittedPerson(game, driving, 1000.0, dict.fromkeys(calibration_of(game, driving).traits, 0.5))
    for found in (one.estimates(), mean_of([one] * 50).traits):
        assert [name for name in UNUSED[game] if found[name]] == []
        assert found["decisions"]
        assert found["timing"]
