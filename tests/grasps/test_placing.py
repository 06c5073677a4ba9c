"""From pads to a grasp, on kinematics small enough to be read: where the object is found, J, G, and the refusals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
import pytest
from made_kinds import made_kind
from scipy.spatial.transform import Rotation

from synergrip.errors import InputError
from synergrip.grasps.contacts.contact import contact_frame
from synergrip.grasps.contacts.hard_finger import HardFinger
from synergrip.grasps.contacts.kind import EXAMPLE_OF
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.objects import Box, Cylinder, Object, Shape, Sphere
from synergrip.grasps.placing import Touch, place
from synergrip.hands.hand import Hand, Joint, Pad, SynergySet
from synergrip.hands.point_motion import Kinematics, PointMotion
from synergrip.linalg import Array, frozen

FINGERS = 3
Q = frozen([0.3, 0.7, -0.2, 0.5, 0.1, 0.9])
SOMEWHERE = frozen([0.01, -0.02, 0.15])
UNKNOWN = None


class Fingers:
    """Three fingers of two hinges; each bends its first link to the side and its second one inward."""

    def at(self, q: Array, points: Sequence[tuple[str, Array]]) -> tuple[PointMotion, ...]:
        return tuple(self._motion(q, int(link), point) for link, point in points)

    def _motion(self, q: Array, finger: int, point: Array) -> PointMotion:
        base = Rotation.from_euler("z", 2 * np.pi * finger / FINGERS)
        root = base.apply([0.06, 0.0, 0.0])
        first = base * Rotation.from_rotvec(q[2 * finger] * np.array([1.0, 0.0, 0.0]))
        knuckle = root + first.apply([0.0, 0.0, 0.05])
        second = first * Rotation.from_rotvec(q[2 * finger + 1] * np.array([0.0, -1.0, 0.0]))
        position = knuckle + second.as_matrix() @ point
        jacobian = np.zeros((6, 2 * FINGERS))
        for i, (axis, origin) in enumerate([(base.apply([1, 0, 0]), root), (first.apply([0, -1, 0]), knuckle)]):
            jacobian[:, 2 * finger + i] = np.concatenate([np.cross(axis, position - origin), axis])
        return PointMotion(frozen(position), frozen(second.as_matrix()), frozen(jacobian))


@dataclass(frozen=True)
class Standing:
    """Pads that stand where they are put; the link is the number of the pad, its axes are those of the palm."""

    positions: Array  # (n, 3)

    def at(self, q: Array, points: Sequence[tuple[str, Array]]) -> tuple[PointMotion, ...]:
        still = frozen(np.zeros((6, len(q))))
        return tuple(PointMotion(frozen(self.positions[int(link)]), frozen(np.eye(3)), still) for link, _ in points)


def _hand(kinematics: Kinematics, joints: int) -> tuple[Hand, SynergySet]:
    synergies = SynergySet(
        name="all",
        title="",
        synergies=tuple(f"s{i}" for i in range(joints)),
        S=frozen(np.eye(joints)),
        offset=frozen(np.zeros(joints)),
        effort_limits=frozen(np.full(joints, np.inf)),
    )
    names = tuple(Joint(name=f"j{i}", kind="hinge", lower=-3.0, upper=3.0, torque_limit=np.inf) for i in range(joints))
    return Hand(
        name="fake",
        title="Fake",
        joints=names,
        C_q=frozen(np.eye(joints)),
        pads={},
        synergy_sets={"all": synergies},
        postures={},
        kinematics=kinematics,
    ), synergies


def _touch(i: int, normal: Sequence[float] | Array, kind: str = "hard", point: Sequence[float] = (0, 0, 0)) -> Touch:
    pad = Pad(
        name=f"pad{i}", link=str(i), point=frozen(point), normal=frozen(np.asarray(normal) / np.linalg.norm(normal))
    )
    return Touch(
        name=f"C{i}",
        pad=pad,
        kind=made_kind(kind, 0.7, 0.004),
        stiffness=dict.fromkeys(EXAMPLE_OF, 1000.0),
        normals="object",
        key=f"contacts.at[{i}]",
    )


def _placed(
    body: Object | None, touches: Sequence[Touch], kinematics: Kinematics, q: Array = Q
) -> tuple[Grasp, Object]:
    hand, synergies = _hand(kinematics, len(q))
    C_q, C_z = frozen(np.eye(len(q))), frozen(np.zeros((len(q), len(q))))
    placed = place("test", hand, synergies, q, body, touches, C_q, C_z)
    return placed.grasp, placed.body


def _ball_on(points: Array, radius: float, inward: Array, **changes: object) -> tuple[Grasp, Object]:
    touches = [replace(_touch(i, n), **changes) for i, n in enumerate(inward)]  # type: ignore[arg-type]
    return _placed(
        Object(title="ball", mass=0.2, position=UNKNOWN, shape=Sphere(radius)), touches, Standing(frozen(points))
    )


def _on_sphere(centre: Array, radius: float, directions: Sequence[Sequence[float]]) -> tuple[Array, Array]:
    """Points of a ball and the normals that push at its centre."""
    outward = np.asarray(directions, dtype=float)
    outward = outward / np.linalg.norm(outward, axis=1, keepdims=True)
    return centre + radius * outward, -outward


BELOW = [(1, 0, -0.4), (-0.5, 0.8, -0.5), (-0.6, -0.7, -0.3)]
ABOVE = [(1, 0, 0.4), (-0.5, 0.8, 0.5), (-0.6, -0.7, 0.3)]


@pytest.mark.parametrize("directions", [BELOW, ABOVE, [*BELOW, (0, 0, 1)], BELOW[:2], BELOW[:1]])
def test_a_ball_is_found_from_its_pads_on_the_side_they_push_to(directions: list[tuple[float, ...]]) -> None:
    points, inward = _on_sphere(SOMEWHERE, 0.04, directions)
    grasp, ball = _ball_on(points, 0.04, inward)
    assert ball.position == pytest.approx(SOMEWHERE, abs=1e-9)
    for contact, point, normal in zip(grasp.contacts, points, inward, strict=True):
        assert contact.point == pytest.approx(point - SOMEWHERE, abs=1e-9)
        assert contact.frame[:, 0] == pytest.approx(normal, abs=1e-9)


def test_pads_on_the_equator_of_a_ball_find_its_centre() -> None:
    points, inward = _on_sphere(SOMEWHERE, 0.04, [(1, 0, 0), (-1, 1, 0), (-1, -1, 0)])
    assert _ball_on(points, 0.04, inward)[1].position == pytest.approx(SOMEWHERE, abs=1e-6)


def test_a_ball_that_is_too_small_for_its_pads_is_refused_and_the_smallest_radius_named() -> None:
    points, inward = _on_sphere(SOMEWHERE, 0.04, [(1, 0, 0), (-1, 1, 0), (-1, -1, 0)])
    _ball_on(points, 0.0396, inward)  # within reach of the pads
    with pytest.raises(InputError) as caught:
        _ball_on(points, 0.035, inward)
    (issue,) = caught.value.issues
    assert issue.key == "object.shape.radius"
    assert "radius 35 mm" in issue.message
    assert "radius 40 mm" in issue.message


@pytest.mark.parametrize("radius", [0.035, 0.045])
def test_four_pads_leave_a_ball_only_one_radius(radius: float) -> None:
    points, inward = _on_sphere(SOMEWHERE, 0.04, [*BELOW, (0, 0, 1)])
    with pytest.raises(InputError, match="cannot touch all pads"):
        _ball_on(points, radius, inward)


def test_an_object_that_is_told_its_place_stays_there() -> None:
    points, inward = _on_sphere(SOMEWHERE, 0.04, ABOVE)
    touches = [_touch(i, n) for i, n in enumerate(inward)]
    _, ball = _placed(
        Object(title="ball", mass=0.2, position=SOMEWHERE, shape=Sphere(0.04)), touches, Standing(frozen(points))
    )
    assert ball.position is SOMEWHERE


@pytest.mark.parametrize(
    ("shape", "points", "normals"),
    [
        (Box((0.04, 0.06, 0.02)), [(0.02, 0.01, 0), (-0.02, 0, 0.005)], [(-1, 0, 0), (1, 0, 0)]),
        (Cylinder(0.02, 0.05), [(0, 0.02, 0.01), (0.01, 0.005, -0.025)], [(0, -1, 0), (0, 0, 1)]),
    ],
)
def test_normals_come_from_the_surface(
    shape: Shape, points: list[tuple[float, ...]], normals: list[tuple[float, ...]]
) -> None:
    tilted = [np.array(n) + 0.3 * np.ones(3) for n in normals]
    touches = [_touch(i, n) for i, n in enumerate(tilted)]
    body = Object(title="thing", mass=0.1, position=SOMEWHERE, shape=shape)
    grasp, _ = _placed(body, touches, Standing(frozen(SOMEWHERE + np.array(points))))
    for contact, normal in zip(grasp.contacts, normals, strict=True):
        assert contact.frame[:, 0] == pytest.approx(np.array(normal), abs=1e-12)


def test_normals_come_from_the_pads_when_asked() -> None:
    points, inward = _on_sphere(SOMEWHERE, 0.04, ABOVE)
    tilted = inward + 0.2 * np.array([[0, 1, 0], [1, 0, 0], [0, 0, 1]])
    tilted /= np.linalg.norm(tilted, axis=1, keepdims=True)
    touches = [replace(_touch(i, n), normals="pad") for i, n in enumerate(tilted)]
    body = Object(title="ball", mass=0.2, position=SOMEWHERE, shape=Sphere(0.04))
    grasp, _ = _placed(body, touches, Standing(frozen(points)))
    for contact, normal, toward in zip(grasp.contacts, tilted, inward, strict=True):
        assert contact.frame[:, 0] == pytest.approx(normal, abs=1e-12)
        assert contact.frame[:, 0] != pytest.approx(toward, abs=0.05)


@pytest.mark.parametrize("body", [None, Object(title="lump", mass=0.3, position=UNKNOWN, shape=None)])
def test_a_bare_object_sits_in_the_middle_of_its_contacts(body: Object | None) -> None:
    points, inward = _on_sphere(SOMEWHERE, 0.04, BELOW)
    touches = [_touch(i, n) for i, n in enumerate(inward)]
    grasp, placed = _placed(body, touches, Standing(frozen(points)))
    middle = points.mean(axis=0)
    assert placed.position == pytest.approx(middle, abs=1e-15)
    assert (placed.title, placed.mass) == (("object", 0.0) if body is None else ("lump", 0.3))
    for contact, point in zip(grasp.contacts, points, strict=True):
        assert np.cross(contact.frame[:, 0], middle - point) == pytest.approx(np.zeros(3), abs=1e-15)
        assert contact.frame[:, 0] @ (middle - point) > 0


@pytest.mark.parametrize(("gap", "word"), [(0.6e-3, "outside"), (-0.6e-3, "inside"), (0.4e-3, ""), (-0.4e-3, "")])
def test_a_pad_off_the_surface_is_refused_by_name(gap: float, word: str) -> None:
    points = np.array([[0.02, 0, 0], [-0.02 - gap, 0, 0]])
    touches = [_touch(0, (-1, 0, 0)), _touch(1, (1, 0, 0))]
    body = Object(title="box", mass=0.1, position=frozen(np.zeros(3)), shape=Box((0.04, 0.04, 0.04)))
    if not word:
        assert _placed(body, touches, Standing(frozen(points)))[0].n_c == 2
        return
    with pytest.raises(InputError) as caught:
        _placed(body, touches, Standing(frozen(points)))
    (issue,) = caught.value.issues
    assert issue.key == "contacts.at[1]"
    assert f"pad 'pad1' is 0.6 mm {word} the surface of the box 40 x 40 x 40 mm" in issue.message


@pytest.mark.parametrize(("shape", "normals"), [(Sphere(0.04), "object"), (Sphere(0.04), "pad"), (None, "object")])
def test_a_pad_that_faces_away_is_refused_by_name(shape: Shape | None, normals: Literal["object", "pad"]) -> None:
    points, inward = _on_sphere(SOMEWHERE, 0.04, ABOVE)
    inward[2] = -inward[2]
    touches = [replace(_touch(i, n), normals=normals) for i, n in enumerate(inward)]
    with pytest.raises(InputError) as caught:
        _placed(Object(title="ball", mass=0.2, position=SOMEWHERE, shape=shape), touches, Standing(frozen(points)))
    (issue,) = caught.value.issues
    assert issue.key == "contacts.at[2]"
    assert "pad 'pad2' faces away from the object (180 deg" in issue.message


def test_every_pad_off_the_surface_or_facing_away_is_named_with_its_place() -> None:
    points = np.array([[0.02, 0, 0], [-0.023, 0.001, -1e-18], [0, 0.02, 0.0123]])
    touches = [_touch(0, (-1, 0, 0)), _touch(1, (1, 0, 0)), _touch(2, (0, 1, 0))]
    body = Object(title="box", mass=0.1, position=frozen(np.zeros(3)), shape=Box((0.04, 0.04, 0.04)))
    with pytest.raises(InputError) as caught:
        _placed(body, touches, Standing(frozen(points)))
    away, facing = caught.value.issues
    assert (away.key, facing.key) == ("contacts.at[1]", "contacts.at[2]")
    assert "pad 'pad1' is 3 mm outside" in away.message
    assert away.message.endswith("; the pad is at (-23, 1, 0) mm in the palm frame")
    assert "pad 'pad2' faces away" in facing.message
    assert facing.message.endswith("; the pad is at (0, 20, 12.3) mm in the palm frame")


MIXED = ("hard", "soft", "frictionless")


def _mixed(q: Array = Q, normals: Literal["object", "pad"] = "object") -> tuple[Grasp, Object]:
    touches = [_touch(i, (-0.8, 0.1, 0.6), kind, (-0.01, 0.004, 0.03)) for i, kind in enumerate(MIXED)]
    return _placed(None, [replace(t, normals=normals) for t in touches], Fingers(), q)


@pytest.mark.parametrize("normals", ["object", "pad"])
def test_the_jacobian_is_the_motion_of_the_contact_points_in_their_frames(normals: Literal["object", "pad"]) -> None:
    grasp, _ = _mixed(normals=normals)
    step, fingers = 1e-6, Fingers()
    points = [(str(i), frozen((-0.01, 0.004, 0.03))) for i in range(FINGERS)]
    assert grasp.J.shape == (3 + 4 + 1, 6)
    for joint in range(len(Q)):
        after = fingers.at(Q + step * np.eye(6)[joint], points)
        before = fingers.at(Q - step * np.eye(6)[joint], points)
        for contact, rows, a, b in zip(grasp.contacts, grasp.rows, after, before, strict=True):
            velocity = contact.frame.T @ (a.position - b.position) / (2 * step)
            turn = Rotation.from_matrix(a.rotation @ b.rotation.T).as_rotvec() / (2 * step)
            complete = np.append(velocity, contact.frame[:, 0] @ turn)
            expected = complete[[("n", "t", "o", "m").index(c) for c in contact.kind.components]]
            assert grasp.J[rows, joint] == pytest.approx(expected, abs=1e-8)


def test_the_grasp_matrix_does_the_work_of_the_forces_on_a_moving_object() -> None:
    grasp, _ = _mixed()
    rng, step = np.random.default_rng(4), 1e-6
    for _ in range(10):
        twist, forces = rng.normal(size=6), rng.normal(size=grasp.n_l)
        forward, back = (Rotation.from_rotvec(s * step * twist[3:]) for s in (1, -1))
        turn = (forward * back.inv()).as_rotvec() / (2 * step)
        work = 0.0
        for contact, rows in zip(grasp.contacts, grasp.rows, strict=True):
            moved = (forward.as_matrix() - back.as_matrix()) @ contact.point / (2 * step) + twist[:3]
            rates = np.append(contact.frame.T @ moved, contact.frame[:, 0] @ turn)
            chosen = rates[[("n", "t", "o", "m").index(c) for c in contact.kind.components]]
            work += float(forces[rows] @ chosen)
        assert (grasp.G @ forces) @ twist == pytest.approx(work, rel=1e-8)


def test_a_joint_that_carries_object_and_fingers_alike_deforms_nothing() -> None:
    """Ties the signs of J and G: fingertips that move with the object see no relative motion."""
    grasp, _ = _mixed()
    twist = np.array([0.3, -0.2, 0.5, 1.0, -2.0, 0.7])
    contacts = [replace(c, kind=HardFinger(friction=0.7)) for c in grasp.contacts]
    tips = np.concatenate([c.frame.T @ (twist[:3] + np.cross(twist[3:], c.point)) for c in contacts])
    seen = np.concatenate([tips[:3], tips[3:6], [contacts[1].frame[:, 0] @ twist[3:]], tips[6:7]])
    assert grasp.G.T @ twist == pytest.approx(seen, abs=1e-12)


def test_compliances_friction_and_names_reach_the_grasp() -> None:
    touches = [_touch(i, (-0.8, 0.1, 0.6), kind, (-0.01, 0.004, 0.03)) for i, kind in enumerate(MIXED)]
    touches[0] = replace(touches[0], stiffness={"stiffness": 1000.0, "tangential_stiffness": np.inf})
    three = {"stiffness": 2000.0, "tangential_stiffness": 500.0, "spin_stiffness": 2.0}
    touches[1] = replace(touches[1], stiffness=three)
    hand, synergies = _hand(Fingers(), 6)
    synergies = replace(synergies, S=frozen(np.ones((6, 1))), synergies=("close",), effort_limits=None)
    C_q, C_z = frozen(np.diag(np.arange(6.0))), frozen([[0.3]])
    grasp = place("a title", hand, synergies, Q, None, touches, C_q, C_z).grasp
    assert np.diag(grasp.C_s) == pytest.approx([1e-3, 0, 0, 5e-4, 2e-3, 2e-3, 0.5, 1e-3])
    assert np.array_equal(grasp.C_q, C_q)
    assert np.array_equal(grasp.C_z, C_z)
    assert (grasp.title, grasp.joints, grasp.synergies) == ("a title", hand.joint_names, ("close",))
    assert grasp.S.shape == (6, 1)
    assert [(c.name, c.kind) for c in grasp.contacts] == [
        (f"C{i}", made_kind(kind, 0.7, 0.004)) for i, kind in enumerate(MIXED)
    ]
    assert grasp.lambda_0 is None
    assert np.array_equal(grasp.w_0, np.zeros(6))


def test_contact_frames_are_right_handed_and_start_with_the_normal() -> None:
    for normal in np.random.default_rng(6).normal(size=(50, 3)):
        frame = contact_frame(normal)
        assert frame.T @ frame == pytest.approx(np.eye(3), abs=1e-12)
        assert np.linalg.det(frame) == pytest.approx(1, abs=1e-12)
        assert frame[:, 0] == pytest.approx(normal / np.linalg.norm(normal), abs=1e-12)


# Round pads, and pads without a normal


def test_a_round_pad_touches_where_the_ball_is_nearest_and_carries_the_contact_there() -> None:
    """The contact's rows of J are the motion of the material point that touches, by finite differences."""
    radius, step, fingers = 0.006, 1e-6, Fingers()
    touches = [_touch(i, (-0.8, 0.1, 0.6), point=(-0.01, 0.004, 0.03)) for i in range(FINGERS)]
    touches = [replace(t, pad=replace(t.pad, radius=radius)) for t in touches]
    tips = np.array([m.position for m in fingers.at(Q, [(t.pad.link, t.pad.point) for t in touches])])
    size = float(np.linalg.norm(tips - tips.mean(axis=0), axis=1).max())
    grasp, ball = _placed(Object(title="ball", mass=0.2, position=UNKNOWN, shape=Sphere(1.2 * size)), touches, fingers)
    for i, (contact, rows, tip) in enumerate(zip(grasp.contacts, grasp.rows, tips, strict=True)):
        inward = (ball.position - tip) / np.linalg.norm(ball.position - tip)
        assert np.linalg.norm(ball.position - tip) == pytest.approx(1.2 * size + radius, abs=1e-9)
        assert contact.frame[:, 0] == pytest.approx(inward, abs=1e-9)
        assert contact.point + ball.position == pytest.approx(tip + radius * inward, abs=1e-9)
        (here,) = fingers.at(Q, [(str(i), touches[i].pad.point)])
        material = touches[i].pad.point + here.rotation.T @ (radius * inward)
        for joint in range(len(Q)):
            (after,) = fingers.at(Q + step * np.eye(6)[joint], [(str(i), material)])
            (before,) = fingers.at(Q - step * np.eye(6)[joint], [(str(i), material)])
            velocity = contact.frame.T @ (after.position - before.position) / (2 * step)
            assert grasp.J[rows, joint] == pytest.approx(velocity, abs=1e-8)


