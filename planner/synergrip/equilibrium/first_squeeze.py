"""The way from the start to the first instant: it counts where contacts roll, and is gone in steps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.equilibrium.setting import Setting
from synergrip.equilibrium.states import Loads, States
from synergrip.linalg import Array
from synergrip.values import Value

SQUEEZE = 10
"""Steps in which the references of the first instant are reached."""


def squeezes(own: Setting) -> int:
    """Return how many steps of the first squeeze are gone through: the way counts only where contacts roll."""
    return SQUEEZE - 1 if own.contact_model == "rolling" else 0


@dataclass(frozen=True, eq=False, repr=False)
class Way(Value):
    """References and loads, step by step."""

    references: Array  # (T, n_z)
    loads: Loads  # (T)


def led(own: Setting, references: Array, loads: Loads, lead: int) -> Way:
    """Return references and loads with steps from the start to the first instant before them."""
    shares = np.arange(1, lead + 1)[:, None] / (lead + 1)
    first = own.unloaded(loads)
    before = Loads(
        (1 - shares) * first.wrench + shares * loads.wrench[:1],
        loads.points,
        shares[:, :, None] * loads.at_points[:1],
    )
    return Way(np.concatenate([shares * references[:1], references]), Loads.joined([before, loads]))


def led_states(own: Setting, states: States, lead: int) -> States:
    """Return states with some before them, on the way from the start: good enough for Newton's method to begin at."""
    shares = np.arange(1, lead + 1) / (lead + 1)
    parts = [own.start if share < 0.5 else states.taken([0]) for share in shares]
    return States.joined([*parts, states])
