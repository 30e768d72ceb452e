"""A network, learned by proximal policy optimisation against rivals, earlier copies and itself.

Ctrl-C ends the training after the current update and saves the result; the same command with --resume continues it,
bit for bit with --updates. The checkpoint for that lies beside the network.
"""

from pigaming_app.jobs.learning.train.options import PpoOptions, check_outputs
from pigaming_app.jobs.terminal.refusal import Refusal, require


def run(options: PpoOptions) -> int:
    """Train, save and print the result; 130 after Ctrl-C. Raises Refusal or NotSaved."""
    require("train")
    if options.workers is not None and options.ray is None:
        raise Refusal("--workers: only with --ray")
    if options.ray is not None:
        require("ray")
    checkpoint = options.out.with_suffix(".checkpoint.npz")
    check_outputs(options, "network", beside=[checkpoint])
    from pigaming_app.jobs.learning.train.ppo_training import train_and_save

    return train_and_save(options, checkpoint)
