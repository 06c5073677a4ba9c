"""The response of many grasps at once: the formulas of one grasp on stacked arrays.

Float64 answers most grasps; they are worked out together, a chunk at a time so that memory stays bounded. What one
grasp alone would need more for (twice the digits) or would be refused for goes to `respond`, one by one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields

import numpy as np

from synergrip.errors import InputError, Refusal
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Metric, scale_of
from synergrip.grasps.stack import GraspStack, Matrices
from synergrip.linalg import Array, Decisions, Places, frozen
from synergrip.statics.response import FIGURES, Accuracy, Maps, Response, is_enough, maps_in_float64, respond
from synergrip.statics.restraint import restraints
from synergrip.statics.yielding import is_rigid

CHUNK = 200
"""Grasps worked out together: enough to make the calls cheap, few enough for the processor's cache."""
Part = tuple[Places, Mapping[str, Array], Array]
"""Places, maps by their names and figures of some grasps."""


@dataclass(frozen=True, eq=False)
class Responses(Maps):
    """The maps of those of many grasps that were not refused, in their order: leading axis N."""

    grasps: GraspStack
    """The N grasps."""
    places: Places
    """(N,) where each of them stood among the grasps asked about."""
    restraint: Decisions
    """(N,) the rank decisions on G'."""
    figures: Array
    """(N, 12, 4) how well the maps are known: the fields of `Accuracy` for every map in the order of `FIGURES`."""
    refusals: Mapping[int, InputError | Refusal]
    """What `respond` raises for the others, by their place among the grasps asked about."""
    one_by_one: Places
    """Places among the grasps asked about that float64 was not enough for, or that were refused."""

    def at(self, index: int) -> Response:
        """Return the response of one of the N grasps, as `respond` would."""
        index = range(len(self.places))[index]
        grasp, rows = self.grasps[index], self.figures[index].tolist()
        maps = {field.name: frozen(getattr(self, field.name)[index]) for field in fields(Maps)}
        accuracy = {name: Accuracy(*row) for name, row in zip(FIGURES, rows, strict=True)}
        return Response(**maps, grasp=grasp, scale=scale_of(grasp), restraint=self.restraint.at(index),
                        accuracy=accuracy)  # fmt: skip

    def taken(self, indices: Places) -> Responses:
        """Return the responses of some of the N grasps, in their order."""
        maps = {field.name: getattr(self, field.name)[indices] for field in fields(Maps)}
        return Responses(**maps, grasps=self.grasps.taken(indices), places=self.places[indices],
                         restraint=self.restraint.taken(indices), figures=self.figures[indices],
                         refusals=self.refusals, one_by_one=self.one_by_one)  # fmt: skip


def respond_many(grasps: Sequence[Grasp]) -> Responses:
    """Return the response maps of many grasps: those that `respond` returns, many times as fast.

    Args:
        grasps: grasps of one form (a sequence of them, or a `GraspStack`).

    Returns:
        the maps with a leading axis; a grasp that `respond` refuses is among its `refusals` and raises nothing.

    Raises:
        InputError: no grasps, or grasps whose contacts, joints or synergies are not alike.

    Example:
        >>> responses = respond_many([grasp, softer])
        >>> responses.dlambda_dzr.shape  # (2, n_l, n_z)
    """
    stack = GraspStack.of(grasps)
    chunks = [np.arange(start, min(start + CHUNK, len(stack))) for start in range(0, len(stack), CHUNK)]
    restraint = restraints(stack.matrices.G, stack.metric)
    parts = [part for chunk in chunks for part in _together(stack.matrices, stack.metric, restraint, chunk)]
    done = np.concatenate([places for places, _, _ in parts])
    left = np.setdiff1d(np.arange(len(stack)), done)
    refusals: dict[int, InputError | Refusal] = {}
    for place in left.tolist():
        try:
            parts.append(_part(place, respond(stack[place])))
        except (InputError, Refusal) as refusal:
            refusals[place] = refusal
    places = np.concatenate([each for each, _, _ in parts])
    order = np.argsort(places)
    maps = {name: _joined([each[name] for _, each, _ in parts], order) for name in parts[0][1]}
    known, answered = _joined([each for _, _, each in parts], order), places[order]
    return Responses(**maps, grasps=stack if not refusals else stack.taken(answered), places=answered,
                     restraint=restraint.taken(answered), figures=known, refusals=refusals, one_by_one=left)  # fmt: skip


def _together(matrices: Matrices, metric: Metric, restraint: Decisions, places: Places) -> Iterator[Part]:
    """Yield what float64 answers of a chunk."""
    rigid = is_rigid(matrices.taken(places), metric.taken(places))
    yield from _answered(matrices, metric, places[(restraint.ranks[places] == 6) & ~rigid])


def _answered(matrices: Matrices, metric: Metric, places: Places) -> Iterator[Part]:
    try:
        maps, known = maps_in_float64(matrices.taken(places), metric.taken(places))
    except np.linalg.LinAlgError:  # of one grasp or more: look for them by halves
        if len(places) > 1:
            for half in np.array_split(places, 2):
                yield from _answered(matrices, metric, half)
        return
    enough = is_enough(known)
    yield places[enough], {name: each[enough] for name, each in maps.items()}, known[enough]


def _part(place: int, response: Response) -> Part:
    maps = {field.name: getattr(response, field.name)[None] for field in fields(Maps)}
    accuracy = [response.accuracy[name] for name in FIGURES]
    return np.array([place]), maps, np.array([[[a.size, a.terms, a.lost, a.changed] for a in accuracy]])


def _joined(parts: Sequence[Array], order: Places) -> Array:
    whole = np.concatenate(parts)[order]
    whole.setflags(write=False)
    return whole
