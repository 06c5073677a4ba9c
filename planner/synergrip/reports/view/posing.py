"""How a hand is posed: by its joints, by its synergies, by named postures; and where its object is."""

from __future__ import annotations

import json
import math
import re
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from synergrip.documents.quantities import SHOWN_IN
from synergrip.hands.hand import Hand, SynergySet
from synergrip.hands.synergies.matrix import coupling_map
from synergrip.hands.units import SI_UNITS, synergy_kinds
from synergrip.linalg import Array
from synergrip.values import Value

BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
WIDE = {"hinge": math.pi, "slide": 0.1}
"""How far a joint without limits is moved [rad, m]."""


class Dial(NamedTuple):
    """A number that a user turns, in the unit in which it is read."""

    name: str
    unit: str
    factor: float
    """From SI to this unit."""
    lower: float
    upper: float
    value: float
    follows: bool = False
    """Whether something else moves it for certain."""


@dataclass(frozen=True, eq=False, repr=False)
class Posing(Value):
    """A posture as it was made: q = base + S dz, inside the ranges of the joints.

    What synergies add is kept apart from what joints were set to, so that a synergy that is turned back takes nothing
    along.
    """

    hand: Hand
    synergies: SynergySet
    base: Array  # (n_q,)
    dz: Array  # (n_z,)
    position: Array  # (3,) of the object [m]

    @classmethod
    def at(cls, hand: Hand, synergies: SynergySet, q: Array, position: Array) -> Posing:
        """Return the posing that begins at a posture (n_q,)."""
        return cls(hand, synergies, np.asarray(q), np.zeros(len(synergies.synergies)), position)

    @property
    def q(self) -> Array:
        """(n_q,) joint values."""
        return np.clip(self.base + self.synergies.S @ self.dz, *_ranges(self.hand))

    def with_joint(self, index: int, value: float) -> Posing:
        """Return it with a joint at a value [rad or m]; the joints that follow it follow."""
        moved = np.zeros(len(self.base))
        moved[index] = value - (self.synergies.S @ self.dz)[index] - self.base[index]
        through = coupling_map(self.hand.joint_names, self.hand.couplings)[0] @ moved
        name = self.hand.joint_names[index]
        if name in self.hand.couplings:  # one that lets go of its driver, as a clutch does
            through = moved
        return replace(self, base=self.base + through)

    def with_synergy(self, index: int, value: float) -> Posing:
        """Return it with a synergy moved by a value from where it began [rad or m]."""
        dz = self.dz.copy()
        dz[index] = value
        return replace(self, dz=dz)

    def with_set(self, synergies: SynergySet) -> Posing:
        """Return it to be moved by other synergies."""
        return Posing.at(self.hand, synergies, self.q, self.position)

    def with_posture(self, q: Array) -> Posing:
        """Return it in a posture (n_q,)."""
        return Posing.at(self.hand, self.synergies, q, self.position)

    def with_position(self, axis: int, value: float) -> Posing:
        """Return it with the object moved along an axis of the palm to a value [m]."""
        position = np.array(self.position)
        position[axis] = value
        return replace(self, position=position)

    def joint_dials(self) -> list[Dial]:
        """Return the joints."""
        lower, upper = _ranges(self.hand)
        dials = []
        for joint, low, high, value in zip(self.hand.joints, lower, upper, self.q, strict=True):
            factor, unit = SHOWN_IN[SI_UNITS[joint.kind]]
            coupling = self.hand.couplings.get(joint.name)
            follows = coupling is not None and (coupling.rigid or not coupling.ratios)
            dials.append(Dial(joint.name, unit, factor, float(low), float(high), float(value), follows))
        return dials

    def synergy_dials(self) -> list[Dial]:
        """Return the synergies, from where the joint that one moves most meets its limits, from where it began."""
        lower, upper = _ranges(self.hand)
        kinds = synergy_kinds(self.synergies, [joint.kind for joint in self.hand.joints])
        dials = []
        for (name, kind), column, value in zip(kinds.items(), self.synergies.S.T, self.dz, strict=True):
            factor, unit = SHOWN_IN[SI_UNITS[kind]]
            most = int(np.argmax(np.abs(column)))
            ends = [(end[most] - self.base[most]) / column[most] for end in (lower, upper)] if column[most] else [0, 0]
            low, high = min(*ends, 0.0, float(value)), max(*ends, 0.0, float(value))
            dials.append(Dial(name, unit, factor, float(low), float(high), float(value)))
        return dials


def posture_line(posing: Posing) -> str:
    """Return a posture as it stands in a problem file; joints that follow others are left out, as they follow there."""
    turned = (dial for dial in posing.joint_dials() if not dial.follows)
    values = (f'{_key(dial.name)} = "{round(dial.factor * dial.value, 2) + 0.0:.10g} {dial.unit}"' for dial in turned)
    return f"posture = {{ {', '.join(values)} }}"


def _key(name: str) -> str:
    """Return a name as a key of TOML."""
    return name if BARE_KEY.fullmatch(name) else json.dumps(name, ensure_ascii=False)


def only_joints(hand: Hand, synergies: SynergySet) -> bool:
    """Tell whether each synergy is a joint, by itself or with what follows it: the dial of the joint does the same."""
    names = list(hand.joint_names)
    if not set(synergies.synergies) <= set(names):
        return False
    which = [names.index(name) for name in synergies.synergies]
    ways = np.eye(len(names)), coupling_map(names, hand.couplings)[0]
    return any(bool(np.allclose(synergies.S, way[:, which])) for way in ways)


def _ranges(hand: Hand) -> tuple[Array, Array]:
    """Return the ends (n_q,) of the ranges in which joints are moved."""
    wide = np.array([WIDE[joint.kind] for joint in hand.joints])
    lower, upper = (np.array([getattr(joint, end) for joint in hand.joints]) for end in ("lower", "upper"))
    low, high = np.where(np.isfinite(lower), lower, -wide), np.where(np.isfinite(upper), upper, wide)
    return np.minimum(low, high), np.maximum(low, high)
