"""The dimensions for the first K synergies: their sum, their growth, and what `analyse` says of each K by itself."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from made_kinds import made_kind
from random_grasps import random_grasp

from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.problems.problem import Problem, load_problem
from synergrip.statics import respond, subspaces
from synergrip.statics.analysis import analyse
from synergrip.statics.dimensions import DimensionColumn, dimension_table, with_kind

SOFT = ["contacts.model=soft", "contacts.spin_friction=5 mm", "contacts.spin_stiffness=2 N m/rad"]
HARD = ["contacts.model=hard"]
HANDS = ["table2-hard-motors", "table2-soft-motors", "table2-hard-joints", "barrett-ball-hold"]


def given(grasp: Grasp) -> Problem:
    """A problem on a grasp given as matrices."""
    return replace(load_problem("tripod"), grasp=grasp)


def numbers(column: DimensionColumn) -> list[tuple[int, int, int]]:
    return [(row.E_s, row.Gamma_ucs, row.Gamma_zr) for row in column.rows]


def judge(column: DimensionColumn, n_z: int) -> None:
    """(34) in every row; one more synergy adds to one of the three and takes from none."""
    found = np.array(numbers(column))
    assert np.array_equal(found.sum(axis=1), np.arange(1, n_z + 1))
    assert np.all(np.diff(found, axis=0) >= 0)


@pytest.mark.parametrize("name", HANDS)
def test_every_row_is_what_analyse_says_of_the_problem_with_that_many_synergies(name: str) -> None:
    problem = load_problem(name)
    chosen = problem.held.synergies.name
    for column, contacts in zip(dimension_table(problem.grasp), (HARD, SOFT), strict=True):
        judge(column, problem.grasp.n_z)
        for k, found in enumerate(numbers(column), start=1):
            changed = load_problem(name, [*contacts, f'hand.synergies={{ set = "{chosen}", first = {k} }}'])
            assert analyse(changed.grasp).spaces.dimensions == found


def test_table_two_of_the_paper() -> None:
    hard, soft = dimension_table(load_problem("table2-hard-motors").grasp)
    assert numbers(hard) == [(0, 0, 1), (1, 0, 1), (2, 0, 1), (3, 0, 1)]
    assert numbers(soft) == [(1, 0, 0), (2, 0, 0), (3, 0, 0), (4, 0, 0)]
    assert not any(row.ambiguous for row in (*hard.rows, *soft.rows))
    joints = [numbers(column)[-1] for column in dimension_table(load_problem("table2-soft-joints").grasp)]
    assert joints == [(3, 2, 3), (6, 1, 1)]


@pytest.mark.parametrize(("name", "model"), [("table2-hard-motors", SOFT), ("table2-soft-motors", HARD)])
def test_contacts_of_another_kind_have_the_rows_of_a_problem_that_has_them(name: str, model: list[str]) -> None:
    kind = made_kind(model[0].split("=")[1], 0.5, 0.01)
    formed, expected = with_kind(load_problem(name).grasp, kind), load_problem(name, model).grasp
    assert formed is not None
    assert formed.components == expected.components
    for matrix in ("G", "J", "S"):
        assert np.allclose(getattr(formed, matrix), getattr(expected, matrix), rtol=0, atol=1e-15)


@pytest.mark.parametrize("kind", ["hard", "soft"])
def test_the_force_map_is_the_contact_motion_that_no_rigid_motion_follows(kind: str) -> None:
    """With the compliances of the table, in coordinates without units: nothing but geometry decides."""
    grasp = with_kind(load_problem("barrett-ball-hold").grasp, made_kind(kind, 0.5, 0.01))
    assert grasp is not None
    response = respond(grasp)
    JS = (grasp.J @ grasp.S) / response.scale.force[:, None]
    Gt = grasp.G.T / response.scale.force[:, None]
    left = JS - Gt @ np.linalg.lstsq(Gt, JS, rcond=None)[0]
    assert response.scale.force[:, None] * response.dlambda_dzr == pytest.approx(left, abs=1e-12)


def test_frictionless_contacts_are_taken_as_hard_and_soft_too() -> None:
    overrides = ["contacts.model=frictionless"]
    table = dimension_table(load_problem("barrett-ball-hold", overrides).grasp)
    assert [numbers(c) for c in table] == [numbers(c) for c in dimension_table(load_problem("barrett-ball-hold").grasp)]


@pytest.mark.parametrize("seed", range(20))
def test_random_matrices(seed: int) -> None:
    """Soft contacts become hard by leaving the spin out; compliances play no part, and the rank of J S is theirs."""
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, ["soft"] * int(rng.integers(3, 5)), degenerate=bool(seed % 2))
    hard, soft = dimension_table(given(grasp).grasp)
    for column in (hard, soft):
        judge(column, grasp.n_z)
    assert numbers(soft)[-1] == subspaces(respond(grasp)).dimensions
    forces = [i for i, (_, component) in enumerate(grasp.components) if component != "m"]
    for k, (E_s, Gamma_ucs, _) in enumerate(numbers(hard), start=1):
        assert np.linalg.matrix_rank(grasp.J[forces] @ grasp.S[:, :k]) == E_s + Gamma_ucs
    for k, (E_s, Gamma_ucs, _) in enumerate(numbers(soft), start=1):
        assert np.linalg.matrix_rank(grasp.J @ grasp.S[:, :k]) == E_s + Gamma_ucs


@pytest.mark.parametrize("kinds", [["hard"] * 3, ["hard", "soft", "hard"]])
def test_matrices_of_hard_contacts_say_nothing_of_soft_ones(kinds: list[str]) -> None:
    grasp = random_grasp(np.random.default_rng(1), kinds)
    hard, soft = dimension_table(given(grasp).grasp)
    judge(hard, grasp.n_z)
    assert (soft.rows, hard.reason) == ((), "")
    assert "moments about the normals" in soft.reason


def test_matrices_of_frictionless_contacts_say_nothing_of_either() -> None:
    grasp = random_grasp(np.random.default_rng(2), ["hard"] * 3 + ["frictionless"])
    hard, soft = dimension_table(given(grasp).grasp)
    assert (hard.rows, soft.rows) == ((), ())
    assert "forces across the normals" in hard.reason


def test_two_hard_contacts_do_not_restrain_what_two_soft_ones_do() -> None:
    hard, soft = dimension_table(load_problem("pinch-soft").grasp)
    assert hard.free == "the object may turn about the line through left and right"
    assert soft.free == ""
    assert numbers(hard) == numbers(soft) == [(1, 0, 0)]


@pytest.mark.parametrize(("size", "ambiguous"), [(1e-7, True), (1e-3, False), (0.0, False)])
def test_a_synergy_that_hardly_moves_a_contact_is_marked(size: float, ambiguous: bool) -> None:
    grasp = random_grasp(np.random.default_rng(3), ["soft"] * 3, n_q=6, n_z=2)
    J, S = np.array(grasp.J), np.zeros((6, 3))
    J[:, 5] *= size
    S[0, 0] = S[1, 1] = S[5, 2] = 1.0
    made = replace(grasp, J=frozen(J), S=frozen(S), C_z=frozen(np.zeros((3, 3))), synergies=("a", "b", "c"))
    _, soft = dimension_table(given(made).grasp)
    assert [row.ambiguous for row in soft.rows] == [False, False, ambiguous]
