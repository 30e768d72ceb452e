"""Environments need no job."""
