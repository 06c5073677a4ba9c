"""Balls found from the pads that touch them: by construction, by finite differences, and where there is none."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import least_squares

from synergrip.errors import InputError
from synergrip.grasps.ball import REACH, ball_centre
from synergrip.linalg import Array

CENTRE = np.array([0.01, -0.02, 0.15])
SILENT = np.zeros(3)


def _pads(rng: np.random.Generator, count: int, radius: float, pads: Array) -> tuple[Array, Array]:
    """Centres of round pads on the upper side of a ball, and where they push to."""
    outward = rng.normal(size=(count, 3)) + np.array([0, 0, 0.8])
    outward[:, 2] = np.abs(outward[:, 2])
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    return CENTRE + (radius + pads)[:, None] * outward, -outward.mean(axis=0)


def _distances(points: Array, centre: Array) -> Array:
    return np.asarray(np.linalg.norm(points - centre, axis=1))


@pytest.mark.parametrize("sizes", ["points", "equal", "different"])
@pytest.mark.parametrize("count", [3, 4, 5, 7])
@pytest.mark.parametrize("seed", range(5))
def test_a_ball_is_found_from_round_pads(count: int, sizes: str, seed: int) -> None:
    rng = np.random.default_rng([count, seed])
    pads = {"points": np.zeros(count), "equal": np.full(count, 0.008), "different": rng.uniform(0.002, 0.02, count)}
    points, pushing = _pads(rng, count, 0.04, pads[sizes])
    centre = ball_centre(points, 0.04, pads[sizes], pushing)
    assert centre == pytest.approx(CENTRE, abs=1e-9)


@pytest.mark.parametrize("radii", [(0.0, 0.0), (0.01, 0.01), (0.004, 0.011)])
def test_two_round_pads_find_the_ball_in_the_plane_of_their_push(radii: tuple[float, float]) -> None:
    """A triangle of sides R + r1, R + r2 and the distance of the pads."""
    pads = np.array(radii)
    angles = np.array([0.3, 2.2])
    outward = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    points = CENTRE + (0.04 + pads)[:, None] * outward
    assert ball_centre(points, 0.04, pads, -outward.mean(axis=0)) == pytest.approx(CENTRE, abs=1e-12)


def test_one_round_pad_pushes_the_ball_ahead() -> None:
    push = np.array([0.6, 0.0, -0.8])
    centre = ball_centre(CENTRE[None], 0.03, np.array([0.01]), 0.5 * push)
    assert centre == pytest.approx(CENTRE + 0.04 * push, abs=1e-15)


@pytest.mark.parametrize("pads", [np.zeros(3), np.full(3, 0.006), np.array([0.002, 0.006, 0.012])])
def test_the_centre_moves_so_that_every_distance_stays(pads: Array) -> None:
    """Finite differences of ``|p_i - c(p)| = R + r_i``: ``(p_i - c) . (dp_i - dc) = 0`` for any motion of the pads."""
    rng = np.random.default_rng(7)
    points, pushing = _pads(rng, 3, 0.04, pads)
    for _ in range(5):
        motion, step = rng.normal(size=points.shape), 1e-6
        ahead, behind = (ball_centre(points + s * step * motion, 0.04, pads, pushing) for s in (1, -1))
        slip = motion - (ahead - behind) / (2 * step)
        assert np.sum((points - CENTRE) * slip, axis=1) == pytest.approx(np.zeros(3), abs=1e-7)


def test_more_pads_than_a_ball_needs_are_fitted_in_distance() -> None:
    """Pads 0.2 mm off a ball, nearly in a plane: the fit is that of an independent solver."""
    rng = np.random.default_rng(3)
    pads = rng.uniform(0.0, 0.01, 5)
    angles = 2 * np.pi * np.arange(5) / 5
    outward = np.column_stack([np.cos(angles), np.sin(angles), 0.3 + 0.02 * rng.normal(size=5)])
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    points = CENTRE + (0.04 + pads + 2e-4 * rng.uniform(-1, 1, 5))[:, None] * outward
    centre = ball_centre(points, 0.04, pads, -outward.mean(axis=0))
    best = least_squares(lambda c: _distances(points, c) - 0.04 - pads, CENTRE, xtol=1e-15, ftol=1e-15, gtol=1e-15)
    assert centre == pytest.approx(best.x, abs=1e-8)
    assert centre[2] == pytest.approx(CENTRE[2], abs=2e-3)


@pytest.mark.parametrize("pushing", [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0)])
def test_pads_in_a_plane_push_the_ball_to_their_side(pushing: tuple[float, float, float]) -> None:
    points = 0.03 * np.array([[1, 0, 0], [-0.5, 0.8, 0], [-0.5, -0.8, 0], [0, np.hypot(0.5, 0.8), 0]])
    points[0] = [0.03 * np.hypot(0.5, 0.8), 0, 0]
    centre = ball_centre(points, 0.05, np.zeros(4), 0.1 * np.array(pushing))
    height = np.sqrt(0.05**2 - points[0] @ points[0])
    assert centre == pytest.approx([0, 0, height * pushing[2]], abs=1e-9)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_pads_that_do_not_say_where_they_push_leave_the_side_open(count: int) -> None:
    outward = np.array([[0.8, 0, 0.6], [-0.6, 0.5, 0.6], [-0.5, -0.6, 0.6]])[:count]
    points = CENTRE + 0.04 * outward / np.linalg.norm(outward, axis=1, keepdims=True)
    with pytest.raises(InputError, match="do not say on which side of them the ball is") as caught:
        ball_centre(points, 0.04, np.zeros(count), SILENT)
    assert caught.value.issues[0].key == "object.position"


def test_four_pads_need_not_say_where_they_push() -> None:
    points, _ = _pads(np.random.default_rng(5), 4, 0.04, np.full(4, 0.01))
    assert ball_centre(points, 0.04, np.full(4, 0.01), SILENT) == pytest.approx(CENTRE, abs=1e-9)


@pytest.mark.parametrize("gap", [0.0, 0.4e-3, -0.4e-3])
def test_two_fingers_that_face_each_other_hold_a_ball_by_its_equator(gap: float) -> None:
    pads = np.array([0.005, 0.005])
    points = CENTRE + np.outer([1, -1], [0.045 + gap, 0, 0])
    assert ball_centre(points, 0.04, pads, SILENT) == pytest.approx(CENTRE, abs=1e-9)


@pytest.mark.parametrize("pads", [np.zeros(3), np.full(3, 0.01), np.array([0.004, 0.008, 0.012])])
def test_the_smallest_ball_between_three_pads_is_named(pads: Array) -> None:
    """Its centre lies in the plane of the pads: a ball of this radius is found, one 1 mm smaller is refused."""
    angles = np.array([0.0, 2.0, 4.0])
    outward = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    points = CENTRE + (0.04 + pads)[:, None] * outward
    assert ball_centre(points, 0.04, pads, np.array([0, 0, 1.0])) == pytest.approx(CENTRE, abs=1e-6)
    with pytest.raises(InputError, match=r"ball of radius 39 mm cannot.*the smallest one has radius 40 mm"):
        ball_centre(points, 0.039, pads, np.array([0, 0, 1.0]))


@pytest.mark.parametrize("radius", [0.035, 0.045])
def test_the_only_ball_between_four_round_pads_is_named(radius: float) -> None:
    pads = np.array([0.004, 0.008, 0.012, 0.002])
    outward = np.array([[1, 0, 0], [-0.8, 0.6, 0], [-0.8, -0.6, 0], [0, 0, 1]])
    points, pushing = CENTRE + (0.04 + pads)[:, None] * outward, -outward.mean(axis=0)
    with pytest.raises(InputError, match="the one through them has radius 40 mm") as caught:
        ball_centre(points, radius, pads, pushing)
    assert caught.value.issues[0].key == "object.shape.radius"


def test_a_ball_within_reach_of_all_pads_is_found_and_one_beyond_is_not() -> None:
    outward = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]], dtype=float)
    points = 0.04 * outward
    assert ball_centre(points, 0.04 + 0.9 * REACH, np.zeros(5), SILENT).shape == (3,)
    with pytest.raises(InputError):
        ball_centre(points, 0.04 + 1.3 * REACH, np.zeros(5), SILENT)
