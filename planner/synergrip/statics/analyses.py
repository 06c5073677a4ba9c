"""The statics of many grasps, worked out at once: response, subspaces, Theorem 1."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.documents.naming import made_by, naming_arguments
from synergrip.documents.places import place_of
from synergrip.errors import InputError, Refusal
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.stack import GraspStack
from synergrip.linalg import Places, frozen
from synergrip.statics.analysis import Analysis
from synergrip.statics.responses import Responses, respond_many
from synergrip.statics.subspace_groups import SubspaceGroup, coordinates_many, groups_of, subspaces_many
from synergrip.statics.theorem1 import Coordinates
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class AnalysisGroup(Value):
    """N grasps whose subspaces have the same dimensions, so that one program has the shape of all; leading axis N."""

    spaces: SubspaceGroup
    coordinates: Coordinates

    @property
    def response(self) -> Responses:
        """The maps."""
        return self.spaces.responses

    @property
    def places(self) -> Places:
        """(N,) where each of them stood among the grasps asked about."""
        return self.spaces.places

    @property
    def dimensions(self) -> tuple[int, int, int]:
        """Dimensions of E_s, Gamma_ucs and Gamma_zr of every grasp of the group."""
        return self.spaces.dimensions

    def at(self, index: int) -> Analysis:
        """Return the analysis of one of the N grasps, as `analyse` would."""
        index = place_of("index", index, len(self.places))
        response = self.response.at(index)
        found = self.coordinates
        own = Coordinates(frozen(found.M[index]), frozen(found.inverse[index]), found.dimensions)
        return Analysis(response.grasp, response, self.spaces.at(index), own)


@made_by("analyse_many(grasps)")
@dataclass(frozen=True, eq=False, repr=False)
class Analyses(Value):
    """Everything that is true of many grasps before any task, those of like dimensions together.

    Example:
        >>> many = analyse_many([grasp, softer])
        >>> [(group.dimensions, group.places.tolist()) for group in many.groups], many.refusals
        ([((3, 1, 0), [0, 1])], {})
    """

    groups: tuple[AnalysisGroup, ...]
    """One for each triple of dimensions; every grasp that is not refused stands in one."""
    refusals: Mapping[int, InputError | Refusal]
    """What `analyse` raises for the others, by their place."""
    one_by_one: Places
    """Places of grasps that were not worked out with the others: float64 was not enough, or they were refused."""

    def at(self, place: int) -> Analysis:
        """Return the analysis of the grasp at a place, as `analyse` would.

        Raises:
            InputError: there is no such place, or the contacts there are rigid.
            NotRestrainedError: the grasp there does not restrain its object.
        """
        if place in self.refusals:
            raise self.refusals[place]
        for group in self.groups:
            index = np.flatnonzero(group.places == place)
            if len(index):
                return group.at(int(index[0]))
        count = len(self.refusals) + sum(len(group.places) for group in self.groups)
        raise InputError.at("place", f"expected a place from 0 to {count - 1}, got {place!r}")


@naming_arguments
def analyse_many(grasps: Sequence[Grasp]) -> Analyses:
    """Return the analyses of many grasps: what `analyse` returns for each, many times as fast.

    Args:
        grasps: grasps of one form (a sequence of them, or a `GraspStack`).

    Raises:
        InputError: no grasps, or grasps whose contacts, joints or synergies are not alike.

    Example:
        >>> analyses = analyse_many(grasps)
        >>> {group.dimensions: len(group.places) for group in analyses.groups}
        {(3, 1, 0): 2}
        >>> {place: str(why) for place, why in analyses.refusals.items()}
        {}
    """
    responses = respond_many(grasps)
    groups = tuple(AnalysisGroup(group, coordinates_many(group)) for group in subspaces_many(responses))
    return Analyses(groups, responses.refusals, responses.one_by_one)


def analyses_for_plans(stack: GraspStack) -> tuple[AnalysisGroup, ...]:
    """Return the groups of `analyse_many`, maybe without the force map's own decision, which no plan looks at."""
    groups = groups_of(respond_many(stack), told=False)
    return tuple(AnalysisGroup(group, coordinates_many(group)) for group in groups)
