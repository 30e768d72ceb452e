"""The brain overlay (F4): percepts, goals and actions of an AI, drawn over a running match."""
