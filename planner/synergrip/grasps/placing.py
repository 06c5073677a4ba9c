"""From a hand in a posture, an object and the pads that touch it to a grasp."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from synergrip.documents.quantities import in_mm
from synergrip.errors import InputError, Issue, raise_issues
from synergrip.grasps.ball import REACH, ball_centre
from synergrip.grasps.contacts.contact import Contact, contact_frame
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.grasp import Grasp, grasp_matrix, hand_jacobian
from synergrip.grasps.objects import Object, Sphere
from synergrip.hands.hand import Hand, Pad, SynergySet
from synergrip.hands.point_motion import PointMotion
from synergrip.linalg import Array, block_diagonal, frozen
from synergrip.values import ByContent

ALONG = 1e-3
"""Sine of the angle to the normal below which a direction says nothing of the tangents."""
SAME_SPOT = 0.1e-3
"""Contacts closer than this are one contact told twice [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Touch(ByContent):
    """A pad that touches the object, and how."""

    name: str
    pad: Pad
    kind: ContactKind
    stiffness: Mapping[str, float]
    """The entries that the kind takes [N/m, N m/rad]; infinity when rigid."""
    normals: Literal["object", "pad"]
    """Contact normal from the object (its surface, or its centre) or from the pad."""
    key: str = field(default="", compare=False)
    """Where it stands, for errors: an argument, or a key of the problem file."""
    tangent: tuple[float, ...] | None = None
    """(3,) direction that t of the contact follows, in the frame of the link; None for any."""
    aimed: bool = True
    """False for a pad without a normal of its own: it pushes toward the object, and its `normal` is 0."""

    normal_at: str = field(default="", compare=False)
    """Where the normal of the pad is stated, for advice."""

    def alone(self, body: Object) -> bool:
        """Tell whether nothing but the pad says where it pushes: a bare mass is a load, and may be anywhere."""
        return body.shape is None and self.normals == "pad"


@dataclass(frozen=True)
class Placed:
    """A grasp, and what was found on the way to it."""

    grasp: Grasp
    body: Object
    """The object, where it is."""
    gaps: tuple[float | None, ...]
    """Distance of each pad from the surface, > 0 outside [m]; None for an object without a shape."""


def place(
    title: str, hand: Hand, synergies: SynergySet, q: Array, body: Object | None, touches: Sequence[Touch],
    C_q: Array, C_z: Array,
) -> Placed:  # fmt: skip
    """Return the grasp of an object by a hand in a posture.

    Args:
        title: of the grasp.
        hand: the hand.
        synergies: its synergy matrix.
        q: (n_q,) joint values [rad].
        body: the object; when its position is not finite it is found from the contacts.
        touches: the contacts.
        C_q: (n_q, n_q) joint compliance [rad/(N m)].
        C_z: (n_z, n_z) synergy compliance.

    Raises:
        InputError: pads that do not reach the object, or face away from it, or touch it on the same spot; all of them.
    """
    motions = hand.kinematics.at(q, [(touch.pad.link, touch.pad.point) for touch in touches])
    placed = _position(body, touches, motions)
    contacts, gaps = _contacts(placed, touches, motions)
    moved = [
        moved_to(motion, contact.point + placed.position) for motion, contact in zip(motions, contacts, strict=True)
    ]
    C_s = block_diagonal([touch.kind.compliance(touch.stiffness) for touch in touches])
    J = hand_jacobian(contacts, [motion.jacobian for motion in moved])
    grasp = Grasp(
        title=title, contacts=contacts, G=grasp_matrix(contacts), J=J,
        S=frozen(synergies.S), C_s=frozen(C_s), C_q=frozen(C_q), C_z=frozen(C_z),
        joints=hand.joint_names, synergies=synergies.synergies,
    )  # fmt: skip
    return Placed(grasp, placed, gaps)


def moved_to(motion: PointMotion, point: Array) -> PointMotion:
    """Return the motion of another point (3,) of the same link, given in the palm frame [m]."""
    arm = point - motion.position
    velocity = motion.jacobian[:3] + np.cross(motion.jacobian[3:], arm, axis=0)
    return replace(motion, position=frozen(point), jacobian=frozen(np.vstack([velocity, motion.jacobian[3:]])))


def same_spots(names: Sequence[str], points: Sequence[Array]) -> Iterator[tuple[int, str]]:
    """Yield the number of each contact that lies on the spot of an earlier one, and a message with both names."""
    for later, point in enumerate(points):
        for earlier in range(later):
            apart = float(np.linalg.norm(point - points[earlier]))
            if apart < SAME_SPOT:
                pair = f"'{names[earlier]}' and '{names[later]}'"
                yield later, f"contacts {pair} are on the same spot, {round(1e3 * apart, 6):.2g} mm apart"


def _position(body: Object | None, touches: Sequence[Touch], motions: Sequence[PointMotion]) -> Object:
    """Return the object where it is said to be, or where the contacts put it."""
    body = body or Object()
    if body.placed:
        return body
    points = np.array([motion.position for motion in motions])
    radii = np.array([touch.pad.radius for touch in touches])
    pushing = np.array([m.rotation @ t.pad.normal for m, t in zip(motions, touches, strict=True)])
    if isinstance(body.shape, Sphere):
        return replace(body, position=ball_centre(points, body.shape.radius, radii, pushing.mean(axis=0)))
    return replace(body, position=frozen((points + radii[:, None] * pushing).mean(axis=0)))


def _contacts(
    body: Object, touches: Sequence[Touch], motions: Sequence[PointMotion]
) -> tuple[tuple[Contact, ...], tuple[float | None, ...]]:
    found, issues = list[tuple[Contact, float | None]](), list[Issue]()
    for touch, motion in zip(touches, motions, strict=True):
        try:
            found.append(_contact(body, touch, motion))
        except InputError as error:
            x, y, z = np.round(1e3 * motion.position, 2) + 0.0  # no -0
            where = f"; the pad is at ({x:g}, {y:g}, {z:g}) mm in the palm frame"
            issues += [replace(issue, message=issue.message + where) for issue in error.issues]
    if not issues:
        spots = same_spots([contact.name for contact, _ in found], [contact.point for contact, _ in found])
        hint = "; move one of them, or leave it out"
        issues = [Issue(message + hint, key=touches[later].key) for later, message in spots]
    raise_issues(issues)
    return tuple(contact for contact, _ in found), tuple(gap for _, gap in found)


def _contact(body: Object, touch: Touch, motion: PointMotion) -> tuple[Contact, float | None]:
    point = motion.position - body.position
    pushing = motion.rotation @ touch.pad.normal
    gap, inward = None, pushing
    if body.shape is not None:
        distance, outward = body.shape.surface(point)
        gap, inward = _reached(body.shape.title, touch, float(distance) - touch.pad.radius), -outward
    elif np.any(point):
        inward = -point / np.linalg.norm(point)
    elif not touch.aimed:
        message = f"pad '{touch.pad.name}' is at the centre of the object; give the contact's normal"
        raise InputError.at(touch.key, message)
    to_surface = inward if body.shape is not None or not touch.aimed else pushing
    normal = pushing if touch.normals == "pad" else inward
    if touch.aimed and not touch.alone(body) and (normal @ pushing <= 0 or normal @ inward <= 0):
        angle = np.degrees(np.arccos(np.clip(inward @ pushing, -1, 1)))
        message = f"pad '{touch.pad.name}' faces away from the object ({angle:.0f} deg from the inward normal)"
        if body.shape is None:
            message += '; if the mass is beyond the pads, write normals = "pad": then each pushes as the pad says'
        raise InputError.at(touch.key, message)
    spot = frozen(point + touch.pad.radius * to_surface)
    stated = touch.normal_at if touch.alone(body) and not touch.pad.radius else ""  # a round one would touch elsewhere
    frame = contact_frame(normal, _tangent(touch, motion, normal))
    return Contact(name=touch.name, kind=touch.kind, point=spot, frame=frame, normal_at=stated), gap


def _tangent(touch: Touch, motion: PointMotion, normal: Array) -> Array | None:
    """Return the direction (3,) that t follows, in the palm frame; None for any.

    Raises:
        InputError: it is along the normal, which says nothing of t.
    """
    if touch.tangent is None:
        return None
    found = motion.rotation @ np.array(touch.tangent)
    if np.linalg.norm(np.cross(found, normal)) < ALONG * np.linalg.norm(normal):
        message = f"the tangent of contact '{touch.name}' is along its normal; give a direction across it"
        raise InputError.at(touch.key, message)
    return np.asarray(found)


def _reached(title: str, touch: Touch, gap: float) -> float:
    """Return the gap of a pad that is close enough to touch.

    Raises:
        InputError: it is not.
    """
    if abs(gap) > REACH:
        message = (
            f"pad '{touch.pad.name}' is {in_mm(abs(gap))} {'outside' if gap > 0 else 'inside'} the surface of "
            f"the {title}; change the posture, or the object's size or position; or let the hand close until its pads "
            'touch, from a more open posture: close = "NAME" of a synergy or joint, or weights by name'
        )
        raise InputError.at(touch.key, message)
    return gap
