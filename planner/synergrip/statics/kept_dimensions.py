"""The statics of a grasp along a motion: subspaces of the dimensions that they had where the motion began.

Where contacts and object have moved, a rigid motion of the hand with the object is one only nearly: the null space of
(31) is gone by as much as the path bends. The directions that were the rigid motions are still those that cost the
least force, so they are taken by number, the smallest singular values first, and not by their size.
"""

from __future__ import annotations

from copy import copy
from dataclasses import fields

import numpy as np

from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Metric, Scale, metric_of
from synergrip.grasps.stack import GraspStack, Matrices
from synergrip.linalg import Array, canonical, frozen
from synergrip.statics.analysis import Analysis
from synergrip.statics.response import FIGURES, Accuracy, Maps, Response
from synergrip.statics.responses import Responses, respond_many
from synergrip.statics.subspaces import Bases, Subspaces
from synergrip.statics.theorem1 import Coordinates, coordinates, coordinates_of


def analyse_along(start: Analysis, *, G: Array, J: Array, points: Array, forces: Array) -> tuple[Analysis, ...]:
    """Return the analyses of a grasp at T states, with subspaces of the dimensions that it has at the start.

    Args:
        start: the analysis at the start, whose rank decisions stand.
        G: (T, 6, n_l) grasp matrix at each state.
        J: (T, n_l, n_q) hand Jacobian.
        points: (T, n_c, 3) where forces act, from B [m].
        forces: (T, n_l) contact forces there, which become lambda_0 [N, N m].

    Raises:
        NotRestrainedError: the contacts leave the object a free motion at some state.
        RigidContactError: some contact direction has no compliance at all.
    """
    w_0 = -np.einsum("tij,tj->ti", G, forces)
    stack = GraspStack.varied(start.grasp, G=G, J=J, points=points, w_0=w_0)
    responses = respond_many(stack)
    for refusal in responses.refusals.values():
        raise refusal
    bases = _bases(responses, stack.matrices, stack.metric, start.spaces.dimensions)
    found = coordinates_of(responses, bases, stack.metric)
    scales = _scales(points, start.grasp)
    grasps = [_at(start.grasp, G=G[k], J=J[k], lambda_0=forces[k], w_0=w_0[k]) for k in range(len(G))]
    return tuple(
        Analysis(
            grasp,
            _response(responses, k, grasp, scales[k]),
            Subspaces(**{each.name: frozen(getattr(bases, each.name)[k]) for each in fields(Bases)},
                      decisions=start.spaces.decisions),
            Coordinates(frozen(found.M[k]), frozen(found.inverse[k]), found.dimensions),
        )
        for k, grasp in enumerate(grasps)
    )  # fmt: skip


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


def _bases(maps: Maps, matrices: Matrices, metric: Metric, dimensions: tuple[int, int, int]) -> Bases:
    """Return bases (T, ...) of the subspaces of given dimensions."""
    forces, motions, _ = dimensions
    of_object, of_synergies = metric.scaled_grasp(matrices.G), metric.scaled_rows(matrices.J) @ matrices.S
    held = np.linalg.qr(of_object)[0]
    free = np.linalg.svd(of_synergies - held @ (held.mT @ of_synergies))[2].mT[..., forces:]
    free = free @ np.linalg.svd(of_synergies @ free)[2].mT
    synergies = free[..., :motions]
    moved = np.linalg.pinv(of_object) @ of_synergies @ synergies
    basis = canonical(moved)
    internal = np.linalg.svd(metric.force[..., None] * maps.dlambda_dzr, full_matrices=False)[0][..., :forces]
    internal = internal - held @ (held.mT @ internal)
    return Bases(
        E_s=canonical(internal) / metric.force[..., None],
        Gamma_ucs=np.asarray(np.linalg.solve(metric.motion, basis), dtype=np.float64),
        Gamma_zcs=synergies @ (np.linalg.pinv(moved) @ basis),
        Gamma_zr=canonical(free[..., motions:]),
    )


def _at(grasp: Grasp, **arrays: Array) -> Grasp:
    """Return the grasp with matrices of another state; they come from an equilibrium and need no judging."""
    there = copy(grasp)
    for name, array in arrays.items():
        object.__setattr__(there, name, frozen(array))
    return there


def _response(responses: Responses, k: int, grasp: Grasp, scale: Scale) -> Response:
    maps = {field.name: frozen(getattr(responses, field.name)[k]) for field in fields(Maps)}
    rows = zip(FIGURES, responses.figures[k].tolist(), strict=True)
    accuracy = {name: Accuracy(*row) for name, row in rows}
    return Response(**maps, grasp=grasp, scale=scale, restraint=responses.restraint.at(k), accuracy=accuracy)


def _scales(points: Array, grasp: Grasp) -> list[Scale]:
    metric, lengths, centroids = metric_of(points, [component for _, component in grasp.components])
    each = zip(metric.motion, metric.force, lengths.tolist(), centroids, strict=True)
    return [Scale(frozen(motion), frozen(force), length, frozen(centroid)) for motion, force, length, centroid in each]
