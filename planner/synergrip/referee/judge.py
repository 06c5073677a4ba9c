"""The referee: a second, independently written formulation, solved through CVXPY.

`solve` answers a question in the place of the direct path and returns multipliers of the program's own rows, so that
the same certificate judges it. `referee` judges a whole task by itself; tests compare plans with it.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from synergrip.conic.formulation import Formulation, Units
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.intersample import Looks
from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.conic.rows import Item
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.errors import InputError, SelfCheckError
from synergrip.linalg import Array, frozen, interpolated
from synergrip.referee.formulas import friction, write_goal, write_limit
from synergrip.referee.maps import mapped
from synergrip.referee.model import Expression, Model, Posed, Written, pose, pose_relaxed, write_model
from synergrip.referee.reserve import cones_of
from synergrip.referee.targets import followed
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import forces_at_start
from synergrip.tasks.timed_task import TimedTask

CLAIMS = {
    "optimal": Claim.OPTIMAL,
    "optimal_inaccurate": Claim.OPTIMAL,
    "unbounded": Claim.UNBOUNDED,
    "unbounded_inaccurate": Claim.UNBOUNDED,
}
"""CVXPY's status -> claim. "Infeasible" is claimed when the relaxed problem, which always has an answer, says so."""

TIGHT: Mapping[str, Mapping[str, float]] = {
    "CLARABEL": {"tol_gap_abs": 1e-10, "tol_gap_rel": 1e-10, "tol_feas": 1e-10},
    "SCS": {"eps_abs": 1e-9, "eps_rel": 1e-9, "max_iters": 200_000},
}
"""Options with which the referee solves; other solvers go by their defaults."""

BAND = 1e-8
"""Relaxation, in force units and shares of a limit, below which feasible and infeasible are too close to tell."""


@dataclass(frozen=True)
class RefereeAnswer:
    """What the referee makes of a task."""

    verdict: str
    """"feasible", "infeasible" or "unknown"."""
    status: str
    """CVXPY's own word, and the least relaxation of all limits with which the task can be done."""
    largest_margin: float | None = None
    """[N] for the goal "margin", whether or not it reaches what the task asks."""
    dz_r: Array | None = None  # (T, n_z)
    objective: float | None = None
    """Margin [N], peak force [N], or sum over knots of squares [N^2], moments and torques over the length."""


def referee(analysis: Analysis, task: TimedTask, cvxpy_solver: str = "CLARABEL") -> RefereeAnswer:
    """Judge a task from the grasp's response and the task alone.

    Args:
        analysis: of the grasp.
        task: with any limits and goal that have a formula.
        cvxpy_solver: name of a conic solver that CVXPY knows.

    Raises:
        NotWrittenError: the task has a limit of a type that has no formula.
    """
    task = task.on(analysis.grasp)
    beta, basis, wanted = followed(analysis, task)
    if beta is None:
        return RefereeAnswer("infeasible", "the wanted motion leaves Gamma_ucs")
    unit, options = _force_unit(analysis, task), TIGHT.get(cvxpy_solver, {})
    model = write_model(
        analysis.response, analysis.coordinates, times=task.times, wrench=task.wrench, beta=beta,
        beta_basis=basis, target=wanted, rigid_basis=analysis.spaces.Gamma_ucs,
        units=Units(unit, 1.0), redundancy=task.watches_references,
    )  # fmt: skip
    limits = [cone for limit in task.kept for cone in write_limit(model, limit)]
    asked = [*limits, *friction(model, task.margin / unit)]
    relaxed, objective, largest = pose_relaxed(model, asked), write_goal(model, task.goal), None
    relaxed.run(cvxpy_solver, options)
    relaxation = relaxed.value if relaxed.solved else np.nan
    if isinstance(task.goal, LargestMargin):
        free = pose(model, objective.cost, [*limits, *objective.cones])
        free.run(cvxpy_solver, options)
        largest = -free.value * unit if free.solved else None
    best = pose(model, objective.cost, [*asked, *objective.cones])
    status = best.run(cvxpy_solver, options)
    verdict, status = _verdict(status, relaxation), f"{status}, relaxation {relaxation:.3g}"
    if verdict != "feasible" or not best.solved:
        return RefereeAnswer(verdict, status, largest)
    return RefereeAnswer(verdict, status, largest, frozen(model.dz_r.value), _physical(task, best.value, unit))


def _force_unit(analysis: Analysis, task: TimedTask) -> float:
    """Return the largest contact force that the load causes by itself, or the margin, or 1 N."""
    response = analysis.response
    passive = forces_at_start(response) + (task.wrench - analysis.grasp.w_0) @ response.dlambda_dw.T
    return max(float(np.abs(passive * response.scale.force).max(initial=0.0)), task.margin) or 1.0


def _verdict(status: str, relaxed: float) -> str:
    """Believe the relaxation, unless it is within the band or the solver's clear word contradicts it."""
    if relaxed < -BAND and status != "infeasible":
        return "feasible"
    if relaxed > BAND and status != "optimal":
        return "infeasible"
    return "unknown"


def _physical(task: TimedTask, value: float, unit: float) -> float:
    if not task.goal.has_scalar:
        return 2 * value * unit**2
    return -value * unit if isinstance(task.goal, LargestMargin) else value * unit


