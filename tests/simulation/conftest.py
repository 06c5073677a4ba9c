"""A gripper that holds a box still, planned and played once for all tests."""

from __future__ import annotations

from pathlib import Path

import pytest

import synergrip

HELD = ("task.move=[]", "task.knots=21")


@pytest.fixture(scope="session")
def held(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a plan of a gripper that holds a box still."""
    folder = tmp_path_factory.mktemp("held")
    problem = synergrip.load_problem("gripper-box", overrides=list(HELD))
    answer = synergrip.plan(problem.grasp, problem.task)
    assert isinstance(answer, synergrip.Plan)
    answer.save(folder)
    return folder


@pytest.fixture(scope="session")
def played(held: Path) -> synergrip.Simulation:
    return synergrip.simulate(held)
