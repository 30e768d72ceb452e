#!/bin/sh
# macOS: double-click to play.
cd "$(dirname "$0")" || exit 1
for python in python3.14 python3.13 python3.12 python3.11 python3; do
    if "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
        exec "$python" main.py "$@"
    fi
done
echo "PiGaming needs Python 3.11 or newer: install it from https://www.python.org/downloads/ and double-click again."
exit 2
