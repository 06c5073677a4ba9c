"""Two jaws that slide along x and y and turn about z: what they do with an object between them has closed forms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation
from small_hands import hand_of, pad

from synergrip.grasps.contact_at import ContactAt
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.contacts.soft_finger import SoftFinger
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.making import make_grasp
from synergrip.grasps.objects import Object, Turned
from synergrip.grasps.shapes.shape import Shape
from synergrip.hands.models.tree import TreeJoint
from synergrip.linalg import Array

SOFT = SoftFinger(friction=0.5, spin_friction=0.01)
STILL = Rotation.identity()


def jaws(
    shape: Shape | None,
    half: float,
    radius: float,
    *,
    C_s: Array | Sequence[float],
    C_q: Sequence[float] | Array,
    kind: ContactKind = SOFT,
    turned: Rotation = STILL,
) -> Grasp:
    """Return the grasp of an object at the origin, touched at x = -half and half; nothing presses yet.

    Joints and synergies are x, y and the turn of the left jaw, then of the right one, which is the left one turned by
    180 degrees about z: positive x is toward the object.

    Args:
        shape: of the object.
        half: of its width [m].
        radius: of the tips, 0 for points [m].
        C_s: of each contact, its diagonal or one for both (n_l, n_l).
        C_q: (6,) of the joints.
        kind: of both contacts.
        turned: how all of it, hand and object, is turned in the palm frame.
    """
    joints, pads = [TreeJoint("base", "fixed", "palm", "hand", quaternion=wxyz(turned))], {}
    for side, yaw in (("left", 0.0), ("right", np.pi)):
        about, far = wxyz(Rotation.from_rotvec([0, 0, yaw])), (-half - radius, 0.0, 0.0)
        names = [f"{side}_{part}" for part in ("in", "across", "jaw")]
        joints += [
            TreeJoint(names[0], "slide", "hand", names[0], quaternion=about, lower=-1, upper=1),
            TreeJoint(names[1], "slide", names[0], names[1], axis=(0.0, 1.0, 0.0), lower=-1, upper=1),
            TreeJoint(names[2], "hinge", names[1], names[2], far, axis=(0.0, 0.0, 1.0), lower=-3, upper=3),
        ]
        pads[side] = pad(side, names[2], radius=radius)
    hand = hand_of(joints, pads)
    real = shape if shape is None or turned is STILL else Turned(shape, turned.as_matrix())
    body = Object(mass=0.1, shape=real, position=np.zeros(3))
    springs = dict.fromkeys(kind.stiffnesses(), 1e4)
    touches = [ContactAt(side, kind, **springs, tangent=(0.0, 1.0, 0.0)) for side in pads]
    grasp = make_grasp(hand, body, posture=np.zeros(6), contacts=touches, joint_compliance=0.0)
    each = np.diag(C_s) if np.ndim(C_s) == 1 else np.asarray(C_s)
    whole = each if len(each) == grasp.n_l else np.kron(np.eye(2), each)
    yielding = np.diag(C_q) if np.ndim(C_q) == 1 else np.asarray(C_q)
    return replace(grasp, C_s=whole, C_q=yielding, lambda_0=np.zeros(grasp.n_l))


def wxyz(rotation: Rotation) -> tuple[float, ...]:
    x, y, z, w = rotation.as_quat()
    return (float(w), float(x), float(y), float(z))
