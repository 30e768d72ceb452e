"""Events without their screens."""

JOBS = {"event": "tournaments and Grand Prix of AIs and people"}
