"""The rule of closing, taken literally in small steps on a second model of a hand, against the search for events."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from small_hands import hand_of, hinge, pad, touching

from synergrip.errors import InputError
from synergrip.grasps.closing import close
from synergrip.grasps.objects import Cylinder, Object
from synergrip.hands.hand import Coupling, Hand, Pad
from synergrip.linalg import Array, frozen

STEP = 4e-4


class Plane:
    """Two fingers of two hinges on one turning palm link, by complex numbers: a second, independent model."""

    LENGTH = 0.045
    ROOTS = (0.04 + 0.0j, -0.04 + 0.0j)
    ALONG = (0.0315, 0.035, 0.036, 0.0315)
    """Where the pads are on their links."""

    @classmethod
    def hand(cls, limits: Array, couplings: dict[str, Coupling]) -> Hand:
        joints = [hinge("wrist", "palm", (0, 0, 0), tuple(limits[0]))]
        for i, root in enumerate(cls.ROOTS):
            joints.append(hinge(f"in{i}", "wrist_link", (root.real, root.imag, 0), tuple(limits[1 + 2 * i])))
            joints.append(hinge(f"out{i}", f"in{i}_link", (cls.LENGTH, 0, 0), tuple(limits[2 + 2 * i])))
        return hand_of(joints, couplings=couplings)

    @classmethod
    def pads(cls) -> tuple[Pad, ...]:
        names = ("in0", "out0", "in1", "out1")
        return tuple(pad(name, f"{name}_link", (x, 0, 0), 0.003) for name, x in zip(names, cls.ALONG, strict=True))

    @classmethod
    def places(cls, q: list[float]) -> list[complex]:
        """Return where the pads are."""
        found = []
        for i, root in enumerate(cls.ROOTS):
            knuckle = root * cmath.exp(1j * q[0])
            inner = cmath.exp(1j * (q[0] + q[1 + 2 * i]))
            outer = inner * cmath.exp(1j * q[2 + 2 * i])
            found += [knuckle + cls.ALONG[2 * i] * inner, knuckle + cls.LENGTH * inner + cls.ALONG[2 * i + 1] * outer]
        return found

    @classmethod
    def crept(cls, start: Array, rate: Array, centre: complex, reach: float, limits: Array) -> Array | None:
        """Return the closed posture by the rule taken literally, in small steps; None when a pad never touches."""
        movers = [{0, 1}, {0, 1, 2}, {0, 3}, {0, 3, 4}]
        q, moving, waiting = start.tolist(), set(np.flatnonzero(rate).tolist()), set(range(4))
        while any(movers[i] & moving for i in waiting):
            places = cls.places(q)
            for i in [i for i in waiting if abs(places[i] - centre) <= reach]:
                waiting.remove(i)
                moving -= movers[i]
            for j in sorted(moving):
                q[j] += STEP * rate[j]
                if not limits[j, 0] <= q[j] <= limits[j, 1]:
                    q[j] = min(max(q[j], limits[j, 0]), limits[j, 1])
                    moving -= {1, 2} if j == 1 else {j}  # out0 follows in0
        return None if waiting else np.array(q)


CLOSED, MISSED = (4, 5, 7, 8, 10, 11, 15, 21), (0, 1, 2, 3)
"""Seeds for which the hand closes, and does not."""


@pytest.mark.parametrize("seed", CLOSED + MISSED)
def test_a_hand_closes_as_it_would_in_small_steps(seed: int) -> None:
    """A wrist that carries both fingers, a coupling, limits, four round pads, a cylinder between the fingers."""
    rng = np.random.default_rng(seed)
    upper = rng.uniform([0.05, 1.5, 0.6, math.pi, 0.1], [0.3, 2.5, 2.0, 3.2, 0.3])
    limits = np.column_stack([[-0.3, -1.0, -1.0, rng.uniform(0.5, 1.5), -2.5], upper])
    hand = Plane.hand(limits, {"out0": Coupling({"in0": 0.3})})
    x, y, radius = rng.uniform([-0.004, 0.026, 0.026], [0.004, 0.034, 0.033])
    body = Object(title="thing", mass=0.1, position=frozen([x, y, 0]), shape=Cylinder(radius, 0.1))
    start = np.array([0.0, 0.0, -0.4, math.pi, 0.1])
    rate = np.array([rng.choice([0.0, 0.1, -0.1]), 1.0, 0.3, *-rng.uniform([0.5, 0.1], [1.5, 0.5])])
    expected = Plane.crept(start, rate, complex(x, y), radius + 0.003, limits)
    touches = touching(*Plane.pads())
    assert (expected is None) == (seed in MISSED)
    if expected is None:
        with pytest.raises(InputError, match="does not reach"):
            close(hand, frozen(start), frozen(rate), body, touches)
        return
    q = close(hand, frozen(start), frozen(rate), body, touches)
    assert q == pytest.approx(expected, abs=0.01)
    assert np.all((q >= limits[:, 0]) & (q <= limits[:, 1]))
    places = hand.kinematics.at(q, [(touch.pad.link, touch.pad.point) for touch in touches])
    across = [math.hypot(place.position[0] - x, place.position[1] - y) for place in places]
    assert across == pytest.approx([radius + 0.003] * 4, abs=1e-10)
