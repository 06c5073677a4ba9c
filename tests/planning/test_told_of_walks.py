"""What is told of motions that are followed badly: what was promised, what is off in all, joints that jump."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from synergrip.planning.outcome import Plan, Unknown
from synergrip.planning.planning import plan
from synergrip.planning.reach import notes
from synergrip.problems.problem import load_problem
from synergrip.reports.data.json_plan import outcome_document


def test_a_plan_of_the_start_posture_that_fails_tells_what_it_promised_and_each_miss_once() -> None:
    problem = load_problem("barrett-ball-far", ['task.linearise="once"'])
    no = plan(problem.grasp, problem.task)
    assert isinstance(no, Unknown)
    assert any("promises a smallest slip margin of 0.5" in note and "keeps -" in note for note in no.notes)
    document = outcome_document(problem.title, problem.grasp, no, problem.notes)
    assert any("promises a smallest slip margin of 0.5" in note for note in document["notes"])
    missed = [part.removeprefix("between the knots: ") for part in no.why.split("; ")]
    assert len(missed) == len(set(missed))


def told(joints: Any, wanted: Any = None) -> list[str]:
    problem = load_problem("dlr-ball-turn")
    answer = plan(problem.grasp, problem.task.replace(knots=9))
    assert isinstance(answer, Plan)
    assert answer.executed is not None
    turned = answer.executed.left(answer.task.target.values) if wanted is None else wanted
    executed = SimpleNamespace(joint=joints(np.array(answer.executed.joint)), left=lambda _: turned)
    walk = SimpleNamespace(executed=executed, behind=1e-3 if wanted is not None else 0.0, way=None)
    walker = SimpleNamespace(task=answer.task, start=answer.analysis, wanted=turned, allowed=2e-3)
    return list(notes(walk, walker))  # type: ignore[arg-type]


def test_joints_that_jump_between_two_knots_are_named() -> None:
    def jumping(values: Any) -> Any:
        values[5:, 9] += 0.3
        return values

    assert told(lambda values: values) == []
    (note,) = told(jumping)
    assert "jumps by 0.3" in note
    assert "limits.synergy_rate" in note


def test_what_is_off_in_all_stands_beside_what_counts_as_behind() -> None:
    off = np.zeros((9, 6))
    off[4] = [3e-3, 0, 0, 0, np.radians(2.0), 0]
    (note,) = told(lambda values: values, off)
    assert "up to 1 mm behind" in note
    assert "(3 mm and 2 deg off the wanted one" in note
