"""The page over a match that stands still: who paused, and what now."""



