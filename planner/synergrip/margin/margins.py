"""How sure a grasp is, and how far it may be pushed: every margin of a plan, and the numbers that people ask for."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from synergrip.changes.asked import Asked
from synergrip.conic.limits.normal_force import least_normal_force
from synergrip.documents.judging import Arguments
from synergrip.documents.naming import made_by, naming_arguments
from synergrip.errors import InputError, one_of
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.margin.direct import direct, wanted
from synergrip.margin.direct_number import DirectNumber
from synergrip.margin.disturbances import AXES, Disturbances, disturbances, judged_box, judged_directions
from synergrip.margin.measures import Measure, measures
from synergrip.margin.quality import WrenchSpaceQuality, wrench_space_quality
from synergrip.planning.outcome import Infeasible, Plan, Unknown
from synergrip.planning.planning import plan
from synergrip.statics.motion import forward
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask
from synergrip.values import Value


@made_by("margins(grasp, task)")
@dataclass(frozen=True, eq=False, repr=False)
class Margins(Value):
    """Every margin of a plan, and how heavy, slippery, hard, fast and far it may get.

    Example:
        >>> found = margins(problem.grasp, problem.task)  # doctest: +SKIP
        >>> found.direct["heaviest_kg"].value, found.measures["slip margin"].worst.value  # doctest: +SKIP
        (0.33081, 0.5)
    """

    plan: Plan
    measures: Mapping[str, Measure]
    """By name: of the hand that moves where there is one, of the linear model else."""
    linear: Mapping[str, Measure] | None
    """The same references in the linear model of the start posture, on a hand."""
    direct: Mapping[str, DirectNumber] = field(default_factory=dict)
    """By name; those that were found before somebody interrupted."""
    interrupted: bool = False
    disturbance: Disturbances | None = None
    """What it withstands beside its load; None where it was not asked for."""
    quality: WrenchSpaceQuality | None = None
    """The classical figures of the grasp; None where they were not asked for, or nothing is known of its contacts."""


@naming_arguments
def margins(
    grasp: Grasp, task: Task | TimedTask, *, only: Sequence[str] = (),
    heard: Callable[[DirectNumber], None] = lambda number: None,
    directions: Sequence[Sequence[float]] | Array | None = None, box: Sequence[float] | Array | None = None,
) -> Margins | Infeasible | Unknown:  # fmt: skip
    """Return the margins of the plan of a task, how far each of its numbers may go, and what it withstands.

    Args:
        grasp: the grasp.
        task: what is asked.
        only: names of the numbers that are wanted, "disturbance" and "quality" among them; all when empty.
        heard: is told of each number as it is found.
        directions: (n, 6) of extra wrenches, see `disturbances`; both ways along and about every axis when None.
        box: (6,) half-widths of a box of extra wrenches, see `disturbances`.

    Returns:
        The margins; or what `plan` says where there is no plan.

    Raises:
        InputError: a name that is none, directions or half-widths that are none, and what `plan` raises.

    Example:
        >>> margins(problem.grasp, problem.task, only=("load_factor",)).direct["load_factor"].proven  # doctest: +SKIP
        True
    """
    judge = Arguments("")
    names = judge.several("only", only, str, '"heaviest_kg"')
    judge.finish()
    chosen = frozen(AXES) if directions is None else judged_directions(directions)
    widths = judged_box(box)
    made = plan(grasp, task)
    if not isinstance(made, Plan):
        return made
    asked = Asked.of(made.grasp, task, made.task)
    numbers = {each.name: each for each in wanted(asked, made)}
    for name in names:
        if name not in (*numbers, *BESIDE):
            raise InputError.at("only", one_of(name, [*numbers, *BESIDE]))
    found, direct_numbers = _found(made), dict[str, DirectNumber]()
    if made.interrupted:
        return replace(found, interrupted=True)
    try:
        for number in direct([each for name, each in numbers.items() if not names or name in names], asked, made):
            direct_numbers[number.name] = number
            found = replace(found, direct=dict(direct_numbers))
            heard(number)
        if not names or "disturbance" in names or directions is not None or box is not None:
            found = replace(found, disturbance=disturbances(made, directions=chosen, box=widths))
        if not names or "quality" in names:
            found = replace(found, quality=_quality(made))
    except KeyboardInterrupt:
        return replace(found, interrupted=True)
    return found


BESIDE = ("disturbance", "quality")
"""What may be asked for by name beside the numbers."""


def _quality(made: Plan) -> WrenchSpaceQuality | None:
    try:
        return wrench_space_quality(made.analysis)
    except InputError:  # contacts of a kind of one's own
        return None


def _found(made: Plan) -> Margins:
    grasp = made.grasp
    least = least_normal_force(made.task.limits)
    own = measures(grasp, made.time, made.forces, least)
    linear = None
    if made.executed is not None:
        promised = forward(made.analysis.response, made.time, made.dz_r, made.task.wrench)
        linear = measures(grasp, made.time, promised.forces, least)
    return Margins(made, own, linear)
