"""The shapes there are. A new shape is one file and one line here."""

from __future__ import annotations

from synergrip.grasps.shapes.box import Box
from synergrip.grasps.shapes.cylinder import Cylinder
from synergrip.grasps.shapes.shape import Shape
from synergrip.grasps.shapes.sphere import Sphere

SHAPES: dict[str, type[Shape]] = {shape.name: shape for shape in (Sphere, Box, Cylinder)}
