"""What is asked of the timing along a path: the rows of all limits at both sides of every grid point, affine in it.

Between grid points the acceleration a is constant, so that b = (ds/dt)^2 is linear in s, and the unknowns v of the
plan are linear in s too: they are the same on both sides of a grid point, where the load jumps.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from synergrip.conic.cones import outside
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.limit import Limit
from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, Places, frozen
from synergrip.margin.timing.by_length import Leg
from synergrip.margin.timing.loads import LoadAlong, load_along
from synergrip.planning.formulated import formulated
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.restraint import NO_LOAD
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask, still
from synergrip.tasks.timing import at_start
from synergrip.values import Value

LOOKS = (1 / 32, 1 / 16, 1 / 8, 1 / 4, 3 / 8, 1 / 2, 5 / 8, 3 / 4, 7 / 8, 15 / 16, 31 / 32)
"""Where between grid points it is looked whether all limits hold there, too, as shares of the part."""
CLOSER = 3
"""How often it is looked again about the instant of each part at which limits are missed most, or nearly missed."""
BETWEEN = 7
"""Instants that are looked at then, between those beside it."""
ADDS_UP = 1e-9
"""Share by which what limits say of a sum of loads may differ from the sum of what they say of each."""


@dataclass(frozen=True, eq=False, repr=False)
class TimingQuestion(Value):
    """A path, a grasp and limits, whose timing is free."""

    grasp: Grasp
    task: Task
    legs: tuple[Leg, ...]
    limits: tuple[Limit, ...]
    """Those that speak of one instant each."""
    formulation: Formulation
    """At both sides of every part: its start, its end, and so on."""
    load: LoadAlong
    """At the same."""

    @cached_property
    def parts(self) -> Array:
        """(n,) length of each part of the path [m]."""
        return frozen(np.concatenate([np.diff(leg.at) for leg in self.legs]))

    @property
    def length(self) -> float:
        """Of the whole path [m]."""
        return float(self.parts.sum())

    @cached_property
    def stops(self) -> Places:
        """Grid points at which the palm is at rest: both ends, and the corners."""
        return np.concatenate([[0], np.cumsum([len(leg.at) - 1 for leg in self.legs])])

    @cached_property
    def rows(self) -> Rows:
        """All limits as rows.

        Raises:
            InputError: a limit is not affine in the load.
        """
        none = np.zeros(len(self.load.at_rest))
        one = none + 1.0
        every = [(none, none), (one, none), (none, one), (one, one)]
        rest, by_a, by_b, both = (self.program_at(self.load.wrench(a, b)) for a, b in every)
        of_a, of_b = by_a.b - rest.b, by_b.b - rest.b
        size = ADDS_UP * (np.abs(rest.b) + np.abs(of_a) + np.abs(of_b) + 1)
        wrong = np.abs(both.b - rest.b - of_a - of_b) > size
        for other in (by_a, by_b, both):
            wrong |= np.asarray(abs(other.A - rest.A).sum(axis=1)).ravel() > ADDS_UP
        for block, own in rest.slices():
            if np.any(wrong[own]):
                message = "is not affine in the load, which the fastest timing takes; leave it out"
                raise InputError.at(block.limit, message)
        return Rows(rest, frozen(of_a), frozen(of_b))

    def program_at(self, wrench: Array) -> Program:
        """Return the rows under some load (2 n, 6)."""
        return Question(replace(self.formulation, wrench=wrench), self.limits, LeastEffort()).program()

    def missing(self, v: Array, b: Array) -> Array:
        """Return how far limits are from holding inside each part (n,), in the units of their rows; 0 where they hold.

        Args:
            v: (n + 1, n_v) unknowns of the plan at the grid points.
            b: (n + 1,) squares of the speed there [m^2/s^2].
        """
        share = np.tile(LOOKS, (len(self.parts), 1))
        beyond = self._beyond(v, b, share)
        worst = beyond.max(axis=1)
        for _ in range(CLOSER):
            at, every = beyond.argmax(axis=1), np.arange(len(share))
            ends = np.pad(share, ((0, 0), (1, 1)), constant_values=((0, 0), (0, 1)))
            share = np.linspace(ends[every, at], ends[every, at + 2], BETWEEN + 2, axis=1)[:, 1:-1]
            beyond = self._beyond(v, b, share)
            worst = np.maximum(worst, beyond.max(axis=1))
        return frozen(np.maximum(worst, 0.0))

    def _beyond(self, v: Array, b: Array, share: Array) -> Array:
        """Return how far limits are missed (n, k), below 0 where they hold.

        Args:
            v: (n + 1, n_v).
            b: (n + 1,).
            share: (n, k) where in each part, from 0 to 1.
        """
        a, count = np.diff(b) / (2 * self.parts), share.shape[1]
        inner = b[:-1, None] * (1 - share) + b[1:, None] * share
        found = None
        for leg, first in zip(self.legs, self.stops, strict=False):
            own = slice(int(first), int(first) + len(leg.at) - 1)
            at = (leg.at[:-1, None] + np.diff(leg.at)[:, None] * share[own]).ravel()
            load = load_along(self.grasp, self.task, leg, at)
            wrench = load.wrench(np.repeat(a[own], count), inner[own].ravel())
            found = wrench if found is None else np.concatenate([found, wrench])
        assert found is not None
        part = share[:, :, None]
        unknowns = (v[:-1, None] * (1 - part) + v[1:, None] * part).reshape(-1, v.shape[1])
        formulation = _at(self.formulation, found)
        program = Question(formulation, self.limits, LeastEffort()).program()
        return _outside(program, program.b - program.A @ unknowns.ravel()).reshape(-1, count)


@dataclass(frozen=True, eq=False, repr=False)
class Rows(Value):
    """Rows ``b + of_a a + of_b b - A v`` in their cones, at both sides of every part."""

    at_rest: Program
    of_a: Array  # (m,)
    of_b: Array  # (m,)

    @cached_property
    def instant(self) -> Places:
        """(m,) of which instant each row speaks."""
        found = [np.repeat(block.instants, block.dim) for block in self.at_rest.blocks]
        return np.concatenate([np.zeros(0, dtype=np.int64), *found])


def timing_question(
    grasp: Grasp, task: Task, timed: TimedTask, path: tuple[Leg, ...], usual: tuple[Array | float, Array | float]
) -> TimingQuestion:
    """Return the question of the linear model of the start posture, which holds the load at rest when the task begins.

    Args:
        grasp: who plans.
        task: what is asked; its loads are not bound to time.
        timed: the same at its knots.
        path: of the palm, legs between its stops.
        usual: acceleration and square of the speed along the path as they are about [m/s^2, m^2/s^2], one for all or
            (2 n,) at both sides of every part; for the units.

    Raises:
        Refusal: the load needs what the contacts leave free.
        InputError: inertia without a mass.
    """
    load = None
    for leg in path:
        ends = np.column_stack([leg.at[:-1], leg.at[1:]]).ravel()
        own = load_along(grasp, task, leg, ends)
        load = own if load is None else load.and_then(own)
    assert load is not None
    limits = tuple(each for each in timed.all_limits if not each.couples_knots)
    begun = at_start(grasp, load.at_rest[0])
    analysis = analyse(begun, NO_LOAD)
    one = np.ones(len(load.at_rest))
    formulation = _formulation(analysis, timed, load.wrench(usual[0] * one, usual[1] * one))
    return TimingQuestion(begun, task, path, limits, formulation, load)


def _formulation(analysis: Analysis, timed: TimedTask, wrench: Array) -> Formulation:
    """Return what the unknowns mean at some instants, in units that suit a load (T, 6) there."""
    times = frozen(np.arange(float(len(wrench))))
    posed = replace(
        timed, times=times, wrench=wrench, target=still(times), course=None, between=None, control=None,
        limits=tuple(each for each in timed.limits if not each.couples_knots),
    )  # fmt: skip
    return formulated(analysis, posed, redundancy=timed.watches_references)


def _at(formulation: Formulation, wrench: Array) -> Formulation:
    """Return the same at other instants, which differ in nothing but the load (T, 6)."""
    count = len(wrench)
    parts = {
        name: replace(part, constant=frozen(np.tile(part.constant[:1], (count, 1))))
        for name in ("alpha", "beta", "gamma")
        for part in (getattr(formulation, name),)
    }
    target = frozen(np.tile(formulation.target[:1], (count, 1)))
    return replace(formulation, times=frozen(np.arange(float(count))), wrench=frozen(wrench), target=target, **parts)


def _outside(program: Program, slack: Array) -> Array:
    """Return how far the slack (m,) is outside the cones of each instant (T,), below 0 inside."""
    worst = np.full(program.knots, -np.inf)
    for block, rows in program.slices():
        np.maximum.at(worst, block.instants, outside(block, slack[rows]))
    return worst
