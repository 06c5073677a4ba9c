"""How many digits of equilibria are looked for, and derivatives that are known from states very near them."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np

from synergrip.equilibrium.balance import Balance
from synergrip.equilibrium.execute import execute
from synergrip.equilibrium.newton import AT_REST, ROUGH
from synergrip.planning.executing import Executor, loads
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem
from synergrip.statics.analysis import analyse


def planned(name: str) -> tuple[Plan, Executor]:
    """Return the plan of a problem, and who executes it."""
    problem = load_problem(name)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    return answer, Executor.of(analyse(problem.grasp), answer.task)


def test_of_forces_that_are_not_looked_for_few_digits_are_found() -> None:
    answer, executor = planned("human-ball")
    first, asked = answer.executed, list[int]()

    def wrong(forces: np.ndarray) -> bool:
        asked.append(len(forces))
        return True

    near = first.interpolated(first.times + 1e-3)
    rough = executor.run(first.times, first.references, answer.task.wrench, near, wrong)
    exact = executor.run(first.times, first.references, answer.task.wrench, near, lambda forces: not wrong(forces))
    assert asked == [len(first.times)] * 2  # of the instants alone, and once
    assert AT_REST < rough.residual <= ROUGH
    assert exact.residual <= AT_REST
    assert rough.iterations < exact.iterations
    assert np.abs(rough.states.forces - exact.states.forces).max() < 1e-4


def test_derivatives_from_very_near_are_those_of_the_equilibrium() -> None:
    answer, executor = planned("human-ball")
    known = answer.executed
    first = executor.run(known.times, known.references, answer.task.wrench, known)
    again = executor.run(first.times, first.references + 1e-8, answer.task.wrench, first)
    assert again.path.known_inverse is not None  # no tangent was inverted for it
    fresh = replace(again.path, known_inverse=None)
    for each in fields(fresh.maps):
        told, true = getattr(again.path.maps, each.name), getattr(fresh.maps, each.name)
        assert np.allclose(told, true, rtol=0, atol=1e-4 * np.abs(true).max())
    farther = executor.run(first.times, first.references + 1e-3, answer.task.wrench, first)
    assert farther.path.known_inverse is None


def test_an_execution_of_another_grasp_is_a_place_to_begin_at_and_no_more() -> None:
    problem = load_problem("human-ball")
    answer, _ = planned("human-ball")
    first, task = answer.executed, answer.task
    other = problem.grasp.replace(C_s=2 * problem.grasp.C_s)
    load = loads(task, task.times, task.wrench)
    known = execute(other, first.times, first.references, load, guess=first)
    alone = execute(other, first.times, first.references, load)
    assert np.allclose(known.states.forces, alone.states.forces, rtol=0, atol=1e-9)
    assert isinstance(known.path, Balance)
