"""Proofs in fractions: the checker against maps in float64, closed forms, every kind of limit, altered files."""

from __future__ import annotations

import json
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from judged_exact import KINDS, MULTIPLIERS, PROBLEM, alone, altered, infeasible
from random_formulations import LIMITS, random_formulation
from small_grasps import pinch

import synergrip as sg
from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.limit import Limit
from synergrip.explain.exact import check_proof
from synergrip.explain.exact.bare_limits import plain_number, values_of
from synergrip.explain.exact.exact_proof import (
    OF_FREE,
    OF_RANK,
    ExactProof,
    NoExactProof,
    exact_proof,
    marked,
    multipliers_of,
    rechecked,
)
from synergrip.explain.exact.weighed_limits import Weighed, on_references, stated
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan, plan_of_start_posture
from synergrip.tasks.timed_task import TimedTask, still

FIRST = {
    "normal, no upper": 192,
    "rate": 79,
    "rate, some free": 137,
    "acceleration": 137,
    "acceleration, some free": 137,
}
"""Seeds from which on a task that this kind of limit makes infeasible is looked for; 0 for the others."""
AT_INSTANTS = [kind for kind in LIMITS if not kind.startswith("sustained")]
"""Kinds that add nothing up over time."""
TIMES = np.array([0.0, 1.0])


def squeezed(margin: float, cap: float = 10.0) -> Infeasible | Plan:
    """A pinch of friction 0.5 without a load: the largest margin is half of the largest normal force."""
    task = TimedTask(TIMES, np.zeros((2, 6)), still(TIMES), margin, (sg.NormalForce(upper=cap),), (sg.LeastEffort(),))
    outcome = plan(pinch(), task)
    assert isinstance(outcome, Infeasible | Plan)
    return outcome


def proof_of(outcome: object) -> ExactProof:
    assert isinstance(outcome, Infeasible)
    found = exact_proof(outcome)
    assert isinstance(found, ExactProof), found
    return found


def document_of(formulation: Formulation, limits: list[Any], multipliers: list[Any], box: np.ndarray) -> dict[str, Any]:
    grasp = formulation.response.grasp
    problem = {name: getattr(grasp, name).tolist() for name in ("G", "J", "S", "C_s", "C_q", "C_z", "w_0")}
    problem |= {"wrench": formulation.wrench.tolist(), "lambda_0": None, "limits": limits, "box": box.tolist()}
    return marked(problem, multipliers)


@pytest.mark.parametrize("kind", AT_INSTANTS)
@pytest.mark.parametrize("seed", [1, 6])
def test_the_sum_is_that_of_the_rows_of_the_program(kind: str, seed: int) -> None:
    rng, formulation = random_formulation(seed)
    limit: Limit = LIMITS[kind](formulation.response.grasp)
    v = rng.normal(size=(formulation.knots, formulation.n_v))
    wanted, weighed = 0.0, []
    for part, cones in zip(limit.rows(formulation), stated((limit,), formulation), strict=True):
        values = values_of(part, v).reshape(len(part.constant), len(part.items), part.dim)
        for i, cone in enumerate(cones):
            y = rng.uniform(size=(len(values), part.dim))
            y[:, 0] += np.linalg.norm(y[:, 1:], axis=1)
            wanted += float((y * values[:, i]).sum())
            weighed.append((cone, y * cone.unit))
    of_references, z = on_references(formulation, weighed), formulation.reference.at(v)
    found = _sum(formulation, weighed, np.zeros(z.shape[1]))
    size = 1 + float(np.abs(of_references * z).sum())
    assert float(found) + float((of_references * z).sum()) == pytest.approx(wanted, rel=1e-9, abs=1e-9 * size)
    for j, one in enumerate(np.eye(z.shape[1])):
        more = float(_sum(formulation, weighed, one) - found)
        assert more == pytest.approx(float(np.abs(of_references[:, j]).sum()), rel=1e-9, abs=1e-9 * size)


