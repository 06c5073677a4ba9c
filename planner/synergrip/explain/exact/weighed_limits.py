"""The limits of a task with the multipliers of a ray, in plain numbers, and the wanted motion as limits beside them."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.limit import Limit
from synergrip.explain.exact.bare_limits import (
    BareFormulation,
    Cone,
    cones_of,
    is_of_quantities,
    quantities,
    seen_of_motion,
)
from synergrip.linalg import Array, frozen, split

Weighed = list[tuple[Cone, Array]]
"""Cones, each with its multipliers (K, rows)."""
NANOMETRE = 1e-9
"""[m] How closely the rigid motion has to follow the wanted one in a proof: references are no real numbers."""


def stated(limits: Sequence[Limit], formulation: Formulation) -> list[list[Cone]]:
    """Return the cones of each block of the program of some limits, in the order of its rows.

    Raises:
        ValueError: a limit adds up over time, or is on something else; in words.
    """
    bare, known = BareFormulation.of(formulation), quantities(formulation)
    found: list[list[Cone]] = []
    for limit in limits:
        parts = limit.rows(bare)
        if any(part.over_time is not None for part in parts):
            raise ValueError(f"'{limit.key}' adds up over time")
        if not is_of_quantities(limit.rows(formulation), parts, known):
            raise ValueError(f"'{limit.key}' looks at more than forces, torques, references and motions")
        found += [list(cones_of(part, bare)) for part in parts]
    return found


def weighed(cones_of_blocks: list[list[Cone]], ray: list[Array]) -> Weighed:
    """Return each cone with its multipliers (K, rows), those inside the cone to the last digit."""
    found = []
    for cones, block in zip(cones_of_blocks, ray, strict=True):
        if len(cones) > block.shape[1]:  # equations: one for each side
            block = np.stack([np.maximum(block, 0.0), np.maximum(-block, 0.0)], axis=-1).reshape(len(block), -1, 1)
        found += [(cone, _inside(block[:, i] * cone.unit)) for i, cone in enumerate(cones)]
    return found


def _inside(rows: Array) -> Array:
    """Return multipliers (K, rows) that are in the dual cone exactly."""
    result = np.array(rows)
    result[:, 0] = np.maximum(result[:, 0], np.linalg.norm(result[:, 1:], axis=1))
    for row in result:
        squares = sum(Fraction(each) ** 2 for each in row[1:])
        while Fraction(row[0]) ** 2 < squares:
            row[0] = np.nextafter(row[0], np.inf)
    return result


def tracked(formulation: Formulation, limits: Weighed) -> Weighed:
    """Return the wanted motion as cones, with the multipliers that take from the sum what it leaves of beta."""
    basis = formulation.beta_basis
    fixed = split(basis.T, 1.0).null_space if basis.size else np.eye(len(basis))
    if not fixed.shape[1]:
        return []
    n_alpha, n_beta, _ = formulation.coordinates.dimensions
    left = on_references(formulation, limits)
    nu = -left @ formulation.coordinates.inverse[:, n_alpha : n_alpha + n_beta] @ fixed
    rows, wanted = fixed.T @ seen_of_motion(formulation), formulation.beta.constant @ fixed
    found = []
    for j, row in enumerate(rows):
        for side, sign in (("lowest", 1.0), ("highest", -1.0)):
            terms = tuple((0, "motion", i, float(sign * each)) for i, each in enumerate(row) if each)
            plus = frozen(NANOMETRE - sign * wanted[:, [j]])
            cone = Cone("task.move", f"direction {j + 1}", side, 0, terms, plus, (), 1.0)
            found.append((cone, np.maximum(sign * nu[:, [j]], 0.0)))
    return found


def on_references(formulation: Formulation, limits: Weighed) -> Array:
    """Return (T, n_z) what the sum has of each reference."""
    response, T = formulation.response, formulation.knots
    of = {
        "force": response.dlambda_dzr, "torque": response.dtau_dzr, "effort": response.dsigma_dzr,
        "reference": np.eye(response.grasp.n_z), "joint": response.dq_dzr, "motion": response.du_dzr,
        "displacement": response.du_dzr,
    }  # fmt: skip
    total = np.zeros((T, response.grasp.n_z))
    for cone, y in limits:
        knots = cone.first_knot + np.arange(len(y))
        for row, name, index, factor in cone.terms:
            for lag, weights in ((0, np.ones(len(y))), *cone.earlier):
                total[knots - lag] += np.outer(y[:, row] * weights * factor, of[name][index])
    return total
