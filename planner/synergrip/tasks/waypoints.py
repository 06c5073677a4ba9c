"""The wanted motion through waypoints: from rest to rest between them, in straight lines, or along a smooth spline."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, Literal, get_args

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.linalg import Array, frozen
from synergrip.tasks.arguments import Numbers, Rows, TaskArguments, keep
from synergrip.tasks.marks import Marks
from synergrip.tasks.profiles import PROFILES, SHORTEST, WaypointProfile
from synergrip.tasks.stated import Corner, Motion, Setting


@naming_arguments
@dataclass(frozen=True, eq=False, kw_only=True)
class Waypoints(Motion):
    """Where the object is wanted at some instants, and the way there from where it is at 0 s.

    After the last of them it stays there.

    Args:
        times: (K,) increasing instants after 0 s [s].
        positions: (K, 3) displacements from the start [m], axes of the palm; None for zeros.
        rotations: (K, 3) rotation vectors about B from the start [rad]; None for zeros.
        modes: (K, m) coordinates of Gamma_ucs [m] instead of both; those that are not there are zero.
        profile: the way from one to the next: "min-jerk" and "cubic" rest at each, "linear" goes in straight lines,
            "spline" passes them without a stop.

    Raises:
        InputError: shapes that do not fit each other, times that do not increase, a pose given twice.

    Example:
        >>> Waypoints(times=[0.4, 1.0], positions=[[0, 0, 0.01], [0.005, 0, 0.01]])
        Waypoints(2 from 0.4 s to 1 s, profile='min-jerk')
    """

    times: Numbers
    positions: Rows | None = None
    rotations: Rows | None = None
    modes: Rows | None = None
    profile: WaypointProfile = "min-jerk"
    moving = True

    def __post_init__(self) -> None:
        """Judge the arguments."""
        judge = TaskArguments("Waypoints")
        times = judge.times("times", self.times, apart=SHORTEST)
        if not judge.issues and times[0] < SHORTEST:
            message = f"must be at least 1 us after the start, at 0 s, where the object is at rest; got {times[0]:g} s"
            judge.refuse("times", message)
        poses = {name: self._judged(judge, name, len(times)) for name in ("positions", "rotations", "modes")}
        if poses["modes"] is not None:
            given = [name for name in ("positions", "rotations") if poses[name] is not None]
            for name in given:
                judge.refuse(name, f"waypoints have modes, or positions and rotations; leave out {name}")
        elif poses["positions"] is None and poses["rotations"] is None:
            judge.refuse("positions", f"is missing; give positions, rotations or modes, a row for each of {len(times)}")
        judge.word("profile", self.profile, get_args(WaypointProfile))
        keep(self, judge, times=times, **poses)

    def _judged(self, judge: TaskArguments, name: str, count: int) -> Array | None:
        value: Any = getattr(self, name)
        if value is None:
            return None
        width = judge.width(value) if name == "modes" else 3
        what = {"positions": "x, y, z [m] in each row", "rotations": "a rotation vector [rad] in each row"}
        found = judge.rows(name, value, (count, width), what.get(name, "coordinates of Gamma_ucs [m] in each row"))
        if name == "rotations":
            judge.turns(name, found)
        return found

    def __repr__(self) -> str:
        """Return one line."""
        span = f"{len(self.times)} from {self.times[0]:g} s to {self.times[-1]:g} s"
        return f"Waypoints({span}, profile={self.profile!r})"

    @property
    def kind(self) -> Literal["motion", "mode moves"]:
        """A displacement, or coordinates of Gamma_ucs of which those that are not there stand for zero."""
        return "motion" if self.modes is None else "mode moves"

    @property
    def last(self) -> float:
        """The last waypoint ends a task that does not say when it ends."""
        return float(self.times[-1])

    @property
    def timed(self) -> bool:
        """True: things happen at the waypoints."""
        return True

    def stretched(self, factor: float) -> Waypoints:
        """Return the same places at times that are multiplied."""
        return replace(self, times=factor * np.asarray(self.times))

    def over(self, setting: Setting) -> Passing:
        """Return the motion (T, m) at any time, from rest at 0 s."""
        zeros = np.zeros((len(self.times), 3))
        if self.modes is not None:
            poses = np.asarray(self.modes)
        else:
            poses = np.hstack([zeros if part is None else part for part in (self.positions, self.rotations)])
        whole = np.vstack([np.zeros((1, poses.shape[1])), poses])
        return Passing(frozen([0.0, *self.times]), frozen(whole), self.profile)

    def corners(self, setting: Setting) -> Iterator[Corner]:
        """Yield the waypoints."""
        yield from ((f"times[{i}]", "the waypoint", float(time)) for i, time in enumerate(self.times))

    def knots(self, setting: Setting) -> Array:
        """Return the waypoints."""
        return np.asarray(self.times)


@dataclass(frozen=True, eq=False)
class Passing:
    """The motion through waypoints, the first of them the start."""

    times: Array  # (K,) [s]
    poses: Array
    """(K, 6) displacement about B [m, rad], or (K, m) coordinates of Gamma_ucs [m]; zero at the start."""
    profile: WaypointProfile

    def at(self, times: Array) -> Array:
        """Return the wanted motion (T, m) at any times (T,) [s]; after the last waypoint the object stays there.

        Every component by itself: a rotation is interpolated as the vector that it is written as.
        """
        inside = np.clip(times, self.times[0], self.times[-1])
        if self.profile == "spline":
            from scipy.interpolate import CubicSpline

            return np.asarray(CubicSpline(self.times, self.poses, bc_type="clamped")(inside))
        segment = np.clip(np.searchsorted(self.times, inside, side="right") - 1, 0, len(self.times) - 2)
        share = (inside - self.times[segment]) / np.diff(self.times)[segment]
        gone = np.asarray(PROFILES[self.profile](share))[:, None]
        return np.asarray(self.poses[segment] * (1 - gone) + self.poses[segment + 1] * gone)

    @property
    def marks(self) -> Marks:
        """The waypoints, and the way between them."""
        return Marks(self.times, () if self.profile == "linear" else ((float(self.times[0]), float(self.times[-1])),))
