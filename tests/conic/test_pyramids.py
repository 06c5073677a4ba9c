"""Pyramids lie inside their cones, touch them, lose what they are said to lose, and turn with the contacts' frames."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from random_tasks import hand_like_grasp
from scipy import sparse

from synergrip.conic.certificate import judge_optimal
from synergrip.conic.decide import decide
from synergrip.conic.formulate import formulate
from synergrip.conic.formulation import Formulation, Units
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.friction_cone import FrictionCone
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.program import Block, Program
from synergrip.conic.pyramids import (
    FrictionPyramid,
    LargestMarginInPyramids,
    goal_in_pyramids,
    inscribed,
    limit_in_pyramids,
    pyramid,
)
from synergrip.conic.question import Question
from synergrip.conic.rows import Item, Kind
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.conic.solvers import clarabel_, qpsolvers_
from synergrip.grasps.contacts.frictionless import Frictionless
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, block_diagonal, frozen
from synergrip.planning.solvers import SOLVERS, ask
from synergrip.statics.analysis import analyse

FACETS = (3, 4, 5, 6, 8, 16)
LOAD = np.array([[0.4, 0.7, -1.5, 0.0, 0.01, 0.004]])


def reach(facets: int, tails: Array) -> Array:
    """How far (k,) the pyramid goes at x_0 = 1 along unit vectors `tails` (k, d - 1); the cone goes 1 far."""
    return 1.0 / (-tails @ pyramid(facets, tails.shape[1] + 1)[:, 1:].T).max(axis=1)


def directions(dim: int, count: int = 20_000) -> Array:
    x = np.random.default_rng(0).normal(size=(count, dim - 1))
    return x / np.linalg.norm(x, axis=1, keepdims=True)


def at(angles: Array) -> Array:
    return np.column_stack([np.cos(angles), np.sin(angles)])


@pytest.mark.parametrize("dim", [3, 4])
@pytest.mark.parametrize("facets", FACETS)
def test_every_point_of_the_pyramid_is_in_the_cone(facets: int, dim: int) -> None:
    assert reach(facets, directions(dim)).max() <= 1 + 1e-14


@pytest.mark.parametrize("facets", FACETS)
def test_a_hard_pyramid_touches_the_cone_at_its_edges_and_loses_the_cosine_between(facets: int) -> None:
    step = 2 * np.pi / facets
    edges, middles = at(step * np.arange(facets)), at(step * (np.arange(facets) + 0.5))
    assert reach(facets, edges) == pytest.approx(1, abs=1e-14)
    assert reach(facets, middles) == pytest.approx(np.cos(np.pi / facets), abs=1e-14)
    assert reach(facets, directions(3)).min() >= np.cos(np.pi / facets) - 1e-14
    assert len(pyramid(facets, 3)) == facets


@pytest.mark.parametrize("facets", FACETS)
def test_a_soft_pyramid_keeps_pure_spin_and_loses_what_is_said(facets: int) -> None:
    sides = 4 * int(np.ceil(facets / 4))
    tangential = np.column_stack([at(np.linspace(0, 2 * np.pi, 999)), np.zeros(999)])
    least = 1 / np.sqrt(np.cos(np.pi / facets) ** -2 + np.tan(np.pi / sides) ** 2)
    longest = np.linalg.norm(pyramid(facets, 4)[:, 1:], axis=1).max()  # along its own normal, a facet is nearest
    assert least == pytest.approx(1 / longest, abs=1e-14)
    assert least - 1e-14 <= reach(facets, directions(4)).min() <= 1.02 * least
    assert reach(facets, np.array([[0, 0, 1.0], [0, 0, -1.0]])) == pytest.approx(1, abs=1e-14)
    assert reach(facets, tangential) == pytest.approx(reach(facets, tangential[:, :2]), abs=1e-14)
    assert len(pyramid(facets, 4)) == facets * sides // 2


@pytest.mark.parametrize(("facets", "dim"), [(2, 3), (0, 3), (8, 1), (8, 7)])
def test_no_pyramid_of_fewer_facets_or_another_dimension(facets: int, dim: int) -> None:
    with pytest.raises(ValueError, match="no pyramid"):
        pyramid(facets, dim)


def held(grasp: Grasp) -> Formulation:
    """The formulation of holding a load for one instant."""
    analysis = analyse(grasp)
    beta = np.zeros((1, analysis.spaces.Gamma_ucs.shape[1]))
    return formulate(
        analysis.response, analysis.spaces, analysis.coordinates, times=np.zeros(1), wrench=LOAD, beta=beta,
        units=Units(2.0, 1.0), redundancy=False,
    )  # fmt: skip


def least_effort(grasp: Grasp, cone: FrictionCone) -> float:
    decision = ask(Question(held(grasp), (cone,), LeastEffort()), SOLVERS["clarabel"]).decision
    assert decision.optimal
    return decision.program.objective(decision.solution.x)


def grasp_of(seed: int, kinds: tuple[str, ...] = ("hard", "soft", "frictionless")) -> Grasp:
    """A random grasp that can hold the load, by its cones and by the coarsest pyramids."""
    rng = np.random.default_rng(seed)
    while True:
        grasp = hand_like_grasp(rng)
        if {c.kind.name for c in grasp.contacts} <= {*kinds}:
            question = Question(held(grasp), (FrictionPyramid(0.1, facets=4),), LeastEffort())
            if ask(question, SOLVERS["clarabel"]).decision.optimal:
                return grasp


@pytest.mark.parametrize("seed", range(6))
def test_the_optimum_falls_to_that_of_the_cones_as_facets_double(seed: int) -> None:
    """Doubling keeps every edge, so pyramids grow; what they lose falls with the square of the angle."""
    grasp = grasp_of(seed)
    cones = least_effort(grasp, FrictionCone(0.1))
    lost = [least_effort(grasp, FrictionPyramid(0.1, facets=f)) - cones for f in (4, 8, 16, 32, 64)]
    assert all(more >= less - 1e-7 for more, less in pairwise(lost))
    assert lost[-1] >= -1e-7
    assert lost[-1] <= lost[0] / 50 + 1e-7


def turned(grasp: Grasp, angle: float) -> Grasp:
    """The same grasp, its contact frames turned about their normals."""
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    blocks = [block_diagonal([np.eye(1), turn, np.eye(c.n_rows - 3)]) for c in grasp.contacts]
    R = block_diagonal(blocks)
    contacts = tuple(replace(c, frame=frozen(c.frame @ block_diagonal([np.eye(1), turn.T]))) for c in grasp.contacts)
    given = None if grasp.lambda_0 is None else frozen(R @ grasp.lambda_0)
    return replace(
        grasp, contacts=contacts, G=frozen(grasp.G @ R.T), J=frozen(R @ grasp.J), C_s=frozen(R @ grasp.C_s @ R.T),
        lambda_0=given,
    )  # fmt: skip


def test_turned_frames_change_the_pyramids_answer_and_not_the_cones() -> None:
    """The price of facets: where the tangential axes happen to point decides what a grasp can hold."""
    grasp = grasp_of(0, ("hard",))
    angles = np.linspace(0, np.pi / 2, 8, endpoint=False)
    cones = np.array([least_effort(turned(grasp, angle), FrictionCone(0.1)) for angle in angles])
    spreads = []
    for facets in (4, 8, 16):
        efforts = np.array([least_effort(turned(grasp, a), FrictionPyramid(0.1, facets=facets)) for a in angles])
        assert np.all(efforts >= cones - 1e-6)
        spreads.append(np.ptp(efforts) / cones[0])
    assert np.ptp(cones) < 1e-6 * cones[0]
    assert spreads[0] > 0.01
    assert spreads[0] > spreads[1] > spreads[2]


def test_a_cone_of_two_dimensions_is_a_pyramid_itself() -> None:
    for facets in (3, 8):
        for x in np.random.default_rng(facets).normal(size=(50, 2)):
            assert np.all(pyramid(facets, 2) @ x >= 0) == (abs(x[1]) <= x[0])


def test_only_the_cones_of_contacts_are_replaced() -> None:
    grasp = grasp_of(1)
    formulation = held(grasp)
    for rows in FrictionCone(0.1).rows(formulation):
        made = inscribed(rows, 8)
        assert made.kind is Kind.NONNEGATIVE
        assert made.dim == 1
        assert {Item(item.name) for item in made.items} == {*rows.items}
        other = replace(rows, friction=False)
        assert inscribed(other, 8) is other
    torque = JointTorque(frozen(np.ones(grasp.n_q)))
    wrapped = limit_in_pyramids(torque, 8)
    for one, other in zip(torque.rows(formulation), wrapped.rows(formulation), strict=True):
        assert one.items == other.items
        assert np.array_equal(one.constant, other.constant)
    assert (wrapped.key, wrapped.watches, wrapped.couples_knots) == ("limits.joint_torque", "forces", False)
    assert limit_in_pyramids(FrictionCone(0.3), 8).loosened(0.5) == FrictionPyramid(0.15, facets=8)
    effort = LeastEffort()
    assert goal_in_pyramids(effort, 8) is effort
    assert LargestMarginInPyramids(facets=5).keeps(1.0, 0.25) == FrictionPyramid(0.75, facets=5)


def test_a_mixed_grasp_has_as_many_rows_as_its_contacts_need() -> None:
    rng = np.random.default_rng(3)
    grasp = hand_like_grasp(rng)
    kinds = [contact.kind.name for contact in grasp.contacts]
    rows = FrictionPyramid(0.1, facets=8).rows(held(grasp))
    per_kind = {"hard": 8, "soft": 32}
    assert sum(len(part.items) for part in rows) == sum(per_kind[kind] for kind in kinds)
    assert Frictionless().cones[0].shape == (1, 1)


# qpsolvers


def by_qp(backend: str):
    return lambda program, settings: qpsolvers_.solve(program, settings, backend)


@pytest.mark.parametrize("backend", ["osqp", "clarabel", "scs"])
@pytest.mark.parametrize("seed", range(3))
def test_backends_find_the_optimum_that_clarabel_finds_and_its_multipliers(seed: int, backend: str) -> None:
    formulation = held(grasp_of(seed))
    program = Question(formulation, (FrictionPyramid(0.1, facets=8),), LeastEffort()).program()
    decision = decide("effort", program, by_qp(backend))
    assert decision.optimal, decision.solution.status
    expected = clarabel_.solve(program, Settings())
    assert program.objective(decision.solution.x) == pytest.approx(program.objective(expected.x), rel=1e-6)
    assert backend in decision.solution.solver


def small_program() -> Program:
    """Least ||x||^2 / 2 with x_1 + x_2 + x_3 = 1 and x_1 >= 0.6: x = (0.6, 0.2, 0.2)."""
    A = np.array([[-1.0, 0, 0], [1, 1, 1], [0, -1.0, 0]])
    blocks = tuple(
        Block("test", kind, 1, (Item("i"),), 0, 1) for kind in (Kind.NONNEGATIVE, Kind.ZERO, Kind.NONNEGATIVE)
    )
    return Program(
        sparse.csc_matrix(np.eye(3)), frozen(np.zeros(3)), sparse.csc_matrix(A), frozen([-0.6, 1.0, 5.0]), blocks, 1, 3,
        frozen(np.full(3, 1e6)),
    )  # fmt: skip


@pytest.mark.parametrize("backend", ["osqp", "clarabel", "scs"])
def test_rows_and_multipliers_come_back_in_their_order_and_with_their_signs(backend: str) -> None:
    """Stationarity x + A'z = 0: x_2 = -z_2 and x_1 = z_1 - z_2."""
    program = small_program()
    found = qpsolvers_.solve(program, Settings(), backend)
    assert found.claim is Claim.OPTIMAL
    assert found.x == pytest.approx([0.6, 0.2, 0.2], abs=1e-7)
    assert found.z == pytest.approx([0.4, -0.2, 0.0], abs=1e-7)
    assert judge_optimal(program, found.x, found.z).verified


