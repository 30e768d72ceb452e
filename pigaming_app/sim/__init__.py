"""The world: robots, walls, contact, sight. It knows no game and no screen."""
