"""How well an object is held at places of it, and which of these are the best."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from synergrip.batch.asked import LIMITS
from synergrip.batch.judged_places import JudgedPlaces
from synergrip.batch.plan_many import plan_many
from synergrip.batch.planned_places import Candidate
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.documents.quantities import in_mm
from synergrip.errors import InputError
from synergrip.grasps.asked_grasp import AskedGrasp
from synergrip.grasps.ball import MEETS
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.in_postures import grasps_in_postures
from synergrip.grasps.pad_overlaps import overlap_notes
from synergrip.grasps.place_search import TouchingPlaces, at_stops, off_centre
from synergrip.grasps.stops import Flags
from synergrip.linalg import Array, Places, frozen
from synergrip.tasks.hold import Hold
from synergrip.tasks.task import Task

INSTANTS = 5
"""Knots of the task, from end to end, at which margins are looked at."""
JUDGED = 150
"""Places whose margins are worked out at a time, most of them those of least doubt (`_some`)."""
BEST = 5
"""Places around which is looked again, nearer."""
DIGITS = (4, 5, 6, 7)
"""Of the place in metres, so that it can be written down: the first at which all contacts meet the object."""
ALIKE = 0.02
"""Share of the largest margin within which places are as good as each other."""
NEARLY = 0.05
"""Share of it that is given for joints that are away from their stops."""
ASKED = ("limits", "task", "goal", "allow")
"""Tables of a problem file that ask for something wherever the object is."""
FORCES = (NormalForce, JointTorque, ActuatorEffort)
"""Limits of how hard a hand may press."""
ENOUGH = 10.0
"""Times the largest load to which normal forces are held where no limit says how hard the hand may press."""


@dataclass(frozen=True, eq=False)
class PlaceJudge:
    """What places are judged by: a grasp and a task of one knot, at some loads."""

    asked: AskedGrasp
    made: Callable[[Array], tuple[Grasp, Task]]
    grasp: Grasp
    task: Task
    wrenches: Array  # (K, 6)
    added: float
    """[N] The bound on normal forces where the task has no limit of forces; else 0."""

    @classmethod
    def of(cls, asked: AskedGrasp, touching: TouchingPlaces, made: Callable[[Array], tuple[Grasp, Task]]) -> PlaceJudge:
        """Take grasp and task from the first of some places that make one."""
        grasp, task = _first(touching.positions, made)
        timed = task.timed(grasp)
        knots = np.unique(np.round(np.linspace(0, len(timed.times) - 1, INSTANTS)).astype(int))
        loads = timed.wrench[knots]
        limits = [_from_posture(each) for each in task.limits if type(each) in LIMITS]
        bound = 0.0
        if not any(isinstance(each, FORCES) for each in limits):
            bound = ENOUGH * (float(np.linalg.norm(loads[:, :3], axis=1).max()) or 1.0)
            limits = [*limits, NormalForce(upper=bound)]
        still = Task(knots=1, target=Hold(), limits=limits, goals=[LargestMargin()], linearise="once")
        return cls(asked, made, grasp, still, loads, bound)

    def margins(self, places: TouchingPlaces) -> Array:
        """Return the largest margin (N,) [N] at each place, at its worst load; -inf where a load is not held."""
        count, each = len(places.q), len(self.wrenches)
        stack = grasps_in_postures(self.grasp, places.q, positions=places.positions)
        many = plan_many(
            stack.taken(np.repeat(np.arange(count), each)), self.task, wrenches=np.tile(self.wrenches, (count, 1))
        )
        held = np.where(many.verdicts == "feasible", many.largest_margin, -np.inf)
        return np.asarray(held.reshape(count, each).min(axis=1))

    def best(
        self, places: TouchingPlaces, others: TouchingPlaces | None = None
    ) -> tuple[TouchingPlaces, float, JudgedPlaces]:
        """Return the best few of some places and of others, how good they are, and all that were judged.

        Those at which a load is held go first, and of these those of which there is least doubt.
        Of margins that are nearly the largest, those with the fewest joints at their stops go first; of those that are
        alike then, that whose contacts stand around the middle of the object. The one with the largest margin always
        stays, so that what is given up for these does not add up over the rounds.
        """
        few = places.taken(_some(places.doubts))
        together = (few if others is None else others.joined(few)).different()
        margins = self.margins(together)
        stopped = at_stops(self.asked, together.q).sum(axis=1)
        unheld = np.isneginf(margins)
        first = unheld if unheld.all() else ~unheld & (together.doubts == together.doubts[~unheld].min())
        near = self._near(margins, first, NEARLY)
        fewest = near & (stopped == stopped[near & first].min())
        alike = fewest & self._near(margins, first & fewest, ALIKE)
        middle = np.round(off_centre(self.asked, together), 7)  # of two places that mirror each other, the first
        order = np.lexsort((middle, -np.where(alike, np.inf, margins), together.doubts, unheld))
        most = int(np.lexsort((-margins, together.doubts, unheld))[0])
        kept = order[:BEST] if most in order[:BEST] else np.append(order[: BEST - 1], most)
        return together.taken(kept), float(margins[most]), JudgedPlaces(together, margins)

    @staticmethod
    def _near(margins: Array, among: Flags, share: float) -> Flags:
        """Return which margins (N,) are at most a share below the largest among some."""
        top = float(margins[among].max(initial=-np.inf))
        return np.asarray(margins >= (1 - share) * top if np.isfinite(top) else np.isneginf(margins))

    def written(self, places: TouchingPlaces) -> Candidate:
        """Return what is made at the first place at which all contacts meet when it is rounded, and its margin."""
        rounded = np.array([np.round(position, digits) for position in places.positions for digits in DIGITS])
        grasp, task = _first(rounded, self._met)
        held = grasp.held
        assert held is not None
        one = TouchingPlaces(held.body.position[None], held.q[None], np.zeros(1, dtype=int))
        return Candidate(grasp, task, float(self.margins(one)[0]))

    def _met(self, position: Array) -> tuple[Grasp, Task]:
        """Return what is made at a position (3,), when closing by itself lets all contacts meet the object there."""
        grasp, task = self.made(position)
        gaps = grasp.held.gaps if grasp.held is not None else ()
        off = max((abs(gap) for gap in gaps if gap is not None), default=0.0)
        if off > MEETS:
            message = f"a contact stays {in_mm(off)} off the object at the best place; give the place yourself"
            raise InputError.at("object.position", message)
        if grasp.held is not None and (said := overlap_notes(grasp.held.hand, grasp.held.q, grasp.held.touches)):
            raise InputError.at("object.position", f"at the best place {said[0]}; give the place yourself")
        return grasp, task

    def notes(self, grasp: Grasp, margin: float) -> tuple[str, ...]:
        """Return what is to be said of the place."""
        held = grasp.held
        stopped = [] if held is None else np.flatnonzero(at_stops(self.asked, held.q[None])[0]).tolist()
        names = ", ".join(self.asked.hand.joint_names[joint] for joint in stopped)
        come, whose = ("comes", "its stop") if len(stopped) == 1 else ("come", "their stops")
        stops = f"closed on it, {names} {come} to {whose} within 1 % of the range: hardly any way is left to press on"
        return (*self._doubts(margin), *([stops] if stopped else []))

    def _doubts(self, margin: float) -> tuple[str, ...]:
        if not np.isfinite(margin):
            return (
                "all contacts touch there, but at no place is the load held with these limits by the start posture",
            )
        if self.added:
            return (f"no limit says how hard the hand may press: normal forces were held to {self.added:.4g} N",)
        return ()


def _some(doubts: Places) -> Places:
    """Return which of places to judge, evenly chosen: two thirds or more with the fewest `doubts` (N,)."""
    least = doubts == (doubts.min() if len(doubts) else 0)
    others = np.flatnonzero(~least)
    first = _evenly(np.flatnonzero(least), JUDGED - min(len(others), JUDGED // 3))
    return np.sort(np.append(first, _evenly(others, JUDGED - len(first))))


def _evenly(among: Places, most: int) -> Places:
    which = np.unique(np.round(np.linspace(0, len(among) - 1, min(most, len(among)))).astype(int))
    return np.asarray(among[which])


def _from_posture(limit: Limit) -> Limit:
    """Return a limit as it is in any posture: joints move from that of each place, and not from that of the first."""
    return replace(limit, start=None) if isinstance(limit, JointRange) else limit


def _asked_anywhere(error: InputError) -> bool:
    """Tell whether something is refused that is asked wherever the object is."""
    return any(issue.key.split(".")[0] in ASKED for issue in error.issues)


def _first(positions: Array, made: Callable[[Array], tuple[Grasp, Task]]) -> tuple[Grasp, Task]:
    """Return what is made at the first of some positions (N, 3) that makes a grasp; else raise the first error.

    What is asked wherever the object is, and refused alike at two places, is not tried at all others.
    """
    refused, said = list[InputError](), set[str]()
    for position in positions:
        try:
            return made(frozen(position))
        except InputError as error:
            if _asked_anywhere(error) and str(error) in said:
                raise
            refused.append(error)
            said.add(str(error))
    raise refused[0]
