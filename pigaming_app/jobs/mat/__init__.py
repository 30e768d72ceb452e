"""Real robots from the command line."""

JOBS = {
    "guide": "the way from the box to a match: each step checked, and the next one",
    "calibrate": "calibration of projector, mat and camera",
    "robots": "status of robots, radios and cameras; pairing, latency",
    "ros": "robots on the mat in a ROS network",
    "fidelity": "measure real robots for the simulator",
}
LOGS_REFUSALS = True
