"""Every margin of every contact at every instant: how far it is from slipping, in the measures that people use.

The cone of a contact is ``(W lambda)_0 >= ||(W lambda)_1..||`` (theory.md); of several the one that is nearest counts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from synergrip.conic.limits.ties import first_worst
from synergrip.documents.naming import made_by
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.values import Value

FORMULAS = (
    ("slip margin", "N", "mu n - t; t = ||(t, o)||, of a soft finger sqrt(t^2 + o^2 + (mu m / nu)^2)"),
    ("cone distance", "N", "slip margin / sqrt(1 + mu^2)"),
    ("angle to cone", "deg", "atan(mu) - atan(t / n)"),
    ("friction safety factor", "", "mu n / t"),
    ("required friction", "", "t / n"),
    ("lift-off margin", "N", "n - n_min"),
)
"""Name, unit and formula of every measure."""
MOST_IS_WORST = "required friction"
"""The one measure of which the most is worst."""


@made_by("margins(grasp, task).measures")
@dataclass(frozen=True, eq=False, repr=False)
class Measure(Value):
    """One measure of all contacts, joints or actuators over time.

    Example:
        >>> slip = margins(grasp, task).measures["slip margin"]  # doctest: +SKIP
        >>> slip.worst.name, slip.worst.time_s, slip.worst.value  # doctest: +SKIP
        ('thumb/tip', 1.5, 0.2)
    """

    name: str
    unit: str
    formula: str
    value: Array  # (T, m)
    items: tuple[str, ...]
    """(m) names of what it is of: all contacts, or the joints or actuators that have a limit."""
    times: Array  # (T,) [s]
    most_is_worst: bool = False
    of: Literal["contact", "joint", "actuator"] = "contact"

    @property
    def worst(self) -> Worst:
        """Where it is worst, and when first."""
        scale = None if self.unit else 1.0  # quotients are 1 where something ends, and huge by rounding
        k, i = first_worst(self.value if self.most_is_worst else -self.value, self.value, scale=scale)
        return Worst(float(self.value[k, i]), self.items[i], float(self.times[k]))


@dataclass(frozen=True)
class Worst:
    """A value, the contact, joint or actuator that has it, and when."""

    value: float
    name: str
    time_s: float


def measures(grasp: Grasp, times: Array, forces: Array, least: Sequence[float] | float = 0.0) -> dict[str, Measure]:
    """Return every measure by its name.

    Args:
        grasp: says what the contacts are.
        times: (T,) [s].
        forces: (T, n_l) contact forces [N, N m].
        least: the normal force below which a contact counts as lifted off [N].
    """
    pairs = [(contact, forces[:, rows]) for contact, rows in zip(grasp.contacts, grasp.rows, strict=True)]
    slip = grasp.slip_margins(forces)
    nearest = (contact.nearest_cone(own) for contact, own in pairs)
    head, tail, mu = (np.stack(parts, axis=1) for parts in zip(*nearest, strict=True))
    names, normal, shears = grasp.contact_names, forces[:, grasp.normal_rows], tail > 0
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(shears, head / tail, np.inf)
        needed = np.where(shears, np.where(head > 0, mu * tail / head, np.inf), 0.0)
    narrow = np.where(shears | (mu > 0), np.degrees(np.arctan(mu) - np.arctan(needed)), np.inf)
    values = (slip, slip / np.sqrt(1 + mu**2), narrow, ratio, needed, normal - least)
    return {
        name: Measure(name, unit, formula, frozen(value), names, times, name == MOST_IS_WORST)
        for (name, unit, formula), value in zip(FORMULAS, values, strict=True)
    }
