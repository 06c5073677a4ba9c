"""Rows of many plans, filled in chunk by chunk: what verified of the batch, and the others as `plan` answers them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synergrip.batch.asked import Asked
from synergrip.batch.clashing import NAMES
from synergrip.batch.decided import Decided
from synergrip.batch.many_plans import FEASIBLE, INFEASIBLE, OF_HAND, UNKNOWN, ManyPlans
from synergrip.conic.limits.friction_cone import FRICTION
from synergrip.errors import InputError, RigidContactError, SelfCheckError
from synergrip.grasps.stack import GraspStack
from synergrip.log import LOG
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan_of_start_posture

Answers = tuple[NDArray[np.intp], Decided, NDArray[np.bool_]]
"""Where among the places of a chunk tasks stand, what verified of them, and whose maps are known well enough."""


class Unfinished:
    """Arrays that are filled chunk by chunk."""

    def __init__(self, question: Asked) -> None:
        """Make them with nothing in them."""
        count, like = question.count, question.like
        self.question = question
        self.verdicts: NDArray[np.str_] = np.full(count, UNKNOWN, dtype="<U10")
        self.clashes: NDArray[np.str_] = np.full(count, "", dtype=NAMES)
        self.flags = {name: np.zeros(count, dtype=bool) for name in ("verified", "one_by_one", "finished")}
        shapes: dict[str, tuple[int, ...]] = {
            "largest_margin": (count,), "margins": (count, like.n_c), "forces": (count, like.n_l),
            "dz_r": (count, like.n_z),
        }  # fmt: skip
        self.numbers = {name: np.full(shape, np.nan) for name, shape in shapes.items()}
        self.refusals: dict[int, InputError | SelfCheckError] = {}

    @property
    def finished(self) -> int:
        """How many rows are."""
        return int(self.flags["finished"].sum())

    def keep(self, places: NDArray[np.intp], answers: Sequence[Answers], hear: Callable[[], None]) -> None:
        """Fill in the answers of a chunk, and plan one by one what has none.

        Args:
            places: of the tasks of the chunk.
            answers: what verified of them.
            hear: called after each that is planned by itself.

        Raises:
            InputError: what is wrong with every task.
            KeyboardInterrupt: somebody interrupted; rows are kept that were finished before.
        """
        open_ = np.ones(len(places), dtype=bool)
        for within, each, known in answers:
            right = known & (each.feasible | each.infeasible)
            self._fill(places[within[right]], each, right)
            open_[within] = ~right
        alone = not open_.all()  # what is wrong with every task is raised
        for place in places[open_].tolist():
            self._one_by_one(place, refusing=alone)
            self.flags["finished"][place] = True
            alone |= place in self.refusals or bool(self.flags["verified"][place])
            hear()

    def _fill(self, places: NDArray[np.intp], answers: Decided, right: NDArray[np.bool_]) -> None:
        self.verdicts[places] = np.where(answers.feasible[right], FEASIBLE, INFEASIBLE)
        self.clashes[places] = answers.clashes[right]
        for name, values in self.numbers.items():
            values[places] = getattr(answers, name)[right]
        self.flags["verified"][places] = True
        self.flags["finished"][places] = True

    def _one_by_one(self, place: int, *, refusing: bool) -> None:
        """Let `plan` answer a task: the same model, one program at a time; `refusing`, what it raises is kept."""
        question = self.question
        self.flags["one_by_one"][place] = True
        try:
            outcome: Any = plan_of_start_posture(question.grasp_at(place), question.task_at(place))
        except InputError as error:
            rigid = isinstance(error, RigidContactError) and isinstance(question.grasp, GraspStack)
            if not (refusing or rigid):
                raise
            self.refusals[place] = error
            return
        except SelfCheckError as error:  # of one task: the others keep their answers
            LOG.warning("task %d: %s", place, error)
            self.refusals[place] = error
            return
        if isinstance(outcome, Plan) and outcome.interrupted:
            raise KeyboardInterrupt
        self.verdicts[place] = outcome.verdict
        self.flags["verified"][place] = not isinstance(outcome, Plan) or outcome.decisions[-1].optimal
        self.flags["verified"][place] &= isinstance(outcome, Plan | Infeasible)
        if isinstance(outcome, Plan | Infeasible) and outcome.largest_margin is not None:
            self.numbers["largest_margin"][place] = outcome.largest_margin
        if isinstance(outcome, Infeasible):
            self.clashes[place] = _clash(outcome)
        if isinstance(outcome, Plan):
            for name in ("margins", "forces", "dz_r"):
                self.numbers[name][place] = getattr(outcome, name)[0]

    def told(self, kernel: str) -> ManyPlans:
        """Return what is known of the tasks that are finished."""
        left = ~self.flags["finished"]
        self.verdicts[left], self.clashes[left] = UNKNOWN, ""
        for each in (self.flags["verified"], self.flags["one_by_one"]):
            each[left] = False
        for values in self.numbers.values():
            values[left] = np.nan
        for each in (self.verdicts, self.clashes, *self.flags.values(), *self.numbers.values()):
            each.setflags(write=False)
        arrays: dict[str, Any] = {**self.flags, **self.numbers, "verdicts": self.verdicts, "clashes": self.clashes}
        question = self.question
        notes = (*question.notes, OF_HAND) if question.like.held is not None else question.notes
        return ManyPlans(**arrays, refusals=self.refusals, notes=notes, kernel=kernel, question=question)


def _clash(no: Infeasible) -> str:
    """Return the limit that a proof rests on most beside friction; the stage of one that is of no limits."""
    if not no.conflicts:
        return no.stage
    others = (each for each in no.conflicts if not each.friction)
    return next((each.key for each in others), FRICTION)
