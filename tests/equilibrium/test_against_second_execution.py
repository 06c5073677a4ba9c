"""Bundled plans executed twice: by the package, and by a program that knows plan.json and the URDF file alone."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from second_execution import executed

from synergrip.equilibrium import way
from synergrip.equilibrium.execute import execute
from synergrip.equilibrium.execution import Execution
from synergrip.planning.executing import loads
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan as plan_along
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.problems.problem import load_problem
from synergrip.reports.data.json_plan import outcome_document

REPOSITORY = Path(__file__).parents[2]
NAMES = sorted(path.stem for path in (REPOSITORY / "problems").glob("*.toml"))
WITHOUT_HANDS = {"pinch-hard", "pinch-soft", "tripod"}
REFUSED = {"barrett-ball-lift", "robonaut-handle-eigengrasps"}
"""Infeasible: there is nothing to execute."""
GROWN = {"gripper-box-draw"}
"""What the start posture has no plan of."""
ROLLING = [
    "gripper-peg",
    "gripper-bar",
    "gripper-box",
    "human-ball-near",
    "dlr-ball-lift-free",
    "robonaut-handle-knock",
]


def both(name: str, model: Any, count: int) -> tuple[Any, Execution]:
    """Return what both make of the first of some knots of a plan, from its beginning to its middle."""
    problem = load_problem(name)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    document = json.loads(json.dumps(outcome_document(problem.title, problem.grasp, answer)))
    knots = sorted({*np.linspace(0, len(answer.time) // 2, count).astype(int).tolist()})
    for key in ("time_s", "dz_r", "wrench"):
        document[key] = [document[key][k] for k in knots]
    second = executed(document, REPOSITORY, model)
    there = loads(answer.task, answer.time, np.array(answer.motion.wrench)).taken(knots)
    references = np.array(answer.dz_r)[knots]
    own = execute(problem.grasp, np.array(answer.time)[knots], references, there, contact_model=model)
    assert own.whole, own.why
    assert second.ended is None
    return second, own


@pytest.mark.parametrize("name", sorted({*NAMES} - WITHOUT_HANDS - REFUSED - GROWN))
def test_fixed_contacts_are_in_the_same_equilibria(name: str) -> None:
    second, own = both(name, "fixed", 2)
    assert own.states.forces == pytest.approx(second.forces, abs=1e-7)
    assert own.du == pytest.approx(second.du, abs=1e-10)
    assert own.states.q == pytest.approx(second.q, abs=1e-10)
    assert own.balance.torques == pytest.approx(second.tau, abs=1e-8)
    assert own.margins == pytest.approx(second.margins, abs=1e-7)


@pytest.mark.parametrize("name", ROLLING)
def test_tips_that_roll_end_in_the_same_equilibria(name: str) -> None:
    """Their way is gone in steps, three from knot to knot there and one here: what that leaves grows with the knots."""
    second, own = both(name, "rolling", 3)
    assert own.setting.contact_model == "rolling"
    assert own.states.forces == pytest.approx(second.forces, abs=2e-3)
    assert own.du == pytest.approx(second.du, abs=5e-5)
    assert own.states.q == pytest.approx(second.q, abs=1e-5)
    assert own.margins == pytest.approx(second.margins, abs=2e-3)


def test_steps_from_knot_to_knot_are_what_is_left(monkeypatch: pytest.MonkeyPatch) -> None:
    """With a knot between each two of before, and a step for each, the difference to many falls to a quarter."""
    monkeypatch.setattr(way, "FARTHEST", np.inf)
    problem = load_problem("human-ball-near")
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    start, end = np.array(answer.dz_r)[0], np.array(answer.dz_r)[len(answer.time) // 2]
    found = []
    for count in (3, 5, 41):
        shares = np.linspace(0, 1, count)[:, None]
        references = (1 - shares) * start + shares * end
        there = loads(answer.task, answer.time, np.array(answer.motion.wrench)).taken([0] * count)
        own = execute(problem.grasp, shares[:, 0], references, there)
        assert own.whole, own.why
        found.append(own.states.forces[-1])
    rough, finer = (float(np.abs(each - found[-1]).max()) for each in found[:2])
    assert 3 < rough / finer < 5.5


def test_few_knots_of_a_large_motion_are_as_true_as_many() -> None:
    """From one knot to the next fingers turn by a radian against the ball: one step of rolling would miss 70 mN."""
    problem = load_problem("human-ball-far", ["task.knots=2", 'task.between="report"'])
    answer = plan_along(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    document = json.loads(json.dumps(outcome_document(problem.title, problem.grasp, answer)))
    second = executed(document, REPOSITORY, "rolling", parts=24)
    assert second.ended is None
    assert answer.executed is not None
    assert answer.executed.states.forces == pytest.approx(second.forces, abs=2e-3)
