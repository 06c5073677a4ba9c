"""What planning ends in: a plan, a proof that there is none, or the admission that neither is certain."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from synergrip.conic.certificate import Certificate
from synergrip.conic.conflicts import Conflict
from synergrip.conic.decide import Decision
from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.limit import Usage
from synergrip.conic.program import Program
from synergrip.documents.in_order import InOrder
from synergrip.documents.naming import made_by
from synergrip.equilibrium.execution import Execution
from synergrip.errors import Refusal, shortened
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.planning.answer import LONG, Reasoned, Tabled
from synergrip.planning.arrays import Moved
from synergrip.planning.between import Between
from synergrip.planning.fresh_samples import FreshSamples
from synergrip.planning.in_case import InCase
from synergrip.planning.pace import FirstPasses
from synergrip.planning.reached import Reached
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import Motion
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask
from synergrip.values import Kept


@dataclass(frozen=True)
class Check(Kept):
    """One statement about a plan, recomputed from the grasp's matrices in SI units."""

    name: str
    error: float
    """Size of the violation, relative to what the statement is measured against."""
    tolerance: float

    @property
    def passed(self) -> bool:
        """True when the error is within the tolerance."""
        return bool(self.error <= self.tolerance)


BETWEEN = "between the knots"
"""How the names of checks begin that are about what happens there on the hand that moves."""


@made_by("plan(grasp, task)")
@dataclass(frozen=True, eq=False, repr=False)
class Plan(Tabled):
    """A verified answer: references to send, and all that follows from them.

    Example:
        >>> answer.dz_r.shape, answer.forces.shape, answer.margins.min()  # doctest: +SKIP
        ((41, 4), (41, 9), 0.5)
    """

    task: TimedTask
    analysis: Analysis
    formulation: Formulation
    motion: Motion
    alpha: Array  # (T, dim E_s) [N]
    beta: Array  # (T, dim Gamma_ucs) [m]
    gamma: Array  # (T, dim Gamma_zr)
    elastic_motion: Array
    """(T, 6) what the references move beyond the rigid motion, sag excluded [m, rad]."""
    margins: Array  # (T, n_c) slip margins [N]
    usages: tuple[Usage, ...]
    """What the plan uses of every limit, friction cones first; `usages["joint torque"]` finds one by its title."""
    checks: tuple[Check, ...]
    decisions: tuple[Decision, ...]
    """The programs solved, in order; the last one is the plan's."""
    largest_margin: float | None
    """The largest margin [N] when it was asked for; of an executed plan the one that it keeps."""
    notes: tuple[str, ...] = ()
    """What the plan is not, although its goal would have it so."""
    between: Between | None = None
    """The plan between its knots; None when nothing is known of it."""
    executed: Execution | None = None
    """The true states along the plan, when its figures are those of the hand that moves; None for the linear model."""
    fixed: Execution | None = None
    """The same references if pads stayed where they are on link and object: what it costs to be wrong about rolling;
    None where nothing rolls."""
    passes: int = 0
    """How often the grasp was linearised anew along the motion, at all knots."""
    first_passes: FirstPasses | None = None
    """How often it was at some of the knots before that; None where all knots were looked at from the start."""
    interrupted: bool = False
    """Whether somebody stopped it before all goals were through; the plan holds all the same."""
    cases: tuple[InCase, ...] = ()
    """What the plan uses of its limits in every case of what the task allows for; none where it allows for nothing."""
    fresh: FreshSamples | None = None
    """What became of random samples of the grasp on a hand that the plan was not made with; None without any."""

    def __post_init__(self) -> None:
        """Let limits and checks be found by their names, too."""
        object.__setattr__(self, "usages", InOrder("usages", self.usages, "title"))
        object.__setattr__(self, "checks", InOrder("checks", self.checks))

    verdict: ClassVar[str] = "feasible"
    holds: ClassVar[tuple[str, ...]] = ("dz_r", "forces", "margins", "time", "usages", "checks")

    @property
    def exit_code(self) -> int:
        """0, or 130 when interrupted."""
        return 130 if self.interrupted else 0

    @property
    def grasp(self) -> Grasp:
        """The grasp that was planned on."""
        return self.analysis.grasp

    @property
    def moved(self) -> Moved:
        """What all arrays are made of."""
        parts = self.alpha, self.beta, self.gamma, self.elastic_motion
        return Moved(self.analysis, self.motion, *parts, self.margins)

    @property
    def time(self) -> Array:
        """(T,) knots [s]."""
        return self.motion.times

    @property
    def dz_r(self) -> Array:
        """(T, n_z) synergy references, from those at the start: what to send to the hand."""
        return self.motion.dz_r

    @property
    def forces(self) -> Array:
        """(T, n_l) contact forces of the hand on the object, rows (n, t, o [, moments]) of each contact [N, N m]."""
        return self.motion.forces

    def __repr__(self) -> str:
        """Return verdict, worst slip margin and sizes."""
        grasp, worst, times = self.grasp, self.usages[0], self.time
        k, i = worst.worst()
        return (
            f"Plan({self.verdict}: {len(times)} knots over {times[-1] - times[0]:.6g} s, {grasp.n_z} synergies, "
            f"{grasp.n_q} joints, {grasp.n_c} contacts;\n     worst slip margin {worst.value.min():.6g} N at "
            f"{shortened(str(worst.items[i]))}, t = {times[k]:.6g} s)"
        )


