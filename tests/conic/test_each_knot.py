"""One grasp at all knots or one at each: the same program for the same grasp, and for others two that agree."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from random_formulations import KNOTS, LIMITS, random_formulation

from synergrip.conic.affine import Affine
from synergrip.conic.beside_knots import beside
from synergrip.conic.build import build
from synergrip.conic.decide import decide
from synergrip.conic.formulate import formulate
from synergrip.conic.formulation import Formulation
from synergrip.conic.free_basis import free_basis
from synergrip.conic.goals.centred_joints import CentredJoints
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_holding import LeastHolding
from synergrip.conic.goals.least_motion import LeastMotion
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.goals.least_reconfiguration import LeastReconfiguration
from synergrip.conic.goals.steady_forces import SteadyForces
from synergrip.conic.goals.weighted_sum import WeightedSum
from synergrip.conic.intersample import Intersample, Looks, shares
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.question import Question
from synergrip.conic.solvers import clarabel_
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen, interpolated
from synergrip.referee.formulas import write_goal, write_limit
from synergrip.referee.judge import _written, solve
from synergrip.referee.model import Model
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.motion import Motion, forward

QUANTITIES = ("force", "torque", "effort", "reference", "joint", "displacement", "rigid", "elastic")


def centred(grasp: Grasp) -> CentredJoints:
    lower = np.linspace(-0.5, -0.3, grasp.n_q)
    return CentredJoints(
        frozen(np.full(grasp.n_q, 0.1)), frozen(lower), frozen(lower + np.linspace(0.9, 1.4, grasp.n_q))
    )


GOALS = {
    "margin": lambda g: LargestMargin(),
    "peak": lambda g: LeastPeak(),
    "effort": lambda g: LeastEffort(),
    "torque": lambda g: LeastEffort("torque"),
    "actuator": lambda g: LeastEffort("actuator"),
    "references": lambda g: LeastMotion(),
    "travel": lambda g: LeastMotion("rates"),
    "smooth": lambda g: LeastMotion("accelerations"),
    "steady": lambda g: SteadyForces(),
    "holding": lambda g: LeastHolding("torque"),
    "centred": centred,
    "reconfiguration": lambda g: LeastReconfiguration(),
    "weighted": lambda g: WeightedSum(((LeastEffort(), 2.0), (LeastMotion("rates", exact=True), 0.1))),
}


def at_each(formulation: Formulation, each: tuple[Analysis, ...]) -> Formulation:
    """The same task, with a grasp at each knot."""
    start = Analysis(formulation.response.grasp, formulation.response, formulation.spaces, formulation.coordinates)
    beta_basis = formulation.beta_basis
    return formulate(
        start.response, start.spaces, start.coordinates, times=formulation.times, wrench=formulation.wrench,
        beta=formulation.beta.constant, units=formulation.units, redundancy=True, beta_basis=beta_basis,
        target=formulation.target, each=each,
    )  # fmt: skip


def once_and_each(seed: int) -> tuple[np.random.Generator, Formulation, Formulation]:
    """A formulation of a grasp given once, and of the same grasp given at every knot."""
    rng, once = random_formulation(seed)
    same = Analysis(once.response.grasp, once.response, once.spaces, once.coordinates)
    return rng, once, at_each(once, (same,) * KNOTS)


def moving(seed: int) -> tuple[np.random.Generator, Formulation]:
    """A formulation of a grasp that changes from knot to knot: other tangents, synergies, compliances, loads.

    None of this changes the dimensions of a degenerate grasp; a generic one also gets other Jacobians.
    """
    rng, once = random_formulation(seed)
    grasp, each = once.response.grasp, []
    way = 0.1 * rng.normal(size=grasp.J.shape) if seed % 3 else np.zeros(grasp.J.shape)
    stretch = rng.uniform(-0.2, 0.2, grasp.n_z)
    for k in range(KNOTS):
        turn = np.eye(grasp.n_l)
        for contact, rows in zip(grasp.contacts, grasp.rows, strict=True):
            if contact.n_rows > 1:
                t, angle = rows.start + 1, 0.3 * k
                turn[t : t + 2, t : t + 2] = [[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]
        changed = replace(
            grasp, G=frozen(grasp.G @ turn.T), J=frozen(turn @ (grasp.J * (1 + k * way))),
            S=frozen(grasp.S * (1 + k * stretch)), C_s=frozen(grasp.C_s * (1 + 0.1 * k)),
            w_0=frozen(grasp.w_0 + 0.01 * k),
        )  # fmt: skip
        each.append(analyse(changed))
    return rng, at_each(once, tuple(each))


def curved_load(seed: int, formulation: Formulation) -> Intersample:
    """A corner of the load between two knots, and a load that is curved from the third knot to the last."""
    rng, times, corner_time = np.random.default_rng(seed), formulation.times, 0.4
    at = np.r_[times[:2], corner_time, times[2:]]
    sizes = [0.1, 0.1, 0.1, 2e-3, 2e-3, 2e-3]

    def looks(when: Array, wrench: Array) -> Looks:
        target = interpolated(when, times, formulation.target)
        return Looks(frozen(when), frozen(wrench), frozen(target + 1e-4 * rng.normal(size=target.shape)))

    wrench = interpolated(at, times, formulation.wrench)
    wrench[2] += sizes * rng.normal(size=6)
    inner = times[2] + (times[3] - times[2]) * shares(4)
    bump = np.outer(np.sin(np.pi * shares(4)), sizes * rng.normal(size=6))
    grid = Looks(frozen(at), frozen(wrench), frozen(interpolated(at, times, formulation.target)))
    curved = looks(inner, interpolated(inner, times, formulation.wrench) + bump)
    return Intersample(grid, at == corner_time, np.array([3]), 4, curved)


def number(value: object) -> Array:
    """The value of an expression, or of an array."""
    return np.asarray(getattr(value, "value", value))


def motion_at(formulation: Formulation, v: Array) -> Motion:
    """What the statics of each knot make of the references there: one knot at a time, and put together."""
    assert formulation.each is not None
    reference = formulation.reference.at(v)
    parts = [
        forward(at.response, formulation.times[[k]], reference[[k]], formulation.wrench[[k]])
        for k, at in enumerate(formulation.each)
    ]
    return Motion(*(np.concatenate([getattr(part, name) for part in parts]) for name in Motion.__dataclass_fields__))


def model_of(formulation: Formulation, references: Array | None = None) -> Model:
    """The second formulation of the same, with given references or any."""
    looks = Looks(formulation.times, formulation.wrench, formulation.target)
    return _written(formulation, looks, references)


@pytest.mark.parametrize("seed", range(4))
def test_a_grasp_given_once_and_at_every_knot_makes_the_same_quantities(seed: int) -> None:
    rng, once, each = once_and_each(seed)
    v = rng.normal(size=(KNOTS, once.n_v))
    for name in QUANTITIES:
        one, other = getattr(once, name), getattr(each, name)
        np.testing.assert_allclose(other.constant, one.constant, rtol=1e-12, atol=1e-12 * np.abs(one.constant).max())
        whole = np.broadcast_to(other.matrix, (KNOTS, *one.matrix.shape))
        size = np.abs(one.matrix).max(initial=0.0)
        np.testing.assert_allclose(whole, np.tile(one.matrix, (KNOTS, 1, 1)), rtol=1e-12, atol=1e-12 * size)
        np.testing.assert_allclose(other.at(v), one.at(v), rtol=1e-12, atol=1e-12 * np.abs(one.at(v)).max())


@pytest.mark.parametrize("between", [False, True])
@pytest.mark.parametrize("goal", GOALS)
@pytest.mark.parametrize("seed", range(4))
def test_a_grasp_given_once_and_at_every_knot_makes_the_same_program(seed: int, goal: str, between: bool) -> None:
    _, once, each = once_and_each(seed)
    if between:
        once, each = (replace(formulation, intersample=curved_load(seed, once)) for formulation in (once, each))
    grasp = once.response.grasp
    limits = [make(grasp) for make in LIMITS.values()]
    one, other = (build(formulation, limits, GOALS[goal](grasp)) for formulation in (once, each))
    assert one.blocks == other.blocks
    for name in ("P", "A"):
        first, second = getattr(one, name).toarray(), getattr(other, name).toarray()
        np.testing.assert_allclose(second, first, rtol=1e-12, atol=1e-12 * np.abs(first).max(initial=0.0))
    for name in ("q", "b", "variable_bounds"):
        first, second = getattr(one, name), getattr(other, name)
        np.testing.assert_allclose(second, first, rtol=1e-9 if name == "variable_bounds" else 1e-12,
                                   atol=1e-12 * np.abs(first).max())  # fmt: skip
    assert other.constant == pytest.approx(one.constant, rel=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_the_second_formulations_maps_are_the_programs(seed: int) -> None:
    """Knot by knot to 1e-12: for a grasp given once, for the same given T times, and for one that changes."""
    rng, once, each = once_and_each(seed)
    for formulation in (once, each, moving(seed)[1]):
        v = rng.normal(size=(KNOTS, formulation.n_v))
        model = model_of(formulation, formulation.reference.at(v))
        pairs = {
            "force": model.force, "torque": model.torque, "effort": model.effort, "joint": model.joints,
            "rigid": model.rigid, "displacement": model.moved + model.sag,
        }  # fmt: skip
        for name, value in pairs.items():
            expected = getattr(formulation, name).at(v)
            found = number(value)
            np.testing.assert_allclose(found, expected, rtol=1e-12, atol=2e-12 * np.abs(expected).max(), err_msg=name)


@pytest.mark.parametrize("seed", range(4))
def test_a_changing_grasp_moves_as_the_statics_of_each_knot_say(seed: int) -> None:
    rng, formulation = moving(seed)
    v = rng.normal(size=(KNOTS, formulation.n_v))
    motion = motion_at(formulation, v)
    named = {"force": "forces", "torque": "torques", "effort": "efforts", "joint": "dq", "displacement": "du"}
    for name, attribute in named.items():
        expected = getattr(motion, attribute)
        found = getattr(formulation, name).at(v)
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max(), err_msg=name)
    assert np.abs(motion.forces - forward(
        formulation.response, motion.times, motion.dz_r, motion.wrench
    ).forces).max() > 1e-3 * np.abs(motion.forces).max()  # fmt: skip


@pytest.mark.parametrize("name", LIMITS)
@pytest.mark.parametrize("seed", range(3))
def test_rows_of_a_changing_grasp_say_what_the_limit_is(seed: int, name: str) -> None:
    """Whether a limit holds, by the motion, by the program's cones, and by those of the second formulation."""
    from synergrip.conic.cones import distance_to_cones

    rng, formulation = moving(seed)
    limit: Limit = LIMITS[name](formulation.response.grasp)
    program = build(formulation, [limit], LeastEffort())
    outcomes = set()
    for size in (0.0, 0.003, 0.03, 0.3, 3.0):
        v = size * rng.normal(size=(KNOTS, formulation.n_v))
        motion = motion_at(formulation, v)
        violation = limit.usage(formulation, motion).violation
        slack = program.b - program.A @ v.ravel()
        model = model_of(formulation, formulation.reference.at(v))
        worst = -np.inf
        for cone in write_limit(model, limit):
            head = number(cone.head)
            tail = 0.0 if cone.tail is None else np.linalg.norm(number(cone.tail), axis=1)
            worst = max(worst, float((tail - head).max()))
        outcomes.add(violation > 0)
        if abs(violation) > 1e-9 and abs(worst) > 1e-9:
            assert (violation > 0) is (worst > 0), size
            assert (distance_to_cones(program, slack) > 1e-9) is (worst > 0), size
    assert outcomes


