"""The way from the start through all instants: it counts where contacts roll, and is gone in steps.

From one state to the next a tip rolls as with the middle of its step, which is off by the cube of the angle. So the
first squeeze is gone in steps, and so is what lies between two instants where contacts turn far from one to the next.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.equilibrium.setting import Setting
from synergrip.equilibrium.states import Loads, States, straight
from synergrip.linalg import Array, Places
from synergrip.values import Value

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
        shares, first, last = _shares(parts)
        squeeze = _squeeze(own)
        before = own.unloaded(loads).between(loads.taken([0]), squeeze)
        steps = loads.taken(first).between(loads.taken(last), shares)
        whole = [squeeze[:, None] * references[:1], straight(references[first], references[last], shares)]
        kept = len(squeeze) + np.flatnonzero(shares == 0.0)
        return cls(np.concatenate(whole), Loads.joined([before, steps]), kept)


def led_states(own: Setting, states: States, parts: Places) -> States:
    """Return states of all steps, from those (T) of the instants: good enough for Newton's method to begin at."""
    shares, first, last = _shares(parts)
    before = [own.start if share < 0.5 else states.taken([0]) for share in _squeeze(own)]
    return States.joined([*before, states.taken(first).between(states.taken(last), shares)])


def steps_between(own: Setting, references: Array) -> Places:
    """Return (T,) into how many steps what follows each instant is split, from what references (T, n_z) ask for there.

    A link turns by no more than the joints that carry it do; what they ask for tells it whatever way a state is found.
    """
    parts = np.ones(len(references), dtype=np.intp)
    if own.contact_model == "rolling" and len(references) > 1:
        turned = np.abs(np.diff(references, axis=0) @ own.grasp.S.T) @ own.turning.T
        parts[:-1] = np.clip(np.ceil(turned.max(axis=1, initial=0.0) / FARTHEST), 1, MOST)
    return parts


def _squeeze(own: Setting) -> Array:
    """Return which shares of the first references the steps before the first instant take."""
    lead = squeezes(own)
    return np.arange(1, lead + 1) / (lead + 1)


def _shares(parts: Places) -> tuple[Array, Places, Places]:
    """Return how far each step begins between an instant and the next, from 0 to 1, and the numbers of the two."""
    counts = np.append(parts[:-1], 1)
    first = np.repeat(np.arange(len(parts)), counts)
    shares = np.concatenate([np.arange(count) / count for count in counts])
    return shares, first, np.minimum(first + 1, len(parts) - 1)
