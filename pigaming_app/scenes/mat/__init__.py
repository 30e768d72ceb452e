"""Real robots on a mat."""
