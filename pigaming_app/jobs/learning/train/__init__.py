"""Train an AI from nothing. Ctrl-C keeps what has been learned; --resume continues from there."""

from argparse import ArgumentParser, Namespace

from pigaming_app.jobs.learning.train import ppo, qlearning
from pigaming_app.jobs.terminal.options import subcommands

LEARNERS = {"qlearning": qlearning, "ppo": ppo}


def options(parser: ArgumentParser) -> None:
    subcommands(parser, "learner", LEARNERS)


def run(arguments: Namespace) -> int:
    """Train, save and print the result; 130 after Ctrl-C. Raises Refusal or NotSaved."""
    return int(LEARNERS[arguments.learner].run(arguments))
