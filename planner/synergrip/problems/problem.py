"""A planning problem: the file made into a grasp and a task, with the place of every value at hand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from synergrip.conic.goals.registry import GOALS
from synergrip.documents.documents import Document, read_document
from synergrip.documents.gathering import gathered
from synergrip.documents.naming import made_by, naming_arguments
from synergrip.documents.source import Source
from synergrip.documents.validation import shown
from synergrip.errors import InputError, Issue, RigidContactError, SynergripError
from synergrip.grasps.chosen_tangents import tangent_notes
from synergrip.grasps.contacts.kind import STIFFNESS_OF
from synergrip.grasps.facing import frame_notes
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.objects import Object
from synergrip.grasps.straight_fingers import straight_notes
from synergrip.linalg import frozen
from synergrip.problems.contact_factors import with_factors
from synergrip.problems.doubts import doubts_of, spot_notes
from synergrip.problems.finding import find_problem
from synergrip.problems.limits_table import limits_of
from synergrip.problems.loads import Keys, stated_at, task_of
from synergrip.problems.problem_file import ProblemFile, parsed, read_problem_file
from synergrip.problems.problem_table import problem_html
from synergrip.problems.problem_values import document_of
from synergrip.statics.unbalanced_springs import unbalanced_notes
from synergrip.tasks.plausible import task_doubts
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.timing import at_start, happening
from synergrip.tasks.unbounded import MAXIMISED
from synergrip.values import Value

if TYPE_CHECKING:
    from synergrip.grasps.held import Held


@made_by("load_problem(name_or_path)")
@dataclass(frozen=True, eq=False, repr=False)
class Problem(Value):
    """A problem ready to be analysed or planned.

    Example:
        >>> problem = load_problem("tripod")
        >>> problem.grasp.n_l, len(problem.timed.times)
        (9, 11)
    """

    name: str
    path: Path
    file: ProblemFile
    document: Document
    grasp: Grasp
    """As it is when the task begins: a hand holds the load of the first instant."""
    task: Task
    """What is asked, for any grasp."""
    timed: TimedTask
    """The same at its knots, for this grasp."""
    keys: Keys
    notes: tuple[str, ...] = ()
    """What is doubtful about grasp and task, though it is no error."""

    @property
    def held(self) -> Held | None:
        """The hand, its synergies and posture, and the object; None for a grasp given as matrices."""
        return self.grasp.held

    @property
    def title(self) -> str:
        """Title of the problem, or its name."""
        return self.file.title or self.name

    @property
    def source(self) -> Source:
        """Its text as it was read, or the dict it was made of, and what was put over it."""
        document = self.document
        return Source(self.name, document.text or document.data, tuple(each.text for each in document.overrides))

    def _repr_html_(self) -> str:
        """Return a table for notebooks: grasp, contacts, task and limits."""
        return problem_html(self)


@naming_arguments
def load_problem(problem: str | Path | Mapping[str, Any], overrides: str | Sequence[str] = ()) -> Problem:
    """Read a problem, with ``KEY=VALUE`` texts put over the file.

    Args:
        problem: path of a problem file or of a grasp given as matrices, the name of a bundled problem, or a dict of
            the same structure, whose files are looked for in the current folder.
        overrides: one or more texts such as ``limits.margin=0.3 N``.

    Raises:
        InputError: everything that is wrong with the file, each with its place.

    Example:
        >>> load_problem("barrett-ball-hold", "limits.margin=1 N").timed.margin
        1.0
    """
    texts = (overrides,) if isinstance(overrides, str) else overrides
    if not isinstance(texts, Sequence) or not all(isinstance(text, str) for text in texts):
        raise InputError.at("overrides", f'expected texts such as "limits.margin=0.3 N", got {shown(overrides)}')
    if isinstance(problem, Mapping):
        document = document_of(problem).with_overrides(texts)
        return _problem(document.data.get("title") or "problem", document.path, parsed(document), document)
    if not isinstance(problem, str | Path):
        raise InputError.at("problem", f"expected a name, a path or a dict, got {shown(problem)}")
    path = find_problem(str(problem))
    return _problem(path.stem, path, *_read(path, texts))


def _problem(name: str, path: Path, file: ProblemFile, document: Document) -> Problem:
    """Return the problem that a file states, or everything that is wrong with it."""
    issues: list[Issue] = []
    touching = gathered(issues, lambda: _touching(path, file))
    asked = gathered(issues, lambda: _asked(file, path.parent, touching))
    if touching is None or asked is None or issues:
        if touching is not None:
            gathered(issues, lambda: limits_of(file, touching.grasp))
        raise InputError([document.locate(issue) for issue in issues])
    task, keys = asked
    try:
        allow = None if file.allow is None else file.allow.value()
        task = task.replace(
            limits=limits_of(file, touching.grasp), goals=file.goal.goals, allow=allow, tie_break=file.goal.tie_break
        )
        timed = task.timed(touching.grasp)
    except InputError as error:
        raise stated_at(error, keys).located(document.locate) from None
    grasp = at_start(touching.grasp, timed.wrench[0])
    asked_for = [stated_at(InputError([each]), keys).issues[0] for each in task_doubts(task, timed, grasp)]
    doubts = [str(document.locate(each)) for each in (*touching.doubts, *asked_for)]
    return Problem(name, path, file, document, grasp, task, timed, keys, (*touching.notes, *doubts))


def _asked(file: ProblemFile, folder: Path, touching: _Touching | None) -> tuple[Task, Keys]:
    """Return the task, judged on its object; without a grasp on a bare mass, so that all that is wrong is told."""
    task, keys = task_of(file.task, folder)
    body = touching.grasp.held.body if touching is not None and touching.grasp.held is not None else None
    if body is None and file.object is not None:
        body = Object(mass=file.object.mass or 0.0, position=frozen(np.zeros(3)))
    try:
        happening(task, body)
    except InputError as error:
        raise stated_at(error, keys) from None
    return task, keys


@dataclass(frozen=True)
class _Touching:
    """What touches what."""

    grasp: Grasp
    notes: tuple[str, ...]
    doubts: tuple[Issue, ...]


def _read(path: Path, overrides: Sequence[str]) -> tuple[ProblemFile, Document]:
    """Read a problem file; a bare grasp file stands for the problem of holding it."""
    if path.suffix == ".json":
        document = read_document(path, "problem file", numbers=True)
        if {"G", "J", "S"} & document.data.keys():
            bare = Document(path, {"schema": 1, "grasp": {"file": path.name}}).with_overrides(overrides)
            return parsed(bare), bare
    return read_problem_file(path, overrides)


def _touching(path: Path, file: ProblemFile) -> _Touching:
    if file.grasp is not None:
        from synergrip.grasps.given import read_given

        matrices = path.parent / file.grasp.file
        grasp = with_factors(read_given(matrices, "grasp.file"), file.grasp, "grasp")
        return _Touching(grasp, (*spot_notes(matrices), *frame_notes(grasp)), doubts_of(grasp, file, path.parent))
    from synergrip.problems.holding import hand_grasp

    grasp = with_factors(hand_grasp(file, path.parent), file.contacts, "contacts")
    notes = grasp.held.notes if grasp.held else ()
    notes = (*unbalanced_notes(grasp), *notes, *frame_notes(grasp), *tangent_notes(grasp), *straight_notes(grasp))
    return _Touching(grasp, notes, doubts_of(grasp, file, path.parent))


def located(problem: Problem, error: SynergripError) -> SynergripError:
    """Return an error of planning with its place in the file that holds its key."""
    if not isinstance(error, InputError):
        return error
    if isinstance(error, RigidContactError):
        return _rigid_located(problem, error)
    goal = problem.file.goal
    largest = next((name for name in goal.names if GOALS[name].maximises), None)
    asked = {MAXIMISED: f"goal.{goal.key_of(largest)}" if largest else MAXIMISED}

    def place(issue: Issue) -> Issue:
        return (
            issue
            if issue.key.isupper()
            else problem.document.locate(replace(issue, key=asked.get(issue.key, issue.key)))
        )

    return stated_at(error, problem.keys).located(place)


def _rigid_located(problem: Problem, error: RigidContactError) -> RigidContactError:
    """Return the error at the compliance of the grasp file, or at the stiffness of the problem file."""
    if problem.file.grasp is not None:
        return error.located(read_document(problem.path.parent / problem.file.grasp.file, numbers=True).locate)
    key = _stiffness_key(problem.file, error)
    return error.located(lambda issue: problem.document.locate(replace(issue, key=key)))


def _stiffness_key(file: ProblemFile, error: RigidContactError) -> str:
    """Return the key that says how stiff the contact is in the direction of the error."""
    names = (STIFFNESS_OF.get(error.component, "stiffness"), "stiffness")
    entries = [(f"contact[{i}]", entry) for i, entry in enumerate(file.contact)
               if error.contact == (entry.name or entry.at or entry.link)]  # fmt: skip
    for name in names:
        for table, values in [*entries, ("contacts", file.contacts)]:
            if getattr(values, name, None) is not None:
                return f"{table}.{name}"
    return "contacts.stiffness"
