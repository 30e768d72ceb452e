"""Changes of an event: what an operator asks for becomes an entry of the journal; what is played just now."""
