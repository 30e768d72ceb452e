"""Real robots on the screen: their matches, their places, what lights their markers, and what is wrong with them."""