def _sum(formulation: Formulation, weighed: Weighed, box: np.ndarray) -> Fraction:
    grasp = formulation.response.grasp
    problem = {name: getattr(grasp, name).tolist() for name in ("G", "J", "S", "C_s", "C_q", "C_z", "w_0")}
    problem |= {
        "wrench": formulation.wrench.tolist(), "lambda_0": None if grasp.lambda_0 is None else grasp.lambda_0.tolist(),
        "limits": [cone.document() for cone, _ in weighed], "box": box.tolist(),
    }  # fmt: skip
    return rechecked(marked(problem, multipliers_of(weighed)))


@pytest.mark.parametrize("factor", [1 + 1e-6, 1.5, 100.0])
def test_a_margin_that_no_squeeze_gives_is_proven_to_be_none(factor: float) -> None:
    found = proof_of(squeezed(5.0 * factor))
    assert found.sum < 0
    assert found.sum == rechecked(found.document())
    assert check_proof.checked(_read(found.document())) == found.sum


def _read(document: dict[str, Any]) -> Any:
    return json.loads(json.dumps(document), parse_float=lambda each: Fraction(float(each)))


def test_multipliers_prove_nothing_of_a_margin_that_a_squeeze_gives() -> None:
    assert isinstance(squeezed(5.0 * (1 - 1e-6)), Plan)
    found = proof_of(squeezed(5.0 * (1 + 1e-6))).document()
    for limit in found["problem"]["limits"]:
        if limit["limit"] == "limits.margin":
            assert limit["plus"][0][0] == -5.0 * (1 + 1e-6)
            limit["plus"][0][0] = -5.0 * (1 - 1e-6)
    assert rechecked(found) >= 0


def test_the_file_holds_the_numbers_of_the_problem_as_they_are_written() -> None:
    found = proof_of(squeezed(6.0, cap=10.0)).problem
    limits = {(each["limit"], each["item"], each["side"]): each for each in found["limits"]}
    cap = limits["limits.normal_force", "left", "highest"]
    assert (cap["terms"], cap["plus"]) == ([[0, "force", 0, -1.0]], [[10.0]])
    cone = limits["limits.margin", "left", ""]
    assert cone["terms"][:3] == [[0, "force", 0, 0.5], [1, "force", 1, 1.0], [2, "force", 2, 1.0]]
    assert cone["plus"] == [[-6.0, 0.0, 0.0, 0.0]]
    assert found["G"] == pinch().G.tolist()


def test_the_last_digits_go_where_they_are_those_of_a_division_only() -> None:
    assert plain_number(0.1 / 3 * 3) == 0.1
    assert plain_number(20.0 / 3.7 * 3.7 * (1 + 2.3e-16)) == 20.0
    for value in (1 / 3, np.pi, 0.123456789012345678, 1e-300 / 3, 0.0):
        assert abs(plain_number(value) - value) <= 1e-15 * abs(value)
    assert plain_number(20.00000000000008) != 20.0


def made_infeasible(kind: str) -> Infeasible:
    first = FIRST.get(kind, 0)
    return next(found for seed in range(first, first + 200) if (found := infeasible(seed, kind)) is not None)


@pytest.mark.parametrize("kind", KINDS)
def test_a_no_of_every_kind_of_limit_is_proven_again(kind: str) -> None:
    outcome = made_infeasible(kind)
    found, key = proof_of(outcome), LIMITS[kind](outcome.grasp).key
    assert found.sum < 0
    blamed = {found.problem["limits"][i]["limit"] for i, _, _ in found.multipliers}
    assert key in blamed
    assert blamed <= {"friction cone", "limits.margin", "task.move", *(limit.key for limit in outcome.task.limits)}
    assert len(found.problem["wrench"]) == len(outcome.task.times)


