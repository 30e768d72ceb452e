"""What is printed: the sheet of markers, and arenas to scale."""
