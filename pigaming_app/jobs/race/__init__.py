"""Robot Race needs no job."""
