"""The statics of a grasp at every knot of a motion, as arrays with an axis more than those of one analysis."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from typing import Any

from synergrip.grasps.scale import Metric
from synergrip.linalg import Array, frozen
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import forces_at_start
from synergrip.statics.response import Maps
from synergrip.statics.subspaces import Bases
from synergrip.statics.theorem1 import Coordinates
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class EachGrasp(Value):
    """What differs from knot to knot of a grasp, by the names that one has."""

    G: Array  # (..., 6, n_l)
    J: Array  # (..., n_l, n_q)
    S: Array  # (..., n_q, n_z)
    lambda_0: Array  # (..., n_l) contact forces there [N, N m]
    w_0: Array  # (..., 6) the load they carry


@dataclass(frozen=True, eq=False, repr=False)
class EachResponse(Maps):
    """The maps at every knot (...)."""

    grasp: EachGrasp

    @classmethod
    def of(cls, maps: Maps, grasp: EachGrasp) -> EachResponse:
        """Return maps together with the grasp that they are of."""
        return cls(**{each.name: getattr(maps, each.name) for each in fields(Maps)}, grasp=grasp)


@dataclass(frozen=True, eq=False, repr=False)
class Each(Value):
    """The statics of T grasps whose subspaces have the same dimensions; ``each[k]`` is that at a knot."""

    response: EachResponse
    spaces: Bases
    coordinates: Coordinates
    metric: Metric

    @classmethod
    def of(cls, analyses: Sequence[Analysis] | Each) -> Each:
        """Return analyses of like dimensions as arrays."""
        if isinstance(analyses, Each):
            return analyses

        def stacked(kind: type, name: str) -> dict[str, Array]:
            parts = [at.response.scale if name == "scale" else getattr(at, name) for at in analyses]
            return {each.name: frozen([getattr(part, each.name) for part in parts]) for each in fields(kind)}

        forces = frozen([forces_at_start(at.response) for at in analyses])
        own = {name: frozen([getattr(at.grasp, name) for at in analyses]) for name in ("G", "J", "S", "w_0")}
        M, inverse = (frozen([getattr(at.coordinates, name) for at in analyses]) for name in ("M", "inverse"))
        return cls(
            EachResponse(**stacked(Maps, "response"), grasp=EachGrasp(**own, lambda_0=forces)),
            Bases(**stacked(Bases, "spaces")), Coordinates(M, inverse, analyses[0].spaces.dimensions),
            Metric(**stacked(Metric, "scale")),
        )  # fmt: skip

    @property
    def grasp(self) -> EachGrasp:
        """The grasps."""
        return self.response.grasp

    def __len__(self) -> int:
        """Return T."""
        return len(self.grasp.w_0)

    def __iter__(self) -> Iterator[Each]:
        """Yield what is at every knot."""
        return (self[k] for k in range(len(self)))

    def __getitem__(self, place: int) -> Each:
        """Return the statics at one knot: arrays without the axis of the knots."""
        place = range(len(self))[place]

        def at(whole: Any) -> dict[str, Any]:
            return {each.name: getattr(whole, each.name)[place] for each in fields(whole) if each.name != "grasp"}

        response = EachResponse(**at(self.response), grasp=EachGrasp(**at(self.grasp)))
        own = Coordinates(self.coordinates.M[place], self.coordinates.inverse[place], self.coordinates.dimensions)
        return Each(response, Bases(**at(self.spaces)), own, Metric(**at(self.metric)))

    def split(self, motion: Array) -> tuple[Array, Array]:
        """Return beta (T, dim Gamma_ucs) [m] of twists (T, 6), and the parts outside of Gamma_ucs (T, 6) [m, rad]."""
        basis = self.metric.motion @ self.spaces.Gamma_ucs
        beta = (basis.mT @ (self.metric.motion @ motion[:, :, None]))[:, :, 0]
        return beta, motion - (self.spaces.Gamma_ucs @ beta[:, :, None])[:, :, 0]
