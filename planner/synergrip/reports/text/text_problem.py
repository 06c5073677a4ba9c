"""The first lines of every answer: what was read, and what is asked; and how it is asked again."""

from __future__ import annotations

from collections.abc import Iterator
from shlex import quote

from synergrip.problems.finding import is_bundled
from synergrip.problems.in_short import asked_in_short, read_in_short
from synergrip.problems.problem import Problem


def problem_lines(problem: Problem) -> Iterator[str]:
    """Yield the lines ``read`` and ``task``."""
    yield "read     " + " · ".join(read_in_short(problem.grasp))
    yield "task     " + " · ".join(asked_in_short(problem.timed))


def command_of(verb: str, problem: Problem) -> str:
    """Return the command that is about the same problem, as it can be pasted into a shell."""
    name = problem.name if is_bundled(problem.path) else str(problem.path)
    changes = "".join(f" --set {quote(each.text)}" for each in problem.document.overrides)
    return f"synergrip {verb} {quote(name)}{changes}"
