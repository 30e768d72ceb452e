"""Real robots from the command line."""

JOBS = {
    "calibrate": "calibration of projector, mat and camera",
    "robots": "status of robots, radios and cameras; pairing, latency",
    "ros": "robots on the mat in a ROS network",
    "fidelity": "measure real robots for the simulator",
}
LOGS_REFUSALS = True
