"""Fingers whose joints are in line with what they touch: these move the contact across the finger, and not along it.

A hinge moves a point square to the line from its axis to the point. Where hinges of one finger that turn about parallel
axes have these lines in one, their ways of moving the contact are one, too, however many they are: a singular posture.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.documents.words import listed
from synergrip.errors import shortened
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.values import Value

IN_LINE = 5.0
"""[deg] Lines from the axes to the contact are in one where they differ by less than this."""
PARALLEL, TURNS, SAME, PRESSES = 0.999, 0.5, 1e-6, 0.7
"""Cosine of the angle between axes from which on they are parallel; turn of a link per unit of a joint from which on it
is a hinge; difference of two motions, as a share of them, of hinges about one axis; cosine of the angle between the
finger and the normal from which on the finger points where it presses."""
MOST_NAMED = 5
"""Fingers that are named."""


@dataclass(frozen=True, eq=False, repr=False)
class StraightFinger(Value):
    """Hinges of a finger that are in line with its contact."""

    contact: str
    joints: tuple[str, ...]
    angle: float
    """[deg] The largest angle between the lines from their axes to the contact."""
    along: Array
    """(3,) unit vector along the finger, from the palm: where they do not move the contact."""
    pressing: bool
    """Whether that is near the normal of the contact."""

    def __str__(self) -> str:
        """Return contact and joints."""
        return f"{shortened(self.contact)} ({listed([shortened(joint) for joint in self.joints])})"


def straight_fingers(grasp: Grasp, q: Array | None = None) -> tuple[StraightFinger, ...]:
    """Return the fingers of a grasp that are straight, where synergies would move their joints each by itself.

    Args:
        grasp: of a hand; one given as matrices has no fingers.
        q: (n_q,) joint values [rad or m]; those of the grasp when None.
    """
    held = grasp.held
    if held is None:
        return ()
    points = [(touch.pad.link, touch.pad.point) for touch in held.touches]
    motions = held.hand.kinematics.at(held.q if q is None else q, points)
    return tuple(
        finger
        for contact, motion in zip(grasp.contacts, motions, strict=True)
        for joints in _parallel(motion.jacobian)
        if (finger := _finger(grasp, contact.name, contact.frame[:, 0], motion.jacobian, joints)) is not None
    )


def _parallel(jacobian: Array) -> Iterator[list[int]]:
    """Yield the hinges that move a point (6, n_q), those about parallel axes together, each axis once."""
    left = [j for j in range(jacobian.shape[1]) if np.linalg.norm(jacobian[3:, j]) > TURNS and jacobian[:3, j].any()]
    while left:
        axis = jacobian[3:, left[0]] / np.linalg.norm(jacobian[3:, left[0]])
        group = [j for j in left if abs(axis @ jacobian[3:, j]) > PARALLEL * np.linalg.norm(jacobian[3:, j])]
        left = [j for j in left if j not in group]
        yield group


def _finger(grasp: Grasp, contact: str, normal: Array, jacobian: Array, joints: Sequence[int]) -> StraightFinger | None:
    """Return the finger that some parallel hinges move a contact with, if it is straight; None if it is not."""
    ways = jacobian[:3, joints] / np.linalg.norm(jacobian[3:, joints], axis=0)
    apart = np.linalg.norm(ways[:, :1] - ways, axis=0) > SAME * np.linalg.norm(ways[:, 0])
    if not apart.any() or np.linalg.matrix_rank(grasp.S[joints]) < 2:  # one axis, or one way to move them anyway
        return None
    units = ways / np.linalg.norm(ways, axis=0)
    angle = float(np.degrees(np.arccos(np.clip(np.abs(units.T @ units), 0.0, 1.0)).max()))
    if angle > IN_LINE:
        return None
    axis = jacobian[3:, joints[0]] / np.linalg.norm(jacobian[3:, joints[0]])
    along = np.cross(units[:, 0], axis)
    pressing = bool(abs(along @ normal) > PRESSES)
    return StraightFinger(contact, tuple(grasp.joints[j] for j in joints), angle, frozen(along), pressing)


def named(fingers: Sequence[StraightFinger]) -> str:
    """Return the names of straight fingers, contacts with their joints."""
    more = f" and {len(fingers) - MOST_NAMED} more" if len(fingers) > MOST_NAMED else ""
    return ", ".join(map(str, fingers[:MOST_NAMED])) + more


def straight_notes(grasp: Grasp) -> Iterator[str]:
    """Yield a note on the fingers that are straight at the start."""
    fingers = straight_fingers(grasp)
    if fingers:
        press = [shortened(finger.contact) for finger in fingers if finger.pressing]
        yield (
            f"near a straight posture: {named(fingers)}. Joints in line with their contact (within "
            f"{max(finger.angle for finger in fingers):.2g} deg) move it across the finger and not along it"
            f"{f', where {listed(press)} would press' if press else ''}; another posture lets them do both"
        )
