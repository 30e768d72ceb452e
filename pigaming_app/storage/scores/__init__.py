"""High scores: the tables, their file, and migration from the file of version 1.3.0."""

from pigaming_app.storage.scores.book import FILE, Scores, migrations
from pigaming_app.storage.scores.table import DAYS, LENGTH, LETTERS, Score, ScoreTable

__all__ = ["DAYS", "FILE", "LENGTH", "LETTERS", "Score", "ScoreTable", "Scores", "migrations"]
