"""Imports between rooms go one way, and the arcade starts without numba."""

import ast
import subprocess
import sys
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent.parent / "pigaming_app"
MAY = {
    "main": {"boot", "jobs"},
    "__init__": set(),
    "__main__": {"jobs"},
    "links": set(),
    "boot": set(),
    "storage": set(),
    "sim": set(),
    "games": {"sim", "storage"},
    "hardware": {"sim", "storage"},
    "ai": {"sim", "storage", "games"},
    "ui": {"storage"},
    "scenes": {"sim", "storage", "ui", "games", "hardware", "ai", "events"},
    "api": {"sim", "storage", "ui", "games", "ai", "scenes", "gym", "hardware"},
    "gym": {"links", "sim", "storage", "ui", "games", "hardware", "ai", "scenes"},
    "events": {"games", "ai", "storage"},
    "jobs": {"links", "boot", "sim", "storage", "ui", "games", "hardware", "ai", "scenes", "gym", "events"},
}
MODULES, FLOORS = 15, 7  # at most: in a folder, between the rooms (gym lies between scenes and jobs)
ONLY_IN = {
    "pygame": {"ui", "scenes"},
    "cv2": {"hardware"},
    "serial": {"hardware"},
    "mpremote": {"hardware"},
    "rospy": {"hardware"},
    "aiohttp": {"ui", "jobs"},
    "segno": {"ui"},
    "ifaddr": {"ui"},
    "cryptography": {"ui"},
    "onnxruntime": {"ai"},
    "ray": {"ai"},
    "pymunk": {"jobs"},
    "PIL": {"scenes"},
    "networkx": {"events"},
    "gymnasium": {"gym"},
    "pettingzoo": {"gym"},
    "stable_baselines3": {"gym"},
    "torch": set(),
}
DEPENDENCIES = {"pygame", "numpy", "platformdirs", "tomli_w", "msgspec", "networkx", "numba", "llvmlite"}
DEPENDENCIES |= {"cv2", "serial", "matplotlib", "onnxruntime", "gymnasium", "pettingzoo", "pymunk", "ray", "PIL"}
DEPENDENCIES |= {"aiohttp", "segno", "ifaddr", "cryptography", "keyring", "mpremote", "stable_baselines3"}
ROS = {"rospy", "rosgraph", "geometry_msgs", "sensor_msgs", "std_msgs"}  # of the system, in one module
DEPENDENCIES |= ROS
FILES = [PACKAGE.parent / "main.py", *sorted(path for path in PACKAGE.rglob("*.py") if "micropython" not in path.parts)]


@cache
def nodes(path):
    """The imports and texts of a file, each with True if at module level."""
    found, left = [], [(ast.parse(path.read_text(encoding="utf-8")), True)]
    while left:
        node, at_once = left.pop()
        if isinstance(node, ast.Import | ast.ImportFrom | ast.Constant):
            found.append((node, at_once))
        at_once = at_once and not isinstance(node, ast.FunctionDef)
        left += [(child, at_once) for child in ast.iter_child_nodes(node)]
    return found


def imported(path):
    """The modules that a file imports, each with True if at module level: `pigaming_app.sim`, `os.path`."""
    for node, at_once in nodes(path):
        if isinstance(node, ast.Import):
            yield from ((alias.name, at_once) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path} imports by a relative name"
            names = [f"pigaming_app.{alias.name}" for alias in node.names if is_module(alias.name)]
            for module in names if node.module == "pigaming_app" and names else [node.module]:
                yield module, at_once


def test_a_file_imports_the_standard_library_declared_packages_and_this_one():
    """Plug-in games stand beside the package and import it; it never imports them."""
    allowed = {*sys.stdlib_module_names, *DEPENDENCIES, "pigaming_app"}
    assert not [(path, module) for path in FILES for module, _ in imported(path) if module.split(".")[0] not in allowed]


def is_module(name):
    return (PACKAGE / name).is_dir() or (PACKAGE / f"{name}.py").is_file()


def test_a_file_imports_only_what_its_layer_may():
    for path in FILES:
        check_layer(path)


