"""Measures of fun and fairness: people as models against the opponents."""

JOBS = {
    "exploits": "scripted tricks against the opponents",
    "fairness": "wins by seat and arena of equal AIs",
    "people": "how often people, as models, win against the AIs",
}
