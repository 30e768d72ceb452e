"""What the reward of a PiTanks robot may depend on, at each of its decisions.

The meaning of each is fixed by who learns: a table (ai/learning/q_learner.py), or a network or an environment
(ai/networks/pitanks_rewards.py).
"""

WEIGHTED = "hit", "miss", "behind", "still"  # those that the knobs of the Lab weight
QUANTITIES = *WEIGHTED, "turned", "fired", "taken", "distance"
FARTHEST = 1600.0  # px, the longest distance that is told apart
HIT, MISS, BEHIND, STILL, TURNED, FIRED, TAKEN, DISTANCE = range(len(QUANTITIES))
