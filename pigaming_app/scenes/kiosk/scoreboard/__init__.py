"""The second screen: scores, standby, event and camera, beside the arena."""
