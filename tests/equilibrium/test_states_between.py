"""States between equilibria, from the derivatives of these: where Newton's method begins there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from synergrip import load_problem
from synergrip.equilibrium.setting import ContactModel, setting
from synergrip.linalg import interpolated
from synergrip.planning.executing import Executor
from synergrip.planning.planning import plan
from synergrip.statics.analysis import analyse
from synergrip.vectors import quaternions, rotation_matrices, rotation_vectors

NAMES = ("human-ball", "dlr-ball-move", "gripper-peg")


def off(name: str, every: int, model: ContactModel, bent: float = 0.0) -> tuple[float, float]:
    """Return how far [N] forces guessed half-way between every n-th knot are off, and straight lines there.

    `bent` is a load that the knots do not know of [N].
    """
    problem = load_problem(name, ["task.knots=25"])
    answer = plan(problem.grasp, problem.task)
    executor = Executor.of(analyse(problem.grasp), answer.task)
    executor = replace(executor, setting=setting(problem.grasp, model))
    times = answer.task.times[::every]
    references, wrench = (each[::every] for each in (answer.dz_r, answer.task.wrench))
    known = executor.run(times, references, wrench, answer.executed.states.taken(slice(None, None, every)))
    middle = (times[1:] + times[:-1]) / 2
    load = interpolated(middle, times, wrench) + bent * np.eye(6)[2]
    guess = known.interpolated(middle, load if bent else None)
    truth = executor.run(middle, interpolated(middle, times, references), load, guess).states.forces
    lines = interpolated(middle, times, known.states.forces)
    return tuple(float(np.abs(each - truth).max()) for each in (guess.forces[len(guess) - len(middle) :], lines))


@pytest.mark.parametrize("name", NAMES)
def test_twice_the_knots_leave_a_sixteenth(name: str) -> None:
    """Straight lines leave a fourth."""
    (coarse, lines), (fine, shorter) = off(name, 4, "fixed"), off(name, 2, "fixed")
    assert fine < coarse / 10
    assert shorter > lines / 6


@pytest.mark.parametrize("name", NAMES)
def test_where_tips_roll_they_are_near(name: str) -> None:
    """But for where tips are when they roll in other steps."""
    guess, lines = off(name, 1, "rolling")
    assert guess < 0.03 * lines


def test_a_load_that_the_knots_do_not_know_is_counted() -> None:
    guess, lines = off("dlr-ball-move", 1, "rolling", bent=0.2)
    assert guess < 0.02 * lines


@pytest.mark.parametrize("angle", [0.0, 1e-200, 1e-12, 1e-7, 1e-2, 1.0, 1.6, 2.1, 3.1, 3.1415926])
def test_rotation_vectors_are_those_of_the_rotations(angle: float) -> None:
    axes = np.random.default_rng(1).normal(size=(4, 3, 3))
    vectors = angle * axes / np.linalg.norm(axes, axis=-1, keepdims=True)
    rotations = Rotation.from_rotvec(vectors.reshape(-1, 3)).as_matrix().reshape(4, 3, 3, 3)
    assert np.allclose(rotation_vectors(rotations), vectors, rtol=0, atol=1e-14)
    assert np.allclose(rotation_matrices(vectors), rotations, rtol=0, atol=1e-14)
    second = Rotation.from_rotvec(vectors.reshape(-1, 3)).as_quat(canonical=True)[:, [3, 0, 1, 2]]
    assert np.allclose(quaternions(rotations.reshape(-1, 3, 3)), second, rtol=0, atol=1e-15)


@pytest.mark.parametrize("name", NAMES)
def test_two_ways_to_an_equilibrium_agree_to_its_digits(name: str) -> None:
    """From the path and from the linear model; human-ball has fingers that are soft enough to tell 1e-11 from less."""
    problem = load_problem(name)
    answer = plan(problem.grasp, problem.task)
    executor = Executor.of(analyse(problem.grasp), answer.task)
    first = answer.executed
    second = executor.run(first.times, first.references, answer.task.wrench, first.interpolated(first.times))
    assert max(first.residual, second.residual) <= 1e-12
    assert np.allclose(first.du, second.du, rtol=0, atol=1e-12)


def test_states_that_come_with_those_of_the_first_squeeze_are_those_of_their_instants() -> None:
    """Also where there are several steps from one instant to the next."""
    problem = load_problem("dlr-ball-turn", ["task.knots=5"])
    answer = plan(problem.grasp, problem.task)
    known, executor = answer.executed, Executor.of(analyse(problem.grasp), answer.task)
    assert np.diff(known.kept).max() > 1
    without = executor.run(known.times, known.references, answer.task.wrench, known.states)
    along = known.interpolated(known.times)
    assert len(along) > len(known.times)
    assert executor.run(known.times, known.references, answer.task.wrench, along).iterations <= without.iterations
