"""Scenes: the screens of the arcade and the code they share."""
