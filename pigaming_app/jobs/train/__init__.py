"""Train an AI from nothing. Ctrl-C keeps what has been learned; --resume continues from there."""

from argparse import ArgumentParser, Namespace

from pigaming_app.jobs.train import ppo, qlearning

LEARNERS = {"qlearning": qlearning, "ppo": ppo}


def options(parser: ArgumentParser) -> None:
    """Declare a sub-command for each learner."""
    learners = parser.add_subparsers(dest="learner", metavar="LEARNER", required=True)
    for name, learner in LEARNERS.items():
        learns = (learner.__doc__ or "").partition("\n\n")[0].replace("\n", " ")
        about = learns[0].lower() + learns[1:].rstrip(".")
        learner.options(learners.add_parser(name, help=about, description=learns, allow_abbrev=False))


def run(arguments: Namespace) -> int:
    """Train, save and print the result; 130 after Ctrl-C. Raises Refusal or NotSaved."""
    return int(LEARNERS[arguments.learner].run(arguments))
