"""The stages of the robot loop import each other in one direction; the root has only the shared types."""

from graphlib import TopologicalSorter

from tests.test_layers import PACKAGE, imported

HARDWARE = PACKAGE / "hardware"
ROOT = {"recordings", "robot_files", "robot_kinds", "run_writer", "signals", "worker"}
MAY = {
    "radio": set(),
    "vision": set(),
    "calibration": {"vision"},
    "control": {"radio"},
    "tracking": {"calibration", "control", "vision"},
    "ros": {"control", "radio", "tracking"},
    "commissioning": {"control"},
    "sysid": {"calibration"},
    "scan": {"calibration", "control", "vision"},
    "emulator": {"calibration", "vision"},
    "session": {"calibration", "control", "emulator", "radio", "ros", "scan", "tracking", "vision"},
    "proof": {"calibration", "commissioning", "control", "emulator", "scan", "session", "tracking", "vision"},
}


def test_no_stage_leads_back_to_itself():
    assert set(TopologicalSorter(MAY).static_order()) == set(MAY)


def test_every_stage_and_every_shared_module_has_its_place():
    assert {path.name for path in HARDWARE.iterdir() if (path / "__init__.py").is_file()} == set(MAY)
    assert {path.stem for path in HARDWARE.glob("*.py")} == ROOT | {"__init__"}


def test_a_stage_imports_only_those_before_it():
    for path in sorted(HARDWARE.rglob("*.py")):
        stage = path.relative_to(HARDWARE).parts[0].removesuffix(".py")
        for module, _ in imported(path):
            if module.startswith("pigaming_app.hardware."):
                other = module.split(".")[2]
                assert other in ROOT | {stage} | MAY.get(stage, set()), f"{path.name} imports {module}"
