"""How far each synergy is moved to be seen: a step in its own unit."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from synergrip.hands.hand import Hand, SynergySet
from synergrip.linalg import Array

SHARE = 0.08
"""The point that moves most moves by this share of the size of the hand."""
LARGEST_TURN = math.radians(30.0)
"""No hinge turns by more, for synergies that turn links about themselves [rad]."""


@dataclass(frozen=True)
class Unit:
    """What the value of a synergy is counted in on paper."""

    name: str
    """"deg", "mm", or empty for a plain number."""
    size: float
    """One of it in SI units."""

    @property
    def each(self) -> str:
        """What a linear answer is given for, such as ``per deg``."""
        return f"per {self.name}" if self.name else f"for dz_r = {self.size:g}"


DEGREE, MILLIMETRE, PLAIN = Unit("deg", math.pi / 180), Unit("mm", 1e-3), Unit("", 1e-2)


@dataclass(frozen=True)
class Step:
    """A change of one synergy."""

    unit: Unit
    value: float
    """[rad or m]; 0 for a synergy that moves nothing."""

    @property
    def text(self) -> str:
        """The step with its unit, for example ``+9 deg``; empty for none."""
        if not self.value:
            return ""
        return f"+{self.value / self.unit.size:g} {self.unit.name}" if self.unit.name else f"+{self.value:g}"


def unit_of(hand: Hand, column: Array) -> Unit:
    """Return the unit of a synergy from the joints that its column (n_q,) moves."""
    kinds = {joint.kind for joint, weight in zip(hand.joints, column, strict=True) if weight}
    return DEGREE if kinds == {"hinge"} else MILLIMETRE if kinds == {"slide"} else PLAIN


def steps(hand: Hand, synergies: SynergySet, q: Array) -> tuple[Step, ...]:
    """Return a step of each synergy from `q` (n_q,) that is easy to see, in round numbers.

    To first order the link origin or pad that moves most moves by `SHARE` of the largest distance between two of them.
    """
    points = [(link, np.zeros(3)) for link in hand.links] + [(p.link, p.point) for p in hand.pads.values()]
    motions = hand.kinematics.at(q, points)
    size = _size(np.array([motion.position for motion in motions]))
    velocities = np.array([motion.jacobian[:3] for motion in motions])  # (points, 3, n_q)
    hinges = np.array([joint.kind == "hinge" for joint in hand.joints])
    return tuple(_step(hand, column, velocities @ column, hinges, size) for column in synergies.S.T)


def _step(hand: Hand, column: Array, velocities: Array, hinges: Array, size: float) -> Step:
    unit = unit_of(hand, column)
    moved = float(np.linalg.norm(velocities, axis=-1).max(initial=0.0))
    turned = float(np.abs(column[hinges]).max(initial=0.0))
    limits = [SHARE * size / moved] if moved > 0 else []
    limits += [LARGEST_TURN / turned] if turned > 0 else []
    return Step(unit, _round(min(limits) / unit.size) * unit.size if limits else 0.0)


def _round(value: float) -> float:
    """Return the value to one digit below 10, to two above."""
    return float(f"{value:.1g}" if value < 9.5 else f"{round(value):.2g}")


def _size(points: Array) -> float:
    return float(np.linalg.norm(points[:, None] - points[None], axis=-1).max(initial=0.0))
