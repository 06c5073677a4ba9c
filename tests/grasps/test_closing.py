"""Hands that close until they touch: against closed forms, against small steps, and where they cannot."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from small_hands import hand_of, hinge, pad, slide, touching

from synergrip.errors import InputError
from synergrip.grasps.closing import close
from synergrip.grasps.objects import Box, Cylinder, Object, Shape, Sphere, Turned, turn
from synergrip.hands.hand import Coupling, Hand, Pad
from synergrip.hands.point_motion import PointMotion
from synergrip.linalg import Array, frozen


def thing_at(centre: Sequence[float], shape: Shape | None) -> Object:
    return Object(title="thing", mass=0.1, position=centre, shape=shape)


def refused(hand: Hand, q: Sequence[float], along: Sequence[float], body: Object, *pads: Pad) -> list[tuple[str, str]]:
    with pytest.raises(InputError) as caught:
        close(hand, frozen(q), frozen(along), body, touching(*pads))
    return [(issue.key, issue.message) for issue in caught.value.issues]


# A gripper: two slides along x that face each other, 0.1 m apart.

GRIPPER = hand_of([slide("left", "palm", (-0.05, 0, 0), (1, 0, 0)), slide("right", "palm", (0.05, 0, 0), (-1, 0, 0))])
TIPS = (pad("left/tip", "left_link"), pad("right/tip", "right_link"))
ROUND = (pad("left/tip", "left_link", radius=0.004), pad("right/tip", "right_link", radius=0.006))


@pytest.mark.parametrize("rates", [(1.0, 1.0), (1.0, 0.3), (2.0, 7.0)])
@pytest.mark.parametrize("pads", [TIPS, ROUND])
def test_a_gripper_closes_on_a_ball_off_its_middle(rates: tuple[float, float], pads: tuple[Pad, Pad]) -> None:
    x, y, z = centre = (0.0123, 0.007, -0.004)
    q = close(GRIPPER, frozen([0, 0]), frozen(rates), thing_at(centre, Sphere(0.02)), touching(*pads))
    half = [math.sqrt((0.02 + each.radius) ** 2 - y**2 - z**2) for each in pads]
    assert q == pytest.approx([0.05 + x - half[0], 0.05 - x - half[1]], abs=1e-12)


@pytest.mark.parametrize("x", [0.0, 2e-13, 1e-11, 3e-4, -3e-4])
def test_pads_that_touch_within_the_same_step_stop_one_after_the_other(x: float) -> None:
    body = thing_at((x, 0, 0), Sphere(0.0207))
    q = close(GRIPPER, frozen([0, 0]), frozen([1, 1]), body, touching(*TIPS))
    assert q == pytest.approx([0.0293 + x, 0.0293 - x], abs=1e-10)


@pytest.mark.parametrize("angle", [0.0, 30.0, 45.0, 100.0])
def test_a_gripper_closes_on_a_turned_box(angle: float) -> None:
    """The line of the pads leaves the box where the first of its two pairs of faces ends."""
    shape = Turned(Box((0.03, 0.02, 0.05)), turn((0, 0, 1), math.radians(angle)))
    centre = np.array([0.01, 0.002, 0.0])
    q = close(GRIPPER, frozen([0, 0]), frozen([1, 1]), thing_at(centre, shape), touching(*TIPS))
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    slabs = [((c, s), 0.015), ((-s, c), 0.01)]  # |n . (x - cx, -cy)| <= half
    ends = [
        sorted((sign * half + n[1] * centre[1]) / n[0] for sign in (1, -1)) for n, half in slabs if abs(n[0]) > 1e-9
    ]
    lower, upper = max(low for low, _ in ends), min(high for _, high in ends)
    assert q == pytest.approx([0.05 + centre[0] + lower, 0.05 - centre[0] - upper], abs=1e-12)


def test_a_pad_stops_in_front_of_a_sheet_thinner_than_a_step() -> None:
    """Both looks, before and behind the sheet, find the pad outside."""
    sheet = thing_at((0.0005, 0, 0), Box((2e-4, 0.05, 0.05)))
    q = close(GRIPPER, frozen([0, 0]), frozen([1, 1]), sheet, touching(*TIPS))
    assert q == pytest.approx([0.05 + 0.0004, 0.05 - 0.0006], abs=1e-12)


def test_a_finger_that_follows_another_one_goes_on_when_that_one_touches() -> None:
    coupled = hand_of(
        [slide("left", "palm", (-0.05, 0, 0), (1, 0, 0)), slide("right", "palm", (0.05, 0, 0), (-1, 0, 0))],
        couplings={"right": Coupling({"left": 1.0})},
    )
    for x in (0.01, -0.01, 0.0):
        q = close(coupled, frozen([0, 0]), frozen([1, 1]), thing_at((x, 0, 0), Sphere(0.02)), touching(*TIPS))
        assert q == pytest.approx([0.03 + x, 0.03 - x], abs=1e-12)


def test_a_joint_at_its_limit_stops_those_that_follow_it_and_no_other() -> None:
    joints = [
        slide("left", "palm", (-0.05, 0, 0), (1, 0, 0), upper=0.01),
        slide("right", "palm", (0.05, 0, 0), (-1, 0, 0)),
        slide("other", "palm", (0, 0.05, 0), (0, -1, 0)),
    ]
    tips = (pad("right/tip", "right_link"), pad("other/tip", "other_link"))
    body = thing_at((0, 0, 0), Sphere(0.02))
    free = close(hand_of(joints), frozen([0, 0, 0]), frozen([1, 1, 1]), body, touching(*tips))
    assert free == pytest.approx([0.01, 0.03, 0.03], abs=1e-12)
    coupled = hand_of(joints, couplings={"right": Coupling({"left": 1.0})})
    ((key, message),) = refused(coupled, [0, 0, 0], [1, 1, 1], body, *tips)
    assert key == "contacts.at[0]"
    assert (
        "pad 'right/tip' does not reach the ball r 20 mm: at its closest, closed by 0.01, it is 20 mm away" in message
    )
    assert "(right stopped with left)" in message
    follower_first = hand_of([slide("left", "palm", (-0.05, 0, 0), (1, 0, 0)), *joints[1:]],
                             couplings={"left": Coupling({"other": 1.0})})  # fmt: skip
    assert close(follower_first, frozen([0, 0, 0]), frozen([1, 1, 1]), body, touching(*tips))[1:] == pytest.approx(
        [0.03, 0.03], abs=1e-12
    )


def test_a_pad_that_its_limit_keeps_just_off_the_object_does_not_touch() -> None:
    """The joints of such a pad have no way left to press; one that is tied to a pad that touches has."""
    left = slide("left", "palm", (-0.05, 0, 0), (1, 0, 0), upper=0.02959)
    joints = [left, slide("right", "palm", (0.05, 0, 0), (-1, 0, 0))]
    body = thing_at((0, 0, 0), Sphere(0.02))
    ((_, message),) = refused(hand_of(joints), [0, 0], [1, 1], body, *TIPS)
    assert "it is 0.41 mm away (left at its limit)" in message
    near = hand_of([replace(left, upper=0.02999), joints[1]])
    assert close(near, frozen([0, 0]), frozen([1, 1]), body, touching(*TIPS)) == pytest.approx([0.02999, 0.03])
    tied = hand_of([replace(left, upper=0.1), joints[1]], couplings={"right": Coupling({"left": 1.0}, rigid=True)})
    beside = thing_at((0.0002, 0, 0), Sphere(0.02))
    assert close(tied, frozen([0, 0]), frozen([1, 1]), beside, touching(*TIPS)) == pytest.approx([0.0298, 0.0298])


# A finger of two hinges in a plane, beside a cylinder that stands on it.

A, B = 0.05, 0.03
FINGER = hand_of([hinge("a", "palm", (0, 0, 0)), hinge("b", "a_link", (A, 0, 0))])
MIDDLE, TIP = pad("middle", "a_link", (0.8 * A, 0, 0)), pad("tip", "b_link", (B, 0, 0))


def turned_by(length: float, centre: complex, radius: float) -> float:
    """Return the angle at which the end of an arm about the origin, coming from angle 0, meets a circle."""
    cosine = (abs(centre) ** 2 + length**2 - radius**2) / (2 * length * abs(centre))
    return float(np.angle(centre)) - math.acos(cosine)


@pytest.mark.parametrize("along", [(1.0, 0.0), (0.2, 0.0), (40.0, 0.0)])
@pytest.mark.parametrize("round_", [0.0, 0.007])
def test_a_stiff_finger_meets_a_cylinder_where_two_circles_cross(along: tuple[float, float], round_: float) -> None:
    centre, radius = 0.05 + 0.06j, 0.02
    tip = pad("tip", "b_link", (B, 0, 0), round_)
    body = thing_at((centre.real, centre.imag, 0.01), Cylinder(radius, 0.1))
    q = close(FINGER, frozen([0, 0]), frozen(along), body, touching(tip))
    assert q == pytest.approx([turned_by(A + B, centre, radius + round_), 0], abs=1e-12)


@pytest.mark.parametrize(("along", "power"), [((1.0, 1.0), 2), ((0.5, 1.0), 3)])
def test_a_finger_of_two_hinges_meets_a_cylinder_at_the_root_of_a_polynomial(
    along: tuple[float, float], power: int
) -> None:
    """With z = exp(i theta) the tip is at A z + B z^power, and |tip - c|^2 = R^2 a polynomial in z, |z| = 1."""
    centre, radius = 0.035 + 0.05j, 0.02
    body = thing_at((centre.real, centre.imag, 0.0), Cylinder(radius, 0.1))
    q = close(FINGER, frozen([0, 0]), frozen(along), body, touching(TIP))
    terms = np.zeros(2 * power + 1, dtype=complex)  # of z^-power to z^power
    position = {1: A, power: B, 0: -centre}
    for m, x in position.items():
        for n, y in position.items():
            terms[power + m - n] += x * np.conj(y)
    terms[power] -= radius**2
    roots = np.roots(terms[::-1])
    angles = np.angle(roots[np.abs(np.abs(roots) - 1) < 1e-7])
    theta = float(min(angle for angle in angles if angle > 0))
    assert q == pytest.approx([theta, (power - 1) * theta], abs=1e-9)


def test_a_pad_nearer_to_the_palm_stops_its_own_joints_and_the_finger_wraps_on() -> None:
    centre, radius = 0.03 + 0.03j, 0.015
    body = thing_at((centre.real, centre.imag, 0.0), Cylinder(radius, 0.1))
    start = np.array([-0.4, -0.5])
    q = close(FINGER, frozen(start), frozen([1, 1]), body, touching(MIDDLE, TIP))
    first = turned_by(0.8 * A, centre, radius)
    there = (centre - A * np.exp(1j * first)) * np.exp(-1j * first)  # the cylinder as the outer link sees it
    assert q == pytest.approx([first, turned_by(B, there, radius)], abs=1e-12)
    assert q[1] > start[1] + first - start[0]


@pytest.mark.parametrize("depth", [1e-6, 1e-9])
def test_a_pad_that_grazes_a_cylinder_stops_and_one_that_just_misses_does_not(depth: float) -> None:
    """The circle of the tip reaches into the cylinder, or passes it, by far less than the tip moves in a step."""
    touched, missed = (thing_at((0, 0.1, 0), Cylinder(0.1 - A - B + d, 0.1)) for d in (depth, -depth))
    q = close(FINGER, frozen([0, 0]), frozen([1, 0]), touched, touching(TIP))
    assert q[0] == pytest.approx(turned_by(A + B, 0.1j, 0.1 - A - B + depth), abs=1e-7)
    assert q[0] < math.pi / 2
    ((_, message),) = refused(FINGER, [0, 0], [1, 0], missed, TIP)
    assert "does not reach the cylinder" in message


def test_a_joint_at_its_limit_waits_for_the_others() -> None:
    centre, radius, limit = 0.03 + 0.055j, 0.01, 0.7
    short = hand_of([hinge("a", "palm", (0, 0, 0), (-1.0, limit)), hinge("b", "a_link", (A, 0, 0))])
    body = thing_at((centre.real, centre.imag, 0.0), Cylinder(radius, 0.1))
    q = close(short, frozen([0, 0]), frozen([1, 0.5]), body, touching(TIP))
    there = (centre - A * np.exp(1j * limit)) * np.exp(-1j * limit)
    assert q == pytest.approx([limit, turned_by(B, there, radius)], abs=1e-12)
    assert q[0] == limit
    assert q[1] > 0.5 * limit


class Endless:
    """A pad on an arm that turns about z, and its hand's kinematics."""

    def at(self, q: Array, points: Sequence[tuple[str, Array]]) -> tuple[PointMotion, ...]:
        position = frozen([0.05 * math.cos(q[0]), 0.05 * math.sin(q[0]), 0.0])
        jacobian = frozen([[-position[1]], [position[0]], [0], [0], [0], [1]])
        return tuple(PointMotion(position, frozen(np.eye(3)), jacobian) for _ in points)


