"""The problem that a verb is about, with the object put where it is held best when the file leaves that open."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from synergrip.errors import InputError
    from synergrip.grasps.grasp import Grasp
    from synergrip.linalg import Array
    from synergrip.planning.outcome import Outcome
    from synergrip.problems.problem import Problem
    from synergrip.tasks.task import Task

WRITTEN = "written under [object] it is not looked for again"


def load_placed(name: str, overrides: Sequence[str] | None) -> Problem:
    """Return a problem; where ``object.position = "auto"`` the place is looked for, and told as it would be written.

    Raises:
        InputError: everything that is wrong with the file; no place at which all contacts touch.
    """
    return load_planned(name, overrides)[0]


def load_planned(name: str, overrides: Sequence[str] | None) -> tuple[Problem, Outcome | None]:
    """Return the same, and what `plan` says of it where a place was looked for, as planning there is part of that.

    Raises:
        InputError: as of `load_placed`.
    """
    from synergrip.errors import InputError
    from synergrip.problems.problem import load_problem

    given = list(overrides or [])
    try:
        return load_problem(name, given), None
    except InputError as error:
        if not is_unplaced(error):
            raise
    return _placed(name, given)


def is_unplaced(error: InputError) -> bool:
    """Tell whether a problem is refused because its object is still to be placed."""
    from synergrip.problems.holding import UNPLACED

    return any(issue.message == UNPLACED for issue in error.issues)


def _placed(name: str, given: list[str]) -> tuple[Problem, Outcome | None]:
    from synergrip.batch.best_place import best_place
    from synergrip.batch.placed_object import found_override
    from synergrip.cli.beside import aside
    from synergrip.cli.progress import shares
    from synergrip.documents.quantities import in_mm
    from synergrip.errors import InputError
    from synergrip.grasps.clearance import FAR_INSIDE
    from synergrip.planning.outcome import Plan
    from synergrip.problems.problem import load_problem
    from synergrip.problems.unplaced import unplaced_problem

    def put(position: Array) -> Problem:
        return load_problem(name, [*given, found_override(position)])

    def made(position: Array) -> tuple[Grasp, Task]:
        there = put(position)
        return there.grasp, there.task

    problem = unplaced_problem(name, given)
    try:
        found = best_place(problem.asked, made, shares())
    except InputError as error:
        raise problem.located(error) from None
    holds = "a plan holds there; " if isinstance(found.outcome, Plan) else ""
    if found.inside > FAR_INSIDE:
        deep = f"links of the hand run up to {in_mm(found.inside)} deep through the object"
        holds = f"a plan holds there, but {deep}: without that none was found; " if holds else f"{deep}; "
    margin = f"slip margin up to {found.margin:.3g} N at the start posture; " if found.margin > 0 else ""
    touching = f"all contacts touch at {found.touching} of {found.tried} places"
    aside(f"placed   {found.line}  ({holds}{margin}{touching}; {WRITTEN})")
    for note in found.notes:
        aside(f"note     {note}")
    return put(found.position), found.outcome
