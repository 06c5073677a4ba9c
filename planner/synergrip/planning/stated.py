"""What a file of a plan should hold, when its references are what they are: by the keys of plan.json."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.reserve import Reserve
from synergrip.conic.rows import Rows
from synergrip.linalg import Array
from synergrip.planning.arrays import Moved, arrays_of, columns_of, names_of
from synergrip.planning.instants import intersample_of
from synergrip.planning.told import (
    between_document,
    check_document,
    margin_document,
    series_document,
    structure_document,
    true_document,
)
from synergrip.tasks.scaling import units_of

if TYPE_CHECKING:
    from synergrip.planning.check import Judgement


def stated(judged: Judgement, claimed: Mapping[str, Any], verdict: str, knots: Array) -> dict[str, Any]:
    """Return what a file should hold, as far as it follows from its references.

    Args:
        judged: the references at their own knots.
        claimed: what the file holds; of its checks those that are there are told.
        verdict: on the references.
        knots: of the task (T,) [s]; a plan that has as many is one at these.
    """
    analysis, motion, task, grasp = judged.analysis, judged.motion, judged.task, judged.analysis.grasp
    parts = analysis.coordinates.coordinates(motion.dz_r)
    arrays = arrays_of(Moved(analysis, motion, *parts, judged.elastic_motion, judged.margins))
    code, executed = claimed.get("exit_code"), judged.executed
    true = {} if executed is None else {"true": true_document(executed, judged.usages[0], judged.fixed)}
    return arrays | true | {
        "verdict": verdict,
        "exit_code": code if verdict == "feasible" and code == INTERRUPTED else int(verdict != "feasible"),
        "structure": structure_document(grasp, analysis),
        **names_of(grasp),
        "time_s": knots if len(knots) == len(motion.times) else motion.times,
        "margin": margin_document(judged.usages[0]) | {"per_contact_N": judged.margins},
        "largest_margin_N": _largest_margin(judged) if isinstance(task.goal, LargestMargin) else None,
        "force_unit_N": units_of(analysis, task).force,
        "limits": [series_document(usage) for usage in judged.usages],
        "checks": _checks(judged, claimed.get("checks")),
        "between": between_document(judged.between),
        "columns": _columns(judged, arrays),
    }  # fmt: skip


INTERRUPTED = 130
"""Exit code of a plan that holds and was interrupted before all its goals were through."""


def _checks(judged: Judgement, claimed: Any) -> list[dict[str, Any]]:
    """Return the checks that a file names as they come out, without their errors, which are rounding."""
    ours = {check.name: check_document(check) for check in judged.checks}
    names = [each.get("name") if isinstance(each, Mapping) else None for each in claimed or ()]
    found = [ours.get(str(name), {"name": "no such check"}) for name in names]
    return [{key: value for key, value in each.items() if key != "error"} for each in found]


def _columns(judged: Judgement, arrays: Mapping[str, Array]) -> dict[str, Array]:
    """Return the columns of plan.csv by their names."""
    return {
        name: column
        for key, names in columns_of(judged.analysis.grasp).items()
        for name, column in zip(names, _columns_in(arrays[key]), strict=True)
    }


def _columns_in(array: Array) -> Array:
    """Return the columns of an array (T, m) or (T,)."""
    return array.reshape(len(array), -1).T


def _largest_margin(judged: Judgement) -> float:
    """Return the margin [N] that the references keep, with the reserve when it is asked for: the largest, if it is."""
    task, analysis = judged.task, judged.analysis
    if judged.executed is not None:
        return float(judged.margins.min())
    intersample = intersample_of(task, analysis) if task.between == "hold" else None
    if intersample is None:
        return float(judged.margins.min())
    formulation = judged.formulation
    unknowns = _unknowns(formulation, analysis.coordinates.coordinates(judged.motion.dz_r))
    rows = Reserve.of(formulation, intersample).kept(LargestMargin().rows, formulation)
    return formulation.force_unit * min(_room(part, unknowns) for part in rows if np.any(part.epigraph))


def _unknowns(formulation: Formulation, parts: tuple[Array, Array, Array]) -> Array:
    """Return v (T, n_v) of alpha, beta and gamma."""
    each = (formulation.alpha, formulation.beta, formulation.gamma)
    matrix = np.vstack([part.matrix for part in each])
    beyond = np.hstack([values - part.constant for values, part in zip(parts, each, strict=True)])
    return np.asarray(np.linalg.lstsq(matrix, beyond.T, rcond=None)[0].T)


def _room(rows: Rows, v: Array) -> float:
    """Return the least by which cones are kept."""
    at = v if rows.inside is None else rows.inside @ v
    cones = (rows.constant + at @ rows.matrix.T).reshape(-1, rows.dim)
    return float((cones[:, 0] - np.linalg.norm(cones[:, 1:], axis=1)).min())
