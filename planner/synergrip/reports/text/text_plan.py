"""A planning outcome as text for people."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import compress
from pathlib import Path

import numpy as np

from synergrip.conic.decide import Decision
from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.limit import first_largest
from synergrip.equilibrium.execution import Execution
from synergrip.errors import Issue
from synergrip.explain.explanation import Explanation
from synergrip.linalg import Array
from synergrip.planning.in_cases import ALL_CASES
from synergrip.planning.outcome import BETWEEN, Infeasible, Outcome, Plan, Unknown
from synergrip.planning.told import notes_together
from synergrip.problems.problem import Problem
from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_between import between_lines
from synergrip.reports.text.text_cases import case_lines, guaranteed_margin
from synergrip.reports.text.text_no import HEADS, more_lines, no_lines
from synergrip.reports.text.text_problem import many, problem_lines
from synergrip.reports.text.text_usages import on_bound, used_rows

_STYLES = {
    "feasible": "\x1b[1;32m", "infeasible": "\x1b[1;31m", "unknown": "\x1b[1;33m", "this plan fails": "\x1b[1;31m",
}  # fmt: skip
_END = "\x1b[0m"
STAY = "contacts stay where they are on link and object"
ROUNDING = 1e-9
"""A motion this small beside the length of the grasp is rounding."""


def outcome_text(
    problem: Problem, outcome: Outcome, folder: Path, written: Sequence[str] | None, color: bool = False
) -> str:
    """Return the answer: what was read, asked, solved, checked; the verdict; what was written, None if that failed."""
    if written is None:
        return "\n".join(verdict_lines(problem, outcome, color))
    number = outcome.exit_code if isinstance(outcome, Plan) else outcome.explanation.exit_code(outcome.exit_code)
    code = f"      exit code {number}" if number else ""
    wrote = (f"wrote {folder}/  " + "  ".join(written) if written else "wrote nothing") + code
    return "\n".join([*verdict_lines(problem, outcome, color), "", wrote])


def explanation_text(problem: Problem, outcome: Outcome, known: Explanation | None, color: bool = False) -> str:
    """Return why there is no plan, all that is known of it; of a plan that there is one."""
    if isinstance(outcome, Plan):
        word = verdict_word(outcome.verdict, color)
        return "\n".join([*problem_lines(problem), "", f"{word}  there is a plan; nothing is to be explained"])
    return "\n".join(verdict_lines(problem, outcome, color, known))


def verdict_lines(
    problem: Problem, outcome: Outcome, color: bool = False, known: Explanation | None = None
) -> list[str]:
    """Return what was read, asked, solved and checked, the verdict and its notes; of a no what is known of it."""
    word = verdict_word(outcome.verdict, color)
    lines = [*problem_lines(problem), *_solved(outcome.decisions)]
    if isinstance(outcome, Plan):
        lines += [_checked(outcome), *_executed(outcome), *between_lines(outcome), *case_lines(outcome), ""]
        lines += _feasible(outcome, word)
    elif isinstance(outcome, Infeasible):
        lines += [*_proof(outcome), "", *_infeasible(problem, outcome, known or outcome.explanation, word)]
    else:
        lines += ["", *wrapped(f"{word}  ", outcome.why), *_used(outcome)]
        lines += more_lines(known or outcome.explanation, outcome.task.times, placed(problem))
    notes = notes_together(outcome.notes, problem.notes)
    lines += [line for note in notes for line in wrapped("note     ", note)]
    if outcome.analysis is not None and outcome.analysis.spaces.ambiguous:
        lines += ["", "note     a singular value lies in the grey zone of the rank decision; see synergrip analyse"]
    return lines


def _solved(decisions: Sequence[Decision]) -> Iterator[str]:
    for i, decision in enumerate(decisions):
        program, solution = decision.program, decision.solution
        cones = sum(block.cones for block in program.blocks)
        tries = f", {decision.attempts} attempts" if decision.attempts > 1 else ""
        yield (
            ("solve    " if i == 0 else "         ")
            + f"{decision.goal}: {many(len(program.q), 'variable')}, {many(cones, 'cone')}, "
            f"{solution.solver}: {solution.claim} in {many(solution.iterations, 'iteration')}, "
            f"{1e3 * decision.seconds:.2g} ms{tries}"
        )


def _checked(plan: Plan) -> str:
    certificates = [decision.certificate for decision in plan.decisions]
    cones, gap = (max(getattr(each, name) for each in certificates) for name in ("primal_residual", "gap"))
    missing = [decision.goal for decision in plan.decisions if not decision.optimal]
    verified = f"not of {', '.join(missing)}" if missing else "✓"  # then a note says what that means
    parts = [f"certificate {verified} (cones {cones:.0e}, gap {gap:.0e})"]
    there = [check for check in plan.checks if plan.executed is not None and check.name.startswith(BETWEEN)]
    cases = [check for check in plan.checks if check.name.startswith(ALL_CASES)]
    parts += [f"{check.name} {check.error:.0e} ✓" for check in plan.checks if check not in (*there, *cases)]
    named = ((BETWEEN, there), (ALL_CASES, cases))
    parts += [f"{name} {many(len(each), 'check')} ✓" for name, each in named if each]
    return "check    " + " · ".join(parts[:3]) + "\n         " + " · ".join(parts[3:])


def _used(outcome: Unknown) -> Iterator[str]:
    """Yield what references use of every limit at the true states, when these are no plan, and at which knots."""
    executed, motion = outcome.executed, outcome.motion
    if executed is None or motion is None:
        return
    count, whole, last = len(motion.times), len(outcome.task.times), f"t = {motion.times[-1]:.3g} s"
    at = f"all {many(whole, 'knot')}" if count == whole else f"the first {count} of {whole} knots, until {last}"
    at = f"the first of {whole} knots, {last}" if count == 1 < whole else at
    told = f"the figures are those of the hand that moves, at {at}; {_model(executed)}; {_held_with(executed)}"
    yield from wrapped("true     ", told)
    yield table(("", "worst", "at", "limit"), used_rows(outcome.usages, motion, outcome.task, outcome.grasp))


def _executed(plan: Plan) -> Iterator[str]:
    """Yield what the figures are those of: the hand that moves, or the linear model of given matrices."""
    if plan.executed is None:
        told = "not executed: matrices have no kinematics, and the figures are those of their linear model"
    else:
        how = f"linearised anew {many(plan.passes, 'time')} along the motion" if plan.passes else "planned at its start"
        if (first := plan.first_passes) is not None:
            how += f", after {many(first.passes, 'time')} at {first.knots} of its knots"
        told = (
            f"the figures are those of the hand that moves, {how}; {_model(plan.executed, _if_fixed(plan.fixed))}; "
            f"{_held_with(plan.executed)}"
        )
    yield from wrapped("true     ", told)


def _held_with(executed: Execution) -> str:
    """Return how stiffly the object is held."""
    return f"the object is held with {1e-3 * float(executed.stiffness.min()):.3g} N/mm at least"


def _model(executed: Execution, otherwise: str = "") -> str:
    """Return how contacts move; of pads that roll also what is known otherwise, in brackets."""
    own = executed.setting
    radii = sorted(1e3 * touch.pad.radius for touch in compress(own.held.touches, own.rolls))
    contacts = zip(own.grasp.contacts, own.held.touches, strict=True)
    flat = any(touch.pad.radius and contact.kind.lies_flat for contact, touch in contacts)
    if not radii:
        return f"{STAY} (patches lie flat, also where pads are round)" if flat else STAY
    size = f"{radii[0]:.3g}" if radii[0] == radii[-1] else f"{radii[0]:.3g} to {radii[-1]:.3g}"
    return f"pads of {size} mm radius roll{', and patches lie flat' if flat else ''}{otherwise}"


def _if_fixed(fixed: Execution | None) -> str:
    """Return what it would cost if pads did not roll."""
    if fixed is None:
        return ""
    other = f"it would keep {fixed.margins.min():.4g} N" if fixed.whole else "it would not get through"
    return f" (if they stayed where they are {other})"


def _feasible(plan: Plan, word: str) -> Iterator[str]:
    k, i = plan.usages[0].worst()
    contact, time = plan.analysis.grasp.contacts[i].name, plan.motion.times[k]
    best = "" if plan.largest_margin is None else f", the largest {_largest_of(plan)}"
    worst = on_bound(plan.usages[0], k, i, plan.task.margin)
    head = f"{word}  smallest slip margin {worst:.4g} N ({contact}, t = {time:.2f} s){guaranteed_margin(plan)}"
    yield f"{head}{best}"
    rows = used_rows(plan.usages, plan.motion, plan.task, plan.grasp)
    scale = plan.analysis.response.scale
    motions = [("elastic motion", plan.elastic_motion), ("sag under load", plan.motion.sag)]
    for name, motion in motions[any(isinstance(limit, ElasticMotion) for limit in plan.task.limits) :]:
        rows.append(_largest_motion(name, np.linalg.norm(scale.twist(motion), axis=1), plan))
    yield table(("", "worst", "at", "limit"), rows)


def _largest_of(plan: Plan) -> str:
    """Return among what a margin is the largest."""
    if plan.executed is not None:
        told = "found along the motion" if plan.passes else "of the start posture, executed"
        return f"{told}, as stated" if plan.cases else told
    held = plan.task.between == "hold" and plan.between is not None and not plan.between.exact
    held = held or (plan.task.allowed is not None and plan.task.allowed.reserves)
    return "there is with the reserve" if held else "there is"  # the program asks for more where a load is curved


def _largest_motion(name: str, sizes: Array, plan: Plan) -> tuple[str, ...]:
    """Return a row for the largest of motions (T,) [m]; one that is rounding has no time at which it is largest."""
    if sizes.max(initial=0.0) < ROUNDING * plan.analysis.response.scale.length:
        return name, "0 mm", "", ""
    at = first_largest(sizes[:, None], 1e-6 * float(sizes.max()))[0]
    return name, f"{1e3 * sizes[at]:.3g} mm", f"t = {plan.motion.times[at]:.2f} s", ""


def _proof(outcome: Infeasible) -> Iterator[str]:
    """Yield that the proof was re-checked, and on a hand what it is about."""
    c = outcome.certificate
    told = f"proof re-checked: ‖Aᵀy‖ {c.primal_residual:.0e}, bᵀy + |Aᵀy|·box = {c.gap:.3g} < 0, y in the dual cone"
    if outcome.refusal is not None:
        told = f"proof re-checked from the grasp's matrices (leak {c.primal_residual:.0e})"
    yield f"check    {told}"
    if outcome.grasp.held is not None:
        yield "         it is about the linear model at the start posture: contacts, G and J stay as they are there"


def _infeasible(problem: Problem, outcome: Infeasible, known: Explanation, word: str) -> Iterator[str]:
    yield f"{word}  {HEADS[outcome.stage]} (stage: {outcome.stage})"
    yield from no_lines(known, outcome.task.times, placed(problem))
    for hint in outcome.hints:
        yield from wrapped("Hint     ", hint)


def placed(problem: Problem) -> Callable[[str], str]:
    """Return what says where in the file of a problem a key stands; empty where it does not."""

    def place(key: str) -> str:
        found = problem.document.locate(Issue("", key=key))
        if not found.file:
            return ""
        stands = found.source and key.rsplit(".", 1)[-1] in found.source
        return found.file if found.file.startswith("--set") else f"line {found.line}" if stands else ""

    return place


def verdict_word(verdict: str, color: bool) -> str:
    """Return the verdict, in its colour when `color`."""
    return f"{_STYLES[verdict]}{verdict}{_END}" if color else verdict


def refused_lines(word: str, stage: str, why: str) -> Iterator[str]:
    """Yield the verdict with what the stage means, and the reason."""
    yield f"{word}  {HEADS.get(stage, stage)} (stage: {stage})"
    yield from wrapped("Why      ", why)
