"""What a motor may carry for long: the root of the mean over time of the squares, of each joint or synergy.

Motors burn out by the heat of their windings, which goes by the square of what they carry. What is straight from knot
to knot has squares that are parabolas there, of which two instants of each step (those of Gauss) tell the integral
exactly. So the bound is one second-order cone over all the knots.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.conic.intersample import knots_in
from synergrip.conic.limits.limit import Usage
from synergrip.conic.limits.symmetric import Symmetric
from synergrip.conic.rows import Kind, Rows, items_of
from synergrip.linalg import Array, frozen
from synergrip.statics.motion import Motion

GAUSS = (0.5 - np.sqrt(3) / 6, 0.5 + np.sqrt(3) / 6)
"""Shares of a step at which two values with equal weights make the integral of a parabola."""


@dataclass(frozen=True, eq=False)
class Sustained(Symmetric):
    """``sqrt(integral of value^2 dt / duration) <= limit``, and ``|value| <= limit`` at the end of a hold.

    Where the object is only held it is so after the task, too: in the long run the mean is what the last knot takes.
    Between the knots values are on straight lines.
    """

    couples_knots = True
    adds_up = True

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return one second-order cone of each joint or synergy, and of a hold two bounds at the last knot."""
        from scipy import sparse

        grasp = formulation.response.grasp
        names, limit, value = self.names(grasp), self.on(grasp).limit, self.value(formulation)
        keep, rows = np.flatnonzero(np.isfinite(limit)), []
        if is_hold(formulation):
            rows = [replace(part, constant=frozen(part.constant[-1:])) for part in super().rows(formulation)]
        if not len(keep) or len(formulation.times) < 2:
            return rows
        instants, weights = gauss_instants(formulation.times)
        shares = sparse.csr_matrix(sparse.diags_array(weights) @ knots_in(instants, formulation.times))
        constant = shares @ (value.constant[:, keep] / limit[keep])
        matrix = frozen(value.matrix[..., keep, :] / limit[keep, None])
        items = items_of((names[i] for i in keep), "norm")
        none = frozen(np.zeros(len(keep)))
        mean = Rows(self.key, Kind.SECOND_ORDER, 1, items, matrix, frozen(constant), none, (), shares, over_time=1.0)
        return [*rows, mean]

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the root of what has come together of the mean square by each time; of a hold the last value, too."""
        of_instants = super().usage(formulation, motion)
        found = so_far(motion.times, of_instants.value, goes_on=is_hold(formulation))
        return replace(of_instants, value=found, lower=frozen(np.full(found.shape[1], -np.inf)))

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> None:
        """Return nothing: an instant may take more than the mean."""


def is_hold(formulation: Formulation) -> bool:
    """Return whether the object is only held: nowhere else is it wanted than where it starts."""
    return len(formulation.times) < 2 or not np.any(formulation.target)


def gauss_instants(times: Array) -> tuple[Array, Array]:
    """Return two instants of each step, and the roots of their weights in the mean over the whole time."""
    steps = np.diff(times)
    instants = (times[:-1, None] + steps[:, None] * np.array(GAUSS)).ravel()
    return instants, np.sqrt(np.repeat(steps, 2) / (2 * (times[-1] - times[0])))


def so_far(times: Array, values: Array, *, goes_on: bool) -> Array:
    """Return the root of the integral of values^2 from the start to each time, over the whole time (T, m).

    Times (T,) may be in any order; of two that are the same the first is that before a step.
    Where it `goes_on` with the last value, the size of this is there at the end where it is more.
    """
    order = np.argsort(times, kind="stable")
    times, values = times[order], values[order]
    first, second = values[:-1], values[1:]
    squares = np.diff(times)[:, None] * (first**2 + first * second + second**2) / 3
    total = np.concatenate([np.zeros((1, values.shape[1])), np.cumsum(squares, axis=0)])
    found = np.sqrt(total / ((times[-1] - times[0]) or 1.0))
    if goes_on:
        found[-1] = np.maximum(found[-1], np.abs(values[-1]))
    result = np.empty_like(found)
    result[order] = found
    return frozen(result)
