"""The build of a bundle as a feature."""

from pigaming_app.scenes.features.feature import Feature

FEATURE = Feature("bundle", rooms=("jobs.bundle",))
