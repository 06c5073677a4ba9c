"""Distances and normals of the shapes, against finite differences and against surfaces sampled point by point."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from synergrip.grasps.objects import Box, Cylinder, Shape, Sphere, Turned, turn
from synergrip.grasps.shapes.shapes import SHAPES as REGISTRY

SPHERE, BOX, CYLINDER = Sphere(0.03), Box((0.04, 0.06, 0.1)), Cylinder(0.02, 0.08)
AXIS = np.array([2, -3, 6]) / 7
SHAPES: list[Shape] = [SPHERE, BOX, CYLINDER, *(Turned(shape, turn(AXIS, 0.9)) for shape in (BOX, CYLINDER))]
STEP = 1e-6


def _titled(shape: Shape) -> str:
    return shape.title


def _surface_points(shape: Shape) -> np.ndarray:
    """Many points of the surface, faces, edges and corners included."""
    share = np.linspace(-1, 1, 81)
    if isinstance(shape, Turned):
        return _surface_points(shape.shape) @ shape.rotation.T
    if isinstance(shape, Sphere):
        z, angle = np.meshgrid(share, np.pi * share)
        across = np.sqrt(1 - z**2)
        return shape.radius * np.stack([across * np.cos(angle), across * np.sin(angle), z], axis=-1).reshape(-1, 3)
    if isinstance(shape, Box):
        a, b = (x.ravel() for x in np.meshgrid(share, share))
        faces = [np.insert(np.column_stack([a, b]), i, s, axis=1) for i in range(3) for s in (-1.0, 1.0)]
        return np.vstack(faces) * np.array(shape.size) / 2
    assert isinstance(shape, Cylinder)
    angle, along = (x.ravel() for x in np.meshgrid(np.pi * share, share))
    side = np.column_stack([np.cos(angle), np.sin(angle), along])
    cap = np.column_stack([np.abs(along) * np.cos(angle), np.abs(along) * np.sin(angle), np.ones(len(angle))])
    return np.vstack([side, cap, cap * [1, 1, -1]]) * [shape.radius, shape.radius, shape.height / 2]


def _inside(shape: Shape, point: np.ndarray) -> bool:
    if isinstance(shape, Turned):
        return _inside(shape.shape, shape.rotation.T @ point)
    if isinstance(shape, Sphere):
        return float(point @ point) < shape.radius**2
    if isinstance(shape, Box):
        return bool(np.all(np.abs(point) < np.array(shape.size) / 2))
    assert isinstance(shape, Cylinder)
    return bool(np.hypot(*point[:2]) < shape.radius and abs(point[2]) < shape.height / 2)


def _gradient(shape: Shape, point: np.ndarray) -> np.ndarray:
    steps = STEP * np.eye(3)
    return np.array([shape.surface(point + d)[0] - shape.surface(point - d)[0] for d in steps]) / (2 * STEP)


def test_every_shape_that_a_file_can_name_is_tested_and_documented() -> None:
    documented = (Path(__file__).parents[2] / "docs" / "problem-file.md").read_text()
    for name, shape in REGISTRY.items():
        assert any(type(each) is shape for each in SHAPES), f"{name} is not in SHAPES of this file"
        assert [size.name for size in shape.sizes] == [each.name for each in fields(shape)]  # type: ignore[arg-type]
        assert f"{name} = " in documented, f"{name} is not in docs/problem-file.md"


@pytest.mark.parametrize("shape", SHAPES, ids=_titled)
def test_the_farthest_point_is_on_the_surface_and_none_is_farther(shape: Shape) -> None:
    rng = np.random.default_rng(8)
    inside = [point for point in rng.uniform(-0.08, 0.08, (4000, 3)) if shape.surface(point)[0] <= 0]
    assert len(inside) > 30
    for direction in rng.normal(size=(20, 3)):
        along = direction / np.linalg.norm(direction)
        farthest = shape.farthest(along)
        assert shape.surface(farthest)[0] == pytest.approx(0, abs=1e-12)
        assert np.max(np.array(inside) @ along) <= farthest @ along + 1e-12
        drawn = np.vstack(shape.lines())
        assert np.max(drawn @ along) <= farthest @ along + 1e-12
    assert max(abs(shape.surface(point)[0]) for line in shape.lines() for point in line) < 1e-12


@pytest.mark.parametrize("shape", SHAPES, ids=_titled)
def test_distance_is_that_of_the_nearest_point_of_the_surface(shape: Shape) -> None:
    surface = _surface_points(shape)
    for point in np.random.default_rng(1).uniform(-0.09, 0.09, (200, 3)):
        distance, _ = shape.surface(point)
        nearest = float(np.linalg.norm(surface - point, axis=1).min())
        assert abs(distance) == pytest.approx(nearest, abs=6e-4)  # the sampled surface has gaps
        assert (distance < 0) == _inside(shape, point)


@pytest.mark.parametrize("shape", SHAPES, ids=_titled)
def test_normal_is_the_gradient_of_the_distance(shape: Shape) -> None:
    checked = {"inside": 0, "outside": 0}
    for point in np.random.default_rng(2).uniform(-0.09, 0.09, (300, 3)):
        distance, normal = shape.surface(point)
        assert np.linalg.norm(normal) == pytest.approx(1, abs=1e-12)
        gradient = _gradient(shape, point)
        if abs(np.linalg.norm(gradient) - 1) > 1e-4:
            continue  # the step crosses a ridge, where two faces are equally near
        assert normal == pytest.approx(gradient, abs=1e-4)
        checked["inside" if distance < 0 else "outside"] += 1
    assert checked["outside"] > 200
    assert checked["inside"] >= 4


@pytest.mark.parametrize("shape", SHAPES, ids=_titled)
def test_stepping_back_along_the_normal_reaches_the_surface(shape: Shape) -> None:
    for point in np.random.default_rng(3).uniform(-0.09, 0.09, (100, 3)):
        distance, normal = shape.surface(point)
        assert shape.surface(point - distance * normal)[0] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize(
    ("shape", "point", "distance", "normal"),
    [
        (SPHERE, (0, 0, 0), -0.03, (0, 0, 1)),
        (SPHERE, (0, -0.05, 0), 0.02, (0, -1, 0)),
        (BOX, (0.03, 0, 0), 0.01, (1, 0, 0)),
        (BOX, (-0.019, 0.01, 0), -0.001, (-1, 0, 0)),
        (BOX, (0.023, -0.034, 0), 0.005, (0.6, -0.8, 0)),  # beside an edge
        (BOX, (0.022, 0.033, -0.056), 0.007, (2 / 7, 3 / 7, -6 / 7)),  # beyond a corner
        (BOX, (0, 0, 0), -0.02, (1, 0, 0)),
        (CYLINDER, (0, 0.03, 0.01), 0.01, (0, 1, 0)),
        (CYLINDER, (0.001, 0, -0.045), 0.005, (0, 0, -1)),
        (CYLINDER, (0, 0, 0.039), -0.001, (0, 0, 1)),
        (CYLINDER, (0.0, -0.023, 0.044), 0.005, (0, -0.6, 0.8)),  # beyond the rim
        (CYLINDER, (0, 0, 0), -0.02, (1, 0, 0)),
        (CYLINDER, (0.02, 0, 0), 0.0, (1, 0, 0)),
    ],
)
def test_known_places(shape: Shape, point: tuple[float, ...], distance: float, normal: tuple[float, ...]) -> None:
    found, outward = shape.surface(np.array(point, dtype=float))
    assert found == pytest.approx(distance, abs=1e-15)
    assert outward == pytest.approx(np.array(normal), abs=1e-12)


def test_titles_are_short_and_in_millimetres() -> None:
    titles = ["ball r 30 mm", "box 40 x 60 x 100 mm", "cylinder r 20 x 80 mm"]
    assert [shape.title for shape in SHAPES] == [*titles, *(f"{title} (turned)" for title in titles[1:])]


def test_a_cylinder_turned_about_x_lies_along_y() -> None:
    """A turn by 90 deg about x takes z to -y: (x, y, z) of the lying cylinder is (x, z, -y) of the standing one."""
    lying = Turned(CYLINDER, turn((1, 0, 0), np.pi / 2))
    for point in np.random.default_rng(4).uniform(-0.09, 0.09, (100, 3)):
        x, y, z = point
        distance, normal = lying.surface(point)
        standing, across = CYLINDER.surface(np.array([x, z, -y]))
        assert distance == pytest.approx(standing, abs=1e-15)
        assert normal == pytest.approx([across[0], -across[2], across[1]], abs=1e-12)


def test_a_turn_is_the_rotation_about_its_axis() -> None:
    for axis in np.random.default_rng(5).normal(size=(20, 3)):
        unit, angle = axis / np.linalg.norm(axis), float(axis[0])
        assert turn(unit, angle) == pytest.approx(Rotation.from_rotvec(angle * unit).as_matrix(), abs=1e-14)
