"""Programs of pupils as players: whoever has a bot's key plays its seats, over a connection and in any language."""
