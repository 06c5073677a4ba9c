"""What came of a number of many tasks: a verified plan at one end, a proof at the other, and what nan stands for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synergrip.documents.naming import made_by
from synergrip.linalg import Array
from synergrip.values import Value

FOUND, ENDLESS, NONE, UNKNOWN, UNFINISHED = "found", "endless", "none", "unknown", "unfinished"
WORDS = (FOUND, ENDLESS, NONE, UNKNOWN, UNFINISHED)


@made_by("margins_many(grasp, task, of='load_factor')")
@dataclass(frozen=True, eq=False, repr=False)
class ManyMargins(Value):
    """A number of N tasks in the linear model at the start posture, in the order they were asked.

    Attributes:
        of: which number it is.
        value: (N,) the last value with a verified plan; nan where `ends` is not "found".
        lower: (N,) the number is between this
        upper: (N,) and this: one is `value`, the other is proven to have no plan.
        proven: (N,) whether they are no more than 1e-6 of the value apart.
        ends: (N,) "found", or why there is no number: "endless", "none", "unknown" or "unfinished".
        verdicts: (N,) of the tasks as they are, before anything is turned: "feasible", "infeasible" or "unknown".
        kernel: "numpy" or "numba": what solved the programs.

    Example:
        >>> loads, limits = [Gravity((0, 0, -9.81))], [NormalForce(upper=20.0)]
        >>> still = task.replace(knots=1, loads=loads, limits=limits, linearise="once")
        >>> found = margins_many(grasp, still, of="load_factor")
        >>> bool(found.proven.all()), bool((found.upper - found.lower <= 1e-6 * found.value).all())
        (True, True)
    """

    of: str
    value: Array
    """(N,) nan where no end was found, which `ends` says why; a value that was found before an interrupt is kept."""
    lower: Array  # (N,)
    upper: Array
    proven: NDArray[np.bool_]
    ends: NDArray[np.str_]
    """(N,) "found": between a verified plan and a proof. "endless": there are plans up to 16 million times what it is
    (down to a 16 millionth of the friction), as without a load. "none": proofs at all values tried, what it is and
    easier ones (to a 65,536th of load or mass, 256 times the friction). "unknown": at some value neither a plan nor
    a proof verified. "unfinished": somebody interrupted."""
    verdicts: NDArray[np.str_]
    """(N,) where "infeasible", `margins` has no numbers and answers so; here the number is looked for all the same: a
    load factor below 1, a friction scale above 1."""
    kernel: str = ""

    @property
    def finished(self) -> NDArray[np.bool_]:
        """(N,) False for tasks whose number was still looked for when somebody interrupted it."""
        return np.asarray(self.ends != UNFINISHED)

    @property
    def interrupted(self) -> bool:
        """Whether somebody stopped it before all numbers were known."""
        return not bool(self.finished.all())

    def __len__(self) -> int:
        """Return N."""
        return len(self.value)

    def __repr__(self) -> str:
        """Return what there is, its range, and how many have none."""
        found = self.value[np.isfinite(self.value)]
        span = f", from {found.min():.6g} to {found.max():.6g}" if found.size else ""
        counts = [f"{count} {word}" for word in WORDS[1:] if (count := int((self.ends == word).sum()))]
        rest = f"; {', '.join(counts)}" if counts else ""
        return f"ManyMargins({self.of} of {len(self)} tasks: {int(self.proven.sum())} proven{span}{rest})"
