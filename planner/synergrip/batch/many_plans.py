"""What came of many tasks: arrays with a leading axis, one row for each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synergrip.documents.naming import made_by
from synergrip.errors import InputError, SelfCheckError
from synergrip.linalg import Array
from synergrip.values import Value

FEASIBLE, INFEASIBLE, UNKNOWN = "feasible", "infeasible", "unknown"


@made_by("plan_many(grasp, task, wrenches=...)")
@dataclass(frozen=True, eq=False, repr=False)
class ManyPlans(Value):
    """Verified answers to N tasks of one knot in the linear model at the start posture, in the order they were asked.

    Rows of tasks that have no plan are nan.

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
    """(N,) False for tasks of the chunks that were not through when somebody interrupted it."""
    refusals: Mapping[int, InputError | SelfCheckError]
    """What `plan` raises for single tasks, by their place (a contact direction is rigid; nothing bounds the goal; a
    plan fails its own check): they are "unknown" here."""
    notes: tuple[str, ...] = ()
    """What of what was asked can hardly be meant."""

    @property
    def worst_margin(self) -> Array:
        """(N,) the smallest slip margin of each plan [N]."""
        return np.asarray(self.margins.min(axis=1))

    @property
    def interrupted(self) -> bool:
        """Whether somebody stopped it before all tasks were through."""
        return not bool(self.finished.all())

    def __len__(self) -> int:
        """Return N."""
        return len(self.verdicts)

    def __repr__(self) -> str:
        """Return how many there are of each verdict."""
        counts = ", ".join(
            f"{int((self.verdicts == each).sum())} {each}" for each in (FEASIBLE, INFEASIBLE, UNKNOWN)
        )  # fmt: skip
        rest = f"; interrupted after {int(self.finished.sum())}" if self.interrupted else ""
        noted = f"; note: {self.notes[0]}" if self.notes else ""
        return f"ManyPlans({len(self)} tasks: {counts}; {int(self.one_by_one.sum())} planned one by one{rest}{noted})"


class Unfinished:
    """Arrays that are filled chunk by chunk."""

    def __init__(self, count: int, n_c: int, n_l: int, n_z: int) -> None:
        """Make them with nothing in them."""
        self.verdicts: NDArray[np.str_] = np.full(count, UNKNOWN, dtype="<U10")
        self.flags = {name: np.zeros(count, dtype=bool) for name in ("verified", "one_by_one", "finished")}
        shapes: dict[str, tuple[int, ...]] = {
            "largest_margin": (count,), "margins": (count, n_c), "forces": (count, n_l), "dz_r": (count, n_z),
        }  # fmt: skip
        self.numbers = {name: np.full(shape, np.nan) for name, shape in shapes.items()}
        self.refusals: dict[int, InputError | SelfCheckError] = {}

    def told(self) -> ManyPlans:
        """Return what is known of the tasks that are finished."""
        left = ~self.flags["finished"]
        self.verdicts[left] = UNKNOWN
        for each in (self.flags["verified"], self.flags["one_by_one"]):
            each[left] = False
        for values in self.numbers.values():
            values[left] = np.nan
        for each in (self.verdicts, *self.flags.values(), *self.numbers.values()):
            each.setflags(write=False)
        arrays: dict[str, Any] = {**self.flags, **self.numbers}
        return ManyPlans(verdicts=self.verdicts, refusals=self.refusals, **arrays)
