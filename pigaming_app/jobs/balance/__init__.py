"""Measures of fun and fairness: people as models against the opponents."""

JOBS = {"people": "how often people, as models, win against the AIs"}
