"""A network, learned by proximal policy optimisation against rivals, earlier copies and itself.

Ctrl-C ends the training after the current update and saves the result; the same command with --resume continues it,
bit for bit with --updates. The checkpoint for that lies beside the network.
"""

from argparse import ArgumentParser, Namespace

from pigaming_app.jobs.learning.train.outputs import check_outputs, output_options
from pigaming_app.jobs.terminal.options import decimal, game_option, integer, shared, word
from pigaming_app.jobs.terminal.refusal import Refusal, require

DEFAULT_MINUTES, DEFAULT_WORKERS = 10.0, 2


def options(parser: ArgumentParser) -> None:
    game_option(parser)
    length = parser.add_mutually_exclusive_group()
    length.add_argument(
        "--updates", type=integer(high=1_000_000), metavar="NUMBER", help="length; the same seed gives the same network"
    )
    length.add_argument(
        "--minutes", type=decimal(0.01, 10_000.0), metavar="NUMBER", help=f"length; default {DEFAULT_MINUTES:g}"
    )
    parser.add_argument("--against", metavar="AI", help="learn duels against this one alone, to exploit it")
    shared(parser, "--seed", "--json")
    output_options(parser, "network")
    machines = parser.add_argument_group("several machines", "The same network, bit for bit, as without them.")
    machines.add_argument("--ray", type=word, metavar="ADDRESS", help="Ray cluster, auto, or local (extra `ray`)")
    machines.add_argument(
        "--workers", type=integer(), metavar="NUMBER", help=f"processes that play; default {DEFAULT_WORKERS}"
    )


def run(arguments: Namespace) -> int:
    """Train, save and print the result; 130 after Ctrl-C. Raises Refusal or NotSaved."""
    require("train")
    if arguments.workers is not None and arguments.ray is None:
        raise Refusal("--workers: only with --ray")
    if arguments.ray is not None:
        require("ray")
    checkpoint = arguments.out.with_suffix(".checkpoint.npz")
    check_outputs(arguments, "network", beside=[checkpoint])
    if arguments.updates is None and arguments.minutes is None:
        arguments.minutes = DEFAULT_MINUTES
    arguments.workers = arguments.workers or DEFAULT_WORKERS
    from pigaming_app.jobs.learning.train.ppo_training import train_and_save

    return train_and_save(arguments, checkpoint)
