"""From unknowns to a plan, and the plan judged as physics: nothing here looks at the program."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from synergrip.conic.arguments import is_own
from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.conic.well_formed import usage_of
from synergrip.documents.quantities import in_mm
from synergrip.errors import InputError, Issue, SelfCheckError, SynergripError
from synergrip.linalg import Array, largest_size, sealed
from synergrip.planning.accuracy import InDoubtError, accuracy_notes, refuse_doubtful_forces, response_check
from synergrip.planning.between import LIMIT, Between, between
from synergrip.planning.free import free_notes
from synergrip.planning.in_cases import case_checks, in_cases, limits_of_cases
from synergrip.planning.let_go import ranges_left, undone_notes
from synergrip.planning.outcome import Check, Plan
from synergrip.planning.stages import Stage
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import Motion, forces_at_start, forward, largest_term
from synergrip.tasks.timed_task import TimedTask

EXACT = 1e-8
"""Relative tolerance of the identities: equilibrium, internal force, forward maps."""
FAR = 0.05
"""Displacement, relative to the grasp's length, from which on contacts and Jacobians are no longer where they were."""
PASSED_OVER = 0.1
"""Share of the wanted motion that happens between knots, from which on a plan is hardly its plan."""
DIGITS = 1e-3
"""Relative excess of a limit up to which a verified program may have been too imprecise, and no formula is wrong."""
OF_FORCES = 1e-5
"""The same of a limit on forces, as a share of the largest of them."""
EQUILIBRIUM = "equilibrium"
"""How the check is called that forces balance the load."""


def verified_plan(task: TimedTask, analysis: Analysis, stage: Stage, largest: float | None) -> Plan:
    """Return the plan that the goals have led to.

    Raises:
        InDoubtError: its forces, or the digits of its program, do not suffice to tell whether limits hold.
        InputError: a limit of a user's own contradicts itself.
        SelfCheckError: a check of the plan fails.
    """
    formulation = stage.formulation
    alpha, beta, gamma = formulation.parts(stage.v)
    references = np.concatenate([alpha, beta, gamma], axis=1) @ analysis.coordinates.inverse.T
    motion = forward(analysis.response, task.times, references, task.wrench)
    usages = limit_usages(task, formulation, motion)
    exact = identities(analysis, motion, (alpha, beta, gamma))
    refuse_doubtful_forces(analysis.response, exact)
    checks = (*exact, *limit_checks(usages))
    found = between(task, analysis, formulation, motion, usages)
    checks += between_checks(task, found)
    cases = in_cases(task, analysis, formulation, motion.dz_r)
    checks += case_checks(cases, LIMIT)
    if not all(check.passed for check in checks):
        there = found.usages if found is not None and task.between == "hold" else ()
        of_instants, of_cases = task.of_instants, limits_of_cases(task)
        asked = [*zip(task.all_limits, usages, strict=True), *zip(of_instants, there, strict=bool(there))]
        asked += [pair for case in cases for pair in zip(of_cases, case.usages, strict=True)]
        raise _failed(checks, exact, asked, analysis.response.scale.largest_force(motion.forces))
    rigid = beta @ analysis.spaces.Gamma_ucs.T
    return Plan(
        task, analysis, formulation.whole, motion, sealed(alpha), sealed(beta), sealed(gamma),
        sealed(motion.du - motion.sag - rigid), usages[0].value, usages, checks, stage.decisions, largest,
        (*free_notes(analysis), *accuracy_notes(analysis.response), *undone_notes(analysis, task), *stage.notes,
         *ranges_left(task, analysis.grasp, motion.dq), *_far(analysis, motion), *passed_over(found),
         *analysis.frame_notes), found,
        interrupted=stage.interrupted, cases=cases,
    )  # fmt: skip


def _failed(
    checks: Sequence[Check], exact: Sequence[Check], asked: Sequence[tuple[Limit, Usage]], largest: float
) -> SynergripError:
    """Return the error of failed checks: a doubt when it is only that the program's digits do not suffice for a limit.

    A limit of a user's own says by its `usage` what its `rows` do not: that is a mistake in it, and none of synergrip.

    Args:
        checks: all of them.
        exact: those among them that no digits of a program excuse.
        asked: the limits that count, each with what the plan uses of it.
        largest: component of all contact forces [N]; the program knows none better than to a share of it.
    """
    failed = (check for check in checks if not check.passed)
    said = "; ".join(f"{check.name}: {check.error:.2e} exceeds {check.tolerance:.0e}" for check in failed)
    beyond = [(limit, u) for limit, u in asked if u.violation > LIMIT]
    rough = all(u.violation < DIGITS or (u.unit == "N" and u.excess.max() < OF_FORCES * largest) for _, u in beyond)
    if all(check.passed for check in exact):
        if rough:
            return InDoubtError(f"the plan that was found misses limits by more than their tolerance ({said})")
        if all(is_own(type(limit)) for limit, _ in beyond):
            return InputError([_contradiction(limit, usage) for limit, usage in beyond])
    return SelfCheckError(f"the plan fails its own check ({said}); please report this problem")


