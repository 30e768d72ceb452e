"""The Lab: a robot learns from scratch by trial and error; visitors watch, adjust rewards and play against it."""