@cache
def rate_proof() -> ExactProof:
    return proof_of(made_infeasible("rate"))


@pytest.mark.parametrize("how", [*PROBLEM, *MULTIPLIERS])
def test_a_file_that_was_altered_is_no_proof_of_the_problem(how: str) -> None:
    found = rate_proof()
    changed = altered(np.random.default_rng(1), found.document(), how)
    assert not alone(changed)
    if how in PROBLEM:
        assert not alone(marked(changed["problem"], changed["multipliers"]), found.of)


def test_the_checker_stands_alone(tmp_path: Path) -> None:
    document = proof_of(squeezed(6.0)).document()
    assert alone(document)
    assert alone(document, proof_of(squeezed(6.0)).of)
    assert not alone(document, proof_of(squeezed(7.0)).of)
    text = Path(check_proof.__file__).read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 100
    assert "synergrip" not in text
    imported = {line.split()[1] for line in text.splitlines() if line.startswith(("import ", "from "))}
    assert imported <= {"fractions", "hashlib", "json", "pathlib", "sys", "typing"}


@pytest.mark.parametrize(
    ("y", "why"),
    [([-1.0, 0.0, 0.0, 0.0], "below 0"), ([1.0, 1.0, 1e-300, 0.0], "outside, by a hair"), ([], "none")],
)
def test_multipliers_that_are_none_are_refused(y: list[float], why: str) -> None:
    document = proof_of(squeezed(6.0)).document()
    document["multipliers"][0][2] = y
    with pytest.raises((ValueError, IndexError)):
        rechecked(document)


@pytest.mark.parametrize("place", [(0, "knot", 2), (0, "knot", -1), (99, "limit", None)])
def test_multipliers_of_knots_and_limits_that_are_none_are_refused(place: tuple[int, str, int | None]) -> None:
    document = proof_of(squeezed(6.0)).document()
    limit, _, knot = place
    document["multipliers"][0][0] = limit
    document["multipliers"][0][1] = 0 if knot is None else knot
    with pytest.raises((ValueError, IndexError)):
        rechecked(document)


@pytest.mark.parametrize("change", [{"index": -1}, {"row": -1}, {"lag": -1}, {"lag": 1}])
def test_places_before_the_first_are_refused(change: dict[str, int]) -> None:
    document = proof_of(squeezed(6.0)).document()
    i, knot, _ = document["multipliers"][0]
    limit = document["problem"]["limits"][i]
    limit["terms"][0][2] = change.get("index", limit["terms"][0][2])
    limit["terms"][0][0] = change.get("row", limit["terms"][0][0])
    limit["earlier"] = [[change["lag"], [1.0] * limit["knots"]]] if "lag" in change else []
    assert knot == 0
    with pytest.raises(ValueError, match="before the first"):
        rechecked(document)


def test_elimination_in_whole_numbers_solves_equations() -> None:
    rng = np.random.default_rng(0)
    for n in (1, 2, 5, 9):
        A, B = (rng.integers(-9, 9, (n, m)) * 2.0 ** rng.integers(-60, 3, (n, m)) for m in (n, 3))
        A[0, 0] = 0.0  # a row must be exchanged
        A[-1, -1] += n == 1
        exactly = [[[Fraction(each) for each in row] for row in part.tolist()] for part in (A, B)]
        X, d = check_proof.solved(*exactly)
        assert d > 0
        assert check_proof.product(exactly[0], X) == [[d * each for each in row] for row in exactly[1]]


def test_a_grasp_that_is_rigid_somewhere_has_no_answer() -> None:
    document = proof_of(squeezed(6.0)).document()
    document["problem"]["G"][0] = document["problem"]["G"][1]
    with pytest.raises(StopIteration):
        rechecked(document)