def _contradiction(limit: Limit, usage: Usage) -> Issue:
    """Return what to compare in a limit of a user's own."""
    name, (k, i) = type(limit).__name__, usage.worst()
    value, bounds = f"{usage.value[k, i]:.6g}", f"{usage.lower[i]:.6g} to {usage.upper[i]:.6g} {usage.unit}".rstrip()
    message = (
        f"contradicts {name}.rows: of a plan that keeps the rows it says that '{usage.items[i]}' is {value} at t = "
        f"{usage.times[k]:.6g} s, allowed {bounds}. Compare the two: the same rows of lambda (or joints, synergies), "
        "the same signs and units, the same bounds, and rows for every item"
    )
    return Issue(message, key=f"{name}.usage")


def _far(analysis: Analysis, motion: Motion) -> Iterator[str]:
    """Yield a note when the object moves so far that the linear model of given matrices is no more than a guess."""
    if analysis.grasp.held is not None:
        return
    scale = analysis.response.scale
    size = float(np.linalg.norm(scale.twist(motion.du), axis=1).max(initial=0.0))
    if size > FAR * scale.length:
        yield (
            f"the object moves by up to {in_mm(size)}, {size / scale.length:.0%} of the size of the grasp "
            f"({in_mm(scale.length)}): the linear model is a first guess there"
        )


def passed_over(between: Between | None) -> Iterator[str]:
    """Yield a note when the knots are so far apart that the plan passes over a good part of the wanted motion."""
    if between is not None and between.path_departure > PASSED_OVER * between.path_size:
        size, departure = (f"{in_mm(value)}" for value in (between.path_size, between.path_departure))
        yield (
            f"between its knots the plan goes straight where the wanted motion, of up to {size}, bends by up to "
            f"{departure}: more knots follow it more closely"
        )


def limit_usages(task: TimedTask, formulation: Formulation, motion: Motion) -> tuple[Usage, ...]:
    """Return what a motion uses of every limit of a task, friction cones first."""
    return tuple(usage_of(limit, formulation, motion) for limit in task.all_limits)


def limit_checks(usages: tuple[Usage, ...]) -> tuple[Check, ...]:
    """Return one check per limit: the largest excess, relative to the limit's size, or to the load it carries."""
    return tuple([Check(u.title, max(u.violation, 0.0), LIMIT) for u in usages])


def between_checks(task: TimedTask, between: Between | None) -> tuple[Check, ...]:
    """Return the check of the limits between the knots, when a task holds them there."""
    if between is None or task.between != "hold":
        return ()
    return (Check("between the knots", max(between.excess, 0.0), LIMIT),)


def identities(analysis: Analysis, motion: Motion, wanted: tuple[Array, Array, Array]) -> tuple[Check, ...]:
    """Return the checks of equilibrium (7), internal force (13), the forward maps of Theorem 1 (35), the response.

    Args:
        analysis: of the grasp.
        motion: what the references do.
        wanted: alpha, beta, gamma that the references are meant to produce.
    """
    response, coordinates, G = analysis.response, analysis.coordinates, analysis.grasp.G
    start = forces_at_start(response) + (motion.wrench - analysis.grasp.w_0) @ response.dlambda_dw.T
    change, whole = motion.forces - start, np.concatenate(wanted, axis=1)
    balance = response.scale.wrench(motion.forces @ G.T + motion.wrench)
    internal = response.scale.wrench(change @ G.T)
    forces, terms = response.scale.largest_force(motion.forces), largest_term(response, motion.dz_r)
    size = max(forces, response.scale.largest_force(start), terms, 1e-12)
    expected = whole @ coordinates.inverse.T
    # and so are the coordinates: relative to them M may be as ill-conditioned as the stiffnesses of the grasp
    of_terms = float(np.linalg.norm(motion.dz_r, axis=1).max()) * coordinates.row_sizes
    missed = np.abs(motion.dz_r @ coordinates.M.T - whole).max(axis=0) / np.maximum(of_terms, 1e-300)
    produced = wanted[0] @ analysis.spaces.E_s.T - change
    known = max(EXACT, response.accuracy["dlambda_dzr"].doubt)
    return (
        Check(EQUILIBRIUM, largest_size(balance) / size, EXACT),
        Check("internal force", largest_size(internal) / size, EXACT),
        Check("references", _relative(motion.dz_r - expected, expected), EXACT),
        Check("forward maps", float(missed.max(initial=0.0)), EXACT),
        Check("forces from alpha", response.scale.largest_force(produced) / size, known),
        *response_check(response, motion, forces, terms),
    )


def _relative(difference: Array, reference: Array) -> float:
    size, error = largest_size(reference), largest_size(difference)
    return error / size if size > 0 else error
