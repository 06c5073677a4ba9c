"""Every limit says the same twice: as rows of the program and, in physical terms, about a motion."""

from __future__ import annotations

import numpy as np
import pytest
from random_formulations import KNOTS, LIMITS, random_formulation

from synergrip.conic.build import build
from synergrip.conic.cones import distance_to_cones
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.goals.least_reconfiguration import LeastReconfiguration
from synergrip.conic.limits.friction_cone import FrictionCone
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.linalg import frozen
from synergrip.statics.motion import Motion, forward


def motion_of(formulation: Formulation, v: np.ndarray) -> Motion:
    references = formulation.coordinates.references(*formulation.parts(v))
    return forward(formulation.response, formulation.times, references, formulation.wrench)


@pytest.mark.parametrize("name", LIMITS)
@pytest.mark.parametrize("seed", range(6))
def test_rows_and_usage_agree_on_what_is_allowed(name: str, seed: int) -> None:
    rng, formulation = random_formulation(seed)
    limit = LIMITS[name](formulation.response.grasp)
    program = build(formulation, [limit], LeastEffort())
    verdicts = set()
    for size in np.geomspace(1e-3, 10, 30):
        v = size * rng.normal(size=(KNOTS, formulation.n_v))
        outside = distance_to_cones(program, program.b - program.A @ v.ravel())
        excess = limit.usage(formulation, motion_of(formulation, v)).excess.max()
        assert (outside > 0) == (excess > 0)
        verdicts.add(bool(excess > 0))
    assert True in verdicts or (name.startswith("drift of the rigid") and not formulation.beta_basis.size)  # it bites


