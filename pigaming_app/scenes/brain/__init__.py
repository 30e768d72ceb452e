"""The brain overlay (F4): what an AI sees, what it would like and what it does, drawn over a running match."""
