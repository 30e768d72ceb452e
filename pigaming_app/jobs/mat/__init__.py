"""Jobs for real robots."""
