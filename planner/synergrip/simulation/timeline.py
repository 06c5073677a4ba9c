"""When references and load are applied: at the plan's own speed, or so slowly that inertia does not count."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from synergrip.linalg import Array, frozen, interpolated
from synergrip.simulation.played_plan import PlayedPlan
from synergrip.values import Value

SLOWEST = {"object": 1e-3, "turn": 0.025, "force": 5.0, "reference": 0.1}
"""What an object moves [m/s], turns [rad/s], a force changes [N/s] and a reference [1/s] at most, when it is slow."""
SHORTEST = 0.02
"""[s] between two stations when it is slow, for what jumps."""


@dataclass(frozen=True, eq=False, repr=False)
class Applied(Value):
    """What is applied at an instant."""

    at: float  # [s] on the clock of the plan
    dz_r: Array  # (n_z,)
    wrench: Array  # (6,)
    forces: Array  # (m, 3)


@dataclass(frozen=True, eq=False, repr=False)
class Timeline(Value):
    """Stations, straight lines in between; a station may stand twice where the load jumps."""

    clock: Array  # (N,) [s] of the simulation, from 0
    at: Array  # (N,) [s] of the plan
    dz_r: Array  # (N, n_z)
    wrench: Array  # (N, 6)
    forces: Array  # (N, m, 3)

    @property
    def duration(self) -> float:
        """How long it takes [s]."""
        return float(self.clock[-1])

    def applied(self, clock: float) -> Applied:
        """Return what is applied at a time of the simulation [s]; at a jump what comes after it."""
        times, stations = self._stations
        i = min(max(bisect_right(times, clock) - 1, 0), max(len(times) - 2, 0))
        j = min(i + 1, len(times) - 1)
        span = times[j] - times[i]
        share = min(max((clock - times[i]) / span, 0.0), 1.0) if span > 0 else 1.0
        mixed, n_z = (1 - share) * stations[i] + share * stations[j], self.dz_r.shape[1]
        return Applied(float(mixed[0]), mixed[1 : 1 + n_z], mixed[1 + n_z : 7 + n_z], mixed[7 + n_z :].reshape(-1, 3))

    @cached_property
    def _stations(self) -> tuple[list[float], Array]:
        """Times, and everything else side by side (N, ...): it is asked at every step."""
        every = [self.at[:, None], self.dz_r, self.wrench, self.forces.reshape(len(self.at), -1)]
        return self.clock.tolist(), np.hstack(every)


def timeline(plan: PlayedPlan, speed: str) -> Timeline:
    """Return the timeline of a plan, "slow" or "real"."""
    load = plan.load
    knots = [time for time in plan.times if not np.any(np.isclose(load.times, time, rtol=0, atol=1e-12))]
    order = np.argsort(np.concatenate([load.times, knots]), kind="stable")
    at = np.concatenate([load.times, knots])[order]
    kept = (at >= plan.times[0] - 1e-12) & (at <= plan.times[-1] + 1e-12)

    def of_load(values: Array) -> Array:
        flat = values.reshape(len(values), int(np.prod(values.shape[1:])))
        columns = [np.interp(knots, load.times, column) for column in flat.T]
        between = np.array(columns).reshape(flat.shape[1], len(knots)).T
        return np.asarray(np.vstack([flat, between])[order][kept].reshape(int(kept.sum()), *values.shape[1:]))

    dz_r = interpolated(at[kept], plan.times, plan.dz_r)
    wrench, forces = of_load(load.wrench), of_load(load.forces)
    steps = np.diff(at[kept]) if speed == "real" else _slow(plan, at[kept], dz_r, wrench)
    clock = np.concatenate([[0.0], np.cumsum(steps)])
    return Timeline(frozen(clock), frozen(at[kept]), frozen(dz_r), frozen(wrench), frozen(forces))


def to_the_first_knot(plan: PlayedPlan, line: Timeline, wrench_0: Array, duration: float) -> Timeline:
    """Return the squeeze: from dz_r = 0 under the wrench (6,) of the start to the first station of a timeline."""

    def both(start: Array, end: Array) -> Array:
        return frozen(np.stack([start, end]))

    return Timeline(
        frozen(np.array([0.0, duration])), frozen(np.repeat(line.at[:1], 2)),
        both(np.zeros_like(line.dz_r[0]), line.dz_r[0]), both(wrench_0, line.wrench[0]),
        both(np.zeros_like(line.forces[0]), line.forces[0]),
    )  # fmt: skip


def _slow(plan: PlayedPlan, at: Array, dz_r: Array, wrench: Array) -> Array:
    """Return how long each step (N - 1,) takes when nothing is faster than `SLOWEST`."""
    du, forces = interpolated(at, plan.times, plan.du), interpolated(at, plan.times, plan.forces)
    changes = [
        (np.linalg.norm(np.diff(du[:, :3], axis=0), axis=1), "object"),
        (np.linalg.norm(np.diff(du[:, 3:], axis=0), axis=1), "turn"),
        (np.abs(np.diff(forces, axis=0)).max(axis=1), "force"),
        (np.abs(np.diff(wrench[:, :3], axis=0)).max(axis=1), "force"),
        (np.abs(np.diff(dz_r, axis=0)).max(axis=1), "reference"),
    ]
    return np.asarray(np.maximum(np.max([size / SLOWEST[of] for size, of in changes], axis=0), SHORTEST))
