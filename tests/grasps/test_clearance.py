"""Lines through shapes, against closed forms and points along them, and what is said of a hand inside an object."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from small_hands import hand_of, hinge, pad, slide, touching

from synergrip.grasps.clearance import at_most, collision_notes, depth
from synergrip.grasps.objects import Box, Cylinder, Object, Shape, Sphere, Turned, turn
from synergrip.linalg import frozen
from synergrip.problems.problem import load_problem

ORIGIN = frozen(np.zeros(3))
SHAPES: list[Shape] = [
    Sphere(0.03), Box((0.04, 0.06, 0.1)), Cylinder(0.02, 0.08),
    Turned(Box((0.04, 0.06, 0.1)), turn((0.6, 0, 0.8), 0.7)),
]  # fmt: skip


def test_a_line_runs_through_a_ball_as_deep_as_its_nearest_point_to_the_centre() -> None:
    for a, b in np.random.default_rng(1).uniform(-0.08, 0.08, (100, 2, 3)):
        share = np.clip(-a @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        assert depth(Sphere(0.03), a, b) == pytest.approx(0.03 - np.linalg.norm(a + share * (b - a)), abs=1e-11)


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.title)
def test_no_point_of_a_line_is_deeper_and_one_is_as_deep(shape: Shape) -> None:
    for a, b in np.random.default_rng(2).uniform(-0.08, 0.08, (40, 2, 3)):
        along = [-shape.surface(a + share * (b - a))[0] for share in np.linspace(0, 1, 401)]
        assert max(along) <= depth(shape, a, b) + 1e-12
        assert max(along) == pytest.approx(depth(shape, a, b), abs=np.linalg.norm(b - a) / 800)


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.title)
def test_no_line_is_deeper_than_its_ends_allow_and_some_are_seen_to_be_outside(shape: Shape) -> None:
    ends = np.random.default_rng(3).uniform(-0.08, 0.08, (200, 2, 3))
    exact, most = np.array([depth(shape, a, b) for a, b in ends]), at_most(shape, ends)
    assert (exact <= most + 1e-12).all()
    assert (most < 0).any()


def test_a_line_of_no_length_is_as_deep_as_its_point() -> None:
    point = np.array([0.01, 0.0, 0.0])
    assert depth(Sphere(0.03), point, point) == pytest.approx(0.02, abs=1e-15)


# A finger along x: palm, knuckle at 20 mm, a link of 60 mm, a pad 10 mm above its end.

FINGER = hand_of(
    [hinge("knuckle", "palm", (0.02, 0, 0)), slide("end", "knuckle_link", (0.06, 0, 0), (1, 0, 0))],
    {"tip": pad("tip", "end_link", (0, 0.01, 0))},
)
STRAIGHT = frozen([0.0, 0.0])


@pytest.mark.parametrize(
    ("centre", "told"),
    [
        ((0.05, 0.006, 0), "the line from link 'knuckle_link' to link 'end_link' (4 mm deep)"),
        ((0.05, 0.0096, 0), ""),  # 0.4 mm are no reason to look
        ((0.0, 0.0, 0.009), "the line from link 'palm' to link 'knuckle_link' (1 mm deep)"),
        ((0.0885, 0.006, 0.0), "the line from link 'end_link' to pad 'tip' (1.5 mm deep)"),
        ((0.05, 0.03, 0), ""),
    ],
)
def test_the_line_that_runs_inside_is_named(centre: tuple[float, float, float], told: str) -> None:
    notes = collision_notes(
        FINGER, STRAIGHT, Object(title="ball", mass=0.1, position=frozen(centre), shape=Sphere(0.01)), ()
    )
    about = f"the hand may collide with the ball r 10 mm: its skeleton runs inside on {told}"
    assert notes == ((about,) if told else ())


def test_every_line_inside_is_named_and_the_posture_counts() -> None:
    ball = Object(title="ball", mass=0.1, position=frozen([0.02, 0.03, 0]), shape=Sphere(0.012))
    assert collision_notes(FINGER, STRAIGHT, ball, ()) == ()
    (note,) = collision_notes(FINGER, frozen([np.pi / 2, -0.02]), ball, ())
    assert note.count("from link") == 2
    assert "from link 'knuckle_link' to link 'end_link' (12 mm deep), from link 'end_link' to pad 'tip'" in note


def test_a_pad_that_touches_is_no_reason_and_a_place_on_a_link_counts() -> None:
    ball = Object(title="ball", mass=0.1, position=frozen([0.08, 0.02, 0]), shape=Sphere(0.01))
    assert collision_notes(FINGER, STRAIGHT, ball, touching(FINGER.pads["tip"])) == ()
    (note,) = collision_notes(FINGER, STRAIGHT, ball, touching(pad("nail", "end_link", (0, 0.03, 0))))
    assert "the line from link 'end_link' to pad 'nail' (10 mm deep)" in note


def test_nothing_is_inside_an_object_without_a_shape() -> None:
    assert collision_notes(FINGER, STRAIGHT, Object(title="mass", mass=0.1, position=ORIGIN, shape=None), ()) == ()


def test_the_shipped_grasp_is_clear_and_a_ball_on_the_palm_is_not() -> None:
    held = load_problem("barrett-ball-hold").held
    assert held is not None
    assert held.notes == ()
    sunk = replace(held.body, position=frozen([0, 0, 0.04]))
    (note,) = collision_notes(held.hand, held.q, sunk, held.touches)
    assert "from link 'palm' to link 'finger1_base'" in note
