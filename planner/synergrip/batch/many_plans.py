"""What came of many tasks: arrays with a leading axis, one row for each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from synergrip.documents.naming import made_by
from synergrip.documents.places import place_of
from synergrip.errors import InputError, SelfCheckError
from synergrip.linalg import Array
from synergrip.values import Value

if TYPE_CHECKING:
    from synergrip.batch.asked import Asked
    from synergrip.planning.outcome import Outcome

FEASIBLE, INFEASIBLE, UNKNOWN = "feasible", "infeasible", "unknown"
OF_HAND = (
    "of a hand these are answers of the linear model at the start posture; plan(...), which many.plan(i) asks, "
    "executes its plan on the hand that moves, too, and may answer 'unknown' where the limits are not kept there"
)
"""What `plan` does of a hand and many plans do not."""


@made_by("plan_many(grasp, task, wrenches=...)")
@dataclass(frozen=True, eq=False, repr=False)
class ManyPlans(Value):
    """Verified answers to N tasks of one knot in the linear model at the start posture, in the order they were asked.

    Rows of numbers are nan where a task has no plan: infeasible, unknown, refused, or not finished (`finished`).

    Attributes:
        verdicts: (N,) "feasible", "infeasible" or "unknown".
        verified: (N,) whether it is proven: the plan is the best one, or there is none.
        largest_margin: (N,) [N] that all contacts can keep, where it was looked for.
        margins: (N, n_c) [N] slip margins of the plan; `worst_margin` (N,) is the smallest of them.
        forces: (N, n_l) [N, N m] of the hand on the object.
        dz_r: (N, n_z) synergy references: what to send.
        one_by_one: (N,) whether `plan` answered instead of the batch.
        finished: (N,) False for what was left when somebody interrupted it; `interrupted` says whether anything was.
        refusals: errors of single tasks, by their place.
        clashes: (N,) which limit clashes most where there is no plan; `plan(i)` says all of it.
        notes: what of what was asked can hardly be meant, and what was left out.
        kernel: "numpy" or "numba": what solved the programs.

    Example:
        >>> loads, limits = [Gravity((0, 0, -9.81))], [NormalForce(upper=20.0)]
        >>> still = task.replace(knots=1, loads=loads, limits=limits, linearise="once")
        >>> many = plan_many(grasp, still, masses=[0.1, 0.2, 10.0])
        >>> many.verdicts.tolist(), many.forces.shape
        (['feasible', 'feasible', 'infeasible'], (3, 9))
    """

    verdicts: NDArray[np.str_]
    """(N,) "feasible", "infeasible" or "unknown" of the linear model; `plan` of a hand executes its answer, too."""
    verified: NDArray[np.bool_]
    """(N,) True where the plan holds and is the best, or where it is proven that there is none."""
    largest_margin: Array
    """(N,) [N] the largest margin that all contacts can keep: for that goal, and in general where it falls short (below
    0 contacts are taken to pull); else nan."""
    margins: Array  # (N, n_c) slip margins of the plan [N]
    forces: Array  # (N, n_l) contact forces of the hand on the object [N, N m]
    dz_r: Array  # (N, n_z) synergy references
    one_by_one: NDArray[np.bool_]
    """(N,) True where nothing verified of the batch and `plan` answered instead."""
    finished: NDArray[np.bool_]
    """(N,) False for tasks that were not through when somebody interrupted it."""
    refusals: Mapping[int, InputError | SelfCheckError]
    """What `plan` raises for single tasks, by their place (a contact direction is rigid; nothing bounds the goal; a
    plan fails its own check): they are "unknown" here."""
    clashes: NDArray[np.str_]
    """(N,) of what is infeasible the key of the limit that its proof rests on most beside friction, such as
    "limits.normal_force"; "friction cone" where it rests on friction alone, the stage ("restraint") where no program
    was needed. Empty for all others."""
    notes: tuple[str, ...] = ()
    """What of what was asked can hardly be meant, and, of a hand, what is not looked at here."""
    kernel: str = ""
    """"numpy" or "numba": what solved the programs; why that one, the logger tells."""
    question: Asked | None = None
    """What was asked."""

    @property
    def worst_margin(self) -> Array:
        """(N,) the smallest slip margin of each plan [N]."""
        return np.asarray(self.margins.min(axis=1))

    @property
    def interrupted(self) -> bool:
        """Whether somebody stopped it before all tasks were through."""
        return not bool(self.finished.all())

    def plan(self, place: int) -> Outcome:
        """Return what `plan` says of one of the tasks: all of its figures, or why there is no plan and what would help.

        On a hand it executes its plan on the hand that moves, too, and may answer "unknown" where the linear model of
        the start posture, which is all that counts here, has a plan.

        Args:
            place: of the task, from 0; from the end where it is below 0.

        Raises:
            InputError: there is no such task; what `plan` refuses.

        Example:
            >>> many.plan(2).why  # doctest: +SKIP
            'as long as limits.normal_force (finger2/tip) holds some contact slips: ...'
        """
        from synergrip.planning.planning import plan

        assert self.question is not None
        i = place_of("place", place, len(self))
        return plan(self.question.grasp_at(i), self.question.task_at(i))

    def __len__(self) -> int:
        """Return N."""
        return len(self.verdicts)

    def __repr__(self) -> str:
        """Return how many there are of each verdict."""
        counts = ", ".join(
            f"{int((self.verdicts == each).sum())} {each}" for each in (FEASIBLE, INFEASIBLE, UNKNOWN)
        )  # fmt: skip
        rest = f"; interrupted after {int(self.finished.sum())}" if self.interrupted else ""
        doubts = [note for note in self.notes if note != OF_HAND]
        noted = f"; note: {doubts[0]}" if doubts else ""
        return f"ManyPlans({len(self)} tasks: {counts}; {int(self.one_by_one.sum())} planned one by one{rest}{noted})"
