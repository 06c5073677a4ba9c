"""The statics of a grasp along a motion: subspaces of the dimensions that they had where the motion began.

Where contacts and object have moved, a rigid motion of the hand with the object is one only nearly: the null space of
(31) is gone by as much as the path bends. The directions that were the rigid motions are still those that cost the
least force, so they are taken by number, the smallest singular values first, and not by their size.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from synergrip.grasps.scale import Metric, metric_of
from synergrip.linalg import Array, canonical, frozen, gram, inverse_of
from synergrip.statics.analysis import Analysis
from synergrip.statics.each import Each, EachGrasp, EachResponse
from synergrip.statics.response import Maps
from synergrip.statics.subspaces import Bases
from synergrip.statics.theorem1 import coordinates_of


def analyse_along(start: Analysis, maps: Maps, *, G: Array, J: Array, points: Array, forces: Array) -> Each:
    """Return the analyses of a grasp at T states, with subspaces of the dimensions that it has at the start.

    Args:
        start: the analysis at the start, whose rank decisions stand.
        maps: (T, ...) how forces and motions answer there.
        G: (T, 6, n_l) grasp matrix at each state.
        J: (T, n_l, n_q) hand Jacobian.
        points: (T, n_c, 3) where forces act, from B [m].
        forces: (T, n_l) contact forces there, which become lambda_0 [N, N m].
    """
    S = np.broadcast_to(start.grasp.S, (len(G), *start.grasp.S.shape))
    w_0 = -(G @ forces[:, :, None])[:, :, 0]
    metric = metric_of(points, [component for _, component in start.grasp.components])[0]
    response = EachResponse.of(maps, EachGrasp(G, J, S, frozen(forces), frozen(w_0)))
    bases = _bases(response, metric, start.spaces.dimensions)
    return Each(response, bases, coordinates_of(response, bases, metric), metric)


def turned(each: Each, seen: Array, free: int) -> Each:
    """Return the analyses with bases of Gamma_ucs whose first `free` directions are those that are seen least.

    Args:
        each: whose coordinates beta are to be told apart.
        seen: (m, 6) what is looked at of a displacement.
        free: how many directions count as not seen.
    """
    spaces = each.spaces
    rotation = np.array(np.linalg.svd(seen @ spaces.Gamma_ucs)[2].mT[..., ::-1])
    rotation[..., :free] = canonical(rotation[..., :free])
    own = Bases(spaces.E_s, spaces.Gamma_ucs @ rotation, spaces.Gamma_zcs @ rotation, spaces.Gamma_zr)
    return replace(each, spaces=own, coordinates=coordinates_of(each.response, own, each.metric))


def _directions(matrices: Array) -> Array:
    """Return the n right singular directions of matrices (T, m, n) as columns, those of the largest values first.

    As eigenvectors of the squares: sooner, and as good as it takes, for they choose coordinates and decide no rank.
    """
    return np.linalg.eigh(gram(matrices))[1][..., ::-1]


def _bases(maps: EachResponse, metric: Metric, dimensions: tuple[int, int, int]) -> Bases:
    """Return bases (T, ...) of the subspaces of given dimensions."""
    forces, motions, _ = dimensions
    of_object, of_synergies = metric.scaled_grasp(maps.grasp.G), metric.scaled_rows(maps.grasp.J) @ maps.grasp.S
    held, triangle = np.linalg.qr(of_object)
    free = _directions(of_synergies - held @ (held.mT @ of_synergies))[..., forces:]
    free = free @ _directions(of_synergies @ free)
    synergies = free[..., :motions]
    moved = np.linalg.solve(triangle, held.mT @ of_synergies @ synergies)
    basis = canonical(moved)
    squeezed = metric.force[..., None] * maps.dlambda_dzr
    internal = squeezed @ _directions(squeezed)[..., :forces]
    internal = internal - held @ (held.mT @ internal)
    return Bases(
        E_s=canonical(internal) / metric.force[..., None],
        Gamma_ucs=np.asarray(np.linalg.solve(metric.motion, basis), dtype=np.float64),
        Gamma_zcs=synergies @ inverse_of(basis.mT @ moved),
        Gamma_zr=canonical(free[..., motions:]),
    )
