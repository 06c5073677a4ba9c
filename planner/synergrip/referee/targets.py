"""What the wanted motion fixes of the rigid motion, worked out a second time."""

from __future__ import annotations

import numpy as np
from scipy.linalg import null_space

from synergrip.linalg import Array
from synergrip.statics.analysis import Analysis
from synergrip.tasks.timed_task import TimedTask

OUTSIDE = 1e-6
"""Share of the wanted motion that may lie outside Gamma_ucs."""
COLUMNS = {"x": 0, "y": 1, "z": 2, "rx": 3, "ry": 4, "rz": 5}
"""Of a displacement, by axis."""


def followed(analysis: Analysis, task: TimedTask) -> tuple[Array | None, Array, Array]:
    """Return beta (T, dim Gamma_ucs) as far as it is fixed (None when it cannot be), where it is free, the motion."""
    basis, scale = analysis.spaces.Gamma_ucs, analysis.response.scale
    dimension = basis.shape[1]
    values = task.target.values
    rows = [COLUMNS[axis] for axis in task.axes]
    wanted = np.zeros((len(task.times), 6))  # on the other axes, where the object starts
    wanted[:, rows] = (values if task.target.kind == "motion" else values @ basis[:, : values.shape[1]].T)[:, rows]
    if task.tracking == "compliant":
        return np.zeros((len(task.times), dimension)), np.eye(dimension), wanted
    if len(task.axes) == 6:
        return _wanted(analysis, task), np.zeros((dimension, 0)), wanted
    scales = np.array([1.0] * 3 + [scale.length] * 3)[rows]
    seen, wish = scales[:, None] * basis[rows], scales * wanted[:, rows]
    beta = np.linalg.lstsq(seen, wish.T, rcond=1e-8)[0].T
    missed = np.linalg.norm(wish - beta @ seen.T, axis=1).max(initial=0.0)
    if missed > max(OUTSIDE * np.linalg.norm(wish, axis=1).max(initial=0.0), task.tolerance):
        return None, np.zeros((dimension, 0)), wanted
    free = null_space(seen, rcond=1e-8) if dimension else np.zeros((0, 0))  # older SciPy takes no empty matrix
    return np.asarray(beta), free, wanted


def _wanted(analysis: Analysis, task: TimedTask) -> Array | None:
    """Return beta (T, dim Gamma_ucs), or None when the wanted motion is no motion of Gamma_ucs."""
    basis, scale = analysis.spaces.Gamma_ucs, analysis.response.scale
    if task.target.kind != "motion":  # beta itself; columns that are not there stand for zero
        beta = np.zeros((len(task.times), basis.shape[1]))
        beta[:, : task.target.values.shape[1]] = task.target.values
        return beta
    wish = scale.twist(task.target.values)
    beta = np.asarray(np.linalg.lstsq(scale.motion @ basis, wish.T, rcond=None)[0].T)
    outside = np.linalg.norm(wish - scale.twist(beta @ basis.T), axis=1).max(initial=0.0)
    allowed = max(OUTSIDE * np.linalg.norm(wish, axis=1).max(initial=0.0), task.tolerance)
    return beta if outside <= allowed else None