@pytest.mark.parametrize("seed", range(6))
def test_distance_is_the_excess_in_the_limits_own_units(seed: int) -> None:
    rng, formulation = random_formulation(seed)
    v = rng.normal(size=(KNOTS, formulation.n_v))
    grasp, motion = formulation.response.grasp, motion_of(formulation, v)
    units = {
        "friction": np.full(grasp.n_c, formulation.force_unit), "normal": np.full(grasp.n_c, formulation.force_unit),
        "torque": np.linspace(0.05, 0.3, grasp.n_q), "effort": np.linspace(0.1, 0.6, grasp.n_z),
        "reference": np.linspace(0.01, 0.05, grasp.n_z),
    }  # fmt: skip
    for name, unit in units.items():
        limit = LIMITS[name](grasp)
        program = build(formulation, [limit], LeastEffort())
        excess = float((limit.usage(formulation, motion).excess / unit).max())
        assert distance_to_cones(program, program.b - program.A @ v.ravel()) == pytest.approx(max(excess, 0), rel=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_objectives_are_what_their_names_say(seed: int) -> None:
    rng, formulation = random_formulation(seed)
    grasp, scale = formulation.response.grasp, formulation.response.scale
    v, u = rng.normal(size=(2, KNOTS, formulation.n_v))
    one, two = motion_of(formulation, v), motion_of(formulation, u)
    efforts = {
        LeastEffort(): lambda m: ((m.forces * scale.force / formulation.force_unit) ** 2).sum() / 2,
        LeastEffort("torque"): lambda m: ((m.torques / (formulation.force_unit * scale.length)) ** 2).sum() / 2,
    }
    for goal, effort in efforts.items():
        program = build(formulation, [], goal)
        difference = program.objective(v.ravel()) - program.objective(u.ravel())  # the constant part drops out
        assert difference == pytest.approx(effort(one) - effort(two), rel=1e-9)
    normal = one.forces[:, [rows.start for rows in grasp.rows]]
    margins = LIMITS["friction"](grasp).usage(formulation, one).value
    for goal, best in ((LeastPeak(), normal.max()), (LargestMargin(), margins.min())):
        program = build(formulation, [], goal)
        sign = 1 if isinstance(goal, LeastPeak) else -1
        for nudge, inside in ((1e-6, True), (-1e-6, False)):
            x = np.append(v.ravel(), best / formulation.force_unit + sign * nudge)
            assert (distance_to_cones(program, program.b - program.A @ x) <= 0) is inside
        assert program.objective(np.append(v.ravel(), 2.5)) == sign * 2.5


def test_the_last_goal_prices_redundancy_and_rigid_motion_only() -> None:
    rng, formulation = random_formulation(0)
    v = rng.normal(size=(KNOTS, formulation.n_v))
    program = build(formulation, [], LeastReconfiguration())
    gamma = formulation.gamma.at(v) / formulation.units.reference
    assert gamma.size
    free = v[:, -1]  # the share of the rigid motion that is the program's choice
    assert program.objective(v.ravel()) == pytest.approx((gamma**2).sum() / 2 + (free**2).sum() / 2)


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("name", ["torque", "effort", "reference", "normal", "joint range", "drift"])
def test_the_box_contains_everything_the_limits_allow(seed: int, name: str) -> None:
    """Push each unknown as far as the limits let it: it stays within the box that the program claims."""
    from synergrip.conic.solution import Claim, Settings
    from synergrip.conic.solvers import clarabel_

    rng, formulation = random_formulation(seed)
    grasp = formulation.response.grasp
    limits = [LIMITS[name](grasp)] + ([FrictionCone(0.0)] if name == "normal" else [])
    program = build(formulation, limits, LeastEffort())
    for column in rng.permutation(len(program.q))[:4]:
        for sign in (1, -1):
            q = np.zeros(len(program.q))
            q[column] = sign
            pushed = type(program)(0 * program.P, frozen(q), program.A, program.b, program.blocks, program.knots,
                                   program.n_v, program.variable_bounds)  # fmt: skip
            solution = clarabel_.solve(pushed, Settings())
            if solution.claim is Claim.OPTIMAL:
                assert abs(solution.x[column]) <= program.variable_bounds[column] * (1 + 1e-6)
            elif solution.claim is Claim.UNBOUNDED:
                assert program.variable_bounds[column] == 1e6


def test_accelerations_are_second_derivatives_of_a_parabola_on_uneven_knots() -> None:
    _, formulation = random_formulation(2)
    grasp = formulation.response.grasp
    rates = np.linspace(-1.0, 1.0, grasp.n_z)
    dz_r = 0.3 + np.outer(formulation.times, rates) + 0.5 * np.outer(formulation.times**2, 3 * rates)
    motion = forward(formulation.response, formulation.times, dz_r, formulation.wrench)
    found = LIMITS["acceleration"](grasp).usage(formulation, motion).value
    np.testing.assert_allclose(found[1:-1], np.tile(3 * rates, (KNOTS - 2, 1)), atol=1e-12)
    assert not found[[0, -1]].any()


def test_a_coupled_limit_leaves_the_first_knot_free() -> None:
    _, formulation = random_formulation(2)
    limit = LIMITS["rate"](formulation.response.grasp)
    block = build(formulation, [limit], LeastEffort()).blocks[0]
    assert (block.first_knot, block.knots) == (1, KNOTS - 1)
    assert limit.usage(formulation, motion_of(formulation, np.ones((KNOTS, formulation.n_v)))).value[0].tolist() == [
        0.0
    ] * len(formulation.response.grasp.synergies)


@pytest.mark.parametrize("seed", range(4))
def test_forces_in_the_cones_stay_within_their_bounds_and_reach_them(seed: int) -> None:
    rng, formulation = random_formulation(seed)
    limit = NormalForce(0.0, 3.0)
    assert limit.bounded(formulation, cones_hold=False) is None
    assert NormalForce(0.0, np.inf).bounded(formulation, cones_hold=True) is None
    _, bounds = limit.bounded(formulation, cones_hold=True) or pytest.fail("a largest normal force bounds the forces")
    for contact, rows in zip(formulation.response.grasp.contacts, formulation.response.grasp.rows, strict=True):
        rest = rng.normal(size=(2000, contact.n_rows - 1))
        rest /= np.maximum(np.linalg.norm(rest, axis=1, keepdims=True), 1e-300)
        sizes = np.diag(contact.cones[0])  # on the rim of the cone at the largest normal force
        rim = np.column_stack([np.full(2000, 3.0), rest * sizes[0] * 3.0 / sizes[1:]])
        assert np.allclose(contact.slip_margin(rim), 0.0 if contact.n_rows > 1 else 3.0, atol=1e-12)
        reached = np.abs(rim).max(axis=0)
        assert np.all(reached <= bounds[rows] * (1 + 1e-12))
        assert np.all(reached >= 0.98 * bounds[rows])


@pytest.mark.parametrize("name", LIMITS)
def test_a_loosened_limit_has_that_much_more_room(name: str) -> None:
    _, formulation = random_formulation(3)
    limit = LIMITS[name](formulation.response.grasp)
    if type(limit).loosened is Limit.loosened:  # by default it is the same, but for its rows
        for before, after in zip(limit.rows(formulation), limit.loosened(0.1).rows(formulation), strict=True):
            assert np.allclose((after.constant - before.constant)[:, :: before.dim], 0.1)
        return
    still = motion_of(formulation, np.zeros((KNOTS, formulation.n_v)))
    tight, loose = limit.usage(formulation, still), limit.loosened(0.1).usage(formulation, still)
    for before, after, sign in ((tight.lower, loose.lower, -1.0), (tight.upper, loose.upper, 1.0)):
        finite = np.isfinite(before)
        size = tight.scale if name.startswith("joint range") else np.abs(before)  # a range counts from its middle
        assert np.allclose(after[finite], before[finite] + sign * 0.1 * size[finite])
        assert np.array_equal(after[~finite], before[~finite])
