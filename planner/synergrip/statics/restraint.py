"""Is the object held at all? The free twists of null(G'), and the refusal when a load works on one of them.

Theorem 1 assumes null(G') = 0. Where the contacts leave the object a motion, everything is as it would be if that
motion were held by a support without a force of its own: the support carries what part of the load works on the free
motion, and where there is none it carries nothing and may be thought away. `supported` adds it, so that the formulas
of a restrained grasp give forces on range(G) and motions on the complement of null(G') (docs/theory.md).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.errors import NotRestrainedError
from synergrip.grasps.compliance import joint_compliance, total_compliance
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Metric, Scale
from synergrip.grasps.stack import Matrices
from synergrip.linalg import RANK_TOLERANCE, Array, Decision, canonical, decided, frozen
from synergrip.statics.twists import describe_twist

NO_LOAD = frozen(np.zeros(6))
"""As the load of a grasp: it works on no motion, so that whatever is left free is no refusal yet."""


NONE = frozen(np.zeros((6, 0)))
"""No free motion."""


def restraint(grasp: Grasp, scale: Scale) -> tuple[Decision, Array]:
    """Return the rank decision on G', 6 when the object is restrained, and the free motions (6, k), k = 6 - rank."""
    of_object = scale.scaled_grasp(grasp.G)
    decision = decided(of_object).at(())
    return decision, NONE if decision.rank == 6 else free_directions(of_object, 6 - decision.rank)


def free_directions(of_object: Array, count: int) -> Array:
    """Return (..., 6, count), the free motions of the object in scaled coordinates, orthonormal.

    Args:
        of_object: (..., n_l, 6) the G' that `Metric.scaled_grasp` makes.
        count: how many there are, 6 less the rank.
    """
    if not count:
        return np.zeros((*of_object.shape[:-2], 6, 0))
    return canonical(np.linalg.svd(of_object)[2][..., 6 - count :, :].mT)


def supported(matrices: Matrices, metric: Metric, free: Array) -> tuple[Matrices, Metric]:
    """Return a grasp, or many (leading axes ...), with a support of every free motion as force components of its own.

    The last components of its forces are those of the support. It yields as contacts do on the average, which is of
    no account: without a load on it, it carries no force.

    Args:
        matrices: of the grasp.
        metric: its scaled coordinates.
        free: (..., 6, k) from `free_directions`; with k = 0 the grasp comes back as it is.
    """
    count = free.shape[-1]
    if not count:
        return matrices, metric
    J, n_l = metric.scaled_rows(matrices.J), matrices.G.shape[-1]
    C_s = metric.scaled_rows(matrices.C_s) / metric.force[..., None, :]
    total = total_compliance(C_s, J, joint_compliance(matrices.C_q, matrices.S, matrices.C_z))
    yields = np.trace(total, axis1=-2, axis2=-1)[..., None, None] / n_l
    leading = matrices.G.shape[:-2]
    beside = np.zeros((*leading, n_l, count))
    C_s = np.concatenate([
        np.concatenate([matrices.C_s, beside], axis=-1),
        np.concatenate([beside.mT, yields * np.eye(count)], axis=-1),
    ], axis=-2)  # fmt: skip
    G = np.concatenate([matrices.G, metric.motion.mT @ free], axis=-1)
    J = np.concatenate([matrices.J, np.zeros((*leading, count, matrices.J.shape[-1]))], axis=-2)
    force = np.concatenate([metric.force, np.ones((*leading, count))], axis=-1)
    return Matrices(G, J, matrices.S, C_s, matrices.C_q, matrices.C_z), Metric(metric.motion, force)


def without_support(parts: dict[str, Array], metric: Metric, free: Array) -> dict[str, Array]:
    """Return the maps of a grasp from those of the same with a support of its free motions (6, k).

    What the support carries is taken out, and what it would let the object move.

    Args:
        parts: maps by what they give ("du", ...), of references and then of the load, both about the centroid: about B,
            which may be far away, what the support carries would have no digits left.
        metric: the scaled coordinates.
        free: (6, k) from `free_directions`.
    """
    if not (count := free.shape[-1]):
        return parts
    size = np.repeat([1.0, metric.motion[5, 5]], 3)[:, None]
    seen, moved = size * free, free / size
    motion = parts["du"] - moved @ (seen.T @ parts["du"])
    motion[:, -6:] -= (motion[:, -6:] @ seen) @ moved.T
    return parts | {"dlambda": parts["dlambda"][:-count], "du": motion}


def twists_of(free: Array, scale: Scale) -> Array:
    """Return (6, k) the free motions in SI units about B, of length 1 in scaled coordinates."""
    return frozen(np.linalg.solve(scale.motion, free))


def refuse_load(grasp: Grasp, scale: Scale, free: Array, load: Array, when: Sequence[str] = ()) -> None:
    """Refuse loads that work on a free motion, to the rank tolerance of the largest of them.

    Args:
        grasp: the grasp.
        scale: its scale.
        free: (6, k) from `free_directions`.
        load: (T, 6) wrenches that the grasp is to hold [N, N m].
        when: the words before "the load", for each of them; none when there is no telling.

    Raises:
        NotRestrainedError: with the free twists and the largest part of the load that no contact force can balance.
    """
    if not free.size:
        return
    scaled = scale.wrench(load)
    parts = scaled @ free
    k = int(np.argmax(np.linalg.norm(parts, axis=1)))
    if np.linalg.norm(parts[k]) <= RANK_TOLERANCE * float(np.linalg.norm(scaled, axis=1).max()):
        return
    unsupported = scale.motion.T @ free @ parts[k]
    force = ", ".join(f"{x:.3g}" for x in np.round(unsupported, 12) + 0.0)
    what = f"{when[k] if when else ''}the load has a part that no contact force can balance: ({force}) N, N m"
    raise not_restrained(grasp, scale, free, what, unsupported)


def not_restrained(grasp: Grasp, scale: Scale, free: Array, what: str, unsupported: Array) -> NotRestrainedError:
    """Return the refusal: the free motions, and what of the task asks for one of them."""
    twists, count = twists_of(free, scale), free.shape[1]
    described = "; ".join(describe_twist(twist, grasp.contacts, scale.length) for twist in twists.T)
    text = (
        f"the contacts do not restrain the object: {count} free motion{'s' if count > 1 else ''} ({described}), and "
        f"{what}; add a contact, or make one a soft finger"
    )
    return NotRestrainedError(text, twists, frozen(unsupported))


def told_as_free(grasp: Grasp, scale: Scale, twists: Array) -> str:
    """Return what the object may do that no contact resists, such as "turn about the line through A and B", if any."""
    if not twists.size:
        return ""
    described = (describe_twist(twist, grasp.contacts, scale.length) for twist in twists.T)
    verbs = (("rotation about ", "turn about "), ("translation along ", "move along "))
    said = []
    for words in described:
        for noun, verb in verbs:
            words = verb + words.removeprefix(noun) if words.startswith(noun) else words
        said.append(words)
    return f"the object may {', and '.join(said)}"
