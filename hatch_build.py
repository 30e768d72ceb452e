"""Hook of the build backend: a package carries the commit that it is made from, since it has no .git."""

import runpy
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class CommitHook(BuildHookInterface[Any]):
    """Adds pigaming_app/commit.txt to a wheel or sdist that is built from a clone."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        sys.path.insert(0, self.root)
        program = runpy.run_path(str(Path(self.root, "pigaming_app", "boot", "version.py")))
        if version == "standard" and not program["RECORD"].exists() and program["commit"]() != program["UNKNOWN"]:
            self._folder = tempfile.TemporaryDirectory()
            record = Path(self._folder.name, program["RECORD"].name)
            record.write_text(program["commit"](), encoding="utf-8")
            build_data["force_include"][str(record)] = f"pigaming_app/{record.name}"

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        if folder := getattr(self, "_folder", None):
            folder.cleanup()
