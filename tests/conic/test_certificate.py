"""Answers are re-verified from the data: true ones pass, tampered ones do not."""

from __future__ import annotations

import copy
import pickle
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy import sparse

from synergrip.conic.certificate import judge_infeasible, judge_optimal
from synergrip.conic.cones import distance_to_cones, project_on_dual
from synergrip.conic.decide import ATTEMPTS, decide, judge
from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Kind, items_of
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.conic.solvers import clarabel_
from synergrip.errors import InputError
from synergrip.linalg import frozen

CONES = ((Kind.NONNEGATIVE, 1, 3), (Kind.SECOND_ORDER, 3, 2), (Kind.ZERO, 1, 1), (Kind.SECOND_ORDER, 4, 1))


def program_of(P, q, A, b, cones=CONES, box: float = 1e6) -> Program:
    blocks = tuple(Block("test", kind, dim, items_of(f"i{i}" for i in range(n)), 0, 1) for kind, dim, n in cones)
    n = len(q)
    return Program(
        sparse.csc_matrix(P), frozen(q), sparse.csc_matrix(A), frozen(b), blocks, 1, n, frozen(np.full(n, box))
    )


def random_program(seed: int, feasible: bool = True) -> Program:
    """A program with a known interior point, or one with a known ray."""
    rng = np.random.default_rng(seed)
    rows = sum(dim * n for _, dim, n in CONES)
    A, x0, L = rng.normal(size=(rows, 5)), rng.normal(size=5), rng.normal(size=(5, 5))
    inside = project_on_dual(program_of(np.eye(5), np.zeros(5), A, np.zeros(rows)), rng.normal(size=rows)) + 0.0
    inside[9] = 0.0  # the zero cone
    b = A @ x0 + inside
    if not feasible:
        program = program_of(np.eye(5), np.zeros(5), A, np.zeros(rows))
        y = project_on_dual(program, rng.normal(size=rows) + np.array([1.0] * 3 + [2, 0, 0] * 2 + [0] + [2, 0, 0, 0]))
        A = A - np.outer(y, y @ A) / (y @ y)  # A'y = 0
        b = A @ x0
        b = b - y * (b @ y + 0.3) / (y @ y)  # b'y < 0
    return program_of(L @ L.T, rng.normal(size=5), A, b)


@pytest.mark.parametrize("seed", range(20))
def test_a_true_optimum_verifies_and_tampering_does_not(seed: int) -> None:
    program = random_program(seed)
    solution = clarabel_.solve(program, Settings())
    assert solution.claim is Claim.OPTIMAL
    assert judge_optimal(program, solution.x, solution.z).verified
    rng = np.random.default_rng(seed + 100)
    nudge = rng.normal(size=5) * 1e-3
    assert not judge_optimal(program, solution.x + nudge, solution.z).verified
    assert not judge_optimal(program, solution.x, 1.01 * solution.z + 1e-3).verified
    assert not judge_optimal(program, solution.x, np.zeros_like(solution.z)).verified
    assert not judge_optimal(program, np.full(5, np.nan), solution.z).verified


def test_an_optimum_far_off_is_one_within_the_box_alone() -> None:
    cap = program_of([[0.0]], [-1.0], [[1.0]], [2e3], cones=((Kind.NONNEGATIVE, 1, 1),))
    x, z = np.array([2e3]), np.array([1.0])
    assert judge_optimal(cap, x, z).verified
    assert not judge_optimal(replace(cap, box=frozen([1.9e3])), x, z).verified


def test_a_box_is_worked_out_when_it_is_asked_for() -> None:
    asked = []
    program = replace(random_program(0), box=lambda: asked.append(1) or np.full(5, 7.0))
    solution = clarabel_.solve(program, Settings())
    assert judge_optimal(program, solution.x, solution.z).verified
    assert not asked
    assert program.variable_bounds.tolist() == program.variable_bounds.tolist() == [7.0] * 5
    assert asked == [1]


@pytest.mark.parametrize("seed", range(20))
def test_a_true_ray_verifies_and_tampering_does_not(seed: int) -> None:
    program = random_program(seed, feasible=False)
    solution = clarabel_.solve(program, Settings())
    assert solution.claim is Claim.INFEASIBLE
    certificate = judge_infeasible(program, solution.z)
    assert certificate.verified
    assert certificate.gap < 0
    assert float(program.b @ certificate.y) == pytest.approx(-1.0)
    assert not judge_infeasible(program, -solution.z).verified
    assert not judge_infeasible(program, np.zeros_like(solution.z)).verified
    nudged = solution.z * (1 + 0.01 * np.random.default_rng(seed).normal(size=len(solution.z)))
    assert not judge_infeasible(program, nudged).verified


