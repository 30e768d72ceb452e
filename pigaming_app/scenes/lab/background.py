"""What works for the Lab while it is not shown."""

import sys

from pigaming_app.ai.learning.compiler import Compiler
from pigaming_app.scenes.features.feature import Service
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Scene
from pigaming_app.scenes.lab.extra_fetch import ExtraFetch

COMPILE_NETWORKS = (sys.executable, "-m", "pigaming_app.ai.ppo.lab.process", "compile")


class LabBackground(Service):
    """What works for the Lab while it is not shown, and the Lab as it was left: its robot is kept."""

    def __init__(self, context: Context) -> None:
        self.compiler = Compiler()  # for tables
        self.network_compiler = Compiler(COMPILE_NETWORKS)
        self.network_fetch = ExtraFetch()  # of what networks need
        self.lab: Scene | None = None

    def preloaded(self) -> None:
        """Compile what the Lab needs. Raises OSError."""
        self.compiler.start()
        self.network_compiler.start()

    def close(self) -> None:
        self.compiler.end()
        self.network_compiler.end()
