"""Set-up of a new event: its format, and its entrants by letters, from a list, and AIs."""