@pytest.mark.parametrize(("problem", "stage"), [("pinch-hard", "restraint"), ("barrett-ball-lift", "direction")])
def test_a_no_of_rank_says_that_it_has_no_exact_proof(problem: str, stage: str) -> None:
    asked = sg.load_problem(problem)
    outcome = plan(asked.grasp, asked.task)
    assert isinstance(outcome, Infeasible)
    assert outcome.stage == stage
    assert exact_proof(outcome) == NoExactProof(OF_RANK)


def test_an_object_that_stays_free_to_move_has_no_exact_proof() -> None:
    asked = sg.load_problem("pinch-hard", ["task.wrench=[0,0,-2,0,0,0]", "limits.normal_force=1 N"])
    outcome = plan(asked.grasp, asked.task)
    assert isinstance(outcome, Infeasible)
    assert outcome.stage == "magnitude"
    assert exact_proof(outcome) == NoExactProof(OF_FREE)


@pytest.mark.parametrize(
    ("problem", "override"),
    [
        ("pinch-soft", 'task={wrench=[0,0,-2,0,0,0],tracking="compliant",tolerance="0.99 mm"}'),
        ("dlr-ball-lift-free", "task.drift=0.74 mm"),
        ("gripper-box", "limits.synergy_rate=0.11"),
        ("barrett-ball-hold", "limits.drift=0.83 mm"),
        ("human-glass", "limits.normal_force=1 N"),
    ],
)
def test_a_no_about_a_bundled_problem_is_proven_again(problem: str, override: str) -> None:
    asked = sg.load_problem(problem, [override])
    found = proof_of(plan_of_start_posture(asked.grasp, asked.task))
    assert found.sum < 0
    assert len(found.problem["joints"]) == asked.grasp.n_q


def with_limit(limit: Limit) -> Infeasible:
    task = TimedTask(
        TIMES, np.zeros((2, 6)), still(TIMES), 1.0, (sg.NormalForce(upper=10.0), limit), (sg.LeastEffort(),)
    )
    outcome = plan(pinch(), task)
    assert isinstance(outcome, Infeasible)
    return outcome


@dataclass(frozen=True)
class Total(Limit):
    """The normal forces add up to 3 N at most; a margin of 1 N takes 4 N."""

    def rows(self, formulation: Formulation) -> Any:
        grasp = formulation.response.grasp
        total = formulation.force.after(np.eye(grasp.n_l)[grasp.normal_rows].sum(axis=0, keepdims=True))
        return sg.within(self.key, ["total"], total, -np.inf, 3.0, 3.0)

    def usage(self, formulation: Formulation, motion: Any) -> Any:
        raise NotImplementedError


class OfAlpha(Total):
    """A limit on a coordinate, which is none of a quantity: the first of alpha is 1 kN at least."""

    def rows(self, formulation: Formulation) -> Any:
        return sg.within(self.key, ["alpha"], formulation.alpha, 1e3, np.inf, 1.0)


def test_a_limit_of_ones_own_is_in_the_proof() -> None:
    found = proof_of(with_limit(Total()))
    limit = next(each for each in found.problem["limits"] if each["limit"] == "Total")
    assert (limit["terms"], limit["plus"]) == ([[0, "force", 0, -1.0], [0, "force", 4, -1.0]], [[3.0]])


def test_a_limit_on_something_else_leaves_no_exact_proof() -> None:
    found = exact_proof(with_limit(OfAlpha()))
    assert isinstance(found, NoExactProof)
    assert "'OfAlpha'" in found.why


def test_a_limit_over_time_leaves_no_exact_proof() -> None:
    found = exact_proof(with_limit(sg.SustainedTorque(1e-3)))
    assert isinstance(found, NoExactProof)
    assert found.why == "no exact proof: 'limits.sustained_torque' adds up over time"


def test_the_page_prints_the_checker() -> None:
    page = (Path(__file__).parents[2] / "docs" / "exact.md").read_text(encoding="utf-8")
    assert f"```python\n{Path(check_proof.__file__).read_text(encoding='utf-8')}```" in page
