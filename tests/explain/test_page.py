"""The page of the fewest synergies: its figures are those of the bundled problems."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from synergrip import load_problem
from synergrip.explain.synergies.needed_points import Pointed
from synergrip.explain.synergies.subset_values import Looking
from synergrip.grasps.other_synergies import of_whole_set
from synergrip.problems.problem import Problem
from synergrip.reports.text.text_needed import HEADER, cells

PAGE = (Path(__file__).parent.parent.parent / "docs" / "synergies-needed.md").read_text(encoding="utf-8")
GLASS, BALL = re.findall(r"```console\n(.*?)\n```", PAGE, re.DOTALL)


def pointed(problem: Problem) -> Pointed:
    whole, origins = of_whole_set(problem.grasp)
    return Pointed(whole, replace(problem.timed.for_synergies(origins), linearise="once"), along=False)


@pytest.mark.parametrize(
    ("shown", "name", "sizes"), [(GLASS, "human-glass", (5, 6, 9)), (BALL, "human-ball", (11, 14))]
)
def test_rows_of_the_first_k_are_what_planning_says(shown: str, name: str, sizes: tuple[int, ...]) -> None:
    lines = shown.split("the first k\n")[1].splitlines()
    assert [each.strip() for each in re.split(r"  +", lines[0].strip())] == list(HEADER)
    some = pointed(load_problem(name))
    for size in sizes:
        assert re.split(r"  +", lines[size].strip()) == list(cells(some.at(range(size))))


def test_the_smallest_subsets_have_plans_and_lose_them_with_any_synergy() -> None:
    named = re.findall(r"^ {9}((?:pc\d+ ?){4})$", GLASS, re.MULTILINE)
    assert len(named) == 4
    some = pointed(load_problem("human-glass"))
    looking = Looking(some.grasp, some.task, "margin")
    for names in named:
        picks = [some.grasp.synergies.index(name) for name in names.split()]
        assert looking.at(picks).stage == ""
        assert {looking.at([at for at in picks if at != out]).stage for out in picks} == {"magnitude"}
