"""The place of an object at which a hand that closes on it holds it best, among thousands."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from synergrip.batch.judged_places import JudgedPlaces
from synergrip.batch.place_judge import PlaceJudge
from synergrip.batch.placed_object import PlacedObject
from synergrip.batch.planned_places import Candidate, first_that_holds
from synergrip.batch.telling import Progress
from synergrip.errors import InputError
from synergrip.grasps.asked_grasp import AskedGrasp
from synergrip.grasps.closing_at_many import Closer
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.place_search import (
    TouchingPlaces,
    around,
    closed_and_centred,
    nearest,
    space,
    touching_places,
)
from synergrip.linalg import Array
from synergrip.tasks.task import Task

FINE = 1e-3
"""[m] The search ends when places are no farther apart."""
AGAIN, GAIN = 6, 0.002
"""How often at most it is looked around as far as before, while the largest margin grows by more than this share."""
PLANNED, FAR = 16, 0.5
"""At how many places it is planned at most, and how far they are from each other, of the distance of the places that
were searched first: where no plan holds, hardly any does a millimetre beside it."""
SEARCHING = "looking for the place of the object"


def best_place(
    asked: AskedGrasp, made: Callable[[Array], tuple[Grasp, Task]], progress: Progress | None = None
) -> PlacedObject:
    """Return the best place of the object; what `place_object` does.

    Args:
        asked: the hand that closes, and the object.
        made: the grasp and the task with the object at a position (3,), or an `InputError` of what is wrong there.
        progress: told how far it is.

    Raises:
        InputError: no place at which all contacts touch, or none that makes a grasp.
    """
    tell = progress or (lambda what, share: None)
    closer = Closer(asked)
    places, apart = space(closer)
    tell(SEARCHING, 0.0)
    found = closed_and_centred(closer, places)
    touching = touching_places(closer, found)
    if not len(touching.q):
        raise InputError([nearest(closer, found)[1]])
    judge = PlaceJudge.of(asked, touching, made)
    tried, touched, rounds = len(places), len(touching.q), int(np.ceil(np.log2(max(apart / FINE, 1.0))))
    wide = apart
    best, top, judged = judge.best(touching)
    for turn in range(rounds):
        apart /= 2
        for again in range(AGAIN):  # a step that gains is taken again: halved ones alone end before they are there
            tell(SEARCHING, (turn + 1 + again / AGAIN) / (rounds + 1))
            near = around(best.positions, apart)
            more = touching_places(closer, closed_and_centred(closer, near))
            tried, touched, before = tried + len(near), touched + len(more.q), top
            best, top, others = judge.best(more, best)
            judged = judged.joined(others)
            if not top > before + GAIN * abs(before):
                break
    tell(SEARCHING, 1.0)
    chosen = first_that_holds(_candidates(judge, best, judged, FAR * wide), PLANNED, tell)
    notes = (*judge.notes(chosen.grasp, chosen.margin), *([chosen.note] if chosen.note else []))
    return PlacedObject(chosen.grasp, chosen.margin, tried, touched, notes, chosen.outcome, chosen.planned)


def _candidates(judge: PlaceJudge, best: TouchingPlaces, judged: JudgedPlaces, apart: float) -> Iterator[Candidate]:
    """Yield the best place, then others that are `apart` [m] from it and from each other, one at a time."""
    yield judge.written(best)
    others = judged.far_from(best.positions[0], apart, PLANNED - 1)
    for index in range(len(others.q)):
        try:
            yield judge.written(others.taken(np.array([index])))
        except InputError:  # of the place as it is rounded
            continue
