"""High scores: the tables and their file."""

from pigaming_app.storage.scores.book import FILE, Scores
from pigaming_app.storage.scores.table import DAYS, LENGTH, LETTERS, Score, ScoreTable

__all__ = ["DAYS", "FILE", "LENGTH", "LETTERS", "Score", "ScoreTable", "Scores"]
