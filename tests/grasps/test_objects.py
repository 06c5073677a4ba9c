"""Distances, normals and inertia of the shapes, against differences, their own support and points inside."""

from __future__ import annotations

import itertools
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from synergrip.grasps.objects import Box, Cylinder, Shape, Sphere, Turned, turn
from synergrip.grasps.shapes.shapes import SHAPES as REGISTRY

SPHERE, BOX, CYLINDER = Sphere(0.03), Box((0.04, 0.06, 0.1)), Cylinder(0.02, 0.08)
AXIS = np.array([2, -3, 6]) / 7


def any_shape(kind: type[Shape]) -> Shape:
    """A shape of a kind with some sizes."""
    lengths = iter(0.04 * 1.4 ** np.arange(3))
    return kind(*(next(lengths) if size.count == 1 else tuple(itertools.islice(lengths, size.count))
                  for size in kind.sizes))  # fmt: skip


EVERY = [any_shape(kind) for kind in REGISTRY.values()]
SHAPES: list[Shape] = [*EVERY, *(Turned(shape, turn(AXIS, 0.9)) for shape in EVERY)]
STEP = 1e-6


def _titled(shape: Shape) -> str:
    return shape.title


def _gradient(shape: Shape, point: np.ndarray) -> np.ndarray:
    steps = STEP * np.eye(3)
    return np.array([shape.surface(point + d)[0] - shape.surface(point - d)[0] for d in steps]) / (2 * STEP)


def test_every_shape_that_a_file_can_name_is_tested_and_documented() -> None:
    documented = (Path(__file__).parents[2] / "docs" / "problem-file.md").read_text()
    for name, shape in REGISTRY.items():
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
def test_distance_is_how_far_the_point_is_beyond_the_supports(shape: Shape) -> None:
    """The largest of ``d . point - d . farthest(d)``, inside and outside of a convex solid; the normal reaches it."""
    rng = np.random.default_rng(1)
    directions = rng.normal(size=(2000, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    supports = np.array([along @ shape.farthest(along) for along in directions])
    found = []
    for point in rng.uniform(-0.06, 0.06, (200, 3)):
        distance, normal = shape.surface(point)
        assert np.all(directions @ point - supports <= distance + 1e-12)
        assert normal @ (point - shape.farthest(normal)) == pytest.approx(distance, abs=1e-12)
        found.append(distance)
    assert min(found) < 0 < max(found)


@pytest.mark.parametrize("shape", SHAPES, ids=_titled)
def test_inertia_is_that_of_points_spread_over_the_solid(shape: Shape) -> None:
    points = np.random.default_rng(6).uniform(-0.08, 0.08, (40000, 3))
    inside = points[[shape.surface(point)[0] < 0 for point in points]]
    spread = inside.T @ inside / len(inside)
    sampled = np.trace(spread) * np.eye(3) - spread
    assert shape.inertia == pytest.approx(sampled, abs=0.05 * np.abs(sampled).max())


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
    assert [shape.title for shape in (SPHERE, BOX, CYLINDER)] == titles
    assert [Sphere(radius=2).title, Box(size=(0.005, 1, 2)).title] == ["ball r 2000 mm", "box 5 x 1000 x 2000 mm"]
    assert [Turned(shape, turn(AXIS, 0.9)).title for shape in (BOX, CYLINDER)] == [f"{t} (turned)" for t in titles[1:]]


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


@pytest.mark.parametrize("shape", [SPHERE, BOX, CYLINDER, Turned(CYLINDER, turn(AXIS, 0.9))], ids=lambda s: s.title)
def test_many_points_at_once_are_each_as_it_is_alone(shape: Shape) -> None:
    points = np.random.default_rng(6).uniform(-0.09, 0.09, (40, 5, 3))
    points[0, 0] = 0.0
    distances, normals = shape.surface(points)
    for place in np.ndindex(40, 5):
        distance, normal = shape.surface(points[place])
        assert distances[place] == pytest.approx(distance, abs=1e-15)
        assert normals[place] == pytest.approx(normal, abs=1e-12)
