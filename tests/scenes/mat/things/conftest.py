"""The emulated arena of the tests of robots, here with things on it."""

from tests.scenes.mat.robots.conftest import arcade, emulated, mat

__all__ = ["arcade", "emulated", "mat"]
