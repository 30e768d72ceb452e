"""`python -m pigaming_app`: the same as `main.py`, in an environment that has everything already."""

import sys

from pigaming_app.cli import main

if __name__ == "__main__":
    sys.exit(main())
