"""An event on the second screen."""
