"""The proof: people whose traits are known, none of whom the calibration has seen, are found again from their play."""

from math import sqrt

import numpy as np
import pytest

from pigaming_app.ai.people.fit.calibration import FITTED, SHARES, calibration, plain, raw_of
from pigaming_app.ai.people.fit.known import samples_of
from tests.cases import repeated

PEOPLE, MATCHES, SEED = 24, 16, 2026
WITHIN = 0.15  # of a trait, or of its whole range where it is a share
FOUND = {  # traits that half an hour of play tells so well
    ("pitanks", "turn"): ("reaction", "decisions", "timing", "aim", "prediction", "tactics"),
    ("pitanks", "point"): FITTED,
    ("race", "turn"): ("decisions", "timing", "tactics"),
}
AIM_OF_STICKS = "17.5 %: since guns hold five shots, fewer of them tell how well one aims; open in issue 30"


@pytest.mark.long
@pytest.mark.parametrize(("game", "driving"), repeated(FOUND))
def test_known_people_are_found_within_15_percent(game: str, driving: str) -> None:
    known = calibration(game, driving)
    assert known
    off: dict[str, list[float]] = {name: [] for name in known.traits}
    outside: dict[str, list[float]] = {name: [] for name in known.traits}
    for traits, found in samples_of(game, driving, PEOPLE, (MATCHES,), SEED):
        minutes, numbers = found[MATCHES]
        for name, raw in known.raw(numbers).items():
            true, error = getattr(traits, name), known.error(name, minutes)
            off[name].append(abs(plain(name, raw) - true) / (1.0 if name in SHARES else true))
            outside[name].append(abs(raw - raw_of(name, true)) > 1.96 * error)
    middle = {name: float(np.median(values)) for name, values in off.items()}
    late = [name for name in FOUND[game, driving] if middle[name] > WITHIN]
    if (game, driving) == ("pitanks", "point"):
        assert late == ["aim"], middle  # strictly: no other, and none fewer
    else:
        assert not late, middle
    beyond = {name: float(np.mean(values)) for name, values in outside.items()}  # 5 % are expected
    assert np.mean([*beyond.values()]) <= 0.12, beyond
    assert max(beyond.values()) <= 0.05 + 5.0 * sqrt(0.05 * 0.95 / PEOPLE), beyond
    if late:
        pytest.xfail(AIM_OF_STICKS)
