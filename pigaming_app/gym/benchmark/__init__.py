"""PiGaming-Bench: named tasks with fixed seeds, budgets and a protocol, and results that anybody can play again."""
