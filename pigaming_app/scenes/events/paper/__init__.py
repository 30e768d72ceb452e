"""What an event prints: poster and certificates."""
