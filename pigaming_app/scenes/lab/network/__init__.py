"""The Lab's robot with a network: the process in which it learns, the match that is shown, and its progress."""
