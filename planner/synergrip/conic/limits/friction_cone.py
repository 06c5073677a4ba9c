"""Every contact force inside its friction cone, with a slip margin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Self

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.conic.limits.usage import alike
from synergrip.conic.rows import Item, Kind, Rows
from synergrip.linalg import Array, sealed
from synergrip.statics.motion import Motion, largest_term

CANCELLED = 1e-9
"""Share of the terms of a sum below which a force is not told from their rounding to all digits that count."""
FRICTION = "friction cone"
"""What a cone is called that no margin is asked of: physics, and no key of a file."""


@dataclass(frozen=True)
class FrictionCone(Limit):
    """``mu n - ||(t, o)|| >= margin`` and its soft and frictionless kin, at every contact.

    With any margin, as programs need it; the margin that a task asks for is a `SlipMargin`.
    """

    margin: float = 0.0  # [N]
    key: str = field(default=FRICTION, repr=False)
    watches = "forces"

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return the second-order cones of each contact (a plain bound for a frictionless one)."""
        return friction_rows(formulation, self.margin, 0.0, self.key)

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> None:
        """Return nothing: a cone alone bounds no force."""

    def loosened(self, share: float) -> Self:
        """Return it with a margin smaller by `share`."""
        return replace(self, margin=self.margin - share * abs(self.margin))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the slip margins, by the contacts' own formula."""
        grasp = formulation.response.grasp
        margins, count = grasp.slip_margins(motion.forces), grasp.n_c
        return Usage.of_known(
            title="slip margin", unit="N", items=grasp.contact_names, value=sealed(margins),
            lower=alike(count, self.margin), upper=alike(count, np.inf), scale=alike(count, formulation.load_size),
            times=motion.times, allowance=carried(formulation, motion),
        )  # fmt: skip


def carried(formulation: Formulation, motion: Motion) -> Array:
    """Return (T, n_c) [N] the largest force component that each contact carries, or what the task asks when more.

    An error of a force is small or large against this, never against a limit that does not bind. Forces are sums over
    the synergies: where these cancel to almost nothing, what is left is their rounding.
    """
    grasp, response = formulation.response.grasp, formulation.response
    sizes = np.abs(motion.forces * response.scale.force)
    largest = np.maximum.reduceat(sizes, grasp.normal_rows, axis=1)  # from one contact's normal row to the next one's
    return sealed(np.maximum(largest, max(formulation.load_size, CANCELLED * largest_term(response, motion.dz_r))))


def friction_rows(formulation: Formulation, margin: float | Array, epigraph: float, key: str) -> list[Rows]:
    """Return rows ``W lambda - (margin - epigraph s) e_1`` in the cone, cones of one size together.

    Args:
        formulation: the task.
        margin: required margin, one for all or (T, n_c) for each knot and contact [N].
        epigraph: coefficient of the goal's scalar in the margin's place, in force units.
        key: what asks for it.
    """
    grasp, unit = formulation.response.grasp, formulation.force_unit
    asked = np.asarray(margin) / unit
    result = []
    for cones in grasp.friction_cones:
        kind = Kind.NONNEGATIVE if cones.size == 1 else Kind.SECOND_ORDER
        value = formulation.force.mapped(cones.in_units / unit)
        each = asked if not asked.ndim else np.repeat(asked[:, cones.contacts], cones.size, axis=1)
        constant = value.constant - cones.heads * each
        rows = Rows.of_known(
            limit=key, kind=kind, dim=cones.size, items=_items(cones.names), matrix=value.matrix,
            constant=sealed(constant), epigraph=sealed(epigraph * cones.heads), friction=True,
        )  # fmt: skip
        result.append(rows)
    return result


@lru_cache(maxsize=256)
def _items(names: tuple[tuple[str, str], ...]) -> tuple[Item, ...]:
    return tuple(Item(*name) for name in names)
