"""Training of AIs, and matches among them by the thousand."""

JOBS = {
    "duel": "many matches between two AIs",
    "exploit": "how much a network loses to a rival that learns against it alone",
    "league": "a round robin of AIs, with ratings",
    "train": "train an AI from nothing",
}
