"""How large the terms are that the numbers of a plan are made of: rounding is small against these, not against sums."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.conic.limits.limit import Usage
from synergrip.linalg import largest_size
from synergrip.planning.arrays import ARRAYS, Size, columns_of
from synergrip.planning.between import Between
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import Motion, forces_at_start

EXACT = 1e-11
"""Rounding of a number, as a share of the terms that it is made of: what another processor may make of it."""
GIVEN_UP = 1e-6
"""Share of the largest force by which the margin of a plan may be smaller than the largest, so that the goals after it
have room."""


@dataclass(frozen=True)
class Sizes:
    """Sizes of terms by the keys of plan.json; arrays for their columns."""

    by_key: Mapping[str, Any]

    def of(self, key: str) -> Any:
        """Return the size of a key; 0 where numbers are not sums."""
        return self.by_key.get(key, 0.0)


def sizes_of(analysis: Analysis, motion: Motion, usages: Sequence[Usage], between: Between | None) -> Sizes:
    """Return the sizes of the terms of everything that is told of a motion.

    Args:
        analysis: of the grasp.
        motion: what the references do.
        usages: what is told of it at its knots.
        between: what is told of it between them.
    """
    response, grasp, scale = analysis.response, analysis.grasp, analysis.response.scale
    dz_r, dw = np.abs(motion.dz_r).max(axis=0), np.abs(motion.wrench - grasp.w_0).max(axis=0)
    against_a_fixed_object = np.abs(scale.force[:, None] * (response.K @ grasp.J @ grasp.S)) @ dz_r
    loaded = np.abs(scale.force[:, None] * response.dlambda_dw) @ dw
    known = (scale.largest_force(motion.forces), scale.largest_force(forces_at_start(response)))
    unsure = max(1.0, max(each.error for each in response.accuracy.values()) / EXACT)  # of the maps themselves
    force = unsure * max(*known, largest_size(against_a_fixed_object), largest_size(loaded))
    forces = force / scale.force
    torque = largest_size(np.abs(grasp.J.T) @ forces)
    effort = largest_size(np.abs(grasp.S.T) @ np.abs(grasp.J.T) @ forces)
    moves = np.abs(response.du_dzr) @ dz_r + np.abs(response.du_dw) @ dw
    path = unsure * max(largest_size(moves[:3]), scale.length * largest_size(moves[3:]))
    du = path / np.repeat([1.0, scale.length], 3)
    dq = unsure * largest_size(np.abs(response.dq_dzr) @ dz_r + np.abs(response.dq_dw) @ dw)
    references = largest_size(dz_r)
    load = max(largest_size(motion.wrench[:, :3]), largest_size(motion.wrench[:, 3:]) / scale.length)
    wrench = load * np.repeat([1.0, scale.length], 3)
    of_unit = {"N": force, "N m": max(torque, effort), "m": path}
    limits, there = (
        [max(largest_size(each.value), of_unit.get(each.unit, max(dq, references))) for each in of]
        for of in (usages, between.usages if between is not None else ())
    )
    looks = {"load_departure_N": force, "path_departure_m": path, "worst_margin_N": force, "limits": there}
    of_terms: dict[Size, Any] = {
        "exact": 0.0, "references": references, "force": force, "forces": forces, "wrench": wrench, "torque": torque,
        "effort": effort, "path": path, "du": du, "dq": dq,
    }  # fmt: skip
    by_key = {each.key: of_terms[each.size] for each in ARRAYS} | {
        "margin": {"worst_N": force, "per_contact_N": force}, "force_unit_N": force, "limits": limits,
        "structure": {"singular_values": 1.0}, "true": {
            "margin": {"worst_N": force, "per_contact_N": force}, "lambda": forces, "du": du, "q": dq,
            "place_m": path + scale.length, "normal": 1.0 + path / scale.length, "force_N": force,
            "smallest_stiffness_N_m": float(np.linalg.norm(response.K, 2)),
        }, "between": looks, "largest_margin_N": GIVEN_UP / EXACT * force,
    }  # fmt: skip
    columns = {
        name: size
        for key, names in columns_of(grasp).items()
        for name, size in zip(names, np.broadcast_to(_of_columns(by_key[key]), len(names)), strict=True)
    }
    return Sizes(by_key | {"columns": columns})


def _of_columns(size: Any) -> Any:
    """Return the size of the columns of plan.csv that belong to a key: one, or one for each."""
    return size["per_contact_N"] if isinstance(size, Mapping) else size
