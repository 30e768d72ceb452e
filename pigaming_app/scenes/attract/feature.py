"""Attract mode as a feature: what the screen shows while nobody plays."""

from pigaming_app.scenes.features.feature import Feature
from pigaming_app.scenes.flow.scene import Context, Scene


def idle(context: Context) -> Scene:
    from pigaming_app.scenes.attract.scene import Attract

    return Attract(context)


FEATURE = Feature("attract", rooms=("scenes.attract",), idle=idle, preload=("pigaming_app.scenes.attract.scene",))
