"""The operator's pages that bring picture, mat and camera together: calibration, corner pin, drift."""
