"""Pushes: forces on the object for some time, and the wrench about B that each of them is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.linalg import Array, frozen
from synergrip.tasks.arguments import Numbers, TaskArguments, keep
from synergrip.tasks.marks import SAME_TIME, Jump, Marks
from synergrip.tasks.stated import Corner, Load, Setting

PushProfile = Literal["step", "trapezoid", "half-sine"]
HALF_SINE_PARTS = 16
"""Into how many parts knots divide a half sine: straight lines between them fall short by 0.5 % of the force."""
CORNERS = {"start": "the start", "end": "the end", "ramp": "a ramp corner", "profile": "the peak"}


@naming_arguments
@dataclass(frozen=True, kw_only=True)
class Push(Load):
    """A force at a point of the object, for some time or throughout the task.

    Args:
        force: its largest size [N].
        direction: in the palm frame: "x", "y", "z" or 3 numbers.
        point: (3,) where it acts, from B, axes of the palm [m].
        start: when it begins [s]; None for the start of the task.
        end: when it is over [s]; None for the end of the task.
        profile: "step", "trapezoid" or "half-sine".
        ramp: time to the full force, and back, of a trapezoid [s].

    Raises:
        InputError: a negative force, no direction, an end before the start, a trapezoid without a ramp.

    Example:
        >>> Push(force=3.0, direction="x", start=0.5, end=0.8).lasting
        False
    """

    force: float
    direction: str | Numbers
    point: Numbers = (0.0, 0.0, 0.0)
    start: float | None = None
    end: float | None = None
    profile: PushProfile = "step"
    ramp: float | None = None

    def __post_init__(self) -> None:
        """Judge the arguments, alone and together."""
        judge = TaskArguments("Push")
        kept = {
            "force": judge.real("force", self.force, at_least=0, unit="N"),
            "direction": judge.direction("direction", self.direction),
            "point": judge.vector("point", self.point, 3, "3 lengths in m from B, axes of the palm"),
            "start": None if self.start is None else judge.real("start", self.start, at_least=0, unit="s"),
            "end": None if self.end is None else judge.real("end", self.end, above=0, unit="s"),
            "ramp": None if self.ramp is None else judge.real("ramp", self.ramp, above=0, unit="s"),
        }
        judge.word("profile", self.profile, get_args(PushProfile))
        profile = self.profile if isinstance(self.profile, str) else ""
        if profile == "trapezoid" and self.ramp is None:
            judge.refuse("ramp", "a trapezoid needs ramp, the time to its full force in seconds, for example 0.1")
        if profile != "trapezoid" and self.ramp is not None:
            judge.refuse("ramp", f"'ramp' is for a trapezoid; the profile is {self.profile!r}")
        if not judge.issues and self.start is not None and self.end is not None and self.end <= self.start:
            judge.refuse("end", f"the push begins at {self.start:g} s and must end later, not at {self.end:g} s")
        keep(self, judge, **kept)

    @property
    def lasting(self) -> bool:
        """True for a force that is the same throughout the task."""
        return self.profile == "step" and self.start is None and self.end is None

    @property
    def timed(self) -> bool:
        """True for a force that comes or goes."""
        return not self.lasting

    def over(self, setting: Setting) -> Pushing:
        """Return the wrench at any time of a task.

        Raises:
            InputError: it is not over before the task, not after it began, or too short for its ramps.
        """
        first = setting.start if self.start is None else self.start
        last = setting.end if self.end is None else self.end
        slack = SAME_TIME * max(setting.end, 1.0)
        if last > setting.end + slack:
            message = f"the push ends at {last:g} s, after the task, which ends at {setting.end:g} s; change it or "
            raise InputError.at("end", f"{message}task.duration")
        if last - first <= slack:
            name = "end" if self.end is not None else "start"
            raise InputError.at(name, f"the push begins at {first:g} s and must end later, not at {last:g} s")
        ramp = self.ramp or 0.0
        if 2 * ramp > (last - first) * (1 + SAME_TIME):
            message = f"two ramps of {ramp:g} s do not fit into a push of {last - first:g} s; at most half of it each"
            raise InputError.at("ramp", message)
        force = self.force * np.array(self.direction, dtype=float)
        wrench = np.concatenate([force, np.cross(self.point, force)])
        return Pushing(frozen(wrench), self.profile, first, last, ramp, frozen(self.point))

    def corners(self, setting: Setting) -> Iterator[Corner]:
        """Yield its start, its end and its peak or corners; none when it lasts."""
        if not self.lasting:
            yield from ((name, CORNERS[name], time) for name, time in self.over(setting).corners)

    def knots(self, setting: Setting) -> Array:
        """Return its corners; of a half sine enough for straight lines between them."""
        return self.over(setting).knots


@dataclass(frozen=True, eq=False)
class Pushing:
    """A wrench that comes and goes."""

    wrench: Array  # (6,) about B at the full force [N, N m]
    profile: PushProfile
    start: float  # [s]
    end: float  # [s]
    ramp: float  # [s]
    point: Array  # (3,) of the object on which it acts, from B at the start of the task, axes of the palm [m]

    def at(self, times: Array) -> Array:
        """Return the wrench (T, 6) about B at any times (T,) [s]; a step is on at its start and its end."""
        return np.outer(self.share(times), self.wrench)

    def share(self, times: Array) -> Array:
        """Return the share (T,) of the full force."""
        slack = SAME_TIME * max(self.end, 1.0)
        inside = (times >= self.start - slack) & (times <= self.end + slack)
        if self.profile == "step":
            return np.where(inside, 1.0, 0.0)
        if self.profile == "trapezoid":
            nearest = np.minimum(times - self.start, self.end - times)  # to either end
            return np.clip(nearest / self.ramp, 0.0, 1.0)
        share = (times - self.start) / (self.end - self.start)
        return np.where(inside, np.maximum(np.sin(np.pi * np.clip(share, 0.0, 1.0)), 0.0), 0.0)

    @property
    def marks(self) -> Marks:
        """Its corners; a step jumps at its start and its end, a half sine is curved between them."""
        corners = np.array([time for _, time in self.corners])
        if self.profile == "step":
            off = frozen(-self.wrench)
            return Marks(corners, jumps=(Jump(self.start, -1, off), Jump(self.end, 1, off)))
        return Marks(corners, ((self.start, self.end),) if self.profile == "half-sine" else ())

    @property
    def corners(self) -> Iterator[tuple[str, float]]:
        """The times at which there must be a knot [s], each with the key that says so."""
        yield "start", self.start
        yield "end", self.end
        if self.profile == "trapezoid":
            yield from (("ramp", self.start + self.ramp), ("ramp", self.end - self.ramp))
        if self.profile == "half-sine":
            yield "profile", (self.start + self.end) / 2

    @property
    def knots(self) -> Array:
        """The times at which the push is looked at when nobody says how many there are [s]."""
        if self.profile == "half-sine":
            return np.linspace(self.start, self.end, HALF_SINE_PARTS + 1)
        return np.array([time for _, time in self.corners])


def pushes_in(course: object) -> list[tuple[Pushing, float]]:
    """Return the pushes among what happens in a task, each with the factor of the whole load."""
    factor = getattr(course, "factor", 1.0)
    return [(part, factor) for part in getattr(course, "load", ()) if isinstance(part, Pushing)]


def shares_in_order(pushes: Sequence[Pushing], times: Array) -> Array:
    """Return the shares (m, T) of the full forces of pushes at times (T,) in their order [s].

    An instant at which one of them jumps may stand more than once: just before it, at it, and just after it, as far as
    it is within the task. Steps are on at it, and off beside it.
    """
    shares = np.array([push.share(times) for push in pushes]).reshape(len(pushes), len(times))
    steps = [push for push in pushes if push.profile == "step"]
    slack = SAME_TIME * max(float(times[-1]), 1.0) if len(times) else 0.0
    for time in {time for push in steps for time in (push.start, push.end)}:
        rows = np.flatnonzero(np.abs(times - time) <= slack)
        before = time > times[0] + slack and any(abs(push.start - time) <= slack for push in steps)
        after = time < times[-1] - slack and any(abs(push.end - time) <= slack for push in steps)
        if len(rows) != 1 + before + after:
            continue  # it stands once
        for i, push in enumerate(pushes):
            if push.profile == "step" and before and abs(push.start - time) <= slack:
                shares[i, rows[0]] = 0.0
            if push.profile == "step" and after and abs(push.end - time) <= slack:
                shares[i, rows[-1]] = 0.0
    return shares