def test_a_joint_without_limits_is_given_up() -> None:
    hand = replace(hand_of([hinge("a", "palm", (0, 0, 0), (-math.inf, math.inf))]), kinematics=Endless())
    ((_, message),) = refused(hand, [0.5], [-2.0], thing_at((0.1, 0, 0), Sphere(0.02)), pad("tip", "a_link"))
    assert "it is 30 mm away (a moves without end)" in message


# Rules


@pytest.mark.parametrize("factor", [1e-6, 0.25, 3.0, 1e7])
def test_the_size_of_the_weights_changes_nothing(factor: float) -> None:
    body = thing_at((0.03, 0.03, 0.0), Cylinder(0.015, 0.1))
    q = [close(FINGER, frozen([-0.4, -0.5]), frozen([f, 0.7 * f]), body, touching(MIDDLE, TIP)) for f in (1, factor)]
    assert q[1] == pytest.approx(q[0], abs=1e-12)


def test_pads_that_the_closing_does_not_move_stay_where_they_are() -> None:
    still = pad("palm", "palm", (0, 0.03, 0))
    body = thing_at((0, 0.0098, 0), Sphere(0.02))
    q = close(GRIPPER, frozen([0, 0]), frozen([1, 1]), body, touching(*TIPS, still))
    assert np.array_equal(q, close(GRIPPER, frozen([0, 0]), frozen([1, 1]), body, touching(*TIPS)))
    only_left = close(GRIPPER, frozen([0, 0.02]), frozen([1, 0]), body, touching(*TIPS))
    assert (only_left[0], only_left[1]) == (q[0], 0.02)


