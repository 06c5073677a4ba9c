"""The formulas of the second formulation for goals over time and of motion, and for what earlier goals determined."""

from __future__ import annotations

import numpy as np

from synergrip.conic.goals.centred_joints import CentredJoints
from synergrip.conic.goals.least_holding import LeastHolding
from synergrip.conic.goals.least_motion import LeastMotion
from synergrip.conic.goals.least_reconfiguration import LeastReconfiguration
from synergrip.conic.goals.steady_forces import SteadyForces
from synergrip.referee.model import Model, Written
from synergrip.referee.motion_formulas import times_rows


def least_reconfiguration(model: Model, goal: LeastReconfiguration) -> Written:
    """Write the squares of gamma and of the free part of beta down."""
    import cvxpy as cp

    cost = 0.5 * cp.sum_squares(model.gamma / model.stated.reference) if model.redundancy else 0.0
    if model.beta_free.size:
        cost = cost + 0.5 * cp.sum_squares(model.beta_free / model.stated.motion)
    return Written(cost)


def least_motion(model: Model, goal: LeastMotion) -> Written:
    """Write the squares of references, rates or accelerations down, for a task that lasts 1."""
    import cvxpy as cp

    z = model.dz_r / model.units.reference
    if goal.of == "references":
        return Written(0.5 * cp.sum_squares(z))
    if len(model.times) < (2 if goal.of == "rates" else 3):
        return Written(cp.Constant(0.0))
    h = (np.diff(model.times) / (model.times[-1] - model.times[0]))[:, None]
    rates = times_rows(1 / h, z[1:] - z[:-1])
    if goal.of == "rates":
        parts, stiffest = times_rows(np.sqrt(h), rates), 1 / h.min()
    else:
        span = (h[1:] + h[:-1]) / 2
        parts = times_rows(1 / np.sqrt(span), rates[1:] - rates[:-1])
        stiffest = float(((1 / h[1:] + 1 / h[:-1]) ** 2 / span).max())  # the middle weight is the largest, squared
    factor = len(model.times) if goal.exact else min(float(len(model.times)), goal.stiffest / stiffest)
    return Written(0.5 * factor * cp.sum_squares(parts))


def steady_forces(model: Model, goal: SteadyForces) -> Written:
    """Write the squares of the forces' rates down, for a task that lasts 1."""
    import cvxpy as cp

    if len(model.times) < 2:
        return Written(cp.Constant(0.0))
    h = (np.diff(model.times) / (model.times[-1] - model.times[0]))[:, None]
    share = model.force @ np.diag(model.response.scale.force / model.force_unit)
    factor = len(model.times) if goal.exact else min(float(len(model.times)), goal.stiffest * h.min())
    return Written(0.5 * factor * cp.sum_squares(times_rows(1 / np.sqrt(h), share[1:] - share[:-1])))


def least_holding(model: Model, goal: LeastHolding) -> Written:
    """Write the mean of the squares down, by Simpson's rule in each step, which is exact for parabolas."""
    import cvxpy as cp

    value = model.torque if goal.of == "torque" else model.effort
    share = value / (model.force_unit * model.response.scale.length)
    if len(model.times) == 1:
        return Written(0.5 * cp.sum_squares(share))
    h = len(model.times) * np.diff(model.times)[:, None] / (model.times[-1] - model.times[0])
    ends = share[:-1], (share[:-1] + share[1:]) / 2, share[1:]
    parts = (cp.sum_squares(times_rows(np.sqrt(w * h / 6), part)) for w, part in zip((1, 4, 1), ends, strict=True))
    return Written(0.5 * sum(parts))


def centred_joints(model: Model, goal: CentredJoints) -> Written:
    """Write the squared distances of the joints from the middle of their ranges down, in half ranges."""
    import cvxpy as cp

    half = (goal.upper - goal.lower) / 2
    used = np.flatnonzero(np.isfinite(half) & (half > 0))
    middle = (goal.lower + goal.upper)[used] / 2
    q = model.joints + goal.start[None, :]
    return Written(
        0.5 * cp.sum_squares((q[:, used] - np.tile(middle, (len(model.times), 1))) @ np.diag(1 / half[used]))
    )
