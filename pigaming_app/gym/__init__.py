"""Faces of the games for learning libraries: Gymnasium and PettingZoo. Extra `gym`; with `train` they are compiled.

    import gymnasium
    import pigaming_app.gym

    one = gymnasium.make("PiTanks-v0", opponents=("level3",))  # one seat
    many = gymnasium.make_vec("PiTanks-v0", num_envs=4096, opponents=("level3",))
    match = pigaming_app.gym.parallel_env("factory", agents=2, teams=(0, 0, 1, 1), opponents=("level1", "level1"))

Environments: PiTanks-v0, RobotRace-v0, RobotFactory-v0; games of `parallel_env`: pitanks, race, factory. An observation
is the game's `Encoding` (see ai/networks) in [-1, 1]; an action is a choice for each of its heads. Options:

- agents: seats of learners in a match, the first ones; 1 by default, in `parallel_env` 2. `make` has one.
- opponents: brains on the seats after them, mates included, by name or by the path of a file; ("level3",) by default
  if there is one agent.
- arena: a name, the path of a .toml file, several of them, or "all"; the game's first by default.
- variant, minutes, goal, teams: as in the lobby, with its defaults. `teams` has a number for each of the four seats.
- ticks: of 1/50 s between decisions; 5 by default, as networks play.
- continuous: actions are linear and angular stick in [-1, 1], then fire and turbo, on above 0.5.
- rewards: weights of the game's tallies by name (see rewards.py); a tally's change since the last decision counts. By
  default PiTanks has hits 1, taken -1, win 5; Robot Race progress 10 (a lap), win 5; Robot Factory progress 4 (a step
  of a pallet of the team), errand 2 (1000 px towards the next target), bumps -0.5, win 5. A win is 1, a defeat -1, at
  the end; the last `info` has all tallies.
- reward: code instead of weights: a line such as "hit - 0.01*turned" (see ai/reward_line.py), or a function of numbers
  with such names. They are these tallies, and in PiTanks also those of the Lab (see ai/reward_quantities.py).
- starts: number of different matches that are played; 128 by default.
- compiled: False to run as plain Python. By default compiled if numba is installed; both give the same bits.
- robots: the path of a file with measured robots; those of an episode are drawn within their range (see robots.py).
- max_episode_steps: decisions after which an episode is truncated.
- autoreset_mode, stagger: of vectors, see vector.py.
- render_mode: "rgb_array" draws with the game's own pictures, 1920 x 1080.

An episode is a match. It is terminated when the match is over, and in the race also when all its agents have finished.
The clock belongs to the rules and is observed, so the end of the time terminates as well; only max_episode_steps and
stagger truncate. `reset(seed=...)` determines all matches from then on; each is one that `main.py play --seed` plays
too, with a seed from -1 to -`starts`. Environments can be pickled, also in the middle of a match.
"""

import os
from itertools import accumulate
from typing import Any

from pigaming_app.links import installing

try:
    _sound = os.environ.get("SDL_AUDIODRIVER")
    import gymnasium
    import pettingzoo as pettingzoo
except ImportError as error:
    raise ImportError(f"pigaming_app.gym needs {error.name}: {installing('gym')}", name=error.name) from None

from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.games.registry import OURS
from pigaming_app.gym.options import OptionError
from pigaming_app.gym.parallel import MatchEnv
from pigaming_app.gym.rewards import TALLIES

os.environ.pop("SDL_AUDIODRIVER", None)  # PettingZoo sets it to dsp, which silences a program that plays sound too
if _sound is not None:
    os.environ["SDL_AUDIODRIVER"] = _sound

__all__ = ["ENVIRONMENTS", "OptionError", "groups", "parallel_env"]

NAMES = {"PiTanks-v0": "pitanks", "RobotRace-v0": "race", "RobotFactory-v0": "factory"}  # of our games
ENVIRONMENTS = {
    **{f"{game.title().replace('_', '')}-v0": game for game in TALLIES if game in ENCODINGS and game not in OURS},
    **{name: game for name, game in NAMES.items() if game in OURS},
}  # names of the games


def parallel_env(game: str, **options: Any) -> MatchEnv:
    """A match as a PettingZoo ParallelEnv. Raises OptionError."""
    return MatchEnv(game, **options)


def groups(game: str) -> dict[str, slice]:
    """The parts of a game's observation by name. Raises OptionError."""
    if game not in ENCODINGS:
        raise OptionError(f"no game '{game}'; there are {', '.join(ENCODINGS)}")
    ends = accumulate(length for _, length in ENCODINGS[game].groups)
    return {name: slice(end - length, end) for (name, length), end in zip(ENCODINGS[game].groups, ends, strict=True)}


for _name, _game in ENVIRONMENTS.items():
    gymnasium.register(
        _name,
        entry_point="pigaming_app.gym.environment:SeatEnv",
        vector_entry_point="pigaming_app.gym.vector:SeatVectorEnv",
        kwargs={"game": _game},
    )