def solve(question: Question, program: Program, settings: Settings) -> Solution:
    """Answer a question by the second formulation, in the coordinates and with the multipliers of `program`.

    Args:
        question: limits and goal over a formulation.
        program: the program that the direct path built of it; only the names of its rows are read.
        settings: how hard to try.

    Raises:
        NotWrittenError: a limit or the goal is of a type that has no formula.
        InputError: the task allows for more than it states.
    """
    formulation = question.formulation
    if formulation.allowed is not None:
        message = "the solver 'cvxpy' writes down what a task states, and nothing that it allows for beside that"
        raise InputError.at("Task.allow", f"{message}; leave one of them out")
    knots = Looks(formulation.times, formulation.wrench, formulation.target)
    model = _written(formulation, knots, _references(formulation))
    objective, limits, inside = cones_of(question, model, partial(_written, formulation))
    cost = objective.cost / (formulation.divisor * question.worth) if objective.scalar is None else objective.cost
    posed = pose(model, cost, [*limits, *objective.cones, *inside.limits, *inside.objective], inside.same)
    status = posed.run("CLARABEL", _options(settings))
    claim, iterations, seconds = CLAIMS.get(status, Claim.NOTHING), posed.iterations, posed.seconds
    if claim is Claim.NOTHING:
        # the goal's scalar has no say in feasibility
        posed = pose_relaxed(model, [*limits, *inside.limits])
        posed.run("CLARABEL", _options(settings))
        claim = Claim.INFEASIBLE if posed.solved and posed.value > 0 else Claim.NOTHING
        iterations, seconds = iterations + posed.iterations, seconds + posed.seconds
    x, z = np.zeros(len(program.q)), np.zeros(len(program.b))
    if posed.solved:
        x, z = _unknowns(program, formulation, model, objective), _multipliers(program, posed)
    return Solution(claim, frozen(x), frozen(z), _name(), status, iterations, seconds)


def _written(formulation: Formulation, looks: Looks, references: Expression | None) -> Model:
    """Write the formulation down at the knots, or at other instants, where beta is on straight lines between them."""
    whole = formulation.whole
    return write_model(
        formulation.response, formulation.coordinates, times=looks.times, wrench=looks.wrench,
        beta=interpolated(looks.times, formulation.times, whole.beta.constant), units=formulation.units,
        redundancy=whole.frees_gamma, beta_basis=formulation.beta_basis, target=looks.target,
        rigid_basis=formulation.map_of(lambda at: at.spaces.Gamma_ucs), references=references,
        stated=formulation.stated, each=formulation.each or (),
    )  # fmt: skip


def _references(formulation: Formulation) -> Expression | None:
    """Return the references as far as earlier goals have left them open; None when none has determined anything."""
    import cvxpy as cp

    if formulation.unreduced is None:
        return None
    matrix, constant = formulation.reference.matrix, formulation.reference.constant
    free = formulation.free_basis @ cp.Variable(formulation.unknowns)
    return constant + mapped(matrix, cp.reshape(free, (formulation.knots, formulation.n_v), order="C"))


def _unknowns(program: Program, formulation: Formulation, model: Model, objective: Written) -> Array:
    """Return x (n,) of the references found."""
    reference = formulation.reference
    missing = model.dz_r.value - reference.constant
    if reference.matrix.ndim == 2:
        v = np.linalg.lstsq(reference.matrix, missing.T, rcond=None)[0].T
    else:
        pairs = zip(reference.matrix, missing, strict=True)
        v = np.array([np.linalg.lstsq(matrix, row, rcond=None)[0] for matrix, row in pairs])
    return program.solution(v, None if objective.scalar is None else objective.scalar.value)


def _multipliers(program: Program, posed: Posed) -> Array:
    """Return z (m,) in the program's order, matched by key and item; 0 for rows that were not posed."""
    found: dict[tuple[str, Item], list[Array]] = defaultdict(list)
    for cone, constraint in posed.pairs:
        for item, values in cone.multipliers(constraint):
            found[cone.key, item].append(values)
    z = np.zeros(len(program.b))
    for block, rows in program.slices():
        nothing = np.zeros((block.knots, block.dim))
        # a key that two limits share is served in the order of the limits
        parts = [found[block.limit, item].pop(0) if found[block.limit, item] else nothing for item in block.items]
        if parts:
            z[rows] = np.stack(parts, axis=1).ravel()
    left = [f"{key} of {item}" for (key, item), values in found.items() if values]
    if left:
        raise SelfCheckError(f"the program has no rows for {', '.join(left)}; the two formulations differ")
    return z


def _options(settings: Settings) -> Mapping[str, float]:
    """Return the settings in the words of CVXPY's interface to Clarabel."""
    tolerances = ("tol_gap_abs", "tol_gap_rel", "tol_feas", "tol_infeas_abs", "tol_infeas_rel")
    return dict.fromkeys(tolerances, settings.tolerance) | {
        "max_iter": settings.max_iterations,
        "equilibrate_enable": settings.equilibrate,
        "static_regularization_constant": settings.regularisation,
        "max_step_fraction": settings.step,
    }


def _name() -> str:
    from importlib.metadata import version

    return f"CVXPY {version('cvxpy')} with Clarabel {version('clarabel')}"
