"""Paths of the palm as CSV files, and the loads that follow from them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation
from task_tables import Loads, loads

from synergrip.documents.time_table import MOTION
from synergrip.grasps.objects import Box, Object, Shape, Turned, turn
from synergrip.linalg import Array, frozen
from synergrip.problems.task_file import TaskTable

AXIS = np.array([1.0, -2.0, 0.5]) / np.linalg.norm([1.0, -2.0, 0.5])
SHIFT = np.array([0.3, -0.1, 0.2])
TURN = np.radians(130)
CENTRE = np.array([0.02, -0.05, 0.11])
GRAVITY = [1.0, 2.0, -9.0]
BOX = Turned(Box((0.02, 0.06, 0.15)), turn(tuple(AXIS[::-1]), 0.7))
FRAME = Rotation.from_rotvec([0.4, -2.0, 1.1]), np.array([3.0, -1.0, 0.5])
"""A frame that has nothing to do with the palm."""
TIMES = np.linspace(0.0, 0.8, 301)


def thing_of(shape: Shape | None = BOX) -> Object:
    return Object(title="thing", mass=0.4, position=frozen(CENTRE), shape=shape)


def write_path(folder: Path, times: Array, positions: Array, rotations: Array) -> None:
    """Write poses down as ``palm.csv``, with all digits."""
    rows = np.column_stack([times, positions, rotations])
    lines = [",".join(["t_s", *MOTION]), *(",".join(repr(float(x)) for x in row) for row in rows)]
    (folder / "palm.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


def path_loads(folder: Path, path: str = "palm.csv", body: Object | None = None, **keys: Any) -> Loads:
    """What happens to a box of 0.4 kg, or another one, in a palm on a path with inertia unless told otherwise."""
    palm = {"path": path, "inertia": keys.pop("inertia", True)}
    body = body or thing_of()
    return loads(TaskTable.model_validate({"palm": palm, **keys}), folder, body.mass, body)


def load_at(found: Loads, times: Array = TIMES) -> Array:
    wrench = found.profiles.load_at(times)
    assert wrench is not None
    return wrench


def wobble(count: int) -> tuple[Array, Array, Rotation]:
    """Times that are not even, positions and rotations of a palm that turns about an axis that turns."""
    rng = np.random.default_rng(1)
    times = np.linspace(0, 0.8, count)
    times[1:-1] += rng.uniform(-0.2, 0.2, count - 2) * times[1]
    phases = rng.uniform(0, 6, (2, 3))
    waves = np.sin(np.multiply.outer(times, [3.0, 4.0, 5.0]) + phases[0])
    return times, 0.2 * np.cos(4 * times[:, None] + phases[1]), Rotation.from_rotvec(waves)
