"""The animated lessons of "how to play": each draws one moment of a loop, centred on a point."""
