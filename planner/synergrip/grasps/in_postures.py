"""One hand in many postures around an object: a stack of grasps, all made in one go."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from synergrip.documents.judging import Arguments, as_numbers, described
from synergrip.documents.naming import naming_arguments
from synergrip.documents.quantities import in_mm
from synergrip.errors import InputError, Issue
from synergrip.grasps.ball import REACH
from synergrip.grasps.contact_maps import component_places, grasp_matrices, hand_jacobians, moved_points
from synergrip.grasps.contacts.contact import contact_frames
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.held import Held
from synergrip.grasps.placing import ALONG, SAME_SPOT
from synergrip.grasps.postures import Postures
from synergrip.grasps.stack import GraspStack, Matrices
from synergrip.hands.point_motion import PointMotions
from synergrip.linalg import Array, frozen
from synergrip.vectors import crossed, lengths_of, times

Flags = NDArray[np.bool_]
SHOWN = 5
"""Of so many postures it is said what is wrong; of the others, how many they are."""


@naming_arguments
def grasps_in_postures(
    grasp: Grasp, q: Array, *, positions: Array | None = None, normals: Array | None = None
) -> GraspStack:
    """Return the grasps that a hand has in N postures with the pads that touch in one of its grasps.

    Each is what `make_grasp` makes of the posture with the same contacts, stiffnesses and synergies: thousands a
    second, for `analyse_many`, `plan_many` and `margins_many`. Load and friction of each are given to these.

    Args:
        grasp: on a hand, from `make_grasp` or a problem: hand, object, contacts, compliances.
        q: (N, n_q) joint values [rad or m].
        positions: (N, 3) of the object frame B in the palm frame [m]; where the object of `grasp` is when absent.
        normals: (N, n_c, 3) of the contacts, of any length, toward the object, in the palm frame; when absent, those of
            the object's surface, within 0.5 mm of which all pads must then be, or of the pads where they state them.

    Returns:
        the stack; ``stack[i]`` is a grasp on the hand, in posture i.

    Raises:
        InputError: a grasp given as matrices, arrays that do not fit, pads that do not reach the object or face away
            from it; with the numbers of the postures.

    Example:
        >>> from synergrip import load_problem, plan_many
        >>> problem = load_problem("barrett-ball-hold")
        >>> grasp = problem.grasp
        >>> q = grasp.held.q + 0.005 * np.random.default_rng(0).normal(size=(1000, grasp.n_q))
        >>> normals = np.broadcast_to([contact.normal for contact in grasp.contacts], (1000, 3, 3))
        >>> stack = grasps_in_postures(grasp, q, normals=normals)
        >>> len(stack), stack[7].held.q.tolist() == q[7].tolist()
        (1000, True)
    """
    held, q, positions, given = _judged(grasp, q, positions, normals)
    pads = [touch.pad for touch in held.touches]
    motions = held.hand.kinematics.along(q, [(pad.link, pad.point) for pad in pads])
    seen = motions.position - positions[:, None]
    pushing = times(motions.rotation, np.array([pad.normal for pad in pads]))
    found, to_surface = _directions(held, seen, pushing, given)
    points = seen + np.array([pad.radius for pad in pads])[:, None] * to_surface
    _refuse(held, "q", _near_another(points), lambda k, i: "touches on the spot of another one; leave one of them out")
    frames = contact_frames(found, _tangents(held, motions, found))
    places = component_places(grasp.contacts)
    G = grasp_matrices(points, frames, places)
    J = hand_jacobians(moved_points(motions.jacobian, points - seen), frames, places)
    others = (np.broadcast_to(each, (len(q), *each.shape)) for each in (grasp.S, grasp.C_s, grasp.C_q, grasp.C_z))
    w_0 = np.broadcast_to(grasp.w_0, (len(q), 6))
    postures = Postures(frozen(q), frozen(positions), frozen(frames))
    return GraspStack(Matrices(frozen(G), frozen(J), *others), frozen(points), w_0, grasp, postures=postures)


def _judged(
    grasp: Grasp, q: Array, positions: Array | None, normals: Array | None
) -> tuple[Held, Array, Array, Array | None]:
    judge = Arguments("")
    if judge.one("grasp", grasp, Grasp, 'load_problem("barrett-ball-hold").grasp') is None:
        judge.finish()
    if grasp.held is None:
        raise InputError.at("grasp", "is given as matrices, which have no postures; give GraspStack.varied its arrays")
    found = as_numbers(q)
    if found is None or found.ndim != 2 or found.shape[1] != grasp.n_q or not len(found):
        raise InputError.at("q", f"expected postures (N, {grasp.n_q}), joint values [rad or m]; got {described(q)}")
    count = len(found)
    place = np.broadcast_to(grasp.held.body.position, (count, 3)) if positions is None else positions
    place = judge.array("positions", place, (count, 3), " [m], one for each posture")
    judge.array("q", q, found.shape, ", joint values [rad or m]")
    own = None
    if normals is not None:
        own = judge.array("normals", normals, (count, grasp.n_c, 3), ", one for each posture and contact")
    judge.finish()
    if own is not None and np.any(none := ~(lengths_of(own) > 0).all(axis=1)):
        raise InputError.at(f"normals[{int(np.argmax(none))}]", "a normal must not be 0")
    return grasp.held, found, place, own


def _directions(held: Held, seen: Array, pushing: Array, given: Array | None) -> tuple[Array, Array]:
    """Return the normals (N, n_c, 3) of contacts, and the directions from the pads' points to where they touch.

    Args:
        held: the hand, the object and the pads.
        seen: (N, n_c, 3) the pads' points from B [m].
        pushing: (N, n_c, 3) where each pad pushes by itself; 0 where that is not stated.
        given: (N, n_c, 3) normals, if any are.
    """
    aimed = np.array([touch.aimed for touch in held.touches])
    if given is not None:
        inward = normals = to_surface = given / lengths_of(given)[..., None]
        alone = np.zeros(len(aimed), dtype=bool)
    else:
        inward = _inward(held, seen, pushing)
        by_pad = np.array([touch.normals == "pad" for touch in held.touches])
        alone = np.array([touch.alone(held.body) for touch in held.touches])
        normals = np.where(by_pad[:, None], pushing, inward)
        to_surface = np.where((aimed & (held.body.shape is None))[:, None], pushing, inward)
    cosines = np.minimum((normals * pushing).sum(axis=-1), (normals * inward).sum(axis=-1))
    _refuse(held, "q", (cosines <= 0) & aimed & ~alone, lambda k, i: "faces away from the object")
    return normals, to_surface


def _inward(held: Held, seen: Array, pushing: Array) -> Array:
    """Return unit vectors (N, n_c, 3) from pads at `seen` into the object's surface, or to its centre."""
    body = held.body
    if body.shape is None:
        lengths = lengths_of(seen)[..., None]
        return np.asarray(np.where(lengths > 0, -seen / np.where(lengths > 0, lengths, 1.0), pushing))
    distances, outward = body.shape.surface(seen)
    off = distances - np.array([touch.pad.radius for touch in held.touches])
    hint = "; change the posture, give positions, or normals where the contacts are known"

    def told(k: int, i: int) -> str:
        side = "outside" if off[k, i] > 0 else "inside"
        return f"is {in_mm(abs(off[k, i]))} {side} the surface of the {body.title}{hint}"

    _refuse(held, "q", np.abs(off) > REACH, told)
    return np.asarray(-outward)


