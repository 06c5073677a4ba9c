"""From a hand in a posture, an object and the pads that touch it to a grasp."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from synergrip.errors import InputError, Issue
from synergrip.grasps.contact import Contact, ContactKind, contact_frame
from synergrip.grasps.grasp import Grasp, grasp_matrix, hand_jacobian
from synergrip.grasps.objects import Object, Sphere
from synergrip.hands.hand import Hand, Pad, PointMotion, SynergySet
from synergrip.linalg import Array, frozen

REACH = 0.5e-3
"""How far a pad may be from the surface of the object it is said to touch [m]."""


@dataclass(frozen=True)
class Touch:
    """A pad that touches the object, and how."""

    name: str
    pad: Pad
    kind: ContactKind
    friction: float
    spin_friction: float  # [m]
    stiffness: tuple[float, ...]
    """One for each force component of the kind [N/m, N m/rad]; infinity when rigid."""
    normals: Literal["object", "pad"]
    """Contact normal from the object (its surface, or its centre) or from the pad."""
    key: str
    """Key in the problem file, for errors."""


def place(
    title: str, hand: Hand, synergies: SynergySet, q: Array, thing: Object | None, touches: Sequence[Touch],
    C_q: Array, C_z: Array,
) -> tuple[Grasp, Object]:  # fmt: skip
    """Return the grasp of an object by a hand in a posture.

    Args:
        title: of the grasp.
        hand: the hand.
        synergies: its synergy matrix.
        q: (n_q,) joint values [rad].
        thing: the object; when its position is not finite it is found from the contacts.
        touches: the contacts.
        C_q: (n_q, n_q) joint compliance [rad/(N m)].
        C_z: (n_z, n_z) synergy compliance.

    Returns:
        The grasp, and the object with its position.

    Raises:
        InputError: pads that do not reach the object, or face away from it; all of them.
    """
    motions = hand.kinematics.at(q, [(touch.pad.link, touch.pad.point) for touch in touches])
    placed = _position(thing, touches, motions)
    contacts = _contacts(placed, touches, motions)
    moved = [
        moved_to(motion, contact.point + placed.position) for motion, contact in zip(motions, contacts, strict=True)
    ]
    C_s = np.diag([1.0 / k for touch in touches for k in touch.stiffness])
    grasp = Grasp(
        title, contacts, grasp_matrix(contacts), hand_jacobian(contacts, [m.jacobian for m in moved]),
        frozen(synergies.S), frozen(C_s), frozen(C_q), frozen(C_z), None, frozen(np.zeros(6)),
        hand.joint_names, synergies.synergies,
    )  # fmt: skip
    return grasp, placed


def moved_to(motion: PointMotion, point: Array) -> PointMotion:
    """Return the motion of another point (3,) of the same link, given in the palm frame [m]."""
    arm = point - motion.position
    velocity = motion.jacobian[:3] + np.cross(motion.jacobian[3:], arm, axis=0)
    return replace(motion, position=frozen(point), jacobian=frozen(np.vstack([velocity, motion.jacobian[3:]])))


def _position(thing: Object | None, touches: Sequence[Touch], motions: Sequence[PointMotion]) -> Object:
    """Return the object where it is said to be, or where the contacts put it."""
    points = np.array([motion.position for motion in motions])
    thing = thing or Object("object", 0.0, frozen(np.full(3, np.nan)), None)
    if np.all(np.isfinite(thing.position)):
        return thing
    if isinstance(thing.shape, Sphere):
        pushing = np.mean([m.rotation @ t.pad.normal for m, t in zip(motions, touches, strict=True)], axis=0)
        return replace(thing, position=_ball_centre(points, thing.shape.radius, pushing))
    return replace(thing, position=frozen(points.mean(axis=0)))


def _ball_centre(points: Array, radius: float, pushing: Array) -> Array:
    """Return the centre (3,) of a ball of `radius` through three or more points, on the side they push to."""
    middle = points.mean(axis=0)
    _, sizes, directions = np.linalg.svd(points - middle)
    rank = int(np.sum(sizes > 1e-6 * max(float(sizes[0]), 1e-300)))
    across = directions[:rank]  # |p - c|^2 equal for all points fixes the centre within their plane
    system = 2 * (points[1:] - points[0]) @ across.T
    right = ((points[1:] - middle) ** 2).sum(axis=1) - ((points[0] - middle) ** 2).sum()
    centre = middle + np.linalg.lstsq(system, right, rcond=None)[0] @ across
    around = float(np.linalg.norm(points - centre, axis=1).mean())
    if rank == 3 or around > radius:
        if abs(around - radius) > REACH:
            message = (
                f"a ball of radius {1e3 * radius:.4g} mm cannot touch all pads in this posture: "
                f"{'the one through them' if rank == 3 else 'the smallest one'} has radius {1e3 * around:.4g} mm; "
                "change the radius or the posture"
            )
            raise InputError.at("object.shape.sphere.radius", message)
        return frozen(centre)
    normal = np.cross(across[0], across[1]) if rank == 2 else pushing - across.T @ (across @ pushing)
    normal = normal / max(float(np.linalg.norm(normal)), 1e-300)
    side = 1.0 if normal @ pushing >= 0 else -1.0
    return frozen(centre + side * np.sqrt(radius**2 - around**2) * normal)


def _contacts(thing: Object, touches: Sequence[Touch], motions: Sequence[PointMotion]) -> tuple[Contact, ...]:
    contacts, issues = list[Contact](), list[Issue]()
    for touch, motion in zip(touches, motions, strict=True):
        try:
            contacts.append(_contact(thing, touch, motion))
        except InputError as error:
            x, y, z = np.round(1e3 * motion.position, 2) + 0.0  # no -0
            where = f"; the pad is at ({x:g}, {y:g}, {z:g}) mm in the palm frame"
            issues += [replace(issue, message=issue.message + where) for issue in error.issues]
    if issues:
        raise InputError(issues)
    return tuple(contacts)


def _contact(thing: Object, touch: Touch, motion: PointMotion) -> Contact:
    point = motion.position - thing.position
    pushing = motion.rotation @ touch.pad.normal
    if thing.shape is not None:
        distance, outward = thing.shape.surface(point)
        distance -= touch.pad.radius
        if abs(distance) > REACH:
            where = "outside" if distance > 0 else "inside"
            message = (
                f"pad '{touch.pad.name}' is {1e3 * abs(distance):.3g} mm {where} the surface of the "
                f"{thing.shape.title}; change the posture, or the object's size or position"
            )
            raise InputError.at(touch.key, message)
        inward = -outward
        point = point + touch.pad.radius * inward
    else:
        inward = -point / np.linalg.norm(point) if np.any(point) else pushing
        point = point + touch.pad.radius * pushing
    normal = pushing if touch.normals == "pad" else inward
    if normal @ pushing <= 0 or normal @ inward <= 0:
        angle = np.degrees(np.arccos(np.clip(inward @ pushing, -1, 1)))
        message = f"pad '{touch.pad.name}' faces away from the object ({angle:.0f} deg from the inward normal)"
        raise InputError.at(touch.key, message)
    return Contact(touch.name, touch.kind, touch.friction, touch.spin_friction, frozen(point), contact_frame(normal))
