"""Real robots on the screen: matches, start positions, marker lighting and faults."""
