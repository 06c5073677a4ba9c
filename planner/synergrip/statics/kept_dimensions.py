"""The statics of a grasp a little further on: subspaces of the dimensions that they had where the motion began.

Where contacts and object have moved, a rigid motion of the hand with the object is one only nearly: the null space of
(31) is gone by as much as the path bends. The directions that were the rigid motions are still those that cost the
least force, so they are taken by number, the smallest singular values first, and not by their size.
"""

from __future__ import annotations

import numpy as np

from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, canonical, frozen
from synergrip.statics.analysis import Analysis
from synergrip.statics.response import Response, respond
from synergrip.statics.subspaces import Subspaces
from synergrip.statics.theorem1 import coordinates


def analyse_like(grasp: Grasp, like: Analysis) -> Analysis:
    """Return the analysis of a grasp with subspaces of the dimensions of another.

    Args:
        grasp: of the hand and contacts of `like`, at another state.
        like: the analysis at the start, whose rank decisions stand.

    Raises:
        NotRestrainedError: the contacts leave the object a free motion there.
        RigidContactError: some contact direction has no compliance at all.
    """
    response = respond(grasp)
    spaces = _spaces(response, like.spaces)
    return Analysis(grasp, response, spaces, coordinates(response, spaces))


def turned(analysis: Analysis, seen: Array, free: int) -> Analysis:
    """Return the analysis with a basis of Gamma_ucs whose first `free` directions are those that are seen least.

    Args:
        analysis: whose coordinates beta are to be told apart.
        seen: (m, 6) what is looked at of a displacement.
        free: how many directions count as not seen.
    """
    spaces = analysis.spaces
    rotation = np.linalg.svd(seen @ spaces.Gamma_ucs)[2].T[:, ::-1]
    rotation[:, :free] = canonical(rotation[:, :free])
    motions, synergies = (frozen(basis @ rotation) for basis in (spaces.Gamma_ucs, spaces.Gamma_zcs))
    own = Subspaces(spaces.E_s, motions, synergies, spaces.Gamma_zr, spaces.decisions)
    return Analysis(analysis.grasp, analysis.response, own, coordinates(analysis.response, own))


def _spaces(response: Response, like: Subspaces) -> Subspaces:
    grasp, scale = response.grasp, response.scale
    forces, motions, _ = like.dimensions
    of_object, of_synergies = scale.scaled_grasp(grasp.G), scale.scaled_rows(grasp.J) @ grasp.S
    held = np.linalg.qr(of_object)[0]
    free = np.linalg.svd(of_synergies - held @ (held.T @ of_synergies))[2].T[:, forces:]
    free = free @ np.linalg.svd(of_synergies @ free)[2].T
    synergies, Gamma_zr = free[:, :motions], canonical(free[:, motions:])
    moved = np.linalg.lstsq(of_object, of_synergies @ synergies, rcond=None)[0]
    basis = canonical(moved)
    internal = np.linalg.svd(scale.force[:, None] * response.dlambda_dzr, full_matrices=False)[0][:, :forces]
    internal = internal - held @ (held.T @ internal)
    return Subspaces(
        E_s=frozen(canonical(internal) / scale.force[:, None]),
        Gamma_ucs=frozen(np.linalg.solve(scale.motion, basis)),
        Gamma_zcs=frozen(synergies @ np.linalg.lstsq(moved, basis, rcond=None)[0]),
        Gamma_zr=Gamma_zr,
        decisions=like.decisions,
    )
