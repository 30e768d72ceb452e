"""Balance as a feature: models of people, and what measures opponents against them."""

from pigaming_app.scenes.features.feature import Feature

FEATURE = Feature("balance", rooms=("jobs.balance", "ai.people", "ai.exploits"))
