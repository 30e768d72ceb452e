"""Saved matches without their list."""

JOBS = {"replay": "show or verify a recorded match"}
