"""Real things on the mat: the scan, their outlines, and matches among them."""
