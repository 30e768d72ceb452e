"""The jobs of the command line, one module each; `registry.py` lists them.

The docstring of a job is the description in its help. `options(parser)` declares its options; `run(arguments)` carries
it out and returns the exit code. It raises Refusal or OSError for a request that cannot be carried out.
"""
