"""A tank written by hand, on the PettingZoo environment: two of them against two hand1.

    pip install '.[gym,train]'  # train compiles the matches; it also runs without
    python3 examples/hand_written_agent.py

It drives along the way to the nearest opponent, turns its gun to the most pressing one, leads the target and fires.
docs/networks.md describes the parts of the observation.
"""

from typing import Any

from pigaming_app.api.environments import groups, parallel_env

PARTS = groups("pitanks")
BACK, STOP, AHEAD = range(3)  # choices of the head `drive`
LEFT, HALF_LEFT, SLIGHTLY_LEFT, STRAIGHT, SLIGHTLY_RIGHT, HALF_RIGHT, RIGHT = range(7)  # of the head `turn`
MATE, DISTANCE, AIM, CLEAR, PROTECTED = 1, 2, 6, 11, 12  # inputs about another robot
NEAR, FAR = -0.6, -0.2  # 320 and 640 px, in the units of DISTANCE


def act(observation: Any) -> tuple[int, int, int, int]:
    """Choices of the heads drive, turn, fire and turbo."""
    forward, sideways, *_ = observation[PARTS["way"]]  # cosine and sine of the way to the nearest opponent
    target = observation[PARTS["first"]]
    if target[MATE] or not target[CLEAR]:
        return (AHEAD if forward > 0.5 else STOP), stick(2.0 * sideways if forward > 0.0 else sideways * 9.0), 0, 0
    drive = BACK if target[DISTANCE] < NEAR else AHEAD if target[DISTANCE] > FAR else STOP
    fire = abs(target[AIM]) < 0.3 and not target[PROTECTED]
    return drive, stick(target[AIM]), int(fire), 0


def stick(error: float) -> int:
    """The choice of the head `turn` that reduces an error, positive to the right."""
    if abs(error) < 0.1:
        return STRAIGHT
    strength = 1 if abs(error) < 0.4 else 2 if abs(error) < 0.9 else 3
    return STRAIGHT + strength if error > 0.0 else STRAIGHT - strength


def play(seed: int, **options: Any) -> dict[str, float]:
    """Play a match; the first agent's tallies at its end."""
    env = parallel_env(
        "pitanks", agents=2, teams=(0, 0, 1, 1), opponents=("hand1", "hand1"), variant="pickups", **options
    )
    observations, infos = env.reset(seed=seed)
    while env.agents:
        actions = {agent: act(observations[agent]) for agent in env.agents}
        observations, _, _, _, infos = env.step(actions)
    return infos["player_0"]


if __name__ == "__main__":
    for seed in range(5):
        print(f"match {seed}: {play(seed)}")
