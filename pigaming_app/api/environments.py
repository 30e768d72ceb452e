"""Matches as environments of Gymnasium and PettingZoo. `import` registers PiTanks-v0, RobotRace-v0 and so on."""

from pigaming_app.gym import groups, parallel_env

__all__ = ["groups", "parallel_env"]
