"""How fast the palm may go along its path: the fastest timing, attained by a plan and bounded by a proof."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np

from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.documents.naming import made_by, naming_arguments
from synergrip.documents.time_table import MOTION, TIME
from synergrip.errors import InputError, OutputError, Refusal
from synergrip.files import atomic_path
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import scale_of
from synergrip.linalg import Array
from synergrip.margin.timing.attained import SLOWER, Attained, attained, given_share
from synergrip.margin.timing.by_length import Leg, legs
from synergrip.margin.timing.fastest_program import Timing, fastest
from synergrip.margin.timing.question import timing_question
from synergrip.margin.timing.timeless import timeless
from synergrip.planning.outcome import Plan
from synergrip.tasks.palm_motion import Palm
from synergrip.tasks.palm_path import PalmPath
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask
from synergrip.values import Value

TIMING = "fastest_timing_s"
"""Its name among the margins."""
PARTS = (128, 256, 512)
"""Into how many the path is divided: into more where limits need a reserve between the points."""
SMALL = 5e-3
"""A reserve, as a share of the load, that is not worth more points."""


@made_by("fastest_timing(grasp, task)")
@dataclass(frozen=True, eq=False, repr=False)
class FastestTiming(Value):
    """The fastest timing of the path of a palm, between a plan that attains it and a proof that none is faster.

    Example:
        >>> found = fastest_timing(grasp, task)  # doctest: +SKIP
        >>> found.value, found.lower, found.given_s  # doctest: +SKIP
        (0.3021, 0.2984, 0.8)
    """

    name: ClassVar[str] = TIMING
    value: float | None
    """[s] attained by `plan`, a verified plan along `path`; None where none was found."""
    lower: float | None
    """[s] that the linear model of the start posture takes at least: the dual bound of its program, on its grid."""
    upper: float | None
    """[s] the same as `value`."""
    proven: bool
    """Whether `lower` is certified, of the discretised program of the linear model of the start posture."""
    local: bool
    """Whether the timing is the best among those near it only, as with limits on the rates of references."""
    given_s: float
    """[s] how long the task takes as it is asked."""
    why: str
    """What is proven of what, or why there is no value; in words."""
    path: PalmPath | None = None
    """The same way at the timing found: poses at instants."""
    share: Array | None = None
    """(K,) the share of the way that is passed at the instants `path.times`."""
    given_share: Array | None = None
    """(K,) the same after equal parts of the time that the task takes as it is asked."""
    plan: Plan | None = None
    """Of the task with `path` in place of the palm's own motion."""

    @naming_arguments
    def write(self, path: str | Path) -> Path:
        """Write the path as a CSV file that `PalmPath.from_csv` and ``task.palm.path`` take, whole or not at all.

        Args:
            path: the file, replaced if it is there.

        Returns:
            The file.

        Raises:
            InputError: there is no timing to be written.
            OutputError: it cannot be written.

        Example:
            >>> found.write("out/palm.csv")  # doctest: +SKIP
            PosixPath('out/palm.csv')
        """
        if self.path is None:
            raise InputError.at("FastestTiming.path", f"there is no timing to be written: {self.why}")
        rows = np.column_stack([np.asarray(self.path.times), np.asarray(self.path.poses)]).tolist()
        lines = [",".join([TIME, *MOTION]), *(",".join(map(repr, row)) for row in rows)]
        place = Path(path)
        try:
            with atomic_path(place) as temporary:
                temporary.write_text("\n".join(lines) + "\n", encoding="utf-8")
        except OSError as error:
            raise OutputError(f"cannot write '{path}': {error.strerror or error}", "path") from None
        return place


@naming_arguments
def fastest_timing(grasp: Grasp, task: Task) -> FastestTiming:
    """Return the fastest timing along the path of the palm for which all limits hold, asked margin included.

    With the length s of the path, ``b = (ds/dt)^2`` and ``a = d^2 s / dt^2`` the load is affine in a and b, and the
    least time a second-order cone program (Verscheure et al. 2009, "Time-optimal path tracking for robots: a convex
    optimization approach"). b is 0 at both ends and at corners; the references have no jumps, and where the
    acceleration jumps the limits hold on both sides. This is the linear model of the start posture. Its timing is then
    planned along the hand that moves, slowed down by a common factor until there is a plan; where that takes much, the
    timing that is asked for is looked at, too, with one factor on its times.

    Args:
        grasp: on a hand, with an object that has a mass.
        task: holds the object; its loads are a `Palm` or `PalmPath` with inertia, and such as stay the same.

    Returns:
        The timing with its plan, and what is proven; or why there is none.

    Raises:
        InputError: no path with inertia; a load, wanted motion or limit that is bound to time; and what `plan` raises.

    Example:
        >>> fastest_timing(problem.grasp, problem.task).value  # doctest: +SKIP
        0.3021
    """
    grasp, task, timed, palm = timeless(grasp, task)
    given = float(timed.times[-1] - timed.times[0])
    for parts in PARTS:
        path = legs(palm, float(timed.times[0]), float(timed.times[-1]), scale_of(grasp).length, parts)
        if not path:
            return _none(given, "the palm stays where it is")
        try:
            found = _linear(grasp, task, timed, path)
        except Refusal as refusal:
            return _none(given, str(refusal))
        if not isinstance(found, str) and found.reserve <= SMALL:
            break
    return _none(given, found) if isinstance(found, str) else _attained(grasp, task, palm, path, found, given)


def _linear(grasp: Grasp, task: Task, timed: TimedTask, path: tuple[Leg, ...]) -> Timing | str:
    """Return the fastest timing of the linear model of the start posture, or why there is none."""
    seconds = float(timed.times[-1] - timed.times[0])
    speed = sum(leg.length for leg in path) / seconds
    return fastest(
        lambda usual: timing_question(grasp, task, timed, path, usual), (4 * speed / seconds, speed**2),
        tuple(each for each in timed.limits if isinstance(each, SynergyRate)),
    )  # fmt: skip


def _none(given: float, why: str, least: float | None = None) -> FastestTiming:
    return FastestTiming(None, least, None, proven=least is not None, local=False, given_s=given, why=why)


def _attained(
    grasp: Grasp, task: Task, palm: Palm | PalmPath, path: tuple[Leg, ...], found: Timing, given: float
) -> FastestTiming:
    """Return the timing as it is planned along the hand that moves."""
    asked = given_share(grasp, task, palm)
    best = attained(grasp, task, palm, path, found, asked)
    if best is None:
        why = f"no plan verified up to {SLOWER[-1]:g} times the time of the linear model, {found.seconds:.4g} s"
        return _none(given, f"{why}, nor of the timing that is asked for", found.least)
    return FastestTiming(
        best.seconds, found.least, best.seconds, found.least is not None, found.local, given,
        _claim(found, best), best.path, best.share, asked, best.plan,
    )  # fmt: skip


def _claim(found: Timing, best: Attained) -> str:
    """Return what is attained, and what is proven of what."""
    who = "the hand that moves" if best.plan.executed is not None else "the linear model of the start posture"
    slower = f"{100 * (best.seconds / found.seconds - 1):.2g} % slower than the linear model of the start posture is"
    if best.as_asked:
        slower = f"with one factor on the times that are given, {slower}"
    local = "; with limits on rates it is the best of those near it only" if found.local else ""
    proof = (
        "; less is proven impossible of the program of the linear model of the start posture, on a grid of the path"
        if found.least is not None else "; nothing is proven"
    )  # fmt: skip
    return f"attained by a plan of {who}, {slower}{local}{proof}"
