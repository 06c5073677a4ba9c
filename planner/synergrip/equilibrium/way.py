"""The way from the start through all instants: it counts where contacts roll, and is gone in steps.

From one state to the next a tip rolls as with the middle of its step, which is off by the cube of the angle. So the
first squeeze is gone in steps, and so is what lies between two instants where contacts turn far from one to the next.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.equilibrium.setting import Setting
from synergrip.equilibrium.states import Loads, States
from synergrip.linalg import Array, Places
from synergrip.values import Value
from synergrip.vectors import rotation_vectors

SQUEEZE = 10
"""Steps in which the references of the first instant are reached."""
FARTHEST = 0.1
"""[rad] How far the joints that carry a contact may turn, all together, in a step from one instant to the next."""
MOST = 64
"""Steps from one instant to the next, at most."""


def squeezes(own: Setting) -> int:
    """Return how many steps of the first squeeze are gone through: the way counts only where contacts roll."""
    return SQUEEZE - 1 if own.contact_model == "rolling" else 0


@dataclass(frozen=True, eq=False, repr=False)
class Way(Value):
    """References and loads, step by step."""

    references: Array  # (P, n_z)
    loads: Loads  # (P)
    kept: Places
    """(T,) which of the steps end at an instant."""

    @classmethod
    def of(cls, own: Setting, references: Array, loads: Loads, parts: Places) -> Way:
        """Return the way through T instants.

        Args:
            own: the grasp, which says how the first of them is reached.
            references: (T, n_z) at the instants.
            loads: (T) at the instants.
            parts: (T,) steps from each instant to the next; the last counts for nothing.
        """
        lead = squeezes(own)
        shares, first = _shares(parts)
        last = np.minimum(first + 1, len(references) - 1)
        wrench, at_points = (
            _between(part, shares, first, last) for part in (loads.wrench, loads.at_points)
        )  # fmt: skip
        between = Loads(wrench, loads.points, at_points)
        squeeze = np.arange(1, lead + 1)[:, None] / (lead + 1)
        unloaded = own.unloaded(loads)
        before = Loads((1 - squeeze) * unloaded.wrench + squeeze * loads.wrench[:1], loads.points,
                       squeeze[:, :, None] * loads.at_points[:1])  # fmt: skip
        whole = np.concatenate([squeeze * references[:1], _between(references, shares, first, last)])
        return cls(whole, Loads.joined([before, between]), lead + np.flatnonzero(shares == 0.0))

    def states(self, own: Setting, states: States, parts: Places) -> States:
        """Return states of all steps, from those (T) of the instants: good enough for Newton's method to begin at."""
        from scipy.spatial.transform import Rotation

        shares, first = _shares(parts)
        last = np.minimum(first + 1, len(states) - 1)
        q, position, forces = (
            _between(part, shares, first, last) for part in (states.q, states.position, states.forces)
        )
        turns = rotation_vectors(states.rotation[last] @ states.rotation[first].mT)
        rotation = Rotation.from_rotvec(shares[:, None] * turns).as_matrix() @ states.rotation[first]
        squeeze = np.arange(1, squeezes(own) + 1) / (squeezes(own) + 1)
        before = [own.start if share < 0.5 else states.taken([0]) for share in squeeze]
        return States.joined([*before, States(q, position, rotation, forces)])


def steps_between(own: Setting, references: Array) -> Places:
    """Return (T,) into how many steps what follows each instant is split, from what references (T, n_z) ask for there.

    A link turns by no more than the joints that carry it do; what they ask for tells it whatever way a state is found.
    """
    parts = np.ones(len(references), dtype=np.intp)
    if own.contact_model == "rolling" and len(references) > 1:
        turned = np.abs(np.diff(references, axis=0) @ own.grasp.S.T) @ own.turning.T
        parts[:-1] = np.clip(np.ceil(turned.max(axis=1, initial=0.0) / FARTHEST), 1, MOST)
    return parts


def parts_of(kept: Places) -> Places:
    """Return (T,) into how many steps what follows each instant was split."""
    return np.append(np.diff(kept), 1)


def _shares(parts: Places) -> tuple[Array, Places]:
    """Return how far each step begins between an instant and the next, from 0 to 1, and the number of that instant."""
    first = np.repeat(np.arange(len(parts)), np.append(parts[:-1], 1))
    step = np.concatenate([np.arange(count) / count for count in (*parts[:-1], 1)])
    return step, first


def _between(values: Array, shares: Array, first: Places, last: Places) -> Array:
    """Return values on the straight ways from some of them to others."""
    own = shares.reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray((1 - own) * values[first] + own * values[last])
