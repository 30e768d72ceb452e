"""The operator's pages, and what runs on every screen for the operator."""
