"""Events: set-up and entrants, the next match, table and bracket, corrections, podium and poster."""
