"""Real things on the mat: convex outlines that stand in the game as walls, mud or lines."""
