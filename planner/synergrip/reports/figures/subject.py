"""What a figure is about: a problem, an answer at hand, or a saved one, which is not planned again."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from synergrip.errors import InputError, kind_of
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.held import Held
from synergrip.planning.answer import Answer
from synergrip.planning.outcome import Outcome, Plan
from synergrip.problems.problem import Problem, load_problem
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.data.saved_problem import problem_of
from synergrip.reports.html.saved_answer import read_answer, saved_file
from synergrip.tasks.timed_task import TimedTask

KEY = "SOURCE"


@dataclass(frozen=True, eq=False)
class Question:
    """What was asked."""

    title: str
    grasp: Grasp
    timed: TimedTask

    @property
    def held(self) -> Held | None:
        """Hand and object; None for a grasp given as matrices."""
        return self.grasp.held


@dataclass(frozen=True, eq=False)
class Subject:
    """What was asked, and what was answered, as far as they are at hand."""

    problem: Problem | None = None
    question: Question | None = None
    document: Mapping[str, Any] | None = None
    """Of the answer, as in plan.json."""
    folder: Path = Path()
    """Where the hand file of the answer is looked for when it is not a bundled one."""

    def asked(self) -> Question:
        """Return what was asked; of a saved answer, what it tells of its problem.

        Raises:
            InputError: a saved answer that was made in code, or whose problem cannot be read again.
        """
        return self.question or _of_provenance(self.document or {})

    def answered(self, plan: Callable[[Problem], Outcome]) -> Subject:
        """Return it with an answer, planned where there is none yet.

        Raises:
            InputError: a saved answer without a plan.
        """
        if self.document is None:
            assert self.problem is not None
            return answered(plan(self.problem), self.problem)
        if self.document["verdict"] != "feasible":
            message = f"its verdict is '{self.document['verdict']}', so that there is no plan to draw"
            raise InputError.at(KEY, f"{message}; `synergrip explain` says why")
        return self


def answered(outcome: Outcome, problem: Problem | None = None) -> Subject:
    """Return an answer, to be drawn with the title and the notes of its problem where this is known."""
    if not isinstance(outcome, Plan):
        raise InputError.at(KEY, f"there is no plan to draw: the verdict is '{outcome.verdict}': {outcome.why}")
    if problem is None:
        title, document = outcome.grasp.title, outcome_document(outcome.grasp.title, outcome.grasp, outcome)
    else:
        title = problem.title
        document = outcome_document(title, outcome.grasp, outcome, problem.notes, problem.source)
    return Subject(problem, Question(title, outcome.grasp, outcome.task), document)


def subject_of(source: object, overrides: Sequence[str] = ()) -> Subject:
    """Return what a figure is about.

    Args:
        source: a problem, its file or its bundled name; an answer, its folder or its plan.json.
        overrides: put over the file of a problem.

    Raises:
        InputError: none of these, overrides of an answer, a saved answer that was changed.
    """
    if isinstance(source, Problem):
        return _of_problem(source)
    if isinstance(source, Answer):
        return answered(source)  # type: ignore[arg-type]
    if not isinstance(source, str | Path):
        raise InputError.at(KEY, f"expected a problem, a plan, or the path of one, got {kind_of(source)}")
    file = saved_file(Path(source), KEY)
    if file is None:
        return _of_problem(load_problem(source, overrides))
    if overrides:
        raise InputError.at("--set", f"'{file}' is planned already; give the problem to change it")
    document, _ = read_answer(file)
    return Subject(document=document, folder=file.parent)


def _of_problem(problem: Problem) -> Subject:
    return Subject(problem, Question(problem.title, problem.grasp, problem.timed))


def _of_provenance(document: Mapping[str, Any]) -> Question:
    """Return what the problem in an answer asks."""
    found = problem_of(document, KEY)
    return Question(found.title, found.grasp, found.timed)
