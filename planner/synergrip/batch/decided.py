"""From stated tasks to verified answers: largest margin first, so that what is infeasible ends in a proof."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synergrip.batch import verifier
from synergrip.batch.assembly import Assembled, assembled
from synergrip.batch.clashing import NAMES, clashes
from synergrip.batch.cone_problems import ConeProblems, ConeSolutions, Status, Tolerance
from synergrip.batch.physical import Physical, judged
from synergrip.batch.stated import Stated
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.linalg import Array
from synergrip.values import Value

OF_MARGIN = Tolerance(5e-9, 2e-9)
"""To which the largest margin is found: sharper than it is verified, by what the projection on the dual cones costs."""
OF_EFFORT = (Tolerance(1e-8, 1e-11), Tolerance(1e-8, 2e-9))
"""To which the least effort is found: forces are known to the root of the gap; and where rounding leaves less."""
ENOUGH = 1e-3
"""By how much of its unit a margin must exceed the one that is asked for, for a task to count as feasible at once."""
AT_LEAST = 1e-8
"""By how much of its unit a margin may be missed."""
Solver = Callable[[ConeProblems, Tolerance, Array], ConeSolutions]


@dataclass(frozen=True, eq=False, repr=False)
class Decided(Value):
    """What verified of N tasks; what is neither feasible nor infeasible is for somebody else."""

    feasible: NDArray[np.bool_]
    largest_margin: Array  # (N,) [N]; nan where it was not looked for, or did not verify
    dz_r: Array  # (N, n_z), nan where there is no plan
    forces: Array  # (N, n_l)
    margins: Array  # (N, n_c)
    clashes: NDArray[np.str_]
    """(N,) the key of the limit that clashes most beside friction where there is proven to be no plan; else empty."""

    @property
    def infeasible(self) -> NDArray[np.bool_]:
        """(N,) whether it is proven that there is no plan."""
        return np.asarray(self.clashes != "")


def decided(stated: Stated, wrench: Array, solver: Solver) -> Decided:
    """Return what verifies of stated tasks.

    Args:
        stated: N tasks.
        wrench: (N, 6) their loads.
        solver: of the programs; it is not believed.
    """
    programs, goal, task = assembled(stated), stated.task.goals[0], stated.task
    N = stated.count
    none = np.zeros(N, dtype=bool)
    if not stated.formulation.n_v:
        return _told(stated, none, np.full(N, "", dtype=NAMES), np.full(N, np.nan), None)
    every = isinstance(goal, LargestMargin)
    x, largest, clashing = _widest(programs, solver, every=every)
    infeasible = clashing != ""
    if every:
        right, kept = largest >= task.margin - AT_LEAST * programs.unit, np.fmax(task.margin, largest)
    else:
        x, right = _best(programs, goal, np.flatnonzero(~infeasible), solver)
        kept, largest = np.full(N, task.margin), np.where(infeasible, largest, np.nan)
    plans = judged(programs, x, kept, wrench)
    return _told(stated, right & plans.holds, clashing, largest, plans)


def _widest(programs: Assembled, solver: Solver, *, every: bool) -> tuple[Array, Array, NDArray[np.str_]]:
    """Return unknowns (N, n) of the largest margin, the margins (N,) [N] that verify, and what proofs of a no rest on.

    A margin is nan that does not verify, or, but for `every`, that is known to be more than what is asked for.
    """
    margin, N = programs.stated.task.margin, programs.stated.count
    asked, widest = margin / programs.unit, programs.largest_margin()
    found = solver(widest, OF_MARGIN, np.full(N, -np.inf) if every else -asked - ENOUGH)
    largest, clashing = np.full(N, np.nan), np.full(N, "", dtype=NAMES)
    left = np.flatnonzero(found.status != Status.ENOUGH)
    if not len(left):
        return found.x[:, :-1], largest, clashing
    own, x, z = widest if len(left) == N else widest.taken(left), found.x[left], found.z[left]
    right = verifier.judge_optimal(own, x, z, programs.far).verified
    reached = x[:, -1]
    largest[left] = np.where(right, np.where(np.abs(reached) > AT_LEAST, reached, 0.0) * programs.unit[left], np.nan)
    # where limits clash without any friction, the multipliers grow into a proof of that by themselves
    far = ~(right & (reached >= asked[left] - AT_LEAST))
    if far.any():
        clashing[left[far]] = _proven(programs, left[far], z[far])
    return found.x[:, :-1], largest, clashing


def _proven(programs: Assembled, places: NDArray[np.intp], z: Array) -> NDArray[np.str_]:
    """Return what clashes where multipliers of the largest margin prove the one asked for out of reach; else empty."""
    A, b = programs.at_margin(programs.stated.task.margin, places)
    n = A.shape[-1]
    at_margin = ConeProblems(np.zeros((1, n, n)), np.zeros((1, n)), A, b, programs.sizes)
    verified = verifier.judge_infeasible(at_margin, z, programs.bounds(places)).verified
    found = np.full(len(z), "", dtype=NAMES)
    found[verified] = clashes(programs.of, programs.sizes, verifier.projected(at_margin, z)[verified])
    return found


def _best(
    programs: Assembled, goal: Goal, possible: NDArray[np.intp], solver: Solver
) -> tuple[Array, NDArray[np.bool_]]:
    """Return the best unknowns (N, n) of the tasks that are possible, and which of them verify."""
    N, n = programs.stated.count, programs.stated.formulation.n_v
    x, right = np.full((N, n), np.nan), np.zeros(N, dtype=bool)
    if not len(possible):
        return x, right
    problems, constant, tolerances = _stated_goal(programs, goal)
    far = programs.far[: problems.q.shape[-1]]
    for tolerance in tolerances:
        every = len(possible) == N
        theirs, own = problems if every else problems.taken(possible), None if constant is None else constant[possible]
        found = solver(theirs, tolerance, np.full(len(possible), -np.inf))
        x[possible] = found.x[:, :n]
        right[possible] = verifier.judge_optimal(theirs, found.x, found.z, far, own).verified
        possible = possible[~right[possible]]
        if not len(possible):
            return x, right
    # without a load, to do nothing may be the best
    theirs, own = problems.taken(possible), None if constant is None else constant[possible]
    x_0, z_0 = (np.zeros((len(possible), size)) for size in (problems.q.shape[-1], problems.b.shape[1]))
    still = verifier.judge_optimal(theirs, x_0, z_0, far, own).verified
    x[possible[still]], right[possible[still]] = 0.0, True
    return x, right


def _stated_goal(programs: Assembled, goal: Goal) -> tuple[ConeProblems, Array | None, Sequence[Tolerance]]:
    """Return the programs of a goal at the margin asked for, constants, and to what they are solved in turn."""
    margin = programs.stated.task.margin
    if isinstance(goal, LeastEffort):
        problems, constant = programs.least_effort(goal.of, margin)
        return problems, constant, OF_EFFORT
    return programs.least_peak(margin), None, (OF_MARGIN,)


def _told(
    stated: Stated, feasible: NDArray[np.bool_], clashing: NDArray[np.str_], largest: Array, plans: Physical | None
) -> Decided:
    """Return it with nan where there is no plan."""
    N, grasp = stated.count, stated.grasps[0]
    shapes = {"dz_r": grasp.n_z, "forces": grasp.n_l, "margins": grasp.n_c}
    arrays = {
        name: np.where(feasible[:, None], np.nan if plans is None else getattr(plans, name), np.full((N, size), np.nan))
        for name, size in shapes.items()
    }
    return Decided(feasible, largest, **arrays, clashes=clashing)
