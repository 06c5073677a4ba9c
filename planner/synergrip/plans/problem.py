"""A planning problem: the file made into a grasp and a task, with the place of every value at hand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from synergrip.documents import Document
from synergrip.errors import InputError, SynergripError, one_of
from synergrip.files import bundled
from synergrip.grasps.given import given
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.matrices import read_matrices
from synergrip.grasps.objects import Object
from synergrip.linalg import frozen
from synergrip.plans.limits_table import HandLimits, limits_of
from synergrip.plans.loads import loads
from synergrip.plans.problem_file import ProblemFile, read_problem_file
from synergrip.plans.task import Task


@dataclass(frozen=True)
class Problem:
    """A problem ready to be analysed or planned."""

    name: str
    path: Path
    file: ProblemFile
    document: Document
    grasp: Grasp
    task: Task
    hand_title: str
    """Title of the hand; empty for a grasp given as matrices."""
    thing: Object | None
    """The grasped object, where it is; None for a grasp given as matrices."""

    @property
    def title(self) -> str:
        """Title of the problem, or its name."""
        return self.file.title or self.name


def bundled_problems() -> tuple[str, ...]:
    """Return the names of the problems that ship with the package."""
    return tuple(sorted(path.stem for path in bundled("problems").glob("*.toml")))


def find_problem(name_or_path: str) -> Path:
    """Return the file of a problem.

    Raises:
        InputError: there is neither such a file nor a bundled problem of that name.
    """
    path = Path(name_or_path)
    if path.suffix or path.exists():
        return path
    inside = bundled("problems") / f"{name_or_path}.toml"
    if not inside.is_file():
        raise InputError.at(
            "PROBLEM", f"no such file, and no such bundled problem: {one_of(name_or_path, bundled_problems())}"
        )
    return inside


def load_problem(name_or_path: str | Path, overrides: Sequence[str] = ()) -> Problem:
    """Read a problem, with ``KEY=VALUE`` texts put over the file.

    Args:
        name_or_path: path of a problem file, or the name of a bundled one.
        overrides: such as ``limits.margin=0.3 N``.

    Raises:
        InputError: everything that is wrong with the file, each with its place.
    """
    path = find_problem(str(name_or_path))
    file, document = read_problem_file(path, overrides)
    try:
        return _problem(path, file, document)
    except InputError as error:
        raise error.located(document.locate) from None


def _problem(path: Path, file: ProblemFile, document: Document) -> Problem:
    mass = (file.object.mass or 0.0) if file.object else 0.0
    hand_limits = HandLimits()
    hand_title, thing = "", None
    if file.grasp is not None:
        grasp = given(read_matrices(path.parent / file.grasp.file, "grasp.file"))
    else:
        from synergrip.plans.setup import hand_grasp

        grasp, thing, hand_title, hand_limits = hand_grasp(file, path.parent)
    happening = loads(file.task, path.parent, mass)
    wrench = happening.wrench
    if file.grasp is None and wrench is not None:
        grasp = replace(grasp, w_0=frozen(wrench[0]))  # the grasp holds its load when the task begins
    if wrench is None:
        wrench = frozen(np.tile(grasp.w_0, (len(happening.times), 1)))
    task = Task(
        happening.times, wrench, happening.wanted, file.limits.margin,
        limits_of(file, grasp, hand_limits), file.goal.name, file.task.tolerance or 0.0,
    )  # fmt: skip
    _supported(file)
    return Problem(path.stem, path, file, document, grasp, task, hand_title, thing)


def _supported(file: ProblemFile) -> None:
    if file.task.tracking == "compliant":
        message = "compliant tracking is not there yet; use tracking = \"rigid\""  # fmt: skip
        raise InputError.at("task.tracking", message)


def located(problem: Problem, error: SynergripError) -> SynergripError:
    """Return an error of planning with its place in the problem file, when it has a key there."""
    if not isinstance(error, InputError):
        return error
    return error.located(lambda issue: issue if issue.key.isupper() else problem.document.locate(issue))
