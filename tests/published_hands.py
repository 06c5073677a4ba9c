"""What the published numbers of a hand say of ours: frames of its links, contacts on its fingertips."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import pytest

from synergrip.hands.hand import Hand, Pad

Array = npt.NDArray[np.float64]


def check_frames(hand: Hand, q: Array, links: Sequence[str], expected: Sequence[Array], atol: float = 1e-12) -> None:
    """Assert that each link stands in its frame (4, 4) of the palm at joint values `q`."""
    found = hand.kinematics.at(q, [(link, np.zeros(3)) for link in links])
    for motion, frame in zip(found, expected, strict=True):
        np.testing.assert_allclose(motion.position, frame[:3, 3], rtol=0, atol=atol)
        np.testing.assert_allclose(motion.rotation, frame[:3, :3], rtol=0, atol=atol)


def check_fingertip(pad: Pad, place: Array, normal: Array) -> None:
    """Assert that a round pad passes through a contact [m] in the frame of its link, and faces its way there."""
    outward = place - pad.point
    assert np.linalg.norm(outward) == pytest.approx(pad.radius, abs=2e-4)
    assert outward @ normal / np.linalg.norm(outward) > math.cos(math.radians(15))
