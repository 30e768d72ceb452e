"""A plug-in appears at every place, whether it lies in the user's folder or was installed."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from pigaming_app.storage.plugins.consent import switch
from pigaming_app.storage.plugins.found import user_folder
from tests.cases import repeated
from tests.plugins.packages import ROOT, install, write_tag


@pytest.mark.long
@pytest.mark.parametrize("place", repeated(["installed", "user"]))  # the page of Tag walks through many in the folder
def test_a_plug_in_appears_at_every_place(home: Path, tmp_path: Path, place: str) -> None:
    site = tmp_path / "site"
    if place == "user":
        write_tag(user_folder() / "tag")
        switch("tag", True)
    else:
        write_tag(install(site, "tag", "robot_tag.game"))
        switch("tag@robot_tag.game", True)
    command = [sys.executable, "-X", "pigaming", "-m", "tests.plugins.places", "tag", str(tmp_path)]
    quiet = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PYTHONPATH": str(site)}
    ended = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, env=os.environ | quiet, timeout=1800)
    assert ended.stdout.splitlines()[-1:] == ["all places"], ended.stderr[-3000:]
