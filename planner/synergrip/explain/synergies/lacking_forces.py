"""Joint motions that keep limits which the synergies cannot keep: where no rank tells, they are found by planning.

All of it is in the linear model of the start posture. There, further synergies never take a plan away: so what all
joints together cannot do no synergies can, and what some columns do more columns do, too.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from synergrip.conic.goals.least_motion import LeastMotion
from synergrip.explain.irreducible import irreducible
from synergrip.explain.synergies.candidates import Extending
from synergrip.explain.synergies.further_columns import Further, Subset
from synergrip.explain.synergies.lacking import Lack
from synergrip.linalg import Array, canonical, frozen
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan_of_start_posture

SMALL = 1e-3
"""Share of the largest motion of the contacts below which a direction of it is left out."""


def plan_of_all_joints(no: Infeasible) -> Plan | Infeasible | None:
    """Return the plan of all joints in which references change least, the proof that there is none, or None."""
    moving = replace(no, task=replace(no.task, goals=(LeastMotion("references"),)))
    outcome = Extending(moving, plan_of_start_posture).outcome(no.grasp.joints, np.eye(no.grasp.n_q))
    return outcome if isinstance(outcome, Plan | Infeasible) else None


def columns_of(plan: Plan, no: Infeasible, weights: Array) -> Iterator[Array]:
    """Yield columns (n_q, k), k = 1, 2, ...: the largest motions of the contacts by all joints beyond J S.

    Args:
        plan: of all joints.
        no: the proof that there is none with the synergies alone.
        weights: (n_q,) by what joint motions are measured.
    """
    if no.analysis is None:
        return
    scale, grasp = no.analysis.response.scale, no.grasp
    moved = scale.scaled_rows(grasp.J @ plan.dz_r[:, grasp.n_z :].T)
    lack = Lack.of(scale, grasp.J, scale.scaled_rows(grasp.J @ grasp.S), moved)
    directions, sizes, _ = np.linalg.svd(lack.outside.T @ moved, full_matrices=False)
    for k in range(1, int(np.sum(sizes > SMALL * sizes.max(initial=0.0))) + 1):
        yield canonical(replace(lack, wanted=frozen(directions[:, :k])).least_columns(weights))


def helping(no: Infeasible, further: Sequence[Further]) -> Iterator[tuple[Further, Subset]]:
    """Yield single columns with which there is a plan; where there are none, of each set some none of which is idle."""
    extending, single = Extending(no, plan_of_start_posture), False

    def helps(columns: Further, picks: Sequence[int]) -> bool:
        names = [columns.names[i] for i in picks]
        return bool(picks) and extending.verdict(names, columns.columns[:, list(picks)]) == "feasible"

    for columns in further:
        for i in range(len(columns.names)):
            if helps(columns, (i,)):
                single = True
                yield columns, (i,)
    for columns in further if not single else ():
        every = range(len(columns.names))
        if helps(columns, every):
            yield columns, irreducible(every, partial(helps, columns))