@pytest.mark.parametrize("goal", [name for name in GOALS if name not in ("margin", "peak")])
@pytest.mark.parametrize("seed", range(3))
def test_goals_of_a_changing_grasp_are_worth_the_same_in_both_formulations(seed: int, goal: str) -> None:
    rng, formulation = moving(seed)
    made: Goal = GOALS[goal](formulation.response.grasp)
    program = build(formulation, [], made)
    for _ in range(3):
        v = rng.normal(size=(KNOTS, formulation.n_v))
        cost = write_goal(model_of(formulation, formulation.reference.at(v)), made).cost
        assert program.objective(v.ravel()) == pytest.approx(float(number(cost)), rel=1e-9)


@pytest.mark.parametrize("seed", range(3))
def test_between_knots_quantities_of_a_changing_grasp_are_straight_and_the_load_is_felt(seed: int) -> None:
    rng, formulation = moving(seed)
    v = rng.normal(size=(KNOTS, formulation.n_v))
    middle = formulation.times[[1]] + (formulation.times[[2]] - formulation.times[[1]]) / 2
    straight = formulation.wrench[1:3].mean(axis=0)
    change = rng.normal(size=6) * [0.1, 0.1, 0.1, 2e-3, 2e-3, 2e-3]
    target = formulation.target[[1]]
    there, loaded = (
        beside(formulation, Looks(middle, wrench[None], target)) for wrench in (straight, straight + change)
    )
    share = np.array([[0.0, 0.5, 0.5, 0.0]])
    for name in QUANTITIES:
        at = getattr(there, name)
        value = at.constant + share @ np.array([matrix @ row for matrix, row in zip(at.matrix, v, strict=True)])
        expected = getattr(formulation, name).at(v)
        np.testing.assert_allclose(value[0], expected[1:3].mean(axis=0), atol=1e-10 * np.abs(expected).max())
    # a load of its own is balanced there as at the knots, whatever the plan
    assert formulation.each is not None
    felt = (loaded.force.constant - there.force.constant)[0]
    G = np.mean([at.grasp.G for at in formulation.each[1:3]], axis=0)
    expected = np.mean([-at.response.right_inverse @ change for at in formulation.each[1:3]], axis=0)
    np.testing.assert_allclose(felt, expected, atol=1e-12 * np.abs(expected).max())
    assert np.linalg.norm(G @ felt + change) < 0.2 * np.linalg.norm(change)