def _tangents(held: Held, motions: PointMotions, normals: Array) -> Array | None:
    """Return the directions (N, n_c, 3) that t of the contacts follow; None where none of them states one."""
    stated = [touch.tangent for touch in held.touches]
    if not any(stated):
        return None
    free = contact_frames(normals)[..., 1]
    along = times(motions.rotation, np.array([each or (0.0, 0.0, 0.0) for each in stated]))
    found = np.where(np.array([each is not None for each in stated])[:, None], along, free)
    across = lengths_of(crossed(found, normals))
    _refuse(held, "q", across < ALONG, lambda k, i: "has its tangent along its normal; give a direction across it")
    return np.asarray(found)


def _near_another(points: Array) -> Flags:
    """Return (N, n_c) which contacts are on the spot of an earlier one."""
    apart = lengths_of(points[:, :, None] - points[:, None])
    return np.asarray((np.tril(apart < SAME_SPOT, -1)).any(axis=2))


def _refuse(held: Held, key: str, wrong: Flags, told: Callable[[int, int], str]) -> None:
    """Raise the error of the postures with contacts that are wrong (N, n_c), saying of the first few why."""
    if not np.any(wrong):
        return
    places = np.flatnonzero(wrong.any(axis=1))
    issues = []
    for k in places[:SHOWN].tolist():
        i = int(np.argmax(wrong[k]))
        issues.append(Issue(f"pad '{held.touches[i].pad.name}' {told(k, i)}", key=f"{key}[{k}]"))
    if len(places) > SHOWN:
        issues.append(Issue(f"{len(places) - SHOWN} more postures are wrong in the same way", key=key))
    raise InputError(issues)
