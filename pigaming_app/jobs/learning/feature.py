"""Learning as a feature: learners, and matches by the thousand in compiled loops."""

from pigaming_app.scenes.features.feature import Feature

FEATURE = Feature("learning", rooms=("jobs.learning", "ai.learning", "ai.ppo", "ai.tallies"))