def test_gaps_are_those_between_the_pads_and_the_surface() -> None:
    points = np.array([[0.0203, 0, 0], [-0.0249, 0, 0], [0, 0.02, 0]])
    touches = [_touch(0, (-1, 0, 0)), _touch(1, (1, 0, 0)), _touch(2, (0, -1, 0))]
    touches[1] = replace(touches[1], pad=replace(touches[1].pad, radius=0.005))
    hand, synergies = _hand(Standing(frozen(points)), 6)
    none = frozen(np.zeros((6, 6)))
    cube = Object(title="box", mass=0.1, position=frozen(np.zeros(3)), shape=Box((0.04, 0.04, 0.04)))
    assert place("", hand, synergies, Q, cube, touches, none, none).gaps == pytest.approx((3e-4, -1e-4, 0), abs=1e-15)
    bare = Object(title="mass", mass=0.1, position=frozen(np.zeros(3)), shape=None)
    assert place("", hand, synergies, Q, bare, touches, none, none).gaps == (None, None, None)


def _unaimed(i: int, radius: float = 0.0) -> Touch:
    touch = _touch(i, (1, 0, 0))
    return replace(touch, pad=replace(touch.pad, normal=frozen(np.zeros(3)), radius=radius), aimed=False)


@pytest.mark.parametrize("shape", [Sphere(0.04), None])
@pytest.mark.parametrize("radius", [0.0, 0.01])
def test_a_pad_without_a_normal_pushes_into_the_object_from_any_side(shape: Shape | None, radius: float) -> None:
    points, inward = _on_sphere(SOMEWHERE, 0.04 + radius, ABOVE)
    touches = [_unaimed(i, radius) for i in range(3)]
    grasp, _ = _placed(
        Object(title="ball", mass=0.2, position=SOMEWHERE, shape=shape), touches, Standing(frozen(points))
    )
    for contact, point, normal in zip(grasp.contacts, points, inward, strict=True):
        assert contact.frame[:, 0] == pytest.approx(normal, abs=1e-12)
        assert contact.point + SOMEWHERE == pytest.approx(point + radius * normal, abs=1e-12)


