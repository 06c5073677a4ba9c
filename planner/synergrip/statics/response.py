"""How forces and motions answer to synergy references and to the external wrench. Equations (17)-(28).

With the total compliance ``C = C_s + J C_q J' + J S C_z S' J'`` everything is one linear system, so C_q = 0
and C_z = 0 are ordinary values and the paper's X (24) and Y (25) are never formed (docs/theory.md).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Scale, scale_of
from synergrip.linalg import SINGULAR, Array, Decision, frozen
from synergrip.statics.restraint import restraint
from synergrip.statics.saddle import DOUBLED, FLOAT64, Answer, about_centroid, answer
from synergrip.statics.yielding import refuse_rigid_contacts
from synergrip.values import Value

ENOUGH = 1e-11
"""Relative error of the maps up to which float64 is believed; beyond it they are worked out in twice the digits."""


@dataclass(frozen=True)
class Accuracy:
    """How well a map is known, by largest entries; lengths and newtons as `Scale` makes them comparable."""

    size: float
    """Of the map."""
    terms: float
    """Of the terms that its entries are sums of."""
    lost: float
    """What the arithmetic may have lost."""
    changed: float
    """About what changes when the grasp's numbers change by less than half a unit of their last digit."""

    @property
    def error(self) -> float:
        """What the arithmetic may have lost, as a share of the map."""
        return self._share(self.lost)

    @property
    def sensitivity(self) -> float:
        """What the digits that the grasp's numbers do not have would change, as a share of the map."""
        return self._share(self.changed)

    @property
    def unknown(self) -> float:
        """The larger of what is lost and what changes, in the unit of the map."""
        return max(self.lost, self.changed)

    @property
    def doubt(self) -> float:
        """The same as a share of the map."""
        return self._share(self.unknown)

    def _share(self, amount: float) -> float:
        """Return an amount as a share of the map; of its terms when the map is 0 as far as anyone can tell."""
        whole = self.size if self.size > self.unknown else self.terms
        return amount / whole if whole > 0 else 0.0 if amount == 0 else np.inf


@dataclass(frozen=True, eq=False, repr=False)
class Response(Value):
    """Linear maps of a restrained grasp, SI units. Forces act on the object."""

    grasp: Grasp
    scale: Scale
    restraint: Decision
    """The rank decision on G'."""
    dlambda_dzr: Array  # (n_l, n_z) (28)
    du_dzr: Array  # (6, n_z) (27)
    dtau_dzr: Array  # (n_q, n_z)
    dsigma_dzr: Array  # (n_z, n_z)
    dz_dzr: Array  # (n_z, n_z) (25)
    dq_dzr: Array  # (n_q, n_z) (26)
    dlambda_dw: Array  # (n_l, 6) = -G+
    du_dw: Array  # (6, 6) = (G K G')^-1: the object sags under load
    dz_dw: Array  # (n_z, 6)
    dq_dw: Array  # (n_q, 6)
    accuracy: Mapping[str, Accuracy]
    """Of every map, by its name."""

    @cached_property
    def K(self) -> Array:
        """(n_l, n_l) total stiffness C^-1 [N/m]; for sizes: where compliances differ much it holds few digits."""
        grasp, JS = self.grasp, self.grasp.J @ self.grasp.S
        C = grasp.C_s + grasp.J @ grasp.C_q @ grasp.J.T + JS @ grasp.C_z @ JS.T
        root = np.sqrt(np.diag(C))
        values, vectors = np.linalg.eigh(C / np.outer(root, root))
        return frozen((vectors / np.maximum(values, SINGULAR)) @ vectors.T / np.outer(root, root))

    @property
    def right_inverse(self) -> Array:
        """(n_l, 6) ``G+ = K G' (G K G')^-1``, K = C^-1."""
        return -self.dlambda_dw


def respond(grasp: Grasp, load: Array | None = None) -> Response:
    """Return the response maps of a grasp.

    Args:
        grasp: the grasp.
        load: (T, 6) wrenches it is to hold, for a refusal to tell about (default: w_0).

    Raises:
        NotRestrainedError: the contacts leave the object a free motion.
        RigidContactError: some contact direction has no compliance at all.
    """
    scale = scale_of(grasp)
    decision = restraint(grasp, scale, np.atleast_2d(grasp.w_0) if load is None else load)
    refuse_rigid_contacts(grasp, scale)
    found, accuracy = _answer(grasp, scale)
    n_z, turned = grasp.n_z, about_centroid(scale)
    maps = dict(found.maps, u=turned.T @ found.maps["u"])
    of_references = {name: frozen(each[:, :n_z]) for name, each in maps.items()}
    of_wrench = {name: frozen(each[:, n_z:] @ turned) for name, each in maps.items()}
    du_dw = of_wrench["u"]
    return Response(
        grasp, scale, decision,
        of_references["lambda"], of_references["u"], of_references["tau"], of_references["sigma"],
        of_references["z"], of_references["q"],
        of_wrench["lambda"], frozen((du_dw + du_dw.T) / 2), of_wrench["z"], of_wrench["q"], accuracy,
    )  # fmt: skip


def _answer(grasp: Grasp, scale: Scale) -> tuple[Answer, dict[str, Accuracy]]:
    """Return the answer in float64 where that is enough, else in twice its digits."""
    try:
        found = answer(grasp, scale, FLOAT64)
    except np.linalg.LinAlgError:
        found = None
    if found is not None:
        accuracy = _accuracy(found, scale)
        if all(each.error <= ENOUGH for each in accuracy.values()):
            return found, accuracy
    found = answer(grasp, scale, DOUBLED)
    return found, _accuracy(found, scale)


def _accuracy(found: Answer, scale: Scale) -> dict[str, Accuracy]:
    """Return the accuracy of every map."""
    motion = np.repeat([1.0, scale.length], 3)
    result = {}
    for name, values in found.maps.items():
        rows = {"lambda": scale.force, "u": motion}.get(name, np.ones(len(values)))
        entries = np.abs(np.stack([values, found.terms[name], found.errors[name], found.changes[name]]))
        entries *= rows[:, None]
        entries[..., -6:] *= motion
        for cause, columns in (("dzr", entries[..., :-6]), ("dw", entries[..., -6:])):
            result[f"d{name}_{cause}"] = Accuracy(*columns.max(axis=(1, 2), initial=0.0).tolist())
    return result