@pytest.mark.parametrize("goal", GOALS)
@pytest.mark.parametrize("between", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_both_formulations_solve_a_changing_grasp_alike(seed: int, goal: str, between: bool) -> None:
    _, formulation = moving(seed)
    if between:
        formulation = replace(formulation, intersample=curved_load(seed, formulation))
    grasp = formulation.response.grasp
    most = frozen(np.full(grasp.n_q, 50.0))
    limits = (NormalForce(0.2, 200.0), JointTorque(most), LIMITS["drift"](grasp).loosened(1e3))
    question = Question(formulation, limits, GOALS[goal](grasp))
    program = question.program()
    direct = decide(goal, program, clarabel_.solve)
    second = decide(goal, program, lambda program, settings: solve(question, program, settings))
    assert (direct.certificate.kind, second.certificate.kind) == ("optimal", "optimal")
    assert direct.certificate.verified
    assert second.certificate.verified
    assert program.objective(second.solution.x) == pytest.approx(
        program.objective(direct.solution.x), rel=1e-6, abs=1e-6
    )


@pytest.mark.parametrize("goals", [("effort",), ("steady",), ("travel",), ("steady", "smooth")], ids="-".join)
@pytest.mark.parametrize("seed", range(3))
def test_what_goals_leave_open_of_a_changing_grasp_is_what_they_do_not_see(seed: int, goals: tuple[str, ...]) -> None:
    rng, formulation = moving(seed)
    squares = [part for goal in goals
               for part in GOALS[goal](formulation.response.grasp).objective(formulation).squares]  # fmt: skip
    basis = free_basis(squares, KNOTS, formulation.n_v)
    v = rng.normal(size=(KNOTS, formulation.n_v))
    change = (basis @ rng.normal(size=basis.shape[1])).reshape(v.shape)
    seen = np.vstack([np.zeros((0, v.size)), *(rows_of(part, v.shape) for part in squares)])
    assert basis.shape[1] == v.size - np.linalg.matrix_rank(seen, tol=1e-8 * np.linalg.norm(seen, 2))
    for part in squares:
        np.testing.assert_allclose(part.at(v + change), part.at(v), atol=1e-9 * np.abs(part.at(v)).max())


def rows_of(part: object, shape: tuple[int, int]) -> Array:
    """The rows of some squares (R, T n_v), 1 in size, by looking at every unknown alone."""
    units = np.eye(shape[0] * shape[1]).reshape(-1, *shape)
    own = np.array([(part.at(unit) - part.at(np.zeros(shape))).ravel() for unit in units]).T  # type: ignore[attr-defined]
    return np.asarray(own / np.linalg.norm(own, 2))


def test_grasps_that_do_not_fit_the_knots_are_refused() -> None:
    _, once, _ = once_and_each(0)
    same = Analysis(once.response.grasp, once.response, once.spaces, once.coordinates)
    with pytest.raises(InputError, match=r"each.*at each of 4 knots, got 3"):
        at_each(once, (same,) * (KNOTS - 1))
    other = random_formulation(1)[1]
    with pytest.raises(InputError, match=r"each\[2\]"):
        at_each(
            once, (same, same, Analysis(other.response.grasp, other.response, other.spaces, other.coordinates), same)
        )
    renamed = replace(once.response.grasp, synergies=tuple(f"y{i}" for i in range(once.response.grasp.n_z)))
    with pytest.raises(InputError, match=r"each\[3\]: expected the joints, synergies and contacts"):
        at_each(once, (same, same, same, analyse(renamed)))


def test_a_shortened_quantity_has_the_same_norm_at_every_knot() -> None:
    rng = np.random.default_rng(9)
    long = Affine(rng.normal(size=(4, 12, 3)), rng.normal(size=(4, 12)))
    short, v = long.shortened, rng.normal(size=(4, 3))
    assert short.matrix.shape == (4, 4, 3)
    assert np.linalg.norm(short.at(v), axis=1) == pytest.approx(np.linalg.norm(long.at(v), axis=1), rel=1e-12)
    assert short.shortened is short
