"""ONNX models as brains as a feature."""

from pigaming_app.scenes.features.feature import Feature

FEATURE = Feature("onnx", rooms=("jobs.onnx", "ai.networks.onnx"))
