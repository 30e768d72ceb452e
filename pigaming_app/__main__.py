"""`python -m pigaming_app`: the same as `main.py`, without setting up the environment first."""

import signal
import sys

if hasattr(signal, "pthread_sigmask"):  # as in main.py
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})

if __name__ == "__main__":
    from pigaming_app.jobs.cli import main

    sys.exit(main())
