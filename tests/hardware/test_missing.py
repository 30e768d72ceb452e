"""Every module can be imported without OpenCV and pyserial."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
MODULES = sorted(
    ".".join(path.relative_to(ROOT).with_suffix("").parts)
    for path in (ROOT / "pigaming_app" / "hardware").rglob("*.py")
    if path.stem != "__init__" and "micropython" not in path.parts  # for another interpreter
)


def test_everything_is_imported_without_opencv_and_pyserial():
    names = "".join(f"import {name}\n" for name in ("pigaming_app.jobs.cli", "pigaming_app.scenes.start", *MODULES))
    code = f"import sys\nsys.modules['cv2'] = sys.modules['serial'] = None\n{names}"
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True)
