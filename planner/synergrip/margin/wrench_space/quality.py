"""The classical figures of a grasp, and what its synergies cost of them.

Unit normal forces: those of all contacts together are one newton at most (L1), or each of them is (L-infinity), both
after Ferrari and Canny, Planning optimal grasps, 1992. Wrenches are those of the length-scaled norm: moments about the
centroid of the contacts, divided by their mean distance L from it, so that all figures are free of units.

Fully actuated, a hand makes every contact force in the cones: the grasp wrench space is the hull of what the contacts
do one by one (L1) or their Minkowski sum (L-infinity), epsilon the radius of the largest ball about 0 in it. With
synergies alone an external wrench w is met by ``lambda = -G+ w + E_s alpha``: what of it lies in the cones is a smaller
convex set, of the same norm and unit forces.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from synergrip.documents.judging import described, expected, is_whole
from synergrip.documents.naming import made_by, naming_arguments
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen, split
from synergrip.margin.wrench_space.contact_wrenches import FEWEST, UnitForces
from synergrip.margin.wrench_space.controlled_wrenches import controlled_figures
from synergrip.margin.wrench_space.wrench_hull import figures_of_support, hull, hull_figures, is_flat
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.response import Response
from synergrip.statics.restraint import NO_LOAD
from synergrip.values import Value

EDGES = 12
"""Of the pyramid of a hard finger, to begin with."""
MOST = 64
"""Edges: a hull of more takes longer than adding points where they count."""
ENDS = (0.0, 0.0)


@made_by("wrench_space_quality(grasp)")
@dataclass(frozen=True, eq=False, repr=False)
class WrenchSpaceQuality(Value):
    """Figures of a grasp without a task, free of units; a pair is at least and at most.

    Example:
        >>> found = wrench_space_quality(grasp)  # doctest: +SKIP
        >>> found.epsilon, found.epsilon_synergies, found.isotropy  # doctest: +SKIP
        ((0.1683, 0.1699), (0.0412, 0.0498), 0.61)
    """

    epsilon: tuple[float, float]
    """Radius of the largest ball about 0 in the grasp wrench space, every contact force being made: between the hull of
    points in the cones and a supporting plane of the cones themselves. 0 without force closure."""
    epsilon_synergies: tuple[float, float]
    """The same where internal forces are those of E_s: between a hull of wrenches with an answer and a plane beyond
    which none has one."""
    epsilon_pyramids: tuple[float, float]
    """That of pyramids inside the cones and around them, as they are, with `edges`."""
    volume: tuple[float, float]
    """Of the grasp wrench space: of a hull of points in the cones, and of pyramids around them."""
    volume_synergies: tuple[float, float]
    """The same where internal forces are those of E_s: of the hull, which is refined near 0 only, and no more than that
    of the whole grasp wrench space."""
    singular_values: Array
    """(6,) of the grasp matrix G, descending."""
    singular_values_synergies: Array
    """(6,) of G on the forces that synergies and loads make: the span of G+ and E_s."""
    edges: int
    """Of the pyramid of a hard finger, before points were added where they count."""
    length: float
    """L [m]."""
    epsilon_each: tuple[float, float] | None = None
    """Epsilon where each normal force is 1 at most (L-infinity), every contact force being made; None where it was
    not asked for."""
    epsilon_each_synergies: tuple[float, float] | None = None
    """The same where internal forces are those of E_s."""
    why: str = ""
    """Why there is no ball, where it is known."""

    @property
    def smallest_singular_value(self) -> float:
        """Of G: the least wrench that contact forces of size 1 can be needed for."""
        return float(self.singular_values[-1])

    @property
    def isotropy(self) -> float:
        """The smallest singular value of G over the largest; 1 where no direction is favoured."""
        return _ratio(self.singular_values)

    @property
    def isotropy_synergies(self) -> float:
        """The same of G on the forces that synergies and loads make."""
        return _ratio(self.singular_values_synergies)


@naming_arguments
def wrench_space_quality(grasp: Grasp | Analysis, *, edges: int = EDGES, each: bool = False) -> WrenchSpaceQuality:
    """Return the classical figures of a grasp: epsilon and volume of its wrench space, singular values, isotropy.

    Args:
        grasp: the grasp, or its analysis.
        edges: of the pyramid of a hard finger, 3 to 64; a sphere of three components has rings of as many
            and fewer.
        each: whether epsilon is told for normal forces of 1 each (L-infinity), too, beside 1 together (L1).

    Raises:
        InputError: no grasp; fewer edges, or more; a kind of contact of one's own whose cones share components.
        RigidContactError: some contact direction has no compliance at all.

    Example:
        >>> wrench_space_quality(grasp).isotropy > 0  # doctest: +SKIP
        True
    """
    if not isinstance(grasp, Analysis):
        expected("grasp", grasp, Grasp, "make_grasp(...)")
    if not is_whole(edges) or not FEWEST <= edges <= MOST:
        raise InputError.at("edges", f"expected a whole number from {FEWEST} to {MOST}, got {described(edges)}")
    analysis = grasp if isinstance(grasp, Analysis) else analyse(grasp, NO_LOAD)
    response = analysis.response
    G = response.scale.scaled_grasp(response.grasp.G).T
    found = partial(
        WrenchSpaceQuality, singular_values=_singular_values(G), edges=int(edges), length=response.scale.length,
        singular_values_synergies=_singular_values(G @ _made(analysis)),
    )  # fmt: skip
    own = Contacts.of(response)
    around = own.points(edges, outside=True)
    if not response.restrained or is_flat(around):
        why = "the wrench space is flat: there is a wrench that no contact forces make"
        flat = found(*(ENDS,) * 5, why=why)
        return replace(flat, epsilon_each=ENDS, epsilon_each_synergies=ENDS) if each else flat
    inner, (outer, most) = hull(own.points(edges))[0], hull(around)
    whole = hull_figures(own.points(edges), own.farthest)
    made = controlled_figures(response, analysis.spaces.E_s)
    why = _none_of(whole.epsilon, "the grasp has force closure", "the grasp has no force closure")
    why = why or _none_of(
        made.epsilon, "the synergies hold loads from every direction",
        "the synergies do not hold loads from every direction",
    )  # fmt: skip
    part = _no_more(made.epsilon, whole.epsilon)
    pyramids = max(float(-inner[:, -1].max()), 0.0), max(float(-outer[:, -1].max()), 0.0)
    told = found(whole.epsilon, part, pyramids, (whole.volume, most), (made.volume, most), why=why)
    return _with_each(told, own, analysis) if each else told


def _with_each(told: WrenchSpaceQuality, own: Contacts, analysis: Analysis) -> WrenchSpaceQuality:
    """Return figures with epsilon of any contact forces, and of E_s, where each normal force is 1 at most."""
    whole = figures_of_support(own.farthest_sum).epsilon
    made = controlled_figures(analysis.response, analysis.spaces.E_s, each=True).epsilon
    return replace(told, epsilon_each=whole, epsilon_each_synergies=_no_more(made, whole))


def _no_more(part: tuple[float, float], whole: tuple[float, float]) -> tuple[float, float]:
    """Return the ends of epsilon of some of the wrenches of a set: what all of them do not hold they do not."""
    return part[0], min(part[1], whole[1])


def _none_of(epsilon: tuple[float, float], some: str, none: str) -> str:
    """Return that there is no ball, or that it is not known whether there is one; nothing where there is."""
    lower, upper = epsilon
    if lower > 0:
        return ""
    return f"it is not known whether {some}: epsilon is {upper:.2g} at most" if upper > 0 else none


@dataclass(frozen=True, eq=False, repr=False)
class Contacts(Value):
    """What each contact of a grasp does to the object with a normal force of one newton."""

    forces: tuple[UnitForces, ...]
    maps: tuple[Array, ...]
    """(6, rows) to wrenches in scaled coordinates."""

    @classmethod
    def of(cls, response: Response) -> Contacts:
        """Return those of a grasp."""
        grasp, scale = response.grasp, response.scale
        maps = tuple(frozen(scale.wrench(grasp.G[:, rows].T).T) for rows in grasp.rows)
        return cls(tuple(UnitForces.of(contact) for contact in grasp.contacts), maps)

    def points(self, edges: int, *, outside: bool = False) -> Array:
        """Return 0 and the wrenches (p, 6) of the edges of all pyramids, inside the cones or around them."""
        pairs = zip(self.forces, self.maps, strict=True)
        return np.vstack([np.zeros((1, 6)), *(own.points(edges, outside=outside) @ G.T for own, G in pairs)])

    def farthest(self, along: Array) -> tuple[Array, float]:
        """Return the wrench (n_c, 6) of each contact that goes farthest along a direction, and how far one does."""
        points = np.array([G @ own.farthest(G.T @ along) for own, G in zip(self.forces, self.maps, strict=True)])
        return points, max(float((points @ along).max()), 0.0)

    def farthest_sum(self, along: Array) -> tuple[Array, float]:
        """Return the wrench (1, 6) of all contacts together that goes farthest along a direction, and how far it does.

        Each does what goes farthest, or nothing where all that it can do goes the other way: the support of a Minkowski
        sum is the sum of the supports.
        """
        points, _ = self.farthest(along)
        gained = points @ along
        return points[gained > 0].sum(axis=0, keepdims=True), float(np.maximum(gained, 0.0).sum())


def _made(analysis: Analysis) -> Array:
    """Return an orthonormal basis (n_l, k), in scaled forces, of those that synergies and loads make."""
    response = analysis.response
    made = np.hstack([response.dlambda_dw @ response.scale.motion.T, analysis.spaces.E_s])
    return split((response.scale.force[:, None] * made).T).row_space


def _singular_values(matrix: Array) -> Array:
    return frozen(np.linalg.svd(matrix, compute_uv=False))


def _ratio(values: Array) -> float:
    return float(values[-1] / values[0]) if values[0] > 0 else 0.0
