"""The program of the largest margin and its answer, sharp enough to be differentiated."""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass, replace

import numpy as np
from scipy import sparse

from synergrip.changes.asked import Asked, Posed
from synergrip.changes.at_a_value import solved
from synergrip.conic.certificate import Certificate, judge_optimal
from synergrip.conic.cones import outside, row_sizes
from synergrip.conic.decide import Decision
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.program import Block, Program
from synergrip.conic.question import Question
from synergrip.conic.rows import Kind
from synergrip.conic.solution import Settings
from synergrip.conic.solvers import clarabel_
from synergrip.errors import SynergripError
from synergrip.linalg import Array
from synergrip.margin.sensitivity.parameters import Parameter
from synergrip.planning.formulated import formulated
from synergrip.planning.instants import intersample_of
from synergrip.planning.solvers import SOLVERS, ask
from synergrip.statics.analysis import analyse
from synergrip.statics.restraint import NO_LOAD
from synergrip.tasks.scaling import caps, grips
from synergrip.tasks.timing import at_start
from synergrip.values import Value

ACTIVE = 1e-5
"""Slack, in the program's units, below which a limit counts as reached."""
SHARP = (1e-12, 1e-11, 1e-10)
"""Tolerances that are tried for an answer that is differentiated; the best of all is taken."""


@dataclass(frozen=True, eq=False, repr=False)
class Optimum(Value):
    """The largest margin of a task in the linear model of the start posture."""

    posed: Posed
    """In the units in which it was solved."""
    counting: frozenset[str]
    """Keys of the limits of which some are reached: the others have no part in derivatives."""
    program: Program
    """With the rows of these limits and of the goal."""
    x: Array
    z: Array
    """(m,) multipliers of these rows; those of all others are 0."""

    @property
    def unit(self) -> float:
        """[N] of the margin in the program."""
        return self.posed.formulation.force_unit

    @property
    def margin(self) -> float:
        """[N]."""
        return float(self.x[-1]) * self.unit


@dataclass(frozen=True, eq=False, repr=False)
class Rows(Value):
    """The rows ``b - A x`` of the program for another value of a number, for unknowns that stay what they mean."""

    A: sparse.csc_matrix
    b: Array


def optimum(posed: Posed) -> Optimum | str:
    """Return the largest margin of a task, or why there is none to be differentiated."""
    goal, kept = LargestMargin(), posed.timed.kept
    sizes = (*grips(posed.formulation), *caps(posed.analysis, posed.timed))
    answered = ask(Question(posed.formulation, kept, goal), SOLVERS["clarabel"], sizes)
    decision, formulation = answered.decision, answered.question.formulation
    if decision.unbounded:
        return "nothing bounds the largest margin: squeezing harder always helps"
    if not decision.optimal:
        return "the largest margin of the start posture was not verified"
    x, z = _sharpest(decision)
    posed = Posed(posed.analysis, posed.timed, formulation)
    return _what_counts(posed, decision.program, x, z)


def _what_counts(posed: Posed, program: Program, x: Array, z: Array) -> Optimum:
    """Return the optimum without the rows of limits that are not reached anywhere."""
    slack = program.b - program.A @ x
    reached = {block.limit for block, rows in program.slices() if _reached(block, slack[rows])}
    keys = frozenset(limit.key for limit in posed.timed.kept if limit.key in reached)
    known = {limit.key for limit in posed.timed.kept}
    kept = [np.full(block.rows, block.limit in keys or block.limit not in known) for block in program.blocks]
    fewer = question(posed, keys).program()
    if len(fewer.b) != np.sum(np.concatenate(kept)):  # rows that do not say of which limit they are
        return Optimum(posed, frozenset(known), program, x, z)
    return Optimum(posed, keys, fewer, x, z[np.concatenate(kept)])


def _reached(block: Block, slack: Array) -> bool:
    """Return whether a slack is on the boundary of any of its cones."""
    return block.kind is Kind.ZERO or bool(np.any(outside(block, slack) >= -ACTIVE))


