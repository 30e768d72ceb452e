"""A scripted walk through the whole arcade, for performance measurements."""
