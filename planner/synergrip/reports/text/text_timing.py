"""The fastest timing along the path of a palm as text, and how to plan it so."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from shlex import quote

from synergrip.documents.quantities import plain
from synergrip.margin.timing.fastest_timing import FastestTiming
from synergrip.problems.problem import Problem
from synergrip.reports.text.tables import wrapped


def timing_lines(problem: Problem, found: FastestTiming, written: Path | None) -> Iterator[str]:
    """Yield how fast the path of the palm can be gone, and the options that plan it so; `written` is its file."""
    first = how_fast(found)[0]
    if found.value is None:
        yield from wrapped("         ", first)
        return
    yield first
    yield from wrapped("         ", found.why)
    if written is None:
        yield "         -o DIR writes it as the path of the palm"
        return
    task, sets = problem.task, [f'task.palm={{path="{written.resolve()}",inertia=true}}']
    if getattr(task, "duration", None) is not None:
        sets.append(f'task.duration="{found.value!r} s"')
    if getattr(task, "knots", None) is not None and found.path is not None:
        sets.append(f"task.knots={len(found.path.times)}")
    yield f"wrote    {written}"
    yield f"with     {' '.join(f'--set {quote(each)}' for each in sets)}"


def how_fast(found: FastestTiming) -> tuple[str, ...]:
    """Return how fast the path of the palm can be gone and what is proven of it, or why that is not known."""
    if found.value is None:
        return (f"fastest timing: {found.why}",)
    below = "" if found.lower is None else f", not below {plain(found.lower, 5)} s"
    instead = f"instead of {plain(found.given_s, 5)} s{below}"
    return f"Fastest timing along the path of the palm: {plain(found.value, 5)} s {instead}", found.why
