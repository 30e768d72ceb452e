"""Policies from elsewhere: ONNX models, each run by a process of its own."""
