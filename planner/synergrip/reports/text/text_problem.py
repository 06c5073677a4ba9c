"""The first lines of every answer: what was read, and what is asked."""

from __future__ import annotations

from collections.abc import Iterator

from synergrip.problems.in_short import asked_in_short, read_in_short
from synergrip.problems.problem import Problem


def problem_lines(problem: Problem) -> Iterator[str]:
    """Yield the lines ``read`` and ``task``."""
    yield "read     " + " · ".join(read_in_short(problem.grasp))
    yield "task     " + " · ".join(asked_in_short(problem.timed))
