"""Events without their screens."""

JOBS = {"event": "tournaments, ladders and records of AIs and people"}
