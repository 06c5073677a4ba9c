"""How sure a grasp is, and how far it may be pushed: every margin of a plan, and the numbers that people ask for."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from synergrip.changes.asked import Asked
from synergrip.conic.limits.normal_force import least_normal_force
from synergrip.documents.judging import Arguments
from synergrip.documents.naming import made_by, naming_arguments
from synergrip.errors import InputError, one_of
from synergrip.grasps.grasp import Grasp
from synergrip.margin.direct import direct, wanted
from synergrip.margin.direct_number import DirectNumber
from synergrip.margin.headroom import headrooms
from synergrip.margin.measures import Measure, measures
from synergrip.margin.on_request import ON_REQUEST
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
    on_request: Mapping[str, Mapping[str, DirectNumber]] = field(default_factory=dict)
    """By name, then by contact or rigid motion: `critical_friction_per_contact`, `largest_amplitude_per_mode`."""
    interrupted: bool = False


@naming_arguments
def margins(
    grasp: Grasp, task: Task | TimedTask, *, only: Sequence[str] = (),
    heard: Callable[[DirectNumber], None] = lambda number: None,
) -> Margins | Infeasible | Unknown:  # fmt: skip
    """Return the margins of the plan of a task, and how far each of its numbers may go.

    Args:
        grasp: the grasp.
        task: what is asked.
        only: names of the numbers that are wanted; when empty all of one number each, which leaves out those of every
            contact and rigid motion: "critical_friction_per_contact", "largest_amplitude_per_mode".
        heard: is told of each number as it is found.

    Returns:
        The margins; or what `plan` says where there is no plan.

    Raises:
        InputError: a name that is none, and what `plan` raises.

    Example:
        >>> margins(problem.grasp, problem.task, only=("load_factor",)).direct["load_factor"].proven  # doctest: +SKIP
        True
    """
    judge = Arguments("")
    names = judge.several("only", only, str, '"heaviest_kg"')
    judge.finish()
    made = plan(grasp, task)
    if not isinstance(made, Plan):
        return made
    asked = Asked.of(made.grasp, task, made.task)
    numbers = {each.name: each for each in wanted(asked, made)}
    for name in names:
        if name not in (known := [*numbers, *ON_REQUEST]):
            raise InputError.at("only", one_of(name, known))
    chosen = [each for name, each in numbers.items() if not names or name in names]
    found, several = dict[str, DirectNumber](), dict[str, dict[str, DirectNumber]]()
    if made.interrupted:
        return _found(made, found, several, interrupted=True)
    interrupted = False
    try:
        for number in direct(chosen, asked, made):
            found[number.name] = number
            heard(number)
        for name in (name for name in ON_REQUEST if name in names):
            several[name] = {}
            for of, number in ON_REQUEST[name](asked, made):
                several[name][of] = number
                heard(number)
    except KeyboardInterrupt:
        interrupted = True
    return _found(made, found, several, interrupted=interrupted)


def _found(
    made: Plan, numbers: Mapping[str, DirectNumber], several: Mapping[str, Mapping[str, DirectNumber]], *,
    interrupted: bool,
) -> Margins:  # fmt: skip
    grasp = made.grasp
    least = least_normal_force(made.task.limits)
    own = measures(grasp, made.time, made.forces, least) | headrooms(grasp, made.task.limits, made.motion)
    linear = None
    if made.executed is not None:
        promised = forward(made.analysis.response, made.time, made.dz_r, made.task.wrench)
        linear = measures(grasp, made.time, promised.forces, least) | headrooms(grasp, made.task.limits, promised)
    return Margins(made, own, linear, numbers, several, interrupted)
