"""What the core asks of features, and where it finds them."""
