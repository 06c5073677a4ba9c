"""A load that jumps, with tips that roll: what is true at the knots is true between them."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import synergrip as sg
from synergrip.linalg import interpolated
from synergrip.planning.beside_jumps import gone_through
from synergrip.planning.executing import Executor, loads
from synergrip.tasks.timed_task import TimedTask

SAME = 1e-6  # N
KNOTS = 25


@cache
def pushed() -> tuple[Executor, TimedTask, np.ndarray]:
    """Return who executes a motion with a step of 12.7 N in its middle, the task, and references at its knots."""
    problem = sg.load_problem("dlr-ball-move", [f"task.knots={KNOTS}"])
    plan = sg.plan(problem.grasp, problem.task)
    assert isinstance(plan, sg.Plan)
    push = sg.Push(force=12.7, direction="x", start=float(plan.time[8]), end=float(plan.time[16]))
    task = replace(problem.task, loads=(*problem.task.loads, push)).timed(problem.grasp)
    return Executor.of(plan.analysis, task), task, plan.dz_r


def with_sides(task: TimedTask, references: np.ndarray, parts: int) -> tuple[np.ndarray, ...]:
    """Return instants, each piece between knots in some parts, references and loads there, with sides of jumps."""
    times = np.unique(
        np.concatenate([task.times, np.linspace(*task.times[[0, -1]], parts * (KNOTS - 1) + 1)]).round(12)
    )
    wrench = task.course.load_at(times)
    gone = gone_through(task.course.marks.jumps, times, interpolated(times, task.times, references), wrench)
    assert len(gone.times) == len(times) + 2
    return gone.times, gone.references, gone.wrench, gone.asked


@pytest.mark.parametrize("parts", [1, 4])
def test_forces_at_knots_are_those_of_a_path_that_goes_through_both_sides(parts: int) -> None:
    executor, task, references = pushed()
    start = executor.setting.start.taken(np.zeros(KNOTS, dtype=int))
    at_knots = executor.run(task.times, references, task.wrench, start)
    times, finer, wrench, asked = with_sides(task, references, parts)
    found = executor.run(times, finer, wrench, executor.setting.start.taken(np.zeros(len(times), dtype=int)))
    assert found.whole
    assert len(at_knots.states) == KNOTS
    there = found.states.forces[asked[::parts]]
    assert np.abs(at_knots.states.forces - there).max() < SAME
    jumps = np.abs(np.diff(found.states.forces, axis=0)).max(axis=1)[np.diff(times) == 0]
    assert np.all(jumps > 1.0)


def test_what_is_known_of_other_references_is_begun_at() -> None:
    """The path of an execution, with the sides of its jumps: no state is found twice."""
    executor, task, references = pushed()
    start = executor.setting.start.taken(np.zeros(KNOTS, dtype=int))
    known = executor.run(task.times, references, task.wrench, start)
    again = executor.run(task.times, references, task.wrench, known)
    assert again.iterations <= 1
    assert np.array_equal(again.kept, known.kept)
    other = executor.run(task.times, references, task.wrench, known.states)
    assert np.abs(other.states.forces - known.states.forces).max() < SAME


def test_pushes_on_both_sides_of_a_knot() -> None:
    """One ends where another begins: just before there is the one, just after the other, at it both."""
    executor = pushed()[0]
    first, second = (sg.Push(force=force, direction="x", start=a, end=b) for force, a, b in ((1, 0.5, 1), (2, 1, 1.5)))
    both = replace(sg.load_problem("dlr-ball-move").task, knots=5, loads=(first, second)).timed(executor.setting.grasp)
    gone = gone_through(both.course.marks.jumps, both.times, np.zeros((5, 4)), both.wrench)
    assert gone.times.tolist() == [0, 0.5, 0.5, 1, 1, 1, 1.5, 1.5, 2]
    assert gone.wrench[:, 0].tolist() == [0, 0, 1, 1, 3, 2, 2, 0, 0]
    assert gone.asked.tolist() == [0, 2, 4, 6, 8]
    at_points = loads(both, gone.times, gone.wrench).at_points.sum(axis=1)
    assert np.allclose(at_points, gone.wrench[:, :3])


def test_nothing_is_added_where_nothing_jumps() -> None:
    _, task, references = pushed()
    same = gone_through((), task.times, references, task.wrench)
    assert same.times is task.times
    jumps = task.course.marks.jumps
    whole = gone_through(jumps, task.times, references, task.wrench)
    again = gone_through(jumps, whole.times, whole.references, whole.wrench)
    assert np.array_equal(again.asked, np.arange(KNOTS + 2))
