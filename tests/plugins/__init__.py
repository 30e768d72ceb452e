"""Games as plug-ins, as a whole."""
