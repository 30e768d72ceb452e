"""A scripted walk through the whole arcade, for measuring it."""
