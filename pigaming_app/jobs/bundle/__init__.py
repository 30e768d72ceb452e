"""The program as a folder."""

JOBS = {"bundle": "the program as a folder, for machines without Python"}