def test_a_pad_that_touches_already_moves_no_more() -> None:
    body = thing_at((0, 0, 0), Sphere(0.02))
    q = close(GRIPPER, frozen([0.03, 0]), frozen([1, 1]), body, touching(*TIPS))
    assert q == pytest.approx([0.03, 0.03], abs=1e-12)


def test_what_is_closed_is_not_written_into() -> None:
    q = frozen([0.0, 0.0])
    closed = close(GRIPPER, q, frozen([1, 1]), thing_at((0, 0, 0), Sphere(0.02)), touching(*TIPS))
    assert not closed.flags.writeable
    assert np.array_equal(q, [0, 0])


# Refusals


def test_every_pad_inside_the_object_at_the_start_is_named() -> None:
    body = thing_at((0, 0, 0), Sphere(0.02))
    found = refused(GRIPPER, [0.035, 0.031], [1, 1], body, *TIPS)
    assert [key for key, _ in found] == ["contacts.at[0]", "contacts.at[1]"]
    assert "pad 'left/tip' is 5 mm inside the ball r 20 mm before the hand closes" in found[0][1]
    assert "pad 'right/tip' is 1 mm inside" in found[1][1]


def test_every_pad_that_never_touches_is_named_with_how_close_it_came_and_what_stopped_it() -> None:
    """The left slide ends 20 mm short; the right one moves away from the start."""
    short = hand_of([
        slide("left", "palm", (-0.05, 0, 0), (1, 0, 0), upper=0.01), slide("right", "palm", (0.05, 0, 0), (-1, 0, 0)),
    ])  # fmt: skip
    body = thing_at((0, 0, 0), Sphere(0.02))
    found = refused(short, [0, 0.025], [2, -1], body, *TIPS)
    assert [key for key, _ in found] == ["contacts.at[0]", "contacts.at[1]"]
    assert "at its closest, closed by 0.005, it is 20 mm away (left at its limit)" in found[0][1]
    assert "at its closest, closed by 0, it is 5 mm away (right at its limit)" in found[1][1]


