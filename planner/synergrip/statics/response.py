"""How forces and motions answer to synergy references and to the external wrench. Equations (17)-(28).

With the total compliance ``C = C_s + J C_q J' + J S C_z S' J'`` everything is one linear system, so C_q = 0
and C_z = 0 are ordinary values and the paper's X (24) and Y (25) are never formed (docs/theory.md).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from synergrip.documents.judging import Arguments, described, expected
from synergrip.documents.naming import naming_arguments
from synergrip.grasps.compliance import compliance_of
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Metric, Scale, scale_of
from synergrip.grasps.stack import Matrices
from synergrip.linalg import SINGULAR, Array, Decision, frozen
from synergrip.statics.accuracy import FIGURES, Accuracy, accuracies, shares
from synergrip.statics.restraint import NONE, refuse_load, restraint, supported, twists_of, without_support
from synergrip.statics.saddle import DOUBLED, FLOAT64, Answer, Arithmetic, about_centroid, answer
from synergrip.statics.yielding import refuse_rigid_contacts
from synergrip.values import Value

ENOUGH = 1e-11
"""Relative error of the maps up to which float64 is believed; beyond it they are worked out in twice the digits."""


@dataclass(frozen=True, eq=False, repr=False)
class Maps(Value):
    """Linear maps of a grasp, or of each of many (leading axes ...); SI units. Forces act on the object.

    Where contacts leave the object a free motion, they speak of loads that do not work on it, and of the rest of the
    object's motion: along the free one it is taken as 0.
    """

    dlambda_dzr: Array  # (..., n_l, n_z) (28)
    du_dzr: Array  # (..., 6, n_z) (27)
    dtau_dzr: Array  # (..., n_q, n_z)
    dsigma_dzr: Array  # (..., n_z, n_z)
    dz_dzr: Array  # (..., n_z, n_z) (25)
    dq_dzr: Array  # (..., n_q, n_z) (26)
    dlambda_dw: Array  # (..., n_l, 6) = -G+
    du_dw: Array  # (..., 6, 6) = (G K G')^-1: the object sags under load
    dz_dw: Array  # (..., n_z, 6)
    dq_dw: Array  # (..., n_q, 6)

    @property
    def right_inverse(self) -> Array:
        """(..., n_l, 6) ``G+ = K G' (G K G')^-1``, K = C^-1."""
        return -self.dlambda_dw

    @cached_property
    def of_references(self) -> Array:
        """(..., n_z, n_l + 6 + n_q + n_z) what references do to forces, object, joints and synergies, side by side."""
        return _side_by_side(self.dlambda_dzr, self.du_dzr, self.dq_dzr, self.dz_dzr)

    @cached_property
    def of_load(self) -> Array:
        """(..., 6, n_l + 6 + n_q + n_z) what the load does to them."""
        return _side_by_side(self.dlambda_dw, self.du_dw, self.dq_dw, self.dz_dw)


def _side_by_side(*maps: Array) -> Array:
    return frozen(np.concatenate(maps, axis=-2).mT)


@dataclass(frozen=True, eq=False, repr=False)
class Response(Maps):
    """The maps of one grasp, and how well they are known."""

    grasp: Grasp
    scale: Scale
    restraint: Decision
    """The rank decision on G'."""
    accuracy: Mapping[str, Accuracy]
    """Of every map, by its name."""

    @property
    def restrained(self) -> bool:
        """Whether contacts resist every motion of the object."""
        return self.restraint.rank == 6

    @cached_property
    def doubt(self) -> float:
        """The largest doubt of any map."""
        return max(each.doubt for each in self.accuracy.values())

    @cached_property
    def term_sizes(self) -> Array:
        """(n_z, n_l) [N] sizes of the contact forces that a unit of each reference makes, moments over the length."""
        return frozen(np.abs(self.dlambda_dzr * self.scale.force[:, None]).T)

    @cached_property
    def free(self) -> Array:
        """(6, k) the motions of the object that no contact resists, orthonormal in scaled coordinates; k = 0 mostly."""
        return NONE if self.restrained else restraint(self.grasp, self.scale)[1]

    @property
    def free_twists(self) -> Array:
        """(6, k) the same about B [m, rad], of length 1 in scaled coordinates."""
        return NONE if self.restrained else twists_of(self.free, self.scale)

    @cached_property
    def K(self) -> Array:
        """(n_l, n_l) total stiffness C^-1 [N/m]; for sizes: where compliances differ much it holds few digits."""
        C = compliance_of(self.grasp)
        root = np.sqrt(np.diag(C))
        values, vectors = np.linalg.eigh(C / np.outer(root, root))
        return frozen((vectors / np.maximum(values, SINGULAR)) @ vectors.T / np.outer(root, root))


