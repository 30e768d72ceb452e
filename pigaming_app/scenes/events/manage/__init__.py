"""What an operator changes: results, title, entrants; the end of an event."""