def test_a_finger_held_by_another_pad_says_so() -> None:
    """The tip touches first and stops both hinges: the middle of the finger stays away."""
    body = thing_at((0.055, 0.057, 0), Cylinder(0.01, 0.1))
    ((key, message),) = refused(FINGER, [0, 0], [1, 0], body, MIDDLE, TIP)
    assert key == "contacts.at[0]"
    assert "(a stopped when pad 'tip' touched)" in message


def test_a_closing_that_moves_no_pad_is_refused() -> None:
    body = thing_at((0, 0, 0), Sphere(0.02))
    assert refused(GRIPPER, [0, 0], [0, 1], body, TIPS[0]) == [("close", "moves none of the pads that are to touch")]


@pytest.mark.parametrize(
    ("body", "keys"),
    [
        (thing_at((0, 0, 0), None), ["object.shape"]),
        (thing_at(None, Sphere(0.02)), ["object.position"]),
        (thing_at(None, None), ["object.shape", "object.position"]),
    ],
)
def test_an_object_needs_a_shape_and_a_place(body: Object, keys: list[str]) -> None:
    found = refused(GRIPPER, [0, 0], [1, 1], body, *TIPS)
    assert [key for key, _ in found] == keys
    assert all(message.startswith("missing; ") for _, message in found)
