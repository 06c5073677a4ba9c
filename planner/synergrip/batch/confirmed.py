"""Statics of many grasps confirmed by their own equations, in NumPy, by code that knows nothing of how they were found.

A linear map that meets an equation on a vector of no particular direction meets it on all (R. Freivalds, 1977): what
costs a product of matrices to work out costs two products with a vector to confirm.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from synergrip.conic.affine import times
from synergrip.grasps.stack import GraspStack
from synergrip.linalg import Array
from synergrip.statics.each import Each

EQUAL = 1e-9
"""By how much of the largest term two sides of an equation may differ."""
REGULAR = 1e7
"""How many times the sizes of M and of its inverse, with rows made as long, may make at most."""


@np.errstate(all="ignore")
def confirmed(stack: GraspStack, each: Each) -> NDArray[np.bool_]:
    """Return (N,) whether maps and bases are those of the grasps: forces, motions, what synergies control."""
    return _balanced(stack, each) & _controlled(stack, each)


def _balanced(stack: GraspStack, each: Each) -> NDArray[np.bool_]:
    """Return (N,) whether contact forces hold the load, and contacts, joints and synergies yield by them. (7)-(16)."""
    matrices, metric, maps = stack.matrices, stack.metric, each.response
    rng, N = np.random.default_rng(1), len(each)
    force = metric.force
    size = np.sqrt(np.einsum("Nij,Nij->N", maps.dlambda_dzr, maps.dlambda_dzr))
    dz_r = rng.normal(size=maps.dlambda_dzr.shape[-1]) / size[:, None]
    w = times(metric.motion.mT, np.broadcast_to(rng.normal(size=6), (N, 6)))

    def answer(name: str) -> Array:
        return times(getattr(maps, f"d{name}_dzr"), dz_r) + times(getattr(maps, f"d{name}_dw"), w)

    forces, motion, joints = answer("lambda"), answer("u"), answer("q")
    torques = times(matrices.J.mT, forces)
    moved = times(matrices.S, dz_r - times(matrices.C_z, times(matrices.S.mT, torques)))
    yielding = times(matrices.C_q, torques)
    terms = (times(matrices.J, moved - yielding), -times(matrices.C_s, forces), -times(matrices.G.mT, motion))
    fits = _nothing((terms[0] + terms[1] + terms[2]) / force, *(term / force for term in terms))
    balance = metric.scaled_wrenches(times(matrices.G, forces) + w)
    return fits & _nothing(balance, forces * force) & _nothing(moved - yielding - joints, moved, yielding)


def _controlled(stack: GraspStack, each: Each) -> NDArray[np.bool_]:
    """Return (N,) whether bases and M are as Theorem 1 says: forces of E_s alone, and rigid motions."""
    matrices, metric, maps, spaces = stack.matrices, stack.metric, each.response, each.spaces
    rng, n_alpha = np.random.default_rng(2), spaces.E_s.shape[-1]
    M, inverse = each.coordinates.M, each.coordinates.inverse
    alpha = np.broadcast_to(rng.normal(size=n_alpha), (len(each), n_alpha))
    dz_r, forces = times(inverse[..., :n_alpha], alpha), times(spaces.E_s, alpha)
    made = times(maps.dlambda_dzr, dz_r)
    right = _nothing((made - forces) * metric.force, forces * metric.force)
    squares = np.einsum("Nij,Nij->Ni", M, M)  # with rows made as long, the root of their number is the size of M
    beside = M.shape[-1] * (np.einsum("Nij,Nij->Nj", inverse, inverse) * squares).sum(axis=-1)
    right &= (beside <= REGULAR**2) & (squares.min(axis=-1) > 0)
    if not (n_beta := spaces.Gamma_ucs.shape[-1]):
        return right
    scaled = metric.motion @ spaces.Gamma_ucs
    along = times(scaled.mT, times(metric.motion, times(maps.du_dzr, dz_r)))
    right &= _size(along) <= EQUAL * np.sqrt(squares.max(axis=1)) * _size(dz_r)
    beta = np.broadcast_to(rng.normal(size=n_beta), (len(each), n_beta))
    of_hand = times(matrices.J, times(matrices.S, times(spaces.Gamma_zcs, beta))) / metric.force
    of_object = times(matrices.G.mT, times(spaces.Gamma_ucs, beta)) / metric.force
    return right & _nothing(of_hand - of_object, of_hand, of_object)


def _nothing(rest: Array, *terms: Array) -> NDArray[np.bool_]:
    """Return (N,) whether a rest (N, m) is nothing beside its terms."""
    return np.asarray(_size(rest) <= EQUAL * np.max([_size(term) for term in terms], axis=0))


def _size(values: Array) -> Array:
    """Return (N,) the lengths of vectors (N, m)."""
    return np.asarray(np.sqrt(np.einsum("Nj,Nj->N", values, values)))
