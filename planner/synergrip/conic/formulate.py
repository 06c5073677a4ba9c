"""From a task, as numbers at knots, to the affine functions of its unknowns."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.conic.affine import Affine
from synergrip.conic.affine import times as product
from synergrip.conic.each_knot import judge_each
from synergrip.conic.formulation import Formulation
from synergrip.conic.units import Units
from synergrip.linalg import Array, frozen, sealed
from synergrip.statics import Coordinates, Response, Subspaces
from synergrip.statics.analysis import Analysis
from synergrip.statics.each import Each


def formulate(
    response: Response, spaces: Subspaces, coords: Coordinates, *,
    times: Array, wrench: Array, beta: Array, units: Units, redundancy: bool,
    beta_basis: Array | None = None, target: Array | None = None, stated: Units | None = None,
    each: Sequence[Analysis] | Each | None = None,
) -> Formulation:  # fmt: skip
    """Write a task as affine functions of its unknowns.

    Args:
        response: response maps of the grasp.
        spaces: its subspaces.
        coords: its M (35).
        times: (T,) [s].
        wrench: (T, 6) external wrench on the object.
        beta: (T, dim Gamma_ucs) rigid motion.
        units: sizes of the unknowns.
        redundancy: whether gamma is an unknown (some limit looks at more than forces) or zero.
        beta_basis: (dim Gamma_ucs, m) orthonormal directions in which beta may differ from what is given; none.
        target: (T, 6) displacement that limits on the object's motion measure against; Gamma_ucs beta when None.
        stated: units in which weights are stated; those of the unknowns when None.
        each: (T,) the grasp at every knot, when it is not the same at all.

    Raises:
        InputError: `each` do not fit the knots, or the grasp.
    """
    judge_each(each, response, spaces, len(times))
    n_alpha, n_beta, n_gamma = spaces.dimensions
    basis = np.zeros((n_beta, 0)) if beta_basis is None else beta_basis
    before = n_alpha + n_gamma * redundancy
    n_v = before + basis.shape[1]
    alpha = np.eye(n_alpha, n_v) * units.force
    gamma, motion = np.zeros((n_gamma, n_v)), np.zeros((n_beta, n_v))
    gamma[:, n_alpha:before] = np.eye(n_gamma, n_gamma * redundancy) * units.reference
    motion[:, before:] = basis * units.motion
    zeros = np.zeros((len(times), n_alpha + n_gamma))
    every = None if each is None else Each.of(each)
    Gamma_ucs = (spaces if every is None else every.spaces).Gamma_ucs
    return Formulation(
        response, spaces, coords, frozen(times), frozen(wrench),
        Affine(sealed(alpha), sealed(zeros[:, :n_alpha])), Affine(sealed(motion), frozen(beta)),
        Affine(sealed(gamma), sealed(zeros[:, n_alpha:])),
        frozen(product(Gamma_ucs, beta) if target is None else target), units, stated or units, units.force,
        each=every,
    )  # fmt: skip
