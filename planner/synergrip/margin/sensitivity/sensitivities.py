"""What a grasp gains and loses by each of its numbers: friction, mass, limits, compliances, places and normals."""

from __future__ import annotations

from synergrip.changes.asked import Asked
from synergrip.documents.judging import Arguments
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.margin.sensitivity.of_largest import of_largest
from synergrip.margin.sensitivity.of_references import of_references
from synergrip.margin.sensitivity.optimum import optimum
from synergrip.margin.sensitivity.parameters import left_out, parameters
from synergrip.margin.sensitivity.sensitivity import FIXED, LARGEST, Sensitivities, Sensitivity
from synergrip.planning.outcome import Infeasible, Plan, Unknown
from synergrip.planning.planning import plan
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask

NAME = "sensitivities"
"""What they are called among the numbers of `margins`."""


@naming_arguments
def sensitivities(
    grasp: Grasp, task: Task | TimedTask, *, known: Plan | None = None
) -> Sensitivities | Infeasible | Unknown:
    """Return how much the margins of a task change with each number of the grasp and the task.

    Two margins are differentiated. The **largest margin** that the task allows, of the best references for each value:
    with the program ``max s, b - A x in K`` and its multipliers z the derivative by a number p is
    ``z' (db/dp - dA/dp x)``, in the linear model of the start posture. And the worst margin under **fixed references**,
    those of the plan: the forces that answer are differentiated directly, on a hand at its true equilibria (but places
    and normals of tips that roll: in the linear model of the start posture). A place moves on link and object together
    and keeps its frame; a normal turns with the whole frame and the springs of the contact; a stiffness of a joint or
    synergy is 1 over its compliance, and what couples it to others goes half along.

    Args:
        grasp: the grasp.
        task: what is asked.
        known: a plan of it that is there already.

    Returns:
        All derivatives, each with its unit; or what `plan` says where there is no plan.

    Raises:
        InputError: another plan than one of the grasp, and what `plan` raises.

    Example:
        >>> sensitivities(grasp, task).worth_most("largest margin (dual)", 1)[0].name  # doctest: +SKIP
        'friction'
    """
    judge = Arguments("sensitivities")
    if known is not None:
        judge.one("known", known, Plan, "plan(grasp, task)")
    judge.finish()
    if known is not None and isinstance(grasp, Grasp) and known.grasp.contacts != grasp.contacts:
        raise InputError.at("known", "is a plan of another grasp; write plan(grasp, task), or leave it out")
    made = plan(grasp, task) if known is None else known
    return sensitivities_of(made, task) if isinstance(made, Plan) else made


def sensitivities_of(made: Plan, task: Task | TimedTask) -> Sensitivities:
    """Return the sensitivities of a task that has a plan; those that are finished when somebody interrupts.

    Raises:
        KeyboardInterrupt: somebody interrupted before there was any.
    """
    asked = Asked.of(made.grasp, task, made.task)
    numbers = parameters(asked, made.task, made.analysis.response)
    posed = asked.posed(made.analysis)
    best = "the start posture does not allow the task" if posed is None else optimum(posed)
    margins = {LARGEST: None if isinstance(best, str) else best.margin, FIXED: float(made.margins.min())}
    missing = dict(left_out(asked)) | ({LARGEST: best} if isinstance(best, str) else {})
    found, interrupted = list[Sensitivity](), False
    try:
        found += () if isinstance(best, str) else of_largest(numbers, best)
        found += of_references(numbers, made, asked)
    except KeyboardInterrupt:
        interrupted = True
    return Sensitivities(margins, tuple(found), missing, interrupted)
