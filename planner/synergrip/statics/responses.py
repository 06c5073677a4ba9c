"""The response of many grasps at once: the formulas of one grasp on stacked arrays.

Float64 answers most grasps; they are worked out together, a chunk at a time so that memory stays bounded. What one
grasp alone would need more for (twice the digits) or would be refused for goes to `respond`, one by one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synergrip.documents.naming import naming_arguments
from synergrip.documents.places import place_of, places_of
from synergrip.errors import InputError, Refusal
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Metric, scale_of
from synergrip.grasps.stack import GraspStack, Matrices
from synergrip.linalg import Array, Decisions, Places, decided, frozen
from synergrip.statics.accuracy import FIGURES, accuracies
from synergrip.statics.response import Maps, Response, is_enough, maps_in_float64, respond
from synergrip.statics.saddle import STACKED
from synergrip.statics.yielding import is_rigid

CHUNK = 200
"""Grasps worked out together, at most: enough to make the calls cheap."""
ENTRIES = 100_000
"""Entries of their largest matrices, at most: few enough for the processor's cache, and for memory to be used again."""
AGREED = 1e-12
"""Relative error of maps up to which another arithmetic is as good as that of one grasp: theirs agree to as much."""
Part = tuple[Places, Mapping[str, Array], Array]
"""Places, maps by their names and figures of some grasps."""


@dataclass(frozen=True, eq=False, repr=False)
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
        index = place_of("index", index, len(self.places))
        maps = {field.name: frozen(getattr(self, field.name)[index]) for field in fields(Maps)}
        grasp = self.grasps[index]
        return Response(**maps, grasp=grasp, scale=scale_of(grasp), restraint=self.restraint.at(index),
                        accuracy=accuracies(self.figures[index]))  # fmt: skip

    def taken(self, indices: Any) -> Responses:
        """Return the responses of some of the N grasps (whole numbers, a slice, or True or False for each), in order.

        Raises:
            UnknownPlaceError: there are no such grasps.
        """
        indices = places_of("indices", indices, len(self.places))
        maps = {field.name: getattr(self, field.name)[indices] for field in fields(Maps)}
        return Responses(**maps, grasps=self.grasps.taken(indices), places=self.places[indices],
                         restraint=self.restraint.taken(indices), figures=self.figures[indices],
                         refusals=self.refusals, one_by_one=self.one_by_one)  # fmt: skip


@naming_arguments
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
        (2, 9, 4)
    """
    stack = GraspStack.of(grasps)
    restraint = decided(stack.of_object)
    parts = _in_chunks(stack, restraint.ranks == 6)
    left = np.setdiff1d(np.arange(len(stack)), np.concatenate([places for places, _, _ in parts]))
    refusals: dict[int, InputError | Refusal] = {}
    for place in left.tolist():
        try:
            parts.append(_part(place, respond(stack[place])))
        except (InputError, Refusal) as refusal:
            refusals[place] = refusal
    answered = np.setdiff1d(np.arange(len(stack)), np.array(list(refusals), dtype=np.int64))
    maps, known = _joined(parts, answered)
    kept = answered if refusals else slice(None)
    return Responses(**maps, grasps=stack.taken(kept), places=answered, restraint=restraint.taken(kept),
                     figures=known, refusals=refusals, one_by_one=left)  # fmt: skip


def _in_chunks(stack: GraspStack, restrained: NDArray[np.bool_]) -> list[Part]:
    """Return what float64 answers, chunk by chunk: at least one part, be it an empty one."""
    parts: list[Part] = []
    size = max(1, min(CHUNK, ENTRIES // (stack.matrices.G.shape[-1] + 6) ** 2))
    for start in range(0, len(stack), size):
        chunk = slice(start, min(start + size, len(stack)))
        matrices, metric = stack.matrices.taken(chunk), stack.metric.taken(chunk)
        together = restrained[chunk] & ~is_rigid(matrices, metric)
        kept = slice(None) if together.all() else np.flatnonzero(together)
        places = np.arange(chunk.start, chunk.stop)[kept]
        parts += _answered(matrices.taken(kept), metric.taken(kept), places)
    none = slice(0)
    return parts or list(_answered(stack.matrices.taken(none), stack.metric.taken(none), np.arange(0)))


def _answered(matrices: Matrices, metric: Metric, places: Places) -> Iterator[Part]:
    """Yield what float64 answers of the grasps at some places: most by factors, the stiff as one by one."""
    try:
        maps, known = maps_in_float64(matrices, metric, STACKED)
        agreed = is_enough(known, AGREED)
    except np.linalg.LinAlgError:
        yield from _answered_as_alone(matrices, metric, places)
        return
    if agreed.all():
        yield places, maps, known
        return
    yield places[agreed], {name: each[agreed] for name, each in maps.items()}, known[agreed]
    yield from _answered_as_alone(matrices.taken(~agreed), metric.taken(~agreed), places[~agreed])


def _answered_as_alone(matrices: Matrices, metric: Metric, places: Places) -> Iterator[Part]:
    """Yield what float64 answers of the grasps at some places, by the arithmetic of one grasp, to the last digits."""
    try:
        maps, known = maps_in_float64(matrices, metric)
    except np.linalg.LinAlgError:  # of one grasp or more: look for them by halves
        middle = len(places) // 2
        for half in (slice(0, middle), slice(middle, None)) if middle else ():
            yield from _answered_as_alone(matrices.taken(half), metric.taken(half), places[half])
        return
    enough = is_enough(known)
    kept = slice(None) if enough.all() else enough
    yield places[kept], {name: each[kept] for name, each in maps.items()}, known[kept]


def _part(place: int, response: Response) -> Part:
    maps = {field.name: getattr(response, field.name)[None] for field in fields(Maps)}
    accuracy = [response.accuracy[name] for name in FIGURES]
    return np.array([place]), maps, np.array([[[a.size, a.whole, a.lost, a.changed] for a in accuracy]])


def _joined(parts: Sequence[Part], answered: Places) -> tuple[dict[str, Array], Array]:
    """Return maps and figures of all parts in the order of the places that are answered."""
    places = np.concatenate([each for each, _, _ in parts])
    order = None if np.array_equal(places, answered) else np.argsort(places)

    def joined(pieces: Sequence[Array]) -> Array:
        whole = np.concatenate(pieces)
        whole = whole if order is None else whole[order]
        whole.setflags(write=False)
        return whole

    maps = {name: joined([each[name] for _, each, _ in parts]) for name in parts[0][1]}
    return maps, joined([each for _, _, each in parts])
