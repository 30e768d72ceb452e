"""How people aim who are drawn here: with a known error, beside targets whose motion they foresee in part."""

import numpy as np
import pytest

from pigaming_app.ai.people.fit.aiming import aims, mixture
from pigaming_app.ai.people.fit.differences import REACTIONS
from pigaming_app.ai.people.fit.wishes import ASKED, Watched


def aimed(lead, spread, nearest, presses=600, every=40):
    """Somebody who fires with this error; of the models only the nearest sees the target where they do."""
    draw, ticks = np.random.default_rng(5), every * (presses + 2)
    block = np.arange(ticks) // every
    target, ahead = draw.uniform(-3.0, 3.0, presses + 2)[block], draw.normal(0.0, 0.4, presses + 2)[block]
    apart = 0.15 * np.array([REACTIONS.index(i) - REACTIONS.index(nearest) if i in REACTIONS else 9 for i in range(12)])
    seen = target[:, None] + apart * draw.choice([-1.0, 1.0], presses + 2)[block][:, None]
    poses = np.zeros((ticks, 2))
    poses[:, 0] = target + lead * ahead + draw.normal(0.0, spread, presses + 2)[block]
    actions = np.zeros((ticks, 5))
    actions[:, 2] = np.arange(ticks) % every > every // 2
    sights = np.stack([seen, seen + ahead[:, None]], axis=2)
    return Watched(actions, poses, np.zeros((ticks, len(ASKED), 3)), sights, 3.0, None)


@pytest.mark.parametrize(("lead", "spread", "nearest"), [(0.0, 0.1, 0), (0.6, 0.2, 2), (1.0, 0.3, 8)])
def test_error_and_lead_are_found(lead: float, spread: float, nearest: int) -> None:
    found = aims([aimed(lead, spread, nearest)])
    assert found["aim_lead"] == pytest.approx(lead, abs=0.1)
    assert found["aim_reaction"] == pytest.approx(np.log(ASKED[nearest].reaction), abs=0.15)
    assert np.exp(found["aim1_every"]) == pytest.approx(spread, rel=0.12)
    assert found["aim1_every_share"] > 0.95


def test_who_never_fires_has_the_same_numbers() -> None:
    play = aimed(0.5, 0.2, 1)
    play.actions[:, 2] = 0.0
    found = aims([play])
    assert found.keys() == aims([aimed(0.5, 0.2, 1)]).keys()
    assert np.isfinite([*found.values()]).all()


def test_a_mixture_is_taken_apart() -> None:
    draw = np.random.default_rng(1)
    off = np.concatenate([draw.normal(0.0, 0.15, 700), draw.uniform(-np.pi, np.pi, 300)])
    spread, share = mixture(off)
    assert spread == pytest.approx(0.15, rel=0.08)
    assert share == pytest.approx(0.7, abs=0.04)
