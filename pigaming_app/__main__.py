"""`python -m pigaming_app`: the same as `main.py`, without setting up the environment first."""

import sys

from pigaming_app.cli import main

if __name__ == "__main__":
    sys.exit(main())
