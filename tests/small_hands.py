"""Hands small enough for closed forms, with the kinematics of real ones."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from made_kinds import made_kind

from synergrip.grasps.contacts.kind import EXAMPLE_OF
from synergrip.grasps.placing import Touch
from synergrip.hands.hand import Coupling, Hand, Joint, Pad
from synergrip.hands.kinematics import kinematics
from synergrip.hands.models.tree import LinkTree, TreeJoint
from synergrip.hands.synergies.matrix import joint_set
from synergrip.linalg import frozen


def hand_of(
    joints: Sequence[TreeJoint], pads: Mapping[str, Pad] | None = None, couplings: Mapping[str, Coupling] | None = None
) -> Hand:
    """Return the hand of joints listed parents first; the parent of the first one is the palm."""
    root = joints[0].parent
    tree = LinkTree("small", root, (root, *(j.child for j in joints)), {j.name: j for j in joints})
    moving = [tree.joints[name] for name in tree.moving]
    every = joint_set(tree.moving)
    return Hand(
        name="small",
        title="A small hand",
        joints=tuple(
            Joint(name=j.name, kind=j.kind, lower=j.lower, upper=j.upper, torque_limit=math.inf, link=j.child)
            for j in moving
        ),
        C_q=frozen(np.zeros((len(moving), len(moving)))),
        pads=pads or {},
        synergy_sets={every.name: every},
        postures={},
        kinematics=kinematics(tree, tree.moving),
        couplings=couplings or {},
        parents=tree.parents,
    )


def slide(name: str, parent: str, xyz: Sequence[float], axis: Sequence[float], upper: float = 0.1) -> TreeJoint:
    """Return a slide of the link ``NAME_link`` from 0 to `upper`."""
    return TreeJoint(name, "slide", parent, f"{name}_link", tuple(xyz), axis=tuple(axis), lower=0.0, upper=upper)


def hinge(name: str, parent: str, xyz: Sequence[float], limits: tuple[float, float] = (-math.pi, math.pi)) -> TreeJoint:
    """Return a hinge about z of the link ``NAME_link``."""
    lower, upper = limits
    return TreeJoint(name, "hinge", parent, f"{name}_link", tuple(xyz), axis=(0.0, 0.0, 1.0), lower=lower, upper=upper)


def pad(name: str, link: str, point: Sequence[float] = (0, 0, 0), radius: float = 0.0) -> Pad:
    """Return a pad that pushes along x."""
    return Pad(name=name, link=link, point=frozen(point), normal=frozen([1.0, 0.0, 0.0]), radius=radius)


def touching(*pads: Pad) -> tuple[Touch, ...]:
    """Return a hard contact for each pad, toward the object whatever its normal says."""
    return tuple(
        Touch(
            name=each.name,
            pad=each,
            kind=made_kind("hard", 0.5, 0.0),
            stiffness=dict.fromkeys(EXAMPLE_OF, 1000.0),
            normals="object",
            key=f"contacts.at[{i}]",
            aimed=False,
        )
        for i, each in enumerate(pads)
    )
