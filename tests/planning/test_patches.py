"""Patches on round pads lie flat: they do not roll, in the plan as in a program that was written independently."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from second_execution import executed as executed_otherwise

from synergrip import Plan, load_problem, plan
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.text.text_plan import verdict_lines

REPOSITORY = Path(__file__).resolve().parents[2]
PATCHES = (
    "contacts.model=patch", 'contacts.spin_friction="5 mm"', 'contacts.patch_radius="8 mm"', "task.knots=9",
    'contacts.spin_stiffness="2 N m/rad"', 'contacts.tilt_stiffness="0.2 N m/rad"', "task.tracking=compliant",
)  # fmt: skip


@pytest.mark.parametrize(("name", "tolerance"), [("human-ball-centred", "2 mm"), ("dlr-ball-move", "3 mm")])
def test_patches_are_in_the_equilibria_of_a_second_program(name: str, tolerance: str) -> None:
    """Rolling, as tips that transmit no moments do, would be off by 7 and 21 mN: fingers turn against the ball."""
    problem = load_problem(name, [*PATCHES, f"task.tolerance={tolerance}"])
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    assert problem.grasp.held is not None
    assert all(touch.pad.radius for touch in problem.grasp.held.touches)
    document = json.loads(json.dumps(outcome_document("", problem.grasp, answer)))
    assert document["true"]["contact_model"] == "fixed"
    assert not any(document["true"]["rolls"])
    other = executed_otherwise(document, REPOSITORY, "rolling")
    assert other.ended is None
    assert answer.forces == pytest.approx(other.forces, abs=1e-7)
    assert answer.margins == pytest.approx(other.margins, abs=1e-7)
    assert np.array(document["true"]["du"]) == pytest.approx(other.du, abs=1e-9)
    text = " ".join("\n".join(verdict_lines(problem, answer)).split())
    assert "contacts stay where they are on link and object (patches lie flat, also where pads are round)" in text