@pytest.mark.parametrize("seed", range(20))
def test_no_ray_is_accepted_for_a_feasible_program(seed: int) -> None:
    program = random_program(seed)
    rng = np.random.default_rng(seed)
    for _ in range(200):
        assert not judge_infeasible(program, rng.normal(size=len(program.b))).verified
    assert not judge_infeasible(program, clarabel_.solve(program, Settings()).z).verified


def test_an_inexact_ray_proves_infeasibility_in_a_small_box_only() -> None:
    """x >= 1 and x <= 0, with a ray whose A'y is 1e-3: it excludes |x| < 1000 and nothing beyond."""
    A, b = np.array([[-1.0], [1.0]]), np.array([-1.0, 0.0])
    ray = np.array([1.0, 1.001])
    cones = ((Kind.NONNEGATIVE, 1, 2),)
    for box, proven in ((900.0, True), (1100.0, False)):
        certificate = judge_infeasible(program_of(np.zeros((1, 1)), np.zeros(1), A, b, cones, box), ray)
        assert certificate.verified is proven


def test_projection_on_the_second_order_cone_is_nearest_and_idempotent() -> None:
    rng = np.random.default_rng(0)
    program = program_of(np.zeros((1, 1)), np.zeros(1), np.zeros((3, 1)), np.zeros(3), ((Kind.SECOND_ORDER, 3, 1),))
    for _ in range(200):
        y = rng.normal(size=3) * [2, 1, 1]
        p = project_on_dual(program, y)
        assert distance_to_cones(program, p) <= 0
        assert np.allclose(project_on_dual(program, p), p, atol=1e-15)
        assert abs((y - p) @ p) < 1e-12  # Moreau
        assert (p - y)[0] >= np.linalg.norm((p - y)[1:]) - 1e-12  # p - y lies in the polar's mirror, the cone itself
    assert np.array_equal(project_on_dual(program, np.array([-1.0, 0, 0])), np.zeros(3))


def test_distance_measures_each_kind_of_cone() -> None:
    program = random_program(0)
    inside = np.array([1, 0, 2, 2, 1, 1, 1, 0, 0, 0, 3, 1, 1, 1], dtype=float)
    assert distance_to_cones(program, inside) == 0
    for row, value, distance in ((1, -0.25, 0.25), (9, 0.5, 0.5), (9, -0.5, 0.5), (10, 1.0, np.sqrt(3) - 1)):
        s = inside.copy()
        s[row] = value
        assert distance_to_cones(program, s) == pytest.approx(distance)


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("feasible", [True, False])
def test_save_and_load_give_the_exact_program(tmp_path: Path, seed: int, feasible: bool) -> None:
    program = random_program(seed, feasible)
    program.save(tmp_path / "program.npz")
    loaded = Program.load(tmp_path / "program.npz")
    assert (loaded.P != program.P).nnz == 0
    assert (loaded.A != program.A).nnz == 0
    for name in ("q", "b", "variable_bounds"):
        assert np.array_equal(getattr(loaded, name), getattr(program, name))
    for name in ("blocks", "knots", "n_v", "constant"):
        assert getattr(loaded, name) == getattr(program, name)
    assert clarabel_.solve(loaded, Settings()).claim == clarabel_.solve(program, Settings()).claim


def test_a_program_is_saved_and_loaded_by_the_text_of_a_path(tmp_path: Path) -> None:
    program = random_program(0)
    name = str(tmp_path / "prog.npz")
    program.save(name)
    assert np.array_equal(Program.load(name).q, program.q)


