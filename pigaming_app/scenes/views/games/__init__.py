"""How each game appears on the screens."""
