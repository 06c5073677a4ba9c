"""What files claim of their references: ours are right, and no number altered by a twentieth is accepted."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from judged_check import accepted, altered, document_of, judged, numbers

from synergrip.errors import InputError
from synergrip.planning.check import judge_references
from synergrip.planning.claims import compared
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.planning.references import read_references
from synergrip.planning.sizes import Sizes
from synergrip.problems.finding import bundled_problems
from synergrip.problems.problem import Problem, load_problem
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.data.plan_files import write_outcome

BY_DIGEST = ("programs", "execution", "control")
"""Keys that do not follow from the references, so that the digest alone guards them."""


@cache
def _written(name: str) -> tuple[Problem, dict[str, Any]]:
    problem = load_problem(name)
    return problem, document_of(problem)


@pytest.mark.parametrize(("name", "most"), [("tripod", 12), ("barrett-ball-hold", 3), ("gripper-peg", 3)])
def test_no_altered_number_is_accepted(name: str, most: int) -> None:
    """`python tests/judged_check.py` alters more of them."""
    found = judged(name, most)
    assert found.count > 60
    assert not found.missed
    # what the references tell is seen without the digest, but for what is rounding beside the load
    assert not [key for key, value in found.compared if not key.startswith(BY_DIGEST) and abs(value) > 1e-8]


def test_the_last_time_of_a_plan_is_seen_when_it_is_altered() -> None:
    problem, document = _written("barrett-ball-hold")
    assert not accepted(problem, altered(document, ("time_s", 40), 2.1), by_digest=False)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("verdict",), "infeasible"),
        (("margin", "contact"), "finger2/tip"),
        (("between", "holds"), False),
        (("checks", 5, "passed"), False),
        (("checks", 5, "name"), "another check"),
        (("limits", 0, "item"), "finger3/tip"),
        (("limits",), []),
        (("joints", 0), "elbow"),
        (("structure", "ambiguous"), True),
        (("largest_margin_N",), 0.5),
        (("lambda", 3), [1.0, 2.0]),
        (("alpha",), None),
        (("margin",), 0.5),
        (("limits", 0, "lower"), "0.5"),
        (("exit_code",), True),
    ],
)
def test_words_and_forms_are_compared_too(path: Any, value: Any) -> None:
    problem, document = _written("barrett-ball-hold")
    assert not accepted(problem, altered(document, path, value), by_digest=False)


@pytest.mark.parametrize(("small", "right"), [(1e-3, False), (1e-6, False), (1e-9, False), (1e-14, True)])
def test_a_small_entry_beside_a_large_one_is_compared_with_itself(small: float, right: bool) -> None:
    """Down to what another processor makes of the terms it is a sum of."""
    claims = compared({"tau": [[1.0, 1.05 * small]]}, {"tau": np.array([[1.0, small]])}, Sizes({"tau": 1.0}))
    assert claims.checks[0].passed is right
    assert [each.key for each in claims.differences] == ([] if right else ["tau[0][1]"])


def test_what_was_not_compared_is_named(tmp_path: Path) -> None:
    problem, document = _written("tripod")
    (tmp_path / "plan.json").write_text(json.dumps(document | {"my_key": 3}), encoding="utf-8")
    claims = judge_references(problem.grasp, problem.timed, read_references(tmp_path, problem.grasp)).claims
    assert {"programs", "certificate", "notes", "my_key"} <= set(claims.skipped)
    assert {"lambda", "alpha", "margin", "largest_margin_N", "between", "verdict"} <= set(claims.right)


@pytest.mark.parametrize("name", bundled_problems())
def test_every_plan_of_ours_claims_what_is_right(name: str, tmp_path: Path) -> None:
    problem = load_problem(name)
    outcome = plan(problem.grasp, problem.task)
    if not isinstance(outcome, Plan):
        return
    write_outcome(tmp_path, outcome_document("", problem.grasp, outcome), outcome, ("json", "csv", "npz"))
    for form in ("plan.json", "plan.csv", "plan.npz"):
        judgement = judge_references(problem.grasp, problem.timed, read_references(tmp_path / form, problem.grasp))
        assert [check.name for check in judgement.checks if not check.passed] == [], form
        assert judgement.claims.right


def test_the_largest_margin_with_a_reserve_is_compared_too() -> None:
    problem = load_problem("barrett-ball-hold", ["goal={maximise='margin'}"])
    document = document_of(problem)
    assert problem.timed.between == "hold"
    assert accepted(problem, document, by_digest=True)
    for factor in (0.999, 1.001):
        other = altered(document, ("largest_margin_N",), factor * document["largest_margin_N"])
        assert not accepted(problem, other, by_digest=False)


@pytest.mark.parametrize("form", ["npz", "csv"])
def test_altered_arrays_of_other_files_are_seen(form: str, tmp_path: Path) -> None:
    problem = load_problem("gripper-box")
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    write_outcome(tmp_path, outcome_document("", problem.grasp, outcome), outcome, ("json", "csv", "npz"))
    path = tmp_path / f"plan.{form}"
    if form == "npz":
        with np.load(path) as file:
            arrays = dict(file)
        arrays["sigma"] = arrays["sigma"] * np.where(np.arange(41)[:, None] == 7, 1.05, 1.0)
        np.savez(path, **{key: value for key, value in arrays.items() if key != "digest"})
    else:
        lines = path.read_text(encoding="utf-8").splitlines()
        cells = lines[8].split(",")
        cells[3] = repr(1.05 * float(cells[3]))
        path.write_text("\n".join([*lines[:8], ",".join(cells), *lines[9:]]), encoding="utf-8")
    judgement = judge_references(problem.grasp, problem.timed, read_references(path, problem.grasp))
    failed = [check.name for check in judgement.checks if not check.passed]
    assert failed == ["claimed sigma" if form == "npz" else "claimed columns"]


def test_a_file_of_a_no_says_that_there_is_nothing_to_check(tmp_path: Path) -> None:
    problem = load_problem("barrett-ball-lift")
    outcome = plan(problem.grasp, problem.task)
    write_outcome(tmp_path, outcome_document("", problem.grasp, outcome), outcome, ("json",))
    with pytest.raises(InputError) as caught:
        read_references(tmp_path, problem.grasp)
    message = caught.value.issues[0].message
    assert "its verdict is 'infeasible' (stage: direction)" in message
    assert "synergrip plan PROBLEM" in message


def test_numbers_of_a_document_are_found() -> None:
    assert list(numbers({"a": [1, 0, {"b": 2.5}], "seconds": 3, "c": True})) == [(("a", 0), 1), (("a", 2, "b"), 2.5)]
