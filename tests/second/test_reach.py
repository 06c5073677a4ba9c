"""The search for postures finds what hands do, and nothing that they cannot do."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from second.reach import APART, BEYOND, Search
from second.tree import read_tree

from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem
from synergrip.reports.data.execution import execution_document

REPOSITORY = Path(__file__).parent.parent.parent


@cache
def moved(name: str) -> tuple[Plan, Search]:
    problem = load_problem(name)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    block = execution_document(answer)
    assert block is not None
    tree = read_tree(REPOSITORY / block["hand_file"], block["root_link"], block["joints"])
    return answer, Search(block, tree)


@pytest.mark.parametrize("name", ["dlr-ball-turn", "barrett-ball-far"])
def test_what_a_plan_reaches_is_found(name: str) -> None:
    answer, search = moved(name)
    assert answer.executed is not None
    found = search.to(answer.executed.du[-1], starts=3)
    assert found.reached
    assert found.apart < APART
    assert found.beyond <= BEYOND


def test_what_no_hand_reaches_is_not_found() -> None:
    _, search = moved("barrett-ball-far")
    found = search.to(np.array([0, 0, 0.5, 0, 0, 0]), starts=3)
    assert not found.reached
    assert found.apart > 0.1


def test_what_only_joints_beyond_their_ranges_reach_is_not_found() -> None:
    """The outer joints of the Barrett hand would have to bend backward."""
    _, search = moved("barrett-ball-far")
    pose = np.array([0, -0.025, 0, np.radians(12.5), 0, 0])
    assert not search.to(pose, starts=3).reached
    free = Search.__new__(Search)
    free.fixed, free.rolling = search.fixed, search.rolling
    free.lower, free.upper = np.full_like(search.lower, -np.inf), np.full_like(search.upper, np.inf)
    assert free.to(pose, starts=3).reached
