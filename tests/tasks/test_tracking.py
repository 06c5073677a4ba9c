"""What becomes of a wanted motion: coordinates of Gamma_ucs, or a refusal that says what leaves it."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from random_tasks import hand_like_grasp

from synergrip.errors import InputError, MotionCountError, MotionDirectionError
from synergrip.grasps.scale import scale_of
from synergrip.linalg import frozen
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.planning.refusals import refusal_certificate
from synergrip.problems.problem import Problem, load_problem
from synergrip.statics.analysis import Analysis, analyse
from synergrip.tasks.timed_task import Target, TimedTask, still
from synergrip.tasks.tracking import rigid_coordinates, target_displacement

LENGTH = 0.04
"""Characteristic length of the tripod, whose synergies lift the puck along z and twist it about z [m]."""


@cache
def _tripod() -> tuple[Problem, Analysis]:
    problem = load_problem("tripod")
    return problem, analyse(problem.grasp)


def _task(values: object, kind: str = "motion", tolerance: float = 0.0) -> TimedTask:
    """A task whose knots are the rows of `values`, under no load."""
    wanted = frozen(values)
    count = len(wanted)
    task = _tripod()[0].timed
    return replace(
        task, times=frozen(np.linspace(0, 1, count)), wrench=frozen(np.zeros((count, 6))), tolerance=tolerance,
        target=Target(kind, wanted, "task.motion"),  # type: ignore[arg-type]
    )  # fmt: skip


def _beta(values: object, kind: str = "motion", tolerance: float = 0.0) -> np.ndarray:
    return rigid_coordinates(_tripod()[1], _task(values, kind, tolerance))


def test_a_lift_and_a_twist_of_the_tripod_are_read_off() -> None:
    beta = _beta([[0] * 6, [0, 0, 0.005, 0, 0, 0], [0, 0, 0.005, 0, 0, 0.1]])
    assert np.abs(beta) == pytest.approx(np.array([[0, 0], [0.005, 0], [0.005, 0.1 * LENGTH]]), abs=1e-11)


@pytest.mark.parametrize("seed", range(12))
def test_a_motion_made_of_gamma_ucs_gives_its_coordinates_back(seed: int) -> None:
    rng = np.random.default_rng(seed)
    grasp = hand_like_grasp(rng)
    grasp = replace(grasp, S=frozen(np.eye(grasp.n_q)), C_z=0.0, synergies=grasp.joints)
    analysis = analyse(grasp)
    basis = analysis.spaces.Gamma_ucs
    assert basis.shape[1] > 0
    beta = 0.01 * rng.normal(size=(4, basis.shape[1]))
    assert rigid_coordinates(analysis, _task(beta @ basis.T)) == pytest.approx(beta, abs=1e-12)


def test_to_hold_and_to_stay_are_the_same() -> None:
    times = frozen(np.linspace(0, 1, 3))
    held = rigid_coordinates(_tripod()[1], replace(_task(np.zeros((3, 6))), target=still(times)))
    assert held.tolist() == _beta(np.zeros((3, 6))).tolist() == [[0, 0]] * 3


def test_rounding_of_the_data_is_forgiven_and_more_is_not() -> None:
    assert _beta([[0, 0, 0.005, 0, 0, 0], [4e-9, 0, 0.005, 0, 0, 0]])[1] == pytest.approx([0.005, 0], abs=1e-9)
    with pytest.raises(MotionDirectionError):
        _beta([[0, 0, 0.005, 0, 0, 0], [6e-9, 0, 0.005, 0, 0, 0]])


SIDEWAYS = [[0, 0, 0, 0, 0, 0], [0.001, 0, 0.004, 0, 0, 0], [0.003, 0, 0.004, 0, 0, 0], [0.002, 0, 0.004, 0, 0, 0]]


def test_what_leaves_gamma_ucs_is_told_with_share_time_and_size() -> None:
    with pytest.raises(MotionDirectionError) as caught:
        _beta(SIDEWAYS)
    refusal = caught.value
    assert refusal.stage == "direction"
    assert refusal.time_s == pytest.approx(2 / 3)
    assert refusal.share == pytest.approx(0.6, abs=1e-9)
    assert refusal.size == pytest.approx(0.003, abs=1e-12)
    assert refusal.residual == pytest.approx([0.003, 0, 0, 0, 0, 0], abs=1e-12)
    for word in ("60%", "t = 0.667 s", "(3, 0, 4) mm", "(3, 0, 0) mm", "dimension 2", "4 synergies"):
        assert word in str(refusal)


def test_a_tilt_is_measured_by_the_length_of_the_grasp() -> None:
    with pytest.raises(MotionDirectionError) as caught:
        _beta([[0, 0, 0.003, 0, 0, 0], [0, 0, 0.003, 0.1, 0, 0]])
    assert caught.value.size == pytest.approx(0.1 * LENGTH, abs=1e-11)
    assert caught.value.share == pytest.approx(0.8, abs=1e-9)


def test_a_tolerance_lets_the_rigid_motion_be_the_nearest_one() -> None:
    beta = _beta(SIDEWAYS, tolerance=0.0031)
    assert beta[2] == pytest.approx([0.004, 0], abs=1e-11)
    with pytest.raises(MotionDirectionError):
        _beta(SIDEWAYS, tolerance=0.0029)
    outcome = plan(_tripod()[0].grasp, _task(SIDEWAYS, tolerance=0.0031))
    assert isinstance(outcome, Plan)


def test_a_refused_direction_comes_with_a_verified_proof() -> None:
    outcome = plan(_tripod()[0].grasp, _task(SIDEWAYS))
    assert isinstance(outcome, Infeasible)
    assert (outcome.stage, outcome.exit_code) == ("direction", 1)
    assert (outcome.certificate.kind, outcome.certificate.verified) == ("infeasible", True)
    assert not outcome.decisions


@pytest.mark.parametrize("residual", [[0, 0, 0.003, 0, 0, 0], [0, 0.003, 0, 0, 0, 0]])
def test_a_direction_that_the_synergies_reach_or_nobody_asks_for_proves_nothing(residual: list[float]) -> None:
    _, analysis = _tripod()
    refusal = MotionDirectionError("", frozen(residual), 0.0, 0.5, 0.003)
    assert not refusal_certificate(_task(SIDEWAYS), analysis, refusal).verified


def _independent(count: int) -> np.ndarray:
    """Motions at `count` knots, each in a direction of its own."""
    return np.diag([0.01, 0.01, 0.01, 0.1, 0.1, 0.1])[:count]


def test_more_motions_than_synergies_are_refused_by_count() -> None:
    problem, analysis = _tripod()
    assert problem.grasp.n_z == 4
    wanted = np.random.default_rng(7).normal(size=(5, 6))
    with pytest.raises(MotionCountError) as caught:
        _beta(wanted)
    refusal = caught.value
    assert (refusal.asked, refusal.available, refusal.stage) == (5, 4, "count")
    assert "asks for 5 independent object motions, the hand has n_z = 4" in str(refusal)
    scaled = scale_of(problem.grasp).twist(np.vstack([refusal.directions.T, wanted]))
    assert np.linalg.matrix_rank(scaled, tol=1e-9) == 5  # they span what was asked
    assert refusal_certificate(_task(wanted), analysis, refusal).verified


def test_as_many_motions_as_synergies_are_not_refused_by_count() -> None:
    with pytest.raises(MotionDirectionError):
        _beta(_independent(4))


@pytest.mark.parametrize("asked", [4, 6])
def test_a_count_that_does_not_hold_is_not_verified(asked: int) -> None:
    _, analysis = _tripod()
    refusal = MotionCountError("", asked, 4, frozen(np.zeros((6, asked))))
    wanted = _independent(5)
    task = _task(np.vstack([wanted, wanted]))
    assert not refusal_certificate(task, analysis, refusal).verified


def test_a_refused_count_is_an_outcome_with_a_verified_proof() -> None:
    outcome = plan(_tripod()[0].grasp, _task(_independent(5)))
    assert isinstance(outcome, Infeasible)
    assert (outcome.stage, outcome.certificate.verified) == ("count", True)


def test_modes_are_taken_as_they_are() -> None:
    assert _beta([[0, 0], [0.001, -0.002]], "modes").tolist() == [[0, 0], [0.001, -0.002]]
    assert _beta([[0], [0.001]], "mode moves").tolist() == [[0, 0], [0.001, 0]]


@pytest.mark.parametrize(("kind", "columns"), [("modes", 1), ("modes", 3), ("mode moves", 3)])
def test_modes_with_another_number_of_columns_are_bad_input(kind: str, columns: int) -> None:
    with pytest.raises(InputError) as caught:
        _beta(np.zeros((2, columns)), kind)
    assert caught.value.issues[0].key == "task.motion"
    assert "dimension 2" in caught.value.issues[0].message


def test_axes_that_are_listed_again_are_no_more_axes() -> None:
    _, analysis = _tripod()
    task = replace(_task(np.ones((1, 6))), axes=("z",) * 6)
    assert target_displacement(analysis, task, task.target.values).tolist() == [[0, 0, 1, 0, 0, 0]]