def test_a_pad_without_a_normal_at_the_centre_of_a_bare_mass_pushes_nowhere() -> None:
    points = SOMEWHERE + np.array([[0, 0, 0], [0.01, 0, 0]])
    with pytest.raises(InputError, match="pad 'pad0' is at the centre of the object; give the contact's normal"):
        _placed(
            Object(title="mass", mass=0.2, position=SOMEWHERE, shape=None),
            [_unaimed(0), _unaimed(1)],
            Standing(frozen(points)),
        )


def test_the_normals_that_are_known_put_a_ball_on_its_side() -> None:
    points, inward = _on_sphere(SOMEWHERE, 0.04, ABOVE)
    touches = [_unaimed(0), _unaimed(1), _touch(2, inward[2])]
    assert _placed(
        Object(title="ball", mass=0.2, position=UNKNOWN, shape=Sphere(0.04)), touches, Standing(frozen(points))
    )[1].position == (pytest.approx(SOMEWHERE, abs=1e-9))


@pytest.mark.parametrize(("apart", "refused"), [(0.0, True), (0.09e-3, True), (0.11e-3, False)])
def test_two_contacts_on_the_same_spot_are_refused_with_both_names(apart: float, refused: bool) -> None:
    points = np.array([[-0.02, 0, 0], [0.02, 0, 0], [0.02, 0.0, apart]])
    touches = [_touch(0, (1, 0, 0)), _touch(1, (-1, 0, 0)), _touch(2, (-1, 0, 0))]
    cube = Object(title="box", mass=0.1, position=frozen(np.zeros(3)), shape=Box((0.04, 0.04, 0.04)))
    if not refused:
        assert _placed(cube, touches, Standing(frozen(points)))[0].n_c == 3
        return
    with pytest.raises(InputError) as caught:
        _placed(cube, touches, Standing(frozen(points)))
    (issue,) = caught.value.issues
    assert issue.key == "contacts.at[2]"
    assert f"contacts 'C1' and 'C2' are on the same spot, {1e3 * apart:.2g} mm apart" in issue.message


def test_round_pads_meet_on_the_spot_where_they_touch_and_not_at_their_centres() -> None:
    """Two round pads of different size behind each other push at one point of the box."""
    points = np.array([[-0.02, 0, 0], [0.025, 0, 0], [0.03, 0, 0]])
    touches = [_touch(0, (1, 0, 0)), _touch(1, (-1, 0, 0)), _touch(2, (-1, 0, 0))]
    touches[1:] = [replace(t, pad=replace(t.pad, radius=r)) for t, r in zip(touches[1:], (0.005, 0.01), strict=True)]
    cube = Object(title="box", mass=0.1, position=frozen(np.zeros(3)), shape=Box((0.04, 0.04, 0.04)))
    with pytest.raises(InputError, match="contacts 'C1' and 'C2' are on the same spot, 0 mm apart"):
        _placed(cube, touches, Standing(frozen(points)))
