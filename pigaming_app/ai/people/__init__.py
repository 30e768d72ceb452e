"""Brains that stand for people, for measuring and tuning. The lobby never offers them."""