def check_layer(path):
    place = path.relative_to(PACKAGE).parts if PACKAGE in path.parents else (path.name,)
    layer = place[0].removesuffix(".py")
    for module, at_once in imported(path):
        root = module.split(".")[0]
        if root == "pigaming_app" and module.count("."):
            other = module.split(".")[1]
            assert other in {layer, *MAY[layer]}, f"{path.name} imports {module}"
        if root in ONLY_IN:
            assert layer in ONLY_IN[root], f"{path.name} imports {module}"
        if root in ROS:
            assert place == ("hardware", "ros", "node.py")
            assert not at_once, path
        if root == "numba":
            assert place == ("sim", "kernel.py")
            assert not at_once, path


@cache
def graph():
    """The modules of the package and what each imports of it, late imports included."""
    names = {name_of(path): path for path in FILES}
    found: dict[str, set[str]] = {name: set() for name in names}
    for name, path in names.items():
        for node, _ in nodes(path):
            if isinstance(node, ast.Import):
                found[name] |= {alias.name for alias in node.names} & names.keys()
            elif isinstance(node, ast.ImportFrom):
                inner = {alias.name: f"{node.module}.{alias.name}" for alias in node.names}
                found[name] |= {inner[one] if inner[one] in names else str(node.module) for one in inner} & names.keys()
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                found[name] |= {node.value} & names.keys()  # imported by name
        found[name].discard(name)
    return found


def name_of(path):
    return ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts).removesuffix(".__init__")


def circle(arrows):
    """Nodes that reach each other, if any."""
    try:
        TopologicalSorter(arrows).prepare()
    except CycleError as found:
        return found.args[1]
    return []


def within(folder):
    """The folders and modules in a folder, and which imports which; its `__init__` is no part of it."""
    arrows: dict[str, set[str]] = {}
    for name, others in graph().items():
        if unit := unit_of(name, folder):
            found = {unit_of(other, folder) for other in others} - {None, unit}
            arrows.setdefault(unit, set()).update(found)
    return arrows


def unit_of(name, folder):
    return name.removeprefix(f"{folder}.").split(".")[0] if name.startswith(f"{folder}.") else None


FOLDERS = sorted({path.parent for path in FILES} - {PACKAGE.parent})


def test_no_circle_between_modules_even_by_late_imports():
    assert circle(graph()) == []


def test_no_circle_between_the_units_of_a_folder():
    for folder in FOLDERS:
        assert circle(within(".".join(folder.relative_to(PACKAGE.parent).parts))) == []


def test_no_folder_holds_more_modules_than_a_shelf():
    modules = {folder: [path for path in folder.glob("*.py") if path.name != "__init__.py"] for folder in FOLDERS}
    assert not [folder for folder in FOLDERS if len(modules[folder]) > MODULES]


def test_rooms_lie_on_few_floors():
    arrows = within("pigaming_app") | {"main": {"boot", "jobs"}}

    def floor(room):
        return 1 + max((floor(other) for other in arrows[room]), default=0)

    assert {"boot", "storage", "sim"} <= {room for room in arrows if floor(room) == 1}
    assert max(map(floor, arrows)) <= FLOORS
    assert all(others <= MAY[room] for room, others in arrows.items())


def test_main_needs_nothing_but_the_standard_library():
    for path in (PACKAGE.parent / "main.py", *(PACKAGE / "boot").glob("*.py")):
        roots = {module.split(".")[0] for module, _ in imported(path)}
        assert roots <= set(sys.stdlib_module_names) | {"pigaming_app"}


def test_the_arcade_is_imported_without_numba_and_numpy():
    code = (
        "import sys\nsys.modules['numba'] = None\n"
        "import pigaming_app.jobs.cli, pigaming_app.scenes.start\n"
        "import pigaming_app.scenes.title.scene, pigaming_app.scenes.play.scene\n"
        "assert 'numpy' not in sys.modules, 'numpy costs a tenth of a second at the start'\n"
    )
    subprocess.run([sys.executable, "-c", code], cwd=PACKAGE.parent, check=True)
