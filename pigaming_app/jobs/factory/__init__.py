"""Robot Factory needs no job."""
