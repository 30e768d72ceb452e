"""Real things on the mat, in the look of each game."""
