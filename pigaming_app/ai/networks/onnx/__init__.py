"""Policies from elsewhere: ONNX models, each run by a process of its own."""

failed: list[str] = []  # files whose models have failed in a match; the arcade shows them and empties the list
