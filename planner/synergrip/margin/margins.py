"""How sure a grasp is, and how far it may be pushed: every margin of a plan, and the numbers that people ask for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from synergrip.changes.asked import STATED, Asked
from synergrip.conic.limits.normal_force import least_normal_force
from synergrip.documents.judging import Arguments
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError, one_of
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.margin.direct import Wanted, direct, wanted
from synergrip.margin.direct_number import DirectNumber
from synergrip.margin.disturbance.disturbances import AXES, disturbances, judged_box, judged_directions
from synergrip.margin.found import Margins
from synergrip.margin.headroom import headrooms
from synergrip.margin.measures import measures
from synergrip.margin.on_request import ON_REQUEST
from synergrip.margin.sensitivity.sensitivities import NAME as SENSITIVITIES
from synergrip.margin.sensitivity.sensitivities import sensitivities_of
from synergrip.margin.timing.fastest_timing import TIMING, FastestTiming, fastest_timing
from synergrip.margin.timing.timeless import timeless
from synergrip.margin.wrench_space.quality import WrenchSpaceQuality, wrench_space_quality
from synergrip.planning.outcome import Infeasible, Plan, Unknown
from synergrip.planning.planning import plan
from synergrip.statics.motion import forward
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask

DISTURBANCE, QUALITY = "disturbance", "quality"
BESIDE = (DISTURBANCE, QUALITY, SENSITIVITIES, *ON_REQUEST, TIMING)
"""What may be asked for by name beside the numbers."""
Heard = Callable[[DirectNumber | FastestTiming], None]


@naming_arguments
def margins(
    grasp: Grasp, task: Task | TimedTask, *, only: Sequence[str] = (),
    directions: Sequence[Sequence[float]] | Array | None = None, box: Sequence[float] | Array | None = None,
    heard: Heard = lambda number: None,
) -> Margins | Infeasible | Unknown:  # fmt: skip
    """Return the margins of the plan of a task, how far its numbers may go, what it withstands and what would help it.

    Args:
        grasp: the grasp.
        task: what is asked.
        only: names of what is wanted: numbers, "disturbance", "quality", "sensitivities". All of these when empty, but
            not what takes as long as all the others: "critical_friction_per_contact", "largest_amplitude_per_mode",
            "fastest_timing_s".
        directions: (n, 6) of extra wrenches, see `disturbances`; both ways along and about every axis when None.
        box: (6,) half-widths of a box of extra wrenches, see `disturbances`.
        heard: is told of each number as it is found.

    Returns:
        The margins; or what `plan` says where there is no plan.

    Raises:
        InputError: a name that is none, directions or half-widths that are none, a timing that is not free though it is
            asked for, and what `plan` raises.

    Example:
        >>> margins(problem.grasp, problem.task, only=("load_factor",)).direct["load_factor"].proven  # doctest: +SKIP
        True
    """
    wishes = Wishes.of(grasp, task, only=only, directions=directions, box=box)
    made = plan(grasp, task)
    return margins_of(made, grasp, task, wishes, heard) if isinstance(made, Plan) else made


@dataclass(frozen=True, eq=False)
class Wishes:
    """What is wanted beside the measures."""

    names: tuple[str, ...]
    """Empty for all that is not on request."""
    directions: Array
    box: Array | None
    pushed: bool
    """Whether directions or a box are given, which ask for disturbances by themselves."""
    free: Task | None
    """The task whose timing is free, where the fastest one is wanted."""

    @classmethod
    def of(
        cls, grasp: Grasp, task: Task | TimedTask, *, only: Sequence[str] = (),
        directions: Sequence[Sequence[float]] | Array | None = None, box: Sequence[float] | Array | None = None,
    ) -> Wishes:  # fmt: skip
        """Return the arguments of `margins`, judged before anything is planned."""
        judge = Arguments("")
        names = judge.several("only", only, str, '"heaviest_kg"')
        judge.finish()
        along, widths = frozen(AXES) if directions is None else judged_directions(directions), judged_box(box)
        free = timeless(grasp, task)[1] if TIMING in names else None
        return cls(names, along, widths, directions is not None or box is not None, free)

    def __contains__(self, name: str) -> bool:
        """Tell whether something is wanted."""
        usual = not self.names and name not in (*ON_REQUEST, TIMING)
        return usual or name in self.names or (self.pushed and name == DISTURBANCE)


def margins_of(
    made: Plan, grasp: Grasp, task: Task | TimedTask, wishes: Wishes, heard: Heard = lambda number: None
) -> Margins:
    """Return the margins of a plan that is made; see `margins`.

    Args:
        made: plan of the task.
        grasp: that it was asked with.
        task: as it was asked.
        wishes: what is wanted.
        heard: is told of each number as it is found.

    Raises:
        InputError: a name that is none.
    """
    if made.fresh is not None:
        made = replace(made, notes=(*made.notes, STATED))
    asked = Asked.of(made.grasp, task, made.task)
    numbers = {each.name: each for each in wanted(asked, made)}
    for name in wishes.names:
        if name not in (*numbers, *BESIDE):
            raise InputError.at("only", one_of(name, [*numbers, *BESIDE]))
    found = _measured(made)
    if made.interrupted:
        return replace(found, interrupted=True)
    chosen = [number for name, number in numbers.items() if name in wishes]
    try:
        for more in _more(found, wishes, chosen, asked, task, heard):
            found = more
        if wishes.free is not None:
            found = replace(found, timing=(timing := fastest_timing(grasp, wishes.free)))
            heard(timing)
    except KeyboardInterrupt:
        return replace(found, interrupted=True)
    return found


def _measured(made: Plan) -> Margins:
    """Return the measures of a plan alone."""
    grasp, limits = made.grasp, made.task.limits
    least = least_normal_force(limits)
    own = measures(grasp, made.time, made.forces, least) | headrooms(grasp, limits, made.motion)
    if made.executed is None:
        return Margins(made, own, None)
    promised = forward(made.analysis.response, made.time, made.dz_r, made.task.wrench)
    return Margins(made, own, measures(grasp, made.time, promised.forces, least) | headrooms(grasp, limits, promised))


def _more(
    found: Margins, wishes: Wishes, chosen: Sequence[Wanted], asked: Asked, task: Task | TimedTask, heard: Heard
) -> Iterator[Margins]:
    """Yield margins of which more and more is known, so that an interrupt keeps what is finished."""
    made = found.plan
    for number in direct(chosen, asked, made):
        yield (found := replace(found, direct={**found.direct, number.name: number}))
        heard(number)
    for name in (name for name in ON_REQUEST if name in wishes):
        several: dict[str, DirectNumber] = {}
        for of, number in ON_REQUEST[name](asked, made):
            several = {**several, of: number}
            yield (found := replace(found, on_request={**found.on_request, name: several}))
            heard(number)
    if DISTURBANCE in wishes:
        yield (found := replace(found, disturbance=disturbances(made, directions=wishes.directions, box=wishes.box)))
    if QUALITY in wishes:
        yield (found := replace(found, quality=_quality(made)))
    if SENSITIVITIES in wishes:
        changes = sensitivities_of(made, task)
        yield replace(found, sensitivities=changes)
        if changes.interrupted:
            raise KeyboardInterrupt


def _quality(made: Plan) -> WrenchSpaceQuality | None:
    try:
        return wrench_space_quality(made.analysis, each=True)
    except InputError:  # contacts of a kind of one's own
        return None
