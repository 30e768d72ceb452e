"""Measurements and checks of the program as a feature."""

from pigaming_app.scenes.features.feature import Feature

FEATURE = Feature("bench", rooms=("jobs.bench", "scenes.bench", "scenes.walk"))
