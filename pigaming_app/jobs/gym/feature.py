"""The environments for learning libraries as a feature."""

from pigaming_app.scenes.features.feature import Feature

FEATURE = Feature("gym", rooms=("jobs.gym", "gym"))