@naming_arguments
def respond(grasp: Grasp, load: Array | None = None) -> Response:
    """Return the response maps of a grasp.

    Args:
        grasp: the grasp.
        load: (T, 6) wrenches it is to hold (default: w_0).

    Raises:
        InputError: no grasp, or no wrenches.
        NotRestrainedError: the contacts leave the object a free motion, and the load works on it.
        RigidContactError: some contact direction has no compliance at all.

    Example:
        >>> respond(grasp).du_dw.shape
        (6, 6)
    """
    expected("grasp", grasp, Grasp, "make_grasp(...)")
    held = np.atleast_2d(grasp.w_0) if load is None else wrenches("load", load)
    scale = scale_of(grasp)
    decision, free = restraint(grasp, scale)
    refuse_load(grasp, scale, free, held)
    refuse_rigid_contacts(grasp, scale)
    maps, known = _worked_out(Matrices.of(grasp), scale, free)
    accuracy = accuracies(known)
    return Response(**{name: frozen(each) for name, each in maps.items()},
                    grasp=grasp, scale=scale, restraint=decision, accuracy=accuracy)  # fmt: skip


def wrenches(name: str, value: object) -> Array:
    """Return wrenches as an array (T, 6); one of 6 numbers is a wrench, too.

    Raises:
        InputError: something else.
    """
    judge = Arguments("")
    found = judge.numbers(name, value, "wrenches (T, 6)")
    if found is not None and (found.ndim not in (1, 2) or found.shape[-1] != 6 or not found.size):
        judge.refuse(name, f"expected wrenches (T, 6), 3 forces and 3 moments in each row; got {described(value)}")
    judge.finish()
    return np.atleast_2d(np.asarray(found))


def maps_in_float64(
    matrices: Matrices, metric: Metric, arithmetic: Arithmetic[Array] = FLOAT64, free: Array = NONE
) -> tuple[dict[str, Array], Array]:
    """Return the maps of one grasp or of many (leading axes ...), by their names in `Maps`, and the `figures` of them.

    Raises:
        numpy.linalg.LinAlgError: the equations of a grasp are singular, as far as float64 can tell.
    """
    found = answer(matrices, metric, arithmetic)
    return _maps(found, metric, free), figures(found, metric)


def is_enough(known: Array, share: float = ENOUGH) -> NDArray[np.bool_]:
    """Return which (...) of the `figures` (..., 12, 4) are those of maps that have lost no larger share."""
    return np.asarray(np.all(shares(known[..., 2], known) <= share, axis=-1))


def _worked_out(matrices: Matrices, scale: Scale, free: Array) -> tuple[dict[str, Array], Array]:
    """Return maps and figures in float64 where that is enough, else in twice its digits."""
    matrices, metric = supported(matrices, scale, free)
    try:
        maps, known = maps_in_float64(matrices, metric, free=free)
        if is_enough(known):
            return maps, known
    except np.linalg.LinAlgError:
        pass
    found = answer(matrices, metric, DOUBLED)
    return _maps(found, metric, free), figures(found, metric)


def _maps(found: Answer, metric: Metric, free: Array) -> dict[str, Array]:
    turned = about_centroid(metric)
    both = {f"d{name}": found.maps[..., rows, :] for name, rows in found.rows.items()}
    both = without_support(both, metric, free)
    both["du"] = turned.mT @ both["du"]
    of_references = {f"{name}_dzr": each[..., :-6] for name, each in both.items()}
    of_wrench = {f"{name}_dw": both[name][..., -6:] @ turned for name in ("dlambda", "du", "dz", "dq")}
    of_wrench["du_dw"] = (of_wrench["du_dw"] + of_wrench["du_dw"].mT) / 2
    return of_references | of_wrench


def figures(found: Answer, metric: Metric) -> Array:
    """Return (..., 12, 4), the fields of `Accuracy` of every map in the order of `FIGURES`."""
    size, lost = _largest(found, found.maps, metric), _largest(found, found.errors, metric)
    changed = lost if found.changes is found.errors else _largest(found, found.changes, metric)
    unknown = np.maximum(lost, changed)
    whole, zero = size.copy(), (size <= unknown) & (unknown > 0)  # 0 as far as anyone can tell
    some = np.any(zero, axis=-1)
    if np.any(some):
        terms = _largest(found, found.terms(some), metric.taken(some))
        whole[some] = np.where(zero[some], terms, size[some])
    return np.stack([size, whole, lost, changed], axis=-1)


def _largest(found: Answer, entries: Array, metric: Metric) -> Array:
    """Return the largest (..., 12) of the entries (..., n, n_z + 6) of every map, in scaled coordinates."""
    force, motion = np.moveaxis(metric.force, -1, 0), np.moveaxis(metric.motion_sizes, -1, 0)
    sizes = np.empty((*entries.shape[-2:], *force.shape[1:]))  # many grasps last: quick to compare
    np.abs(np.moveaxis(entries, (-2, -1), (0, 1)), out=sizes)
    sizes[found.rows["lambda"]] *= force[:, None]
    sizes[found.rows["u"]] *= motion[:, None]
    columns = np.stack([sizes[rows].max(axis=0, initial=0.0) for rows in found.rows.values()])  # (6, n_z + 6, ...)
    largest = [columns[:, :-6].max(axis=1, initial=0.0), (columns[:, -6:] * motion).max(axis=1)]
    return np.moveaxis(np.stack(largest, axis=1).reshape(len(FIGURES), *force.shape[1:]), 0, -1)
