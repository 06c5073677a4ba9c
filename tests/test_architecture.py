"""The one-way rule of the house, read from the imports: a folder imports only folders to its left."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import synergrip

PACKAGE = Path(synergrip.__file__).parent
REPOSITORY = Path(__file__).parent.parent
LINE = (
    "ground documents hands grasps statics equilibrium conic tasks problems|referee planning "
    "batch changes explain|margin|simulation reports cli"
)
"""From left to right; those beside each other do not know each other. The ground the house stands on is not a folder:
errors, linear algebra, files."""
PLACES = {room: place for place, rooms in enumerate(LINE.split()) for room in rooms.split("|")}
LOOK_RIGHT = {"planning/answer.py": ("synergrip.reports.data.", "synergrip.explain.", "synergrip.margin.found.")}
"""The only file that may import from the right, from there, and inside functions alone: the methods of an answer that
write and draw it. A hook that the front door fills would make an answer differ by what was imported before it."""
ONLY_IN = {
    "matplotlib": {"reports/pictures/sheet.py"},
    "mujoco": {"hands/kinematics.py", "hands/models/mjcf.py", "simulation/model.py", "simulation/playing.py"},
    "clarabel": {"conic/solvers/clarabel_.py", "conic/semidefinite.py"},
    "qpsolvers": {"conic/solvers/qpsolvers_.py"},
    "osqp": set(),  # only by way of qpsolvers
    "viser": {"reports/view/serving.py"},
    "jinja2": {"reports/html/page.py"},
    "cvxpy": {
        f"referee/{name}.py" for name in ("judge", "maps", "model", "formulas", "motion_formulas", "motion_goals")
    },
    "typer": {
        f"cli/{name}.py"
        for name in (
            "app",
            "running",
            "plan",
            "explain",
            "front",
            "analyse",
            "check",
            "simulate",
            "export",
            "figure",
            "synergies",
            "margins",
            "report",
            "view",
            "lists",
            "pictures",
        )
    },
    "numba": {"batch/lanes.py", "batch/lanes_algebra.py"},
    "llvmlite": {"batch/lanes.py"},
    "pyarrow": {"reports/data/exports/tables.py"},
    "rosbags": {"reports/data/exports/joint_trajectories.py"},
    "yaml": {"reports/data/exports/yaml_text.py"},
    "tree_sitter": {"documents/documents.py", "documents/positions.py"},
}
COMPILED = {
    f"batch/{name}.py"
    for name in (
        "lanes",
        "lanes_rows",
        "lanes_algebra",
        "lanes_linear",
        "lanes_kernel",
        "lanes_dense",
        "lanes_bases",
        "lanes_centroid",
        "lanes_confirmed",
        "lanes_statics",
    )
}
"""Files that Numba compiles: of its types from the first line on, and imported by others inside functions alone."""
FILES = sorted(path.relative_to(PACKAGE).as_posix() for path in PACKAGE.rglob("*.py"))


def imports(path: Path, top_level_only: bool = False) -> Iterator[str]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    nodes = tree.body if top_level_only else ast.walk(tree)
    for node in nodes:
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def room(first: str) -> str:
    return first if (PACKAGE / first).is_dir() else "ground"


def test_every_room_is_in_the_line_and_is_there() -> None:
    folders = {path.name for path in PACKAGE.iterdir() if path.is_dir() and path.name != "__pycache__"}
    assert folders - {"bundled"} == PLACES.keys() - {"ground"}  # the data that a wheel carries is no room


@pytest.mark.parametrize("name", FILES)
def test_a_room_imports_only_rooms_to_its_left(name: str) -> None:
    if name in ("__init__.py", "__main__.py"):  # the front door opens on every room
        return
    here = room(name.split("/")[0])
    for imported in imports(PACKAGE / name):
        parts = imported.split(".")
        if parts[0] == "synergrip" and len(parts) > 2:
            there = room(parts[1])
            if name in LOOK_RIGHT and imported.startswith(LOOK_RIGHT[name]):
                assert imported not in set(imports(PACKAGE / name, top_level_only=True))
                continue
            assert there == here or PLACES[there] < PLACES[here], f"{name} imports {imported}"


@pytest.mark.parametrize(
    "library",
    [room for room in PLACES if room not in ("ground", "problems", "reports", "cli", "equilibrium")],
)
def test_the_library_stands_without_the_problem_file(library: str) -> None:
    for path in (PACKAGE / library).rglob("*.py"):
        allowed = LOOK_RIGHT.get(path.relative_to(PACKAGE).as_posix(), "-")
        right = [name for name in imports(path) if name.startswith(("synergrip.problems", "synergrip.reports"))]
        found = [name for name in right if not name.startswith(allowed)]
        assert not found, f"{path} imports {found}"


@pytest.mark.parametrize("name", FILES)
def test_each_third_party_door_is_in_one_place(name: str) -> None:
    for imported in imports(PACKAGE / name):
        top = imported.split(".")[0]
        assert name in ONLY_IN.get(top, {name}), f"{name} imports {imported}"


@pytest.mark.parametrize("name", ["conic/certificate.py", "conic/cones.py"])
def test_the_certificate_imports_no_solver(name: str) -> None:
    allowed = {"numpy", "synergrip", "dataclasses", "__future__"}
    found = set(imports(PACKAGE / name))
    assert {imported.split(".")[0] for imported in found} <= allowed
    assert not [imported for imported in found if "solvers" in imported or "solution" in imported]


@pytest.mark.parametrize("name", FILES)
def test_heavy_libraries_are_imported_where_they_are_used(name: str) -> None:
    heavy = {"cvxpy", "matplotlib", "viser", "dask", "numba", "mujoco", "clarabel", "pandas", "qpsolvers", "osqp"}
    heavy |= {"pyarrow", "rosbags", "yaml"}
    at_top = set(imports(PACKAGE / name, top_level_only=True))
    tops = {imported.split(".")[0] for imported in at_top}
    if name in COMPILED:
        tops -= {"numba"}
    else:
        files = {each.replace("/", ".").removesuffix(".py") for each in COMPILED}
        assert not [each for each in at_top if ".".join(each.split(".")[1:3]) in files], name
    assert not tops & heavy, f"{name} imports {tops & heavy} at its top"


@pytest.mark.parametrize("name", FILES)
def test_files_are_of_one_idea(name: str) -> None:
    assert len((PACKAGE / name).read_text(encoding="utf-8").splitlines()) <= 260
    assert Path(name).stem not in {"utils", "common", "helpers", "core", "manager", "base"}


def test_nobody_imports_the_source_root_as_a_package() -> None:
    forbidden = "import " + "planner", "from " + "planner"
    for folder in ("planner", "tests"):
        for path in (REPOSITORY / folder).rglob("*.py"):
            text = path.read_text(encoding="utf-8")
            assert not [word for word in forbidden if word in text], path