def _pieces(path: Path) -> list[bytes]:
    """Contents that are no saved program."""
    random_program(0).save(path)
    whole = path.read_bytes()
    broken = bytearray(whole)
    broken[70] ^= 0xFF  # in the first array
    with path.open("wb") as stream:
        np.savez(stream, q=np.zeros(2))
    other = path.read_bytes()
    with path.open("wb") as stream:
        np.save(stream, np.zeros(2))
    return [b"", b"garbage", whole[: len(whole) // 2], bytes(broken), other, path.read_bytes()]


@pytest.mark.parametrize("piece", range(6))
def test_a_file_without_a_program_is_bad_input(tmp_path: Path, piece: int) -> None:
    path = tmp_path / "program.npz"
    path.write_bytes(_pieces(path)[piece])
    with pytest.raises(InputError) as caught:
        Program.load(path)
    (issue,) = caught.value.issues
    assert issue.key == ""
    assert issue.message.startswith(f"'{path}' holds no saved program (")


def test_a_program_that_is_not_there_is_bad_input(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"holds no saved program .*not found"):
        Program.load(str(tmp_path / "program.npz"))


def test_the_chain_goes_on_until_a_claim_verifies_and_ends_without_one() -> None:
    program = random_program(0)
    true = clarabel_.solve(program, Settings())
    asked: list[Settings] = []

    def lies_twice(program: Program, settings: Settings) -> Solution:
        asked.append(settings)
        return true if len(asked) == 3 else replace(true, x=frozen(true.x + 1.0))

    decision = decide("test", program, lies_twice)
    assert decision.optimal
    assert decision.attempts == 3
    assert asked == list(ATTEMPTS[:3])

    calls: list[Settings] = []

    def never(program: Program, settings: Settings) -> Solution:
        calls.append(settings)
        return replace(true, claim=Claim.INFEASIBLE)

    decision = decide("test", program, never)
    assert not decision.optimal
    assert not decision.infeasible
    assert calls == list(ATTEMPTS)


def test_without_a_sharp_claim_the_chain_returns_its_best() -> None:
    """Verified at 4e-7, at 2e-7, not at all, at 3e-7, not at all: the second is the best."""
    program = random_program(0)
    true = clarabel_.solve(program, Settings(tolerance=1e-11))
    rows = np.flatnonzero(true.z > 1e-3)
    outward = np.linalg.lstsq(program.A.toarray(), np.eye(len(program.b))[rows[0]], rcond=None)[0]
    shifts = iter([4e-7, 2e-7, 1e-3, 3e-7, 1e-2])
    decision = decide("test", program, lambda p, s: replace(true, x=frozen(true.x + next(shifts) * outward)))
    assert decision.attempts == len(ATTEMPTS)
    assert 1e-7 < decision.certificate.primal_residual < 2.5e-7
    assert decision.optimal
    assert not decision.certificate.tight()


def test_a_modest_claim_is_heard_on_both_counts() -> None:
    good, bad = random_program(3), random_program(3, feasible=False)
    for program, kind in ((good, "optimal"), (bad, "infeasible")):
        silent = replace(clarabel_.solve(program, Settings()), claim=Claim.NOTHING)
        certificate = judge(program, silent)
        assert certificate.verified
        assert certificate.kind == kind
    unbounded = replace(clarabel_.solve(good, Settings()), claim=Claim.UNBOUNDED)
    assert not judge(good, unbounded).verified


def one_variable(q: float, A: list[float], b: list[float]) -> Program:
    return program_of(
        np.zeros((1, 1)), np.array([q]), np.array(A)[:, None], np.array(b), ((Kind.NONNEGATIVE, 1, len(b)),)
    )


def test_multipliers_outside_the_dual_cone_prove_nothing() -> None:
    """x <= 1 and x >= 1: stationarity and gap hold for multipliers that are both negative."""
    program = one_variable(1.0, [1.0, -1.0], [1.0, -1.0])
    assert judge_optimal(program, np.ones(1), np.array([0.0, 1.0])).verified
    assert not judge_optimal(program, np.ones(1), np.array([-5.0, -4.0])).verified


def test_a_feasible_stationary_point_with_a_gap_is_no_optimum() -> None:
    """Minimise x >= 0: at x = 5 the slack and the multiplier are both positive."""
    program = one_variable(1.0, [-1.0], [0.0])
    assert judge_optimal(program, np.zeros(1), np.ones(1)).verified
    certificate = judge_optimal(program, np.full(1, 5.0), np.ones(1))
    assert (certificate.primal_residual, certificate.dual_residual) == (0.0, 0.0)
    assert not certificate.verified


def test_a_copy_of_a_program_has_its_box_in_numbers() -> None:
    program = replace(random_program(0), box=lambda: frozen(np.full(5, 7.0)))  # which no pickle takes
    for again in (pickle.loads(pickle.dumps(program)), copy.deepcopy(program)):
        assert again.box.tolist() == again.variable_bounds.tolist() == [7.0] * 5
        assert not again.box.flags.writeable