@made_by("plan(grasp, task)")
@dataclass(frozen=True, eq=False, repr=False)
class Infeasible(Reasoned):
    """A proof that no plan exists.

    Example:
        >>> answer.stage, answer.why  # doctest: +SKIP
        ('direction', 'the motion asked for leaves ...')
    """

    task: TimedTask
    grasp: Grasp
    analysis: Analysis | None
    """None when the grasp does not restrain the object."""
    stage: str
    """"restraint", "count", "direction" or "magnitude" (docs/theory.md)."""
    why: str
    refusal: Refusal | None
    """What was refused before any program was solved."""
    certificate: Certificate
    """The verified proof: a free twist, a direction outside Gamma_ucs, or the ray of the program."""
    program: Program | None
    decisions: tuple[Decision, ...]
    largest_margin: float | None
    """The largest margin [N] that the other limits allow, when that is what falls short."""
    conflicts: tuple[Conflict, ...] = ()
    """The limits that the proof rests on, when the program itself is infeasible."""
    hints: tuple[str, ...] = ()
    """What in the problem may not say what its author means, and what would come of it; computed, not guessed."""
    asked: Task | TimedTask | None = None
    """The task as it was asked, for what would come of another one."""
    notes: tuple[str, ...] = ()  # what of grasp and task can hardly be meant

    verdict: ClassVar[str] = "infeasible"
    exit_code: ClassVar[int] = 1
    holds: ClassVar[tuple[str, ...]] = ("why", "stage", "conflicts", "repairs", "when", "hints", "notes", "certificate")

    def __repr__(self) -> str:
        """Return stage and reason."""
        return f"Infeasible({self.stage}: {shortened(self.why, LONG)})"


@made_by("plan(grasp, task)")
@dataclass(frozen=True, eq=False, repr=False)
class Unknown(Reasoned):
    """Nothing could be verified either way.

    Example:
        >>> answer.why  # doctest: +SKIP
        "clarabel says 'AlmostSolved' and nothing verifies"
    """

    task: TimedTask
    analysis: Analysis
    why: str
    decisions: tuple[Decision, ...]
    stage: str = "solver"
    """"solver": nothing that was solved verifies; "reach": the hand does not follow the motion; "execution": the hand
    does not do what a plan promises."""
    reached: Reached | None = None
    """Until when the motion was followed, at the stage "reach"."""
    executed: Execution | None = None
    """The true states that the references found lead to, at the stages "reach" and "execution": at the knots until the
    motion is no longer followed, or the way ends; None where that is before the first."""
    motion: Motion | None = None
    """These states as a motion: references, forces, torques and displacements at the same knots."""
    usages: tuple[Usage, ...] = ()
    """What they use of every limit, friction cones first."""
    between_only: bool = False
    """Whether limits are missed between the knots alone: more of these may help."""
    passes: int = 0
    """How often the grasp was linearised anew along the motion, in vain."""
    asked: Task | TimedTask | None = None
    """The task as it was asked, for what would come of another one."""
    notes: tuple[str, ...] = ()  # what of grasp and task can hardly be meant

    def __post_init__(self) -> None:
        """Let limits be found by their names, too."""
        object.__setattr__(self, "usages", InOrder("usages", self.usages, "title"))

    verdict: ClassVar[str] = "unknown"
    exit_code: ClassVar[int] = 3
    holds: ClassVar[tuple[str, ...]] = ("why", "stage", "reached", "usages", "motion", "notes", "decisions", "analysis")

    @property
    def grasp(self) -> Grasp:
        """The grasp that was planned on."""
        return self.analysis.grasp

    def __repr__(self) -> str:
        """Return the reason."""
        return f"Unknown({shortened(self.why, LONG)})"


Outcome = Plan | Infeasible | Unknown