def test_a_backend_that_takes_dense_matrices_gets_them(monkeypatch: pytest.MonkeyPatch) -> None:
    import qpsolvers

    taken: list[object] = []
    solve = qpsolvers.solve_problem
    monkeypatch.setattr(qpsolvers, "sparse_solvers", [])
    monkeypatch.setattr(
        qpsolvers, "solve_problem", lambda problem, *a, **k: (taken.append(problem), solve(problem, *a, **k))[1]
    )
    found = qpsolvers_.solve(small_program(), Settings())
    assert found.x == pytest.approx([0.6, 0.2, 0.2], abs=1e-7)
    assert not any(sparse.issparse(getattr(taken[0], name)) for name in "PGA")


def test_a_program_with_cones_is_refused() -> None:
    program = Question(held(grasp_of(0)), (FrictionCone(0.1),), LeastEffort()).program()
    assert qpsolvers_.other_cones(program) == ("friction cone",)
    with pytest.raises(ValueError, match="friction cone"):
        qpsolvers_.solve(program, Settings())


def test_what_a_backend_raises_becomes_its_status(monkeypatch: pytest.MonkeyPatch) -> None:
    import qpsolvers

    def raises(*arguments: object, **options: object) -> Solution:
        raise ArithmeticError("no way")

    monkeypatch.setattr(qpsolvers, "solve_problem", raises)
    program = Question(held(grasp_of(0)), (FrictionPyramid(0.1),), LeastEffort()).program()
    found = qpsolvers_.solve(program, Settings())
    assert found.status == "ArithmeticError: no way"
    assert np.all(np.isnan(found.x))
    assert not decide("effort", program, by_qp("osqp")).certificate.verified
