"""The Ladder: the choice of a game, the page between two matches, the end of a climb, the best climbers."""
