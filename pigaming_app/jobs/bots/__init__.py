"""Programs of pupils as players, from the command line."""

JOBS = {"bots": "programs of your own as players: list, add, remove"}
