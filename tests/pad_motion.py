"""Where the pads of a hand are, which way they push, and how a joint moves them."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from synergrip.files import bundled
from synergrip.hands.hand import Hand

Array = npt.NDArray[np.float64]


def pads_at(hand: Hand, q: Array, names: Sequence[str]) -> tuple[Array, Array, Array]:
    """Return points (n, 3) [m], pushing directions (n, 3) in the palm frame, and radii (n,) [m] of the named pads."""
    pads = [hand.pads[name] for name in names]
    motions = hand.kinematics.at(q, [(pad.link, pad.point) for pad in pads])
    normals = [motion.rotation @ pad.normal for motion, pad in zip(motions, pads, strict=True)]
    return np.array([m.position for m in motions]), np.array(normals), np.array([pad.radius for pad in pads])


def push(hand: Hand, q: Array, pad: str, joint: str) -> float:
    """Return the cosine between where a pad pushes and where the positive turn of a joint moves it."""
    found = hand.pads[pad]
    (motion,) = hand.kinematics.at(q, [(found.link, found.point)])
    velocity = motion.jacobian[:3, hand.joint_names.index(joint)]
    return float(motion.rotation @ found.normal @ velocity / np.linalg.norm(velocity))


def urdf_efforts(name: str) -> dict[str, float]:
    """Return the effort limit that the URDF of a bundled hand states for each joint."""
    root = ET.parse(bundled("models") / "hands" / name / "hand.urdf").getroot()
    return {
        joint.attrib["name"]: float(limit.attrib["effort"])
        for joint in root.iter("joint")
        for limit in joint.iter("limit")
    }
