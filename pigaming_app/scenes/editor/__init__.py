"""The arena editor: drawings are immutable values of `games.drawing`; each game says what can be drawn."""
