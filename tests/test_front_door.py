"""The package as one meets it: its names, its help, what it logs, and that it prints nothing by itself."""

from __future__ import annotations

import logging
import pydoc
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

import synergrip
from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.conic.solution import Settings, Solution
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.planning.solvers import SOLVERS
from synergrip.problems.problem import load_problem

NAMES = {
    "load_hand", "Object", "Sphere", "Box", "Cylinder", "HardFinger", "SoftFinger", "Contact", "Grasp", "analyse",
    "NormalForce", "LeastEffort", "load_problem", "plan", "Plan", "Infeasible", "Unknown", "InputError", "VerdictError",
}  # fmt: skip


def test_the_public_names_are_listed_and_all_of_them_load() -> None:
    assert set(dir(synergrip)) == set(synergrip.__all__) >= NAMES
    assert len(synergrip.__all__) == len(set(synergrip.__all__))
    for name in synergrip.__all__:
        assert getattr(synergrip, name).__doc__, name
    with pytest.raises(AttributeError, match="no attribute 'plann'"):
        synergrip.plann  # noqa: B018


def test_names_stand_in_the_order_of_the_pipeline() -> None:
    order = ["load_hand", "Object", "HardFinger", "Grasp", "analyse", "NormalForce", "LeastEffort", "plan"]
    places = [synergrip.__all__.index(name) for name in (*order, "Plan")]
    assert places == sorted(places)


def test_help_tells_of_every_name() -> None:
    text = pydoc.plain(pydoc.render_doc(synergrip))
    assert not [name for name in synergrip.__all__ if name not in text and name != "__version__"]


def test_importing_loads_nothing_heavy() -> None:
    """A name is loaded when it is first used; listing them loads none."""
    code = (
        "import sys, synergrip; dir(synergrip); "
        "print([m for m in ('numpy', 'scipy', 'pydantic', 'logging', 'typing') if m in sys.modules])"
    )
    source = Path(synergrip.__path__[0]).parent
    command = (sys.executable, "-S", "-c", code)
    done = subprocess.run(command, capture_output=True, text=True, check=False, env={"PYTHONPATH": str(source)})
    assert done.stdout.strip() == "[]", done.stdout + done.stderr


def test_planning_tells_its_stages_to_who_listens(caplog: pytest.LogCaptureFixture) -> None:
    problem = load_problem("barrett-ball-carry")
    with caplog.at_level(logging.DEBUG, logger="synergrip"):
        answer = plan(problem.grasp, problem.task)
    stages = [record.getMessage() for record in caplog.records if record.levelno == logging.INFO]
    details = [record.getMessage() for record in caplog.records if record.levelno == logging.DEBUG]
    assert "planning on" in stages[0]
    assert repr(answer) == stages[-1]
    goals = [decision.goal for decision in answer.decisions]
    assert all(any(f"'{goal}'" in stage for stage in stages) for goal in goals)
    assert any("attempt 1 of 5" in each and "verified" in each for each in details)
    assert all(len(message) < 1000 for message in stages + details)


def test_a_retry_and_a_change_of_units_are_told(caplog: pytest.LogCaptureFixture) -> None:
    """By a solver whose answers to the first program are a hundred times too large."""
    problem, asked = load_problem("tripod"), list[Program]()

    def hasty(question: Question, program: Program, settings: Settings) -> Solution:
        asked.append(program)
        found = SOLVERS["clarabel"](question, program, settings)
        return found if program is not asked[0] else replace(found, x=100 * found.x)

    with caplog.at_level(logging.DEBUG, logger="synergrip"):
        assert isinstance(plan(problem.grasp, problem.task, hasty), Plan)
    told = [record.getMessage() for record in caplog.records]
    assert any("attempt 2 of 5" in message for message in told)
    assert any("asked again in the units Units(force=" in message for message in told)


@pytest.mark.parametrize("name", ["barrett-ball-carry", "barrett-ball-lift"])
def test_the_library_prints_nothing(name: str, capfd: pytest.CaptureFixture[str]) -> None:
    problem = load_problem(name)
    plan(problem.grasp, problem.task)
    assert capfd.readouterr() == ("", "")
    handlers = logging.getLogger("synergrip").handlers
    assert [type(each) for each in handlers if isinstance(each, logging.NullHandler)] == [logging.NullHandler]
