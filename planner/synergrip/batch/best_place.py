"""The place of an object at which a hand that closes on it holds it best, among thousands."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from synergrip.batch.asked import LIMITS
from synergrip.batch.plan_many import plan_many
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.grasps.asked_grasp import AskedGrasp, Posture, Synergies, asked_grasp, grasp_of
from synergrip.grasps.closing_at_many import Closer
from synergrip.grasps.contact_at import ContactAt
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.in_postures import grasps_in_postures
from synergrip.grasps.objects import Object
from synergrip.grasps.place_search import (
    TouchingPlaces,
    around,
    closed_and_centred,
    nearest,
    off_centre,
    space,
    touching_places,
)
from synergrip.hands.hand import Hand
from synergrip.linalg import Array, frozen
from synergrip.tasks.hold import Hold
from synergrip.tasks.task import Task
from synergrip.values import Value

INSTANTS = 5
"""Knots of the task, from end to end, at which margins are looked at."""
JUDGED = 150
"""Places whose margins are worked out at a time, evenly chosen of those that touch."""
BEST = 5
"""Places around which is looked again, nearer."""
FINE = 1e-3
"""[m] The search ends when places are no farther apart."""
DIGITS = 4
"""Of the place in metres, so that it can be written down."""
ALIKE = 0.02
"""Share of the largest margin within which places are as good as each other."""
ENOUGH = 10.0
"""Times the largest load to which normal forces are held where no limit bounds the margin."""
Progress = Callable[[str, float], None]


@dataclass(frozen=True, eq=False, repr=False)
class PlacedObject(Value):
    """Where an object is held best."""

    grasp: Grasp
    """The grasp there."""
    margin: float
    """[N] The largest slip margin that all contacts can keep in the linear model of this posture, at the worst of the
    instants that were looked at; nan where the load is not held at all of them."""
    tried: int
    """Places that were closed on."""
    touching: int
    """Places of these at which all contacts touch."""
    notes: tuple[str, ...] = ()
    """What is doubtful."""

    @property
    def position(self) -> Array:
        """(3,) centre of the object in the palm frame [m]."""
        assert self.grasp.held is not None
        return self.grasp.held.body.position

    @property
    def line(self) -> str:
        """The position as it stands in a problem file."""
        return position_line(self.position)


def position_line(position: Array) -> str:
    """Return how a position (3,) [m] is written under [object]."""
    texts = (f'"{round(1e3 * float(value), 4) + 0.0:.10g} mm"' for value in position)
    return f"position = [{', '.join(texts)}]"


@naming_arguments
def place_object(
    hand: Hand | str | Path,
    object: Object,
    *,
    posture: Posture,
    contacts: Sequence[ContactAt],
    close: str | Mapping[str, float],
    task: Task,
    synergies: Synergies | None = None,
    joint_compliance: float | Sequence[float] | Array | None = None,
    synergy_compliance: float | Sequence[float] | Array = 0.0,
    title: str = "",
    relative_to: str | Path | None = None,
    progress: Progress | None = None,
) -> PlacedObject:
    """Return where an object is held best by a hand that closes on it, and the grasp there.

    Places all over the space that the pads sweep are closed on at once. Where all contacts touch, the largest slip
    margin at the task's load is worked out by `plan_many`, with the limits of the task on forces, torques, efforts and
    references; around the best ones it is looked again, until places are 1 mm apart. A place at which the skeleton of
    the hand stays outside the object goes before one where it does not. The same question has the same answer.

    Args:
        hand: as of `make_grasp`, and so are the other arguments that it has.
        object: with a shape; its position, if it has one, does not count.
        posture: an open one, from which the hand closes.
        contacts: all of which are to touch.
        close: the synergy, joint or weights by name along which the hand closes.
        task: whose load is to be held, at up to five of its knots.
        synergies: as of `make_grasp`.
        joint_compliance: as of `make_grasp`.
        synergy_compliance: as of `make_grasp`.
        title: of the grasp.
        relative_to: folder of a synergy file.
        progress: told what is under way and which share of it is done.

    Raises:
        InputError: arguments as of `make_grasp`; no place at which all contacts touch, with the nearest one and how far
            pads are away there.

    Example:
        >>> from synergrip import Gravity, HardFinger, NormalForce, Sphere
        >>> tips = [f"finger{i}/tip" for i in (1, 2, 3)]
        >>> found = place_object(
        ...     "barrett", Object(mass=0.2, shape=Sphere(radius=0.05)), posture="open", close="close",
        ...     contacts=[ContactAt(tip, HardFinger(friction=0.6), stiffness=8e3) for tip in tips],
        ...     task=Task(loads=[Gravity((0, 0, -9.81))], limits=[NormalForce(upper=20.0)]),
        ... )
        >>> found.margin > 1, found.grasp.n_c
        (True, 3)
    """
    asked = asked_grasp(
        hand, object, posture=posture, contacts=contacts, synergies=synergies, close=close, title=title,
        joint_compliance=joint_compliance, synergy_compliance=synergy_compliance, relative_to=relative_to,
        anywhere=True,
    )  # fmt: skip
    return best_place(asked, lambda position: (grasp_of(asked.at(position)), task), progress)


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
    judge = _Judge.of(asked, touching, made)
    tried, touched, rounds = len(places), len(touching.q), int(np.ceil(np.log2(max(apart / FINE, 1.0))))
    best = judge.best(touching)
    for turn in range(rounds):
        tell(SEARCHING, (turn + 1) / (rounds + 1))
        apart /= 2
        near = around(best.positions, apart)
        more = touching_places(closer, closed_and_centred(closer, near))
        tried, touched = tried + len(near), touched + len(more.q)
        best = judge.best(more, best)
    tell(SEARCHING, 1.0)
    grasp, margin = judge.written(best)
    return PlacedObject(grasp, margin, tried, touched, judge.notes(margin))


SEARCHING = "looking for the place of the object"


@dataclass(frozen=True, eq=False)
class _Judge:
    """What places are judged by: a grasp and a task of one knot, at some loads."""

    asked: AskedGrasp
    made: Callable[[Array], tuple[Grasp, Task]]
    grasp: Grasp
    task: Task
    wrenches: Array  # (K, 6)
    added: float
    """[N] The bound on normal forces that no limit of the task is; 0 for none."""

    @classmethod
    def of(cls, asked: AskedGrasp, touching: TouchingPlaces, made: Callable[[Array], tuple[Grasp, Task]]) -> _Judge:
        """Take grasp and task from the first of some places that make one."""
        grasp, task = _first(touching.positions, made)
        timed = task.timed(grasp)
        knots = np.unique(np.round(np.linspace(0, len(timed.times) - 1, INSTANTS)).astype(int))
        loads = timed.wrench[knots]
        still = Task(
            knots=1, target=Hold(), limits=[each for each in task.limits if type(each) in LIMITS],
            goals=[LargestMargin()], linearise="once",
        )  # fmt: skip
        judge = cls(asked, made, grasp, still, loads, 0.0)
        try:
            judge.margins(touching.taken(np.arange(1)))
        except InputError as error:
            if error.issues[0].key != "goal.maximise":
                raise
            bound = ENOUGH * (float(np.linalg.norm(loads[:, :3], axis=1).max()) or 1.0)
            limits = [*(each for each in still.limits if not isinstance(each, NormalForce)), NormalForce(upper=bound)]
            return replace(judge, task=still.replace(limits=limits), added=bound)
        return judge

    def margins(self, places: TouchingPlaces) -> Array:
        """Return the largest margin (N,) [N] at each place, at its worst load; -inf where a load is not held."""
        count, each = len(places.q), len(self.wrenches)
        stack = grasps_in_postures(self.grasp, places.q, positions=places.positions)
        many = plan_many(
            stack.taken(np.repeat(np.arange(count), each)), self.task, wrenches=np.tile(self.wrenches, (count, 1))
        )
        held = np.where(many.verdicts == "feasible", many.largest_margin, -np.inf)
        return np.asarray(held.reshape(count, each).min(axis=1))

    def best(self, places: TouchingPlaces, others: TouchingPlaces | None = None) -> TouchingPlaces:
        """Return the best few of some places, those first at which the hand stays outside, and of others.

        Of margins that are alike, that goes first whose contacts stand around the middle of the object.
        """
        few = places.taken(np.unique(np.round(np.linspace(0, len(places.q) - 1, JUDGED)).astype(int)))
        together = few if others is None else others.joined(few)
        margins = self.margins(together)
        top = float(margins[together.clear].max(initial=-np.inf))
        alike = margins >= (1 - ALIKE) * top if np.isfinite(top) else np.isneginf(margins)
        order = np.lexsort((off_centre(self.asked, together), -np.where(alike, np.inf, margins), ~together.clear))
        return together.taken(order[:BEST])

    def written(self, places: TouchingPlaces) -> tuple[Grasp, float]:
        """Return the grasp of the first place that makes one when it is rounded, and its margin."""
        grasp, _ = _first(np.round(places.positions, DIGITS), self.made)
        held = grasp.held
        assert held is not None
        one = TouchingPlaces(held.body.position[None], held.q[None], np.ones(1, dtype=bool))
        return grasp, float(self.margins(one)[0])

    def notes(self, margin: float) -> tuple[str, ...]:
        """Return what is to be said of the place."""
        if not np.isfinite(margin):
            return ("all contacts touch there, but at no place that was judged is the load held with these limits",)
        if self.added:
            return (f"no limit bounds the margin: it was judged with normal forces of {self.added:.4g} N at most",)
        return ()


def _first(positions: Array, made: Callable[[Array], tuple[Grasp, Task]]) -> tuple[Grasp, Task]:
    """Return what is made at the first of some positions (N, 3) that makes a grasp; else raise the first error."""
    refused: InputError | None = None
    for position in positions:
        try:
            return made(frozen(position))
        except InputError as error:
            refused = refused or error
    assert refused is not None
    raise refused
