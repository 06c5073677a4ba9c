"""The batched kernel and its verifier, against Clarabel and the certificates of single programs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from random_cone_problems import by_clarabel, certificates, proofs, random_problems, values

from synergrip.batch import fast_kernel, fast_statics, kernel, numpy_kernel, verifier
from synergrip.batch.compiling import Compiled
from synergrip.batch.cone_problems import ConeProblems, Status, Tolerance
from synergrip.batch.decided import Solver
from synergrip.batch.scaling import Scaling
from synergrip.errors import InputError
from synergrip.grasps.stack import GraspStack
from synergrip.problems.problem import load_problem

SHARP = Tolerance(5e-9, 2e-9)
SHAPES = [
    (4, [1] * 12 + [3] * 3, False),
    (7, [1] * 16 + [4] * 4, False),
    (3, [1] * 12 + [3] * 3, True),
    (6, [1, 1, 3, 4, 4, 5], True),
    (1, [2, 2, 1], False),
    (5, [3] * 4, True),
]


def kernels() -> list[object]:
    return [
        pytest.param(numpy_kernel.solve, id="numpy"),
        pytest.param("numba", id="numba"),
    ]


@pytest.fixture(params=kernels())
def solve(request: pytest.FixtureRequest) -> Solver:
    if request.param == "numba":
        pytest.importorskip("numba")
        return fast_kernel.solve
    found: Solver = request.param
    return found


@pytest.mark.parametrize(("unknowns", "sizes", "quadratic"), SHAPES)
def test_random_programs_are_solved_as_clarabel_solves_them(
    solve: Solver, unknowns: int, sizes: list[int], quadratic: bool
) -> None:
    problems = random_problems(60, unknowns, sizes, quadratic=quadratic, seed=unknowns)
    found = solve(problems, SHARP, np.full(60, -np.inf))
    theirs = values(problems, np.array(by_clarabel(problems, 1e-9)))
    judged = verifier.judge_optimal(problems, found.x, found.z, np.full(found.x.shape, np.inf))
    right = found.status == Status.SOLVED
    assert right.mean() > 0.95
    assert judged.verified[right].all()
    assert np.abs(values(problems, found.x) - theirs)[right].max() <= 3e-8 * np.maximum(1, np.abs(theirs)).max()
    slack = problems.b - (problems.A @ found.x[:, :, None])[:, :, 0]
    assert np.abs(slack - found.s)[right].max() < 1e-7


@pytest.mark.parametrize("N", [3, 37])
def test_the_two_kernels_are_the_same_method(N: int) -> None:
    pytest.importorskip("numba")
    problems = random_problems(N, 4, [1] * 9 + [3] * 2 + [4], quadratic=False, seed=3)
    enough = np.where(np.arange(N) % 3 == 0, 1.0 + values(problems, np.zeros((N, 4))), -np.inf)
    ours, theirs = (each.solve(problems, SHARP, enough) for each in (numpy_kernel, fast_kernel))
    assert np.array_equal(ours.status, theirs.status)
    assert np.array_equal(ours.iterations, theirs.iterations)
    assert np.abs(ours.x - theirs.x).max() < 1e-6


@pytest.mark.parametrize("quadratic", [False, True])
def test_lower_and_upper_bounds_of_the_same_are_solved_as_any_others(solve: Solver, quadratic: bool) -> None:
    lines = random_problems(21, 5, [1] * 4 + [3, 4], quadratic=quadratic, seed=8)
    A = np.concatenate([lines.A[:, :3], -lines.A[:, :3], lines.A[:, 3:]], axis=1)
    b = np.concatenate([lines.b[:, :3], 3.0 - lines.b[:, :3], lines.b[:, 3:]], axis=1)
    apart = ConeProblems(lines.P, lines.q, A, b, (1, 1, 1, *lines.sizes))
    ours, theirs = (solve(each, SHARP, np.full(21, -np.inf)) for each in (replace(apart, pairs=3), apart))
    assert np.array_equal(ours.status, theirs.status)
    assert (right := ours.status == Status.SOLVED).mean() > 0.5
    for name in ("x", "s", "z"):
        assert np.abs(getattr(ours, name) - getattr(theirs, name))[right].max() < 1e-6


@pytest.mark.parametrize("wrong", [np.nan, np.inf, 1e300])
def test_a_problem_that_is_none_is_nothing_and_takes_nothing_from_its_neighbours(solve: Solver, wrong: float) -> None:
    problems = random_problems(9, 4, [1] * 12 + [3] * 3, quadratic=True, seed=1)
    b = problems.b.copy()
    b[3, 14] = wrong
    few = np.full(9, -np.inf)
    right, found = (solve(replace(problems, b=each), SHARP, few) for each in (problems.b, b))
    others = np.arange(9) != 3
    assert found.status[3] == Status.NOTHING
    assert np.array_equal(found.status[others], right.status[others])
    assert np.allclose(found.x[others], right.x[others], rtol=0, atol=1e-9)


def test_a_point_that_is_good_enough_is_taken_and_keeps_all_cones(solve: Solver) -> None:
    problems = random_problems(20, 4, [1] * 9 + [3] * 3, quadratic=False, seed=4)
    best = values(problems, solve(problems, SHARP, np.full(20, -np.inf)).x)
    found = solve(problems, SHARP, best + 0.1)
    assert (found.status == Status.ENOUGH).any()
    taken = found.status == Status.ENOUGH
    assert (values(problems, found.x) <= best + 0.1)[taken].all()
    slack = problems.b - (problems.A @ found.x[:, :, None])[:, :, 0]
    assert verifier.outside(problems, slack)[taken].max() < 1e-8
    impossible = solve(problems, SHARP, best - 0.1)
    assert not (impossible.status == Status.ENOUGH).any()


def test_the_scaling_makes_one_of_both_and_stays_symmetric() -> None:
    problems, rng = random_problems(15, 3, [1, 1, 3, 4, 4, 6], quadratic=False, seed=5), np.random.default_rng(5)
    W = Scaling.of_units(problems.groups, 15)
    for _ in range(6):
        s, z = (W.point + 0.7 * _inner(rng, problems, W.point) for _ in range(2))
        whole_s, whole_z = W.scaled(s), W.unscaled(z)  # as they are, whatever the scaling
        W = W.carried_on(s, z)
        size = np.abs(W.point).max(axis=1, keepdims=True)
        for made in (W.scaled(whole_z), W.unscaled(whole_s)):
            assert np.abs(made - W.point).max() < 1e-11 * size.max()
        a, b = rng.normal(size=(2, 15, sum(problems.sizes)))
        assert np.allclose((W.scaled(a) * b).sum(axis=1), (a * W.scaled(b)).sum(axis=1), rtol=1e-9)
        assert np.allclose(W.unscaled_rows(b[:, :, None])[:, :, 0], W.unscaled(b), rtol=1e-11)
        assert np.allclose(W.product(W.divided(b), W.point), b, atol=1e-8)


def _inner(rng: np.random.Generator, problems: ConeProblems, point: np.ndarray) -> np.ndarray:
    """Directions of which the cones at `point` leave the whole way free."""
    W = Scaling.of_units(problems.groups, len(point))
    step = rng.normal(size=point.shape)
    at = Scaling(W.groups, W.parts, point)
    return np.asarray(step * np.minimum(1.0, at.longest_step(step))[:, None])


def test_the_verifier_says_what_the_certificate_of_one_program_says() -> None:
    problems, rng = random_problems(30, 4, [1] * 5 + [3] * 3, quadratic=True, seed=6), np.random.default_rng(6)
    found = numpy_kernel.solve(problems, SHARP, np.full(30, -np.inf))
    bounds = np.abs(found.x) + rng.uniform(-1e-7, 1.0, found.x.shape)
    noise = 10.0 ** rng.uniform(-12, -3, (30, 1))  # from what verifies to what does not
    x, z = found.x + noise * rng.normal(size=found.x.shape), found.z + noise * rng.normal(size=found.z.shape)
    judged = verifier.judge_optimal(problems, x, z, bounds)
    each = certificates(problems, x, z, bounds)
    assert judged.verified.tolist() == [one.verified for one in each]
    assert 0 < judged.verified.sum() < 30
    for name in ("primal_residual", "dual_residual", "gap"):
        assert np.allclose(getattr(judged, name), [getattr(one, name) for one in each], rtol=1e-6, atol=1e-13)


def test_proofs_are_judged_as_the_certificate_of_one_program_judges_them() -> None:
    rng = np.random.default_rng(7)
    problems = random_problems(30, 4, [1] * 6 + [3] * 3, quadratic=False, seed=7)
    y = numpy_kernel.solve(problems, SHARP, np.full(30, -np.inf)).z
    A = problems.A - y[:, :, None] * ((problems.A.mT @ y[:, :, None]) / (y**2).sum(axis=1)[:, None, None]).mT
    b = problems.b - ((problems.b * y).sum(axis=1) + 1.0)[:, None] * y / (y**2).sum(axis=1)[:, None]
    clashing = ConeProblems(problems.P, problems.q, A, b, problems.sizes)  # A'y = 0 and b'y = -1
    bounds = 10.0 ** rng.uniform(0, 3, (30, 4))
    moved = y + 10.0 ** rng.uniform(-9, -1, (30, 1)) * rng.normal(size=y.shape)
    judged = verifier.judge_infeasible(clashing, moved, bounds)
    each = proofs(clashing, moved, bounds)
    assert judged.verified.tolist() == [one.verified for one in each]
    assert 0 < judged.verified.sum() < 30
    assert not verifier.judge_infeasible(problems, y, bounds).verified.any()  # these have answers
    assert not verifier.judge_infeasible(clashing, -y, bounds).verified.any()


def test_tampered_answers_are_refused() -> None:
    problems = random_problems(20, 4, [1] * 5 + [3] * 3, quadratic=False, seed=8)
    found = numpy_kernel.solve(problems, SHARP, np.full(20, -np.inf))
    free = np.full(found.x.shape, np.inf)
    right = verifier.judge_optimal(problems, found.x, found.z, free).verified
    assert right.all()
    x, z = found.x.copy(), found.z.copy()
    x[:, 0] += 1e-4
    z[:, 0] += 1e-4
    nothing = np.full(x.shape, np.nan)
    for wrong in ((x, found.z), (found.x, z), (found.x, 0 * z), (np.roll(found.x, 1, axis=0), found.z), (nothing, z)):
        assert not verifier.judge_optimal(problems, *wrong, free).verified.any()
    assert not verifier.judge_optimal(problems, found.x, found.z, 0.9 * np.abs(found.x)).verified.any()


def test_arrays_that_do_not_fit_are_refused_by_name() -> None:
    good = random_problems(3, 2, [1, 3], quadratic=False, seed=9)
    with pytest.raises(InputError, match=r"ConeProblems\.A: expected shape"):
        ConeProblems(good.P, good.q, good.A[:, :3], good.b, good.sizes)
    with pytest.raises(InputError, match=r"ConeProblems\.P: expected shape"):
        ConeProblems(good.P[:, :1], good.q, good.A, good.b, good.sizes)


def test_what_is_compiled_is_chosen_where_that_repays(monkeypatch: pytest.MonkeyPatch) -> None:
    there, kept, stack = [True], [False], GraspStack.of([load_problem("tripod").grasp])
    monkeypatch.setattr(kernel, "find_spec", lambda name: object() if there[0] else None)
    monkeypatch.setattr(Compiled, "kept", lambda self: kept[0])
    for each in (fast_kernel.compiled, fast_statics.compiled):
        monkeypatch.setattr(each, "loaded", False)

    def fast(count: int, name: str | None = None) -> tuple[bool, bool]:
        return kernel.chosen(count, name) is fast_kernel.solve, kernel.quick_statics(stack, count, name) is not None

    every = [fast(count) for count in (10, 20_000, 99_999, 100_000, 1_000_000)]
    assert every == [(False, False)] * 3 + [(True, False), (True, True)]
    assert fast(1, "numba") == (True, True)
    kept[0] = True
    assert [fast(count) for count in (10, 19_999, 20_000)] == [(False, False)] * 2 + [(True, True)]
    fast_kernel.compiled.loaded = True
    assert fast(1) == (True, False)
    assert fast(10**6, "numpy") == (False, False)
    there[0] = fast_kernel.compiled.loaded = False
    assert fast(10**6) == (False, False)
    with pytest.raises(InputError, match="pip install"):
        kernel.chosen(1, "numba")
