"""The Lab: a robot learns from nothing, just by trying; people watch, turn knobs, and play against it."""
