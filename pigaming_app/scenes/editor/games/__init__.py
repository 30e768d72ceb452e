"""What can be drawn in each game."""
