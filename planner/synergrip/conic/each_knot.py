"""The statics of a grasp at every knot, where they are not the same at all."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from synergrip.errors import InputError
from synergrip.linalg import Array
from synergrip.statics import Coordinates, Response, Subspaces
from synergrip.statics.analysis import Analysis
from synergrip.statics.each import Each, EachResponse
from synergrip.statics.subspaces import Bases


class Statics(Protocol):
    """The maps of a grasp: the same at all knots, or (T, ...) of each."""

    @property
    def response(self) -> Response | EachResponse:
        """Response maps."""

    @property
    def spaces(self) -> Bases:
        """Subspaces of internal forces, rigid motions and redundancy."""

    @property
    def coordinates(self) -> Coordinates:
        """M (35)."""


def to_beta(at: Statics) -> Array:
    """Return what makes the rigid motion of references, (dim Gamma_ucs, n_z)."""
    n_alpha, n_beta, _ = at.coordinates.dimensions
    return at.coordinates.M[..., n_alpha : n_alpha + n_beta, :]


def judge_each(each: Sequence[Analysis] | Each | None, response: Response, spaces: Subspaces, knots: int) -> None:
    """Refuse grasps at the knots that are no grasp of the same hand on the same contacts."""
    if each is None:
        return
    if len(each) != knots:
        raise InputError.at("each", f"expected the analysis of a grasp at each of {knots} knots, got {len(each)}")
    if isinstance(each, Each):  # of one hand on the same contacts, with the dimensions of its start
        return
    for k, at in enumerate(each):
        if at.spaces.dimensions != spaces.dimensions:
            raise InputError.at(
                f"each[{k}]",
                f"expected subspaces of dimensions {spaces.dimensions} as at the start, got {at.spaces.dimensions}; a "
                f"task over knots where they change is to be planned in parts",
            )
        named, names = ([(g.joints, g.synergies, tuple((c.name, c.n_rows) for c in g.contacts))]
                        for g in (at.grasp, response.grasp))  # fmt: skip
        if named != names:
            raise InputError.at(f"each[{k}]", "expected the joints, synergies and contacts of the grasp at the start")
