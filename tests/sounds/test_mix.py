"""What the loudspeakers get: nothing clips with four players at full volume, and the finale is in step."""

import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from assets.sounds.render import FOLDER
from pigaming_app.games.game import Game
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.scenes.bench.frame_times import AllEffects
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.world import WIDTH
from pigaming_app.ui.sounds import MIN_REPEAT, stereo
from tests.cases import repeated
from tests.matches import match_of
from tests.sounds.meter import RATE, Samples, decoded
from tests.sounds.test_effects import GROUP

ROOT = Path(__file__).resolve().parents[2]
FULL = 32767 / 32768
FREQUENT = ("hit", "wall", "pickup")  # besides shots, for each player
SELDOM = [name for name, group in GROUP.items() if group in ("call", "blow")]
Cue = tuple[float, str, float]  # s, name of the file, pan
pytestmark = pytest.mark.usefixtures("mixer")


@cache
def file(folder: Path, name: str) -> Samples:
    return decoded(folder / f"{name}.ogg")


def music(game: str) -> Samples:
    """Theme and finale together."""
    own = ROOT / "pigaming_football" / "sounds"
    folder = own if game == "football" else FOLDER
    return file(folder, f"theme_{game}") + file(folder, f"finale_{game}")


def mixed(game: str, cues: Sequence[Cue], seconds: float, start: float = 0.0) -> Samples:
    """The mixer's sum at full volume: the music from `start` on, and these sounds."""
    theme = music(game)
    out = theme[(round(start * RATE) + np.arange(round(seconds * RATE))) % len(theme)]
    for at, name, pan in cues:
        sound = file(FOLDER, name)[: len(out) - round(at * RATE)]
        out[round(at * RATE) : round(at * RATE) + len(sound)] += sound * stereo(pan)
    return out


def crowd(seed: int) -> tuple[list[Cue], float]:
    """Four players who each do six things in the same second, and where in the music."""
    chance = np.random.default_rng(seed)
    names = [(f"fire{k + 1}", f"fire{k + 1}", *FREQUENT, str(chance.choice(SELDOM))) for k in range(4)]
    cues = [(chance.uniform(0.0, 1.0), name, chance.uniform(-1.0, 1.0)) for each in names for name in each]
    return cues, chance.uniform(0.0, 60.0)


@pytest.mark.parametrize("seed", range(12))
def test_four_players_at_once_do_not_clip(seed: int) -> None:
    cues, start = crowd(seed)
    assert np.abs(mixed("pitanks", cues, 2.0, start)).max() < FULL


@pytest.mark.long
@pytest.mark.parametrize("game", sorted(games()))
def test_no_crowd_of_a_hundred_clips(game: str) -> None:
    crowds = [crowd(1000 + seed) for seed in range(100)]
    assert max(np.abs(mixed(game, cues, 2.0, start)).max() for cues, start in crowds) < FULL


def played(match: Match, seconds: float) -> Iterator[Cue]:
    """The sounds of a match as `Sounds.play` plays them: not the same one twice within a moment."""
    brains = [seat.brain for seat in match.setup.seats]
    view = SCREENS[match.setup.game].view(match.arena, match.state, brains, AllEffects(), None)
    last: dict[str, float] = {}
    while not match.over and match.seconds < seconds:
        match.tick()
        for name, player, x in view.watch(match.state):
            name = name if name in GROUP else f"{name}{(player or 0) + 1}"
            if match.seconds - last.get(name, -1.0) >= MIN_REPEAT:
                last[name] = match.seconds
                yield match.seconds, name, 2.0 * x / WIDTH - 1.0


@pytest.mark.long
@pytest.mark.parametrize("game", repeated(games().values()), ids=lambda game: game.name)
def test_no_match_of_four_ais_clips(game: Game) -> None:
    for variant in game.variants:
        match = match_of(game.name, "level5 level5 level4 level4", variant=variant)
        cues = list(played(match, 60.0))
        assert len(cues) > 5, variant
        assert np.abs(mixed(game.name, cues, 61.0)).max() < FULL, variant


RECORDER = """
import os, sys, pygame
from pigaming_app.ui.sounds import Sounds

def record(seconds):
    while os.path.getsize(os.environ["SDL_DISKAUDIOFILE"]) < seconds * 4 * 44100:
        pygame.time.wait(5)

sounds = Sounds()
sounds.volume(10, 10)
sounds.music("pitanks")
assert sounds.wait(), sounds.trouble
sounds.finale()
record(4.0)
for player in range(4):
    for name in ("fire", "ready", "hit", "wall", "mine", "crumble", "pickup", "go"):
        sounds.play(name, player, (-0.9, -0.3, 0.3, 0.9)[player])
record(5.0)
sounds.close()
"""


@pytest.mark.long
def test_what_the_mixer_of_sdl_writes_is_the_sum_in_step(tmp_path: Path) -> None:
    """SDL's driver `disk` writes what a sound card would get: theme plus finale, to the last bit."""
    recorded = tmp_path / "recorded.raw"
    drivers = {"SDL_AUDIODRIVER": "disk", "SDL_DISKAUDIOFILE": str(recorded), "SDL_DISKAUDIODELAY": "11"}
    subprocess.run([sys.executable, "-c", RECORDER], cwd=ROOT, env={**os.environ, **drivers}, check=True)
    heard = np.fromfile(recorded, "<i2").reshape(-1, 2) / 32768.0
    both = music("pitanks")[: len(heard)]
    piece = heard[3 * RATE : 4 * RATE - 2048]
    offset = next(k for k in range(0, RATE) if np.abs(both[3 * RATE - k :][:64] - piece[:64]).max() < 2 / 32768)
    assert np.abs(both[3 * RATE - offset :][: len(piece)] - piece).max() < 2 / 32768
    assert 0.3 < np.abs(heard).max() < FULL, "sounds of four players join it, all at once"
