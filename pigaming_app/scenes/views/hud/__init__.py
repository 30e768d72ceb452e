"""Parts of the display above the arena."""
