"""Answers that pencil and paper give."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from named_goals import goals
from small_grasps import pinch, tripod

from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.object_error import ObjectError
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.linalg import Array, frozen
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan
from synergrip.tasks.timed_task import TimedTask, still


def task(wrench: Array, margin: float, goal: str, *limits) -> TimedTask:
    w = np.atleast_2d(np.asarray(wrench, dtype=float))
    times = np.linspace(0, 1, len(w)) if len(w) > 1 else np.zeros(1)
    return TimedTask(times, w, still(times), margin, limits, goals(goal))


def planned(*args) -> Plan:
    outcome = plan(*args)
    assert isinstance(outcome, Plan), outcome
    assert all(d.certificate.verified for d in outcome.decisions)
    return outcome


@pytest.mark.parametrize("weight", [0.0, 1.0, 5.0])
@pytest.mark.parametrize("moment", [0.0, 0.004])
@pytest.mark.parametrize("goal", ["effort", "torque", "peak_force"])
def test_antipodal_pinch_with_weight_and_spin(weight: float, moment: float, goal: str) -> None:
    mu, nu, margin = 0.5, 0.005, 0.3
    outcome = planned(pinch(mu, nu), task([0, 0, -weight, moment, 0, 0], margin, goal, NormalForce(0.0, 50.0)))
    n = (margin + np.sqrt((weight / 2) ** 2 + (mu * moment / (2 * nu)) ** 2)) / mu
    assert np.allclose(outcome.motion.forces[0, [0, 4]], n, rtol=2e-6)
    assert np.allclose(outcome.motion.dz_r, 1e-3 * n, rtol=2e-6)  # force = displacement / C_s, each finger its own way
    assert outcome.margins.min() == pytest.approx(margin, abs=1e-6)


@pytest.mark.parametrize("weight", [0.5, 2.0, 8.0])
def test_the_largest_margin_of_a_pinch_is_mu_n_less_half_the_weight(weight: float) -> None:
    outcome = planned(pinch(), task([0, 0, -weight, 0, 0, 0], 0.0, "margin", NormalForce(0.0, 20.0)))
    assert outcome.largest_margin == pytest.approx(0.5 * 20 - weight / 2, rel=1e-7)


def test_two_soft_fingers_carry_twice_nu_n_about_their_line_and_no_more() -> None:
    """With the whole of friction spent on the spin: moment 2 nu N."""
    for factor, verdict in ((0.999, "feasible"), (1.001, "infeasible")):
        moment = factor * 2 * 0.005 * 20
        outcome = plan(pinch(), task([0, 0, 0, moment, 0, 0], 0.0, "effort", NormalForce(0.0, 20.0)))
        assert outcome.verdict == verdict, factor
    outcome = planned(pinch(), task([0, 0, 0, 0.1, 0, 0], 0.0, "margin", NormalForce(0.0, 20.0)))
    assert outcome.largest_margin == pytest.approx(0.5 * 20 - 0.5 * 0.05 / 0.005, rel=1e-7)


def test_the_largest_margin_of_a_pinch_is_what_the_limit_leaves() -> None:
    outcome = planned(pinch(), task([0, 0, -2, 0.004, 0, 0], 0.0, "margin", NormalForce(0.0, 20.0)))
    assert outcome.largest_margin == pytest.approx(0.5 * 20 - np.sqrt(1 + 0.2**2), rel=1e-7)
    assert outcome.margins.min() == pytest.approx(outcome.largest_margin, abs=1e-5)


def test_a_pinch_asked_for_more_than_its_limit_is_refused_with_the_largest_margin() -> None:
    largest = 0.5 * 20 - np.sqrt(1 + 0.2**2)
    for factor, verdict in ((0.999, Plan), (1.001, Infeasible), (1.5, Infeasible)):
        outcome = plan(pinch(), task([0, 0, -2, 0.004, 0, 0], factor * largest, "effort", NormalForce(0.0, 20.0)))
        assert isinstance(outcome, verdict), factor
        if isinstance(outcome, Infeasible):
            assert outcome.certificate.verified
            assert outcome.stage == "magnitude"
            assert outcome.largest_margin == pytest.approx(largest, rel=1e-6)


@pytest.mark.parametrize(
    ("limit", "normal"),
    [(JointTorque(frozen(np.full(8, 4.0))), 4.0), (SynergyReference(frozen([0.006])), 6.0)],
)
def test_torque_and_reference_limits_bite(limit, normal: float) -> None:
    """Unit Jacobian: tau_1 = n; n = dz_r / C_s."""
    outcome = planned(pinch(), task(np.zeros(6), 0.0, "margin", limit))
    assert outcome.largest_margin == pytest.approx(0.5 * normal, rel=1e-6)


def test_tripod_under_weight() -> None:
    mu, weight, margin = 0.8, 3.0, 0.4
    outcome = planned(tripod(mu), task([0, 0, -weight, 0, 0, 0], margin, "effort", NormalForce(0.0, 50.0)))
    n = (margin + weight / 3) / mu
    assert np.allclose(outcome.motion.forces[0, [0, 3, 6]], n, rtol=1e-6)


@pytest.mark.parametrize("below", [0.1, 0.3, 0.5])
def test_three_fingers_below_the_equator_of_a_ball(below: float) -> None:
    """Vertical balance n sin + t cos = W / 3 with n at its limit N: margin mu N - |W / 3 - N sin| / cos."""
    mu, weight, largest = 0.8, 3.0, 10.0
    outcome = planned(tripod(mu, below), task([0, 0, -weight, 0, 0, 0], 0.0, "margin", NormalForce(0.0, largest)))
    margin = mu * largest - abs(weight / 3 - largest * np.sin(below)) / np.cos(below)
    assert outcome.largest_margin == pytest.approx(margin, rel=1e-7)


def test_three_fingers_far_below_the_equator_press_the_ball_up_and_out() -> None:
    """Beyond the friction angle a squeeze costs margin: it is best when nothing but the weight is tangential."""
    mu, weight, below = 0.3, 3.0, 0.6
    outcome = planned(tripod(mu, below), task([0, 0, -weight, 0, 0, 0], 0.0, "margin", NormalForce(0.0, 50.0)))
    n = weight / 3 / np.sin(below)  # no tangential force at all
    assert outcome.largest_margin == pytest.approx(mu * n, rel=1e-7)
    assert np.allclose(outcome.motion.forces[0, [0, 3, 6]], n, rtol=1e-5)


@pytest.mark.parametrize("joint_compliance", [0.0, 2e-3])
def test_a_joint_that_ends_its_range_ends_the_squeeze(joint_compliance: float) -> None:
    """q = dz_r - C_q n and (C_s + C_q) n = dz_r: the joint is at C_s n whatever its own compliance."""
    room, free = 6e-3, np.full(8, np.inf)
    upper = np.r_[np.inf, np.inf, np.inf, np.inf, 0.1 + room, np.inf, np.inf, np.inf]
    limit = JointRange(frozen(np.full(8, 0.1)), frozen(-free), frozen(upper))
    outcome = planned(pinch(joint_compliance=joint_compliance), task(np.zeros(6), 0.0, "margin", limit))
    assert outcome.largest_margin == pytest.approx(0.5 * room / 1e-3, rel=1e-6)
    assert outcome.motion.dz_r[0, 0] == pytest.approx(room * (1 + joint_compliance / 1e-3), rel=1e-5)


def test_a_joint_that_yields_under_the_load_may_leave_its_range() -> None:
    """The joints across the normals carry half the weight each and give way by C_q W / 2, whatever the squeeze."""
    room = 2e-3 * 3.0 / 2
    for factor, verdict in ((1.001, "feasible"), (0.999, "infeasible")):
        ends = np.full(8, factor * room)
        ends[[0, 4]] = np.inf  # along the normals
        limit = JointRange(frozen(np.zeros(8)), frozen(-ends), frozen(ends))
        outcome = plan(pinch(joint_compliance=2e-3), task([0, 0, -3, 0, 0, 0], 0.1, "effort", limit))
        assert outcome.verdict == verdict
        if isinstance(outcome, Infeasible):
            assert {conflict.key for conflict in outcome.conflicts} == {"limits.joint_range"}


def test_a_squeeze_may_push_the_object_no_farther_than_its_limit() -> None:
    """The softer side gives way: the object moves by n (C_right - C_left) / 2."""
    grasp = pinch(compliance=(1e-3, 3e-3))
    outcome = planned(grasp, task(np.zeros(6), 0.0, "margin", ElasticMotion(5e-3), NormalForce(0.0, 50.0)))
    assert outcome.largest_margin == pytest.approx(0.5 * 5e-3 / 1e-3, rel=1e-6)
    assert outcome.motion.du[0, 0] == pytest.approx(5e-3, rel=1e-5)


def test_drift_counts_the_sag_under_the_load() -> None:
    """Each contact carries half the weight: a sag of C W / 2, which no squeeze of equal contacts changes."""
    for factor, verdict in ((1.001, "feasible"), (0.999, "infeasible")):
        limit = ObjectError(factor * 1e-3 * 2 / 2)
        outcome = plan(pinch(), task([0, 0, -2, 0, 0, 0], 0.1, "effort", limit, NormalForce(0.0, 20.0)))
        assert outcome.verdict == verdict
        if isinstance(outcome, Infeasible):
            assert {conflict.key for conflict in outcome.conflicts} == {"limits.drift"}


def test_effort_is_least_among_all_squeezes() -> None:
    """Squeezing a little more or less than the plan is worse or breaks the cone."""
    grasp = pinch()
    outcome = planned(grasp, task([0, 0, -2, 0, 0, 0], 0.3, "effort", NormalForce(0.0, 50.0)))
    contact = grasp.contacts[0]
    for change, holds in ((0.01, True), (-0.01, False)):
        force = np.array(outcome.motion.forces[0, :4])
        force[0] += change
        assert (contact.slip_margin(force) >= 0.3) is np.bool_(holds)


def test_given_initial_forces_are_the_start() -> None:
    squeezed = np.zeros(8)
    squeezed[[0, 4]] = 7.0
    grasp = replace(pinch(), lambda_0=frozen(squeezed))
    outcome = planned(grasp, task([0, 0, -2, 0, 0, 0], 0.3, "effort", NormalForce(0.0, 50.0)))
    n = (0.3 + 1.0) / 0.5
    assert np.allclose(outcome.motion.forces[0, [0, 4]], n, rtol=1e-6)
    assert np.allclose(outcome.motion.dz_r, 1e-3 * (n - 7.0), rtol=1e-6)  # the references loosen the grip


def test_the_worst_margin_is_over_all_knots() -> None:
    wrench = np.zeros((3, 6))
    wrench[:, 2] = [-1, -4, -2]
    outcome = planned(pinch(), task(wrench, 0.0, "margin", NormalForce(0.0, 20.0)))
    assert outcome.largest_margin == pytest.approx(0.5 * 20 - 2, rel=1e-6)
    # at that margin no knot squeezes more than it must
    assert np.allclose(outcome.margins.min(axis=1), outcome.largest_margin, atol=1e-4)


@pytest.mark.parametrize("goal", ["effort", "torque", "peak_force"])
def test_a_grip_on_nothing_is_let_go(goal: str) -> None:
    """No load, no margin: the best force is none, and rounding is judged against the forces that cancel."""
    squeezed = np.zeros(8)
    squeezed[[0, 4]] = 0.97
    grasp = replace(pinch(), lambda_0=frozen(squeezed))
    outcome = planned(grasp, task(np.zeros(6), 0.0, goal, JointTorque(frozen(np.full(8, 1.0)))))
    assert np.abs(outcome.motion.forces).max() < 1e-4
    assert np.allclose(outcome.motion.dz_r, -0.97e-3, rtol=1e-3)
