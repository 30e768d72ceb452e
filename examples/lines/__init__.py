"""A driver of robots as a plug-in: lines of text on one serial line. Copy the folder to the games of the user."""

API = 1
