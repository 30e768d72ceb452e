"""Calibration pages: calibration of camera and projector, corner pin, drift check."""
