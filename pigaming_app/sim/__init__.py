"""Simulated world shared by all games: robots, walls, contact, line of sight. No game rules, no drawing."""
