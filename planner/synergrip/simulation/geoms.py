"""The shapes that MuJoCo plays, as plan.json has them. A shape that is not here is planned with and not played."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

from synergrip.grasps.shapes.shapes import SHAPES
from synergrip.linalg import Array
from synergrip.simulation.told_values import Told


class Geom(NamedTuple):
    """A shape as MuJoCo has it."""

    kind: str
    """Name of its type in `mujoco.mjtGeom`."""
    size: Callable[[Mapping[str, Any]], Array]
    """What MuJoCo calls its size, (3,) [m], from the sizes of the shape with ``_m`` in their names."""


GEOMS: dict[str, Geom] = {
    "sphere": Geom("mjGEOM_SPHERE", lambda sizes: np.array([sizes["radius_m"], 0.0, 0.0])),
    "box": Geom("mjGEOM_BOX", lambda sizes: sizes["size_m"] / 2),
    "cylinder": Geom("mjGEOM_CYLINDER", lambda sizes: np.array([sizes["radius_m"], sizes["height_m"] / 2, 0.0])),
}
"""By the name of the shape. A new one is a line here."""


def sizes_of(name: str, told: Told) -> dict[str, Any]:
    """Return sizes and rotation of a shape, each judged.

    Raises:
        InputError: one that is missing or none.
    """
    sizes: dict[str, Any] = {}
    for size in SHAPES[name].sizes:
        key = f"{size.name}_m"
        sizes[key] = told.positive(key) if size.count == 1 else told.array(key, (size.count,))
    return sizes if name == "sphere" else sizes | {"rotation": told.array("rotation", (3, 3))}
