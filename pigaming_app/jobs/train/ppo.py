"""A network, learned by proximal policy optimisation against rivals, earlier copies and itself.

Ctrl-C ends the training after the current update and saves the result; the same command with --resume continues it,
bit for bit with --updates. The checkpoint for that lies beside the network.
"""

from argparse import ArgumentParser, Namespace

from pigaming_app.jobs.terminal.options import decimal, game_option, integer, shared
from pigaming_app.jobs.terminal.refusal import require
from pigaming_app.jobs.train.outputs import check_outputs, output_options

DEFAULT_MINUTES = 10.0


def options(parser: ArgumentParser) -> None:
    game_option(parser)
    length = parser.add_mutually_exclusive_group()
    length.add_argument(
        "--updates", type=integer(high=1_000_000), metavar="NUMBER", help="length; the same seed gives the same network"
    )
    length.add_argument(
        "--minutes", type=decimal(0.01, 10_000.0), metavar="NUMBER", help=f"length; default {DEFAULT_MINUTES:g}"
    )
    shared(parser, "--seed", "--json")
    output_options(parser, "network")


def run(arguments: Namespace) -> int:
    """Train, save and print the result; 130 after Ctrl-C. Raises Refusal or NotSaved."""
    require("train")
    checkpoint = arguments.out.with_suffix(".checkpoint.npz")
    check_outputs(arguments, "network", beside=[checkpoint])
    if arguments.updates is None and arguments.minutes is None:
        arguments.minutes = DEFAULT_MINUTES
    from pigaming_app.jobs.train.ppo_training import train_and_save

    return train_and_save(arguments, checkpoint)
