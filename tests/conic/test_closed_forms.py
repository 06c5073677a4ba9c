"""Answers that pencil and paper give."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.grasps.contact import Contact, contact_frame
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.grasps.kinds import contact_kind
from synergrip.linalg import Array, frozen
from synergrip.plans.outcome import Infeasible, Plan
from synergrip.plans.planning import plan
from synergrip.plans.task import Task, still


def pinch(mu: float = 0.5, nu: float = 0.005) -> Grasp:
    """Two soft fingers 40 mm apart on x; one synergy closes both by 1 m per unit; C_s = 1 mm/N."""
    contacts = tuple(
        Contact(name, contact_kind("soft"), mu, nu, frozen(point), contact_frame(normal))
        for name, point, normal in (("left", [-0.02, 0, 0], [1, 0, 0]), ("right", [0.02, 0, 0], [-1, 0, 0]))
    )
    S = np.zeros((8, 1))
    S[[0, 4], 0] = 1
    return Grasp("pinch", contacts, grasp_matrix(contacts), frozen(np.eye(8)), frozen(S), frozen(1e-3 * np.eye(8)),
                 frozen(np.zeros((8, 8))), frozen(np.zeros((1, 1))), None, frozen(np.zeros(6)),
                 tuple(f"q{i}" for i in range(8)), ("squeeze",))  # fmt: skip


def tripod(mu: float = 0.8) -> Grasp:
    """Three hard fingers at 120 degrees in the xy plane, each closed by its own synergy."""
    contacts = []
    for i in range(3):
        direction = np.array([np.cos(2 * np.pi * i / 3), np.sin(2 * np.pi * i / 3), 0])
        contacts.append(
            Contact(f"C{i}", contact_kind("hard"), mu, 0, frozen(0.04 * direction), contact_frame(-direction))
        )
    S = np.zeros((9, 3))
    S[[0, 3, 6], [0, 1, 2]] = 1
    return Grasp("tripod", tuple(contacts), grasp_matrix(contacts), frozen(np.eye(9)), frozen(S),
                 frozen(1e-3 * np.eye(9)), frozen(np.zeros((9, 9))), frozen(np.zeros((3, 3))), None,
                 frozen(np.zeros(6)), tuple(f"q{i}" for i in range(9)), ("a", "b", "c"))  # fmt: skip


def task(wrench: Array, margin: float, goal: str, *limits) -> Task:
    w = np.atleast_2d(np.asarray(wrench, dtype=float))
    times = np.linspace(0, 1, len(w)) if len(w) > 1 else np.zeros(1)
    return Task(times, w, still(times), margin, limits, (goal,))


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
