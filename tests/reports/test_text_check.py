"""What `check` says of references that break something: what, where, when and by how much, before anything else."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from synergrip import Plan, load_problem, plan
from synergrip.linalg import frozen
from synergrip.planning.check import LINEAR, Judgement, judge_references
from synergrip.planning.outcome import Check
from synergrip.planning.references import References, read_references
from synergrip.problems.problem import Problem
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.text.tables import wrapped
from synergrip.reports.text.text_between import looked_at
from synergrip.reports.text.text_check import judgement_document, judgement_text

REPOSITORY = Path(__file__).resolve().parents[2]
CONTINUED = re.compile(r" {9}\S| {17}\S")
"""A line that goes on with what stands after a label, or after the verdict."""


@cache
def planned() -> tuple[Problem, Plan]:
    problem = load_problem("gripper-box", ["task.knots=3"])
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    return problem, outcome


@cache
def judged(factor: float = 1.0, shift: float = 0.0) -> Judgement:
    problem, outcome = planned()
    references = References(outcome.motion.times, frozen(factor * outcome.dz_r + shift), {})
    return judge_references(problem.grasp, problem.timed, references)


def text_of(judgement: Judgement, *, details: bool = False) -> str:
    """Return what is printed, each sentence on one line."""
    lines = list[str]()
    for line in judgement_text(planned()[0], judgement, details=details).split("\n"):
        if CONTINUED.match(line):
            lines[-1] += f" {line.strip()}"
        else:
            lines.append(line)
    return "\n".join(lines)


def from_file(tmp_path: Path, **changes: Any) -> Judgement:
    """Judge the file of a plan with other entries."""
    problem, outcome = planned()
    document = json.loads(json.dumps(outcome_document("", problem.grasp, outcome), default=np.ndarray.tolist))
    (tmp_path / "plan.json").write_text(json.dumps(document | changes), encoding="utf-8")
    return judge_references(problem.grasp, problem.timed, read_references(tmp_path / "plan.json", problem.grasp))


def test_figures_of_the_linear_model_are_said_to_be_no_more() -> None:
    """References off by 1 rad: a margin of hundreds of newtons beside limits that are broken."""
    judgement = judged(shift=1.0)
    failed = [check.name for check in judgement.checks if not check.passed]
    assert failed == ["equilibrium", f"{LINEAR}normal force", f"{LINEAR}joint torque"]
    text = text_of(judgement)
    said = "at no equilibrium from t = 0 s on (no equilibrium is near: the hand does not follow there)"
    assert f"this plan fails  with these references the hand is {said}" in text
    assert "breaks   linear model: joint torque of left_proximal is 34.05 N m at t = 2 s, 32 N m above its" in text
    assert text.count("a limit that is kept there says nothing about the hand") == 1
    assert re.search(r"^ +linear model +at +limit$", text, re.MULTILINE)
    document = judgement_document(judgement)
    assert "linear model at the start posture" in document["notes"][0]
    assert len(document["broken"]) == 2


@pytest.mark.parametrize("shift", [0.0, 1.0])
def test_the_text_is_not_wider_than_its_place(shift: float) -> None:
    for details in (False, True):
        lines = judgement_text(planned()[0], judged(shift=shift), details=details).split("\n")
        assert max(len(line) for line in lines if not line.startswith(("read", "task"))) <= 80


def test_more_knots_are_advised_only_where_the_knots_keep_the_limit() -> None:
    everywhere = judged(0.5).between
    assert everywhere is not None
    times = judged(0.5).motion.times
    (told,) = [" ".join(line.strip() for line in looked_at(everywhere, None, times))]
    assert "more knots" not in told
    assert told.endswith("past its limit of 0.5 N, at knots as well")
    slip = everywhere.usages[0]
    value = slip.value.copy()
    value[np.isclose(slip.times[:, None], times, rtol=0, atol=1e-9).any(axis=1)] = 1.0
    inside = replace(everywhere, usages=(replace(slip, value=frozen(value)), *everywhere.usages[1:]))
    (told,) = [" ".join(line.strip() for line in looked_at(inside, None, times))]
    assert told.endswith("past its limit of 0.5 N; more knots straighten it")


def test_what_is_broken_comes_before_what_the_file_claims(tmp_path: Path) -> None:
    judgement = from_file(tmp_path, dz_r=(0.5 * planned()[1].dz_r).tolist())
    lines = text_of(judgement).split("\n")
    verdict = next(i for i, line in enumerate(lines) if line.startswith("this plan fails"))
    assert lines[verdict] == "this plan fails  it breaks: rigid motion, slip margin"
    k, i = judgement.usages[0].worst()
    least = judgement.between.usages[0].value.min() if judgement.between is not None else judgement.margins[k, i]
    assert lines[verdict + 1].startswith("breaks   the object is ")
    assert lines[verdict + 1].endswith("0.2 mm allowed; at 2 of 3 knots")
    assert lines[verdict + 2].startswith(f"breaks   slip margin of left/tip is {least:.4g} N at t = ")
    assert lines[verdict + 2].endswith(f"{0.5 - least:.3g} N below its limit of 0.5 N; at 3 of 3 knots")
    claims = [line for line in lines if line.startswith("claims")]
    wrong, count = len(judgement.claims.differences), len(judgement.claims.checks) - 1
    so = f"claims   {wrong} of the {count} things that the file says of its references are not so"
    assert len(claims) == 1
    assert claims[0].startswith(so)
    assert wrong > 10
    assert "inf" not in "\n".join(lines).replace("infeasible", "")
    detailed = text_of(judgement, details=True)
    assert "claims   verdict: the file says feasible, its references fail" in detailed
    assert detailed.count(": the file says") == wrong
    assert "inf " not in detailed
    assert judgement_document(judgement)["broken"] == [
        line.removeprefix("breaks   ") for line in lines[verdict + 1 :][:2]
    ]


def test_a_file_that_is_wrong_about_references_that_keep_all_is_told_so_in_one_sentence(tmp_path: Path) -> None:
    text = text_of(from_file(tmp_path, largest_margin_N=3.0))
    assert "this plan fails  it keeps every limit of the problem, but not all that its file says is true" in text
    assert "breaks" not in text
    assert "claims   largest_margin_N: the file says 3.0, it is null" in text
    assert "its numbers are not those that were written (by its digest)" in text


def test_all_that_a_file_says_is_so(tmp_path: Path) -> None:
    judgement = from_file(tmp_path)
    text = text_of(judgement)
    assert "feasible  this plan keeps every limit of the problem" in text
    assert f"claims   all of the {len(judgement.claims.checks) - 1} things that the file says" in text
    assert f"check    {len(judgement.checks) - len(judgement.claims.checks)} checks ✓; -v shows each" in text


def test_contacts_that_are_pulled_or_slip_are_said_to_come_off_or_slip_once() -> None:
    pulled, slipping, kept = (text_of(judged(factor)) for factor in (-0.3, 0.3, 1.0))
    ends = "the figures are those of contacts that stick whatever happens"
    assert f"left/tip and right/tip would come off (first at t = 0 s): {ends}, also when pulled" in pulled
    assert f"left/tip and right/tip would slip (first at t = 0 s): {ends}\n" in slipping
    assert [text.count("stick whatever happens") for text in (pulled, slipping, kept)] == [1, 1, 0]


def test_torques_are_kept_to_the_forces_times_the_size_of_the_grasp_as_the_page_says() -> None:
    judgement = judged()
    room = {check.name: check.tolerance for check in judgement.checks}
    length = judgement.analysis.response.scale.length
    assert room["joint torque"] == pytest.approx(room["slip margin"] * length, rel=1e-12)
    page = (REPOSITORY / "docs" / "along.md").read_text(encoding="utf-8")
    assert "the same times the length of the grasp for torques, 10 um, 0.1 mrad, a thousandth of a limit" in page


def test_what_is_missed_in_what_is_allowed_for_is_told_with_the_case() -> None:
    problem, outcome = planned()
    allowing = load_problem("gripper-box", ["task.knots=3", "allow.friction=[0.3, 0.9]"])
    references = References(outcome.motion.times, outcome.dz_r, {})
    text = text_of(judge_references(problem.grasp, allowing.timed, references))
    assert "this plan fails  it breaks: slip margin in what is allowed for" in text
    assert re.search(r"breaks   what is allowed: least friction: slip margin -0\.2\d* N \(left/tip, t = ", text)


def test_an_end_between_two_knots_is_a_check_with_a_short_name_and_its_reason_a_sentence() -> None:
    """Loads and references where the knots are kept, and the hand has no equilibrium halfway."""
    whole = judged()
    why = "between the knots: no equilibrium is near: the hand does not follow there"
    missed = Check("between the knots: equilibrium", float("inf"), 1e-8)
    text = text_of(replace(whole, checks=(*whole.checks[:4], missed), between=None, lost=why), details=True)
    assert "this plan fails  it breaks: equilibrium between the knots\n" in text
    assert f"breaks   {why}\n" in text
    assert re.search(r"^between the knots: equilibrium +1e-08 +FAILS$", text, re.MULTILINE)


def test_matrices_are_told_once_of_a_limit_that_is_missed_at_knots_and_between_them() -> None:
    problem = load_problem("tripod", ["task.between=hold"])
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    asked = load_problem("tripod", ["task.between=hold", "limits.margin=8 N"])
    judgement = judge_references(asked.grasp, asked.timed, References(outcome.motion.times, outcome.dz_r, {}))
    assert [check.name for check in judgement.checks if not check.passed] == ["slip margin", "between the knots"]
    text = text_of(judgement)
    assert "this plan fails  it breaks: slip margin\n" in text
    assert text.count("breaks   ") == 1
    assert "is 7 N at t = 0 s, 1 N below its limit of 8 N; at 11 of 11 knots" in text


@pytest.mark.parametrize("unit", ["N m", "N mm", "mN m"])
def test_units_of_several_words_are_not_split_within_a_sentence(unit: str) -> None:
    for width in range(20, 60):
        lines = wrapped("", f"joint torque of left_proximal, 24.6 {unit} above its limit", width)
        assert sum(f"24.6 {unit}" in line for line in lines) == 1
