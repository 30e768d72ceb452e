"""ONNX models need no job."""