def _sharpest(decision: Decision) -> tuple[Array, Array]:
    """Return unknowns and multipliers that leave the least open of some solutions."""
    tried = [(decision.certificate, decision.solution)]
    for tolerance in SHARP:
        found = clarabel_.solve(decision.program, Settings(tolerance=tolerance))
        tried.append((judge_optimal(decision.program, found.x, found.z), found))
    _, best = min(tried, key=lambda pair: _left(pair[0]))
    return np.asarray(best.x), np.asarray(best.z)


def _left(certificate: Certificate) -> float:
    return max(certificate.primal_residual, certificate.dual_residual, certificate.gap)


def posed_with(parameter: Parameter, change: float, of: Optimum) -> Posed | str:
    """Return what is asked after a change of a number, in its scale, or why there is no program like the first."""
    known, units = of.posed.analysis, of.posed.formulation.units
    try:
        asked = parameter.turned(change * parameter.scale)
        if parameter.same_task and not parameter.same_statics:
            other: Posed | None = _posed_again(asked, of)
        else:
            other = asked.posed(known if parameter.same_statics else None, units)
    except SynergripError as error:
        return f"it cannot be changed: {error}"
    if other is None:
        return "the task is refused as soon as it changes"
    before, after = known.spaces.dimensions, other.analysis.spaces.dimensions
    if before != after:
        now, then = (" + ".join(map(str, each)) for each in (before, after))
        what = f"{now} directions of force, motion and reconfiguration"
        return f"the synergies control {what}, and {then} as soon as it changes"
    return other


def _posed_again(asked: Asked, of: Optimum) -> Posed:
    """Return what is asked of another grasp with the same loads and limits."""
    timed, formulation = of.posed.timed, of.posed.formulation
    analysis = analyse(at_start(asked.grasp, timed.wrench[0]), NO_LOAD)
    other = formulated(analysis, timed, redundancy=timed.watches_references).in_units(formulation.units)
    held = intersample_of(timed, analysis) if timed.between == "hold" else None
    return Posed(analysis, timed, replace(other, intersample=held))


def rows_with(parameter: Parameter, change: float, of: Optimum) -> Rows | str:
    """Return the program's rows with another value of a number, or why there are none to compare."""
    other = posed_with(parameter, change, of)
    if isinstance(other, str):
        return other
    program = question(other, of.counting).program()
    if program.A.shape != of.program.A.shape or len(program.blocks) != len(of.program.blocks):
        return "limits come to count or no longer count as soon as it changes"
    if not parameter.same_statics:
        turned = _same_meaning(other.formulation, of.posed.formulation)
        program = replace(program, A=sparse.csc_matrix(program.A @ turned))
    sizes = row_sizes(of.program) / row_sizes(program)  # rows may be in units that depend on the number
    return Rows(sparse.csc_matrix(sparse.diags_array(sizes) @ program.A), sizes * program.b)


def question(posed: Posed, keys: Container[str]) -> Question:
    """Return the question of the largest margin within the limits of some keys."""
    limits = tuple(limit for limit in posed.timed.kept if limit.key in keys)
    return Question(posed.formulation, limits, LargestMargin())


def _same_meaning(new: Formulation, old: Formulation) -> sparse.csc_matrix:
    """Return the unknowns that mean of another grasp what those of a grasp mean: forces, motions, references.

    Bases of subspaces are known up to a rotation only; the subspaces themselves go along smoothly.
    """
    maps = []
    for each in (new, old):
        parts = ((each.spaces.E_s, each.alpha), (each.spaces.Gamma_zr, each.gamma), (each.spaces.Gamma_ucs, each.beta))
        maps.append(np.vstack([basis @ part.matrix for basis, part in parts]))
    turned = np.linalg.lstsq(maps[0], maps[1], rcond=None)[0]
    knots = sparse.kron(sparse.eye_array(old.knots), sparse.csr_matrix(turned))
    return sparse.csc_matrix(sparse.block_diag([knots, sparse.eye_array(1)]))


def margin_with(parameter: Parameter, change: float, of: Optimum) -> float | None:
    """Return the largest margin [N] with another value of a number; None where none is verified."""
    other = posed_with(parameter, change, of)
    if isinstance(other, str):
        return None
    whole = Question(other.formulation, other.timed.kept, LargestMargin())
    decision = solved("largest margin", whole.program())
    return float(decision.solution.x[-1]) * other.formulation.force_unit if decision.optimal else None
