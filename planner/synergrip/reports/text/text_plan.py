"""A planning outcome as text for people."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import compress
from pathlib import Path
from shlex import quote
from typing import TYPE_CHECKING

from synergrip.documents.quantities import plain
from synergrip.equilibrium.execution import Execution
from synergrip.errors import Issue
from synergrip.planning.outcome import Infeasible, Outcome, Plan, Unknown
from synergrip.planning.told import notes_together
from synergrip.problems.in_short import many
from synergrip.problems.problem import Problem
from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_between import between_lines, tolerated
from synergrip.reports.text.text_cases import case_lines, guaranteed_margin
from synergrip.reports.text.text_checked import checked_lines, proof_lines, solved_lines
from synergrip.reports.text.text_moved import moved_lines
from synergrip.reports.text.text_problem import command_of, problem_lines
from synergrip.reports.text.text_usages import STAR, on_bound, used_rows
from synergrip.statics.twists import describe_kind

if TYPE_CHECKING:
    from synergrip.explain.explanation import Explanation

_STYLES = {
    "feasible": "\x1b[1;32m", "infeasible": "\x1b[1;31m", "unknown": "\x1b[1;33m", "this plan fails": "\x1b[1;31m",
}  # fmt: skip
_END = "\x1b[0m"
HEADS = {
    "restraint": "the object is not held", "count": "too many motions for the synergies",
    "direction": "out of reach of these synergies", "magnitude": "limits too tight",
}  # fmt: skip
"""Stage -> what it means."""
STAY = "contacts stay where they are on link and object"


def outcome_text(
    problem: Problem,
    outcome: Outcome,
    folder: Path,
    written: Sequence[str] | None,
    color: bool = False,
    *,
    details: bool = False,
) -> str:
    """Return the answer: what was read, asked, solved, checked; the verdict; what was written, None if that failed."""
    lines = verdict_lines(problem, outcome, color, details=details)
    if written is None:
        return "\n".join(lines)
    number = outcome.exit_code if isinstance(outcome, Plan) else outcome.explanation.exit_code(outcome.exit_code)
    code = f"      exit code {number}" if number else ""
    wrote = (f"wrote {folder}/  " + "  ".join(written) if written else "wrote nothing") + code
    return "\n".join([*lines, "", wrote])


def explanation_text(
    problem: Problem, outcome: Outcome, known: Explanation | None, color: bool = False, *, details: bool = False
) -> str:
    """Return why there is no plan, all that is known of it; of a plan that there is one."""
    if isinstance(outcome, Plan):
        word = verdict_word(outcome.verdict, color)
        return "\n".join([*problem_lines(problem), "", f"{word}  there is a plan; nothing is to be explained"])
    return "\n".join(verdict_lines(problem, outcome, color, known, details=details))


def verdict_lines(
    problem: Problem,
    outcome: Outcome,
    color: bool = False,
    known: Explanation | None = None,
    *,
    details: bool = False,
) -> list[str]:
    """Return what was read, asked, solved and checked, the verdict and its notes; of a no what is known of it.

    Args:
        problem: what was asked.
        outcome: what came of it.
        color: whether the verdict has its colour.
        known: of a no, where more is known than it says by itself.
        details: whether every program and every check has a line.
    """
    word = verdict_word(outcome.verdict, color)
    lines = [*problem_lines(problem), *solved_lines(outcome.decisions, details=details)]
    if isinstance(outcome, Plan):
        lines += [*checked_lines(outcome, details=details), *_executed(outcome), *between_lines(outcome)]
        lines += [*case_lines(outcome), "", *_feasible(outcome, word, details=details)]
    elif isinstance(outcome, Infeasible):
        lines += [
            *proof_lines(outcome, details=details),
            "",
            *_infeasible(problem, outcome, known or outcome.explanation, word),
        ]
    else:
        from synergrip.reports.text.text_no import more_lines

        lines += ["", *wrapped(f"{word}  ", outcome.why), *_used(outcome)]
        lines += more_lines(
            known or outcome.explanation, outcome.task.times, placed(problem), command_of("explain", problem)
        )
    notes = notes_together(outcome.notes, problem.notes)
    lines += [line for note in notes for line in wrapped("note     ", note)]
    if outcome.analysis is not None and outcome.analysis.spaces.ambiguous:
        lines += ["", "note     a singular value lies in the grey zone of the rank decision; see synergrip analyse"]
    return lines


def _used(outcome: Unknown) -> Iterator[str]:
    """Yield what references use of every limit at the true states, when these are no plan, and at which knots."""
    executed, motion, analysis = outcome.executed, outcome.motion, outcome.analysis
    if executed is None or motion is None or analysis is None:
        return
    count, whole, last = len(motion.times), len(outcome.task.times), f"t = {plain(motion.times[-1], 3)} s"
    at = f"all {many(whole, 'knot')}" if count == whole else f"the first {count} of {whole} knots, until {last}"
    at = f"the first of {whole} knots, {last}" if count == 1 < whole else at
    told = f"the figures are those of the hand that moves, at {at}; {_model(executed)}; {_held_with(executed)}"
    yield from wrapped("true     ", told)
    yield table(("", "worst", "at", "limit"), used_rows(outcome.usages, motion, outcome.task, analysis))


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
    """Return how stiffly the object is held, and against which motion."""
    held = f"the object is held with {plain(1e-3 * float(executed.stiffness.min()), 3)} N/mm at least"
    softest = executed.softest
    if softest is None:
        return held
    one = describe_kind(softest[0], executed.setting.length) if len(softest) == 1 else f"{len(softest)} motions alike"
    return f"{held}, against {one}"


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
    other = f"it would keep {plain(fixed.margins.min())} N" if fixed.whole else "it would not get through"
    return f" (if they stayed where they are {other})"


def _feasible(plan: Plan, word: str, *, details: bool) -> Iterator[str]:
    k, i = plan.usages[0].worst()
    contact, time = plan.analysis.grasp.contacts[i].name, plan.motion.times[k]
    best = "" if plan.largest_margin is None else f", the largest {_largest_of(plan)}"
    worst = on_bound(plan.usages[0], k, i, plan.task.margin)
    head = f"{word}  smallest slip margin {plain(worst)} N ({contact}, t = {time:.2f} s){guaranteed_margin(plan)}"
    yield f"{head}{best}"
    rows = used_rows(plan.usages, plan.motion, plan.task, plan.analysis, STAR)
    yield table(("", "worst", "at", "limit"), rows)
    if any(row[-1].endswith(STAR) for row in rows):
        yield from wrapped("*        ", tolerated(plan))
    yield from moved_lines(plan, details=details)


def _largest_of(plan: Plan) -> str:
    """Return among what a margin is the largest."""
    if plan.executed is not None:
        told = "found along the motion" if plan.passes else "of the start posture, executed"
        return f"{told}, as stated" if plan.cases else told
    held = plan.task.between == "hold" and plan.between is not None and not plan.between.exact
    held = held or (plan.task.allowed is not None and plan.task.allowed.reserves)
    return "there is with the reserve" if held else "there is"  # the program asks for more where a load is curved


def _infeasible(problem: Problem, outcome: Infeasible, known: Explanation, word: str) -> Iterator[str]:
    from synergrip.reports.text.text_no import no_lines

    yield f"{word}  {HEADS[outcome.stage]} (stage: {outcome.stage})"
    yield from no_lines(known, outcome.task.times, placed(problem), command_of("explain", problem))
    for hint in outcome.hints:
        yield from wrapped("Hint     ", hint)


def placed(problem: Problem) -> Callable[[str], str]:
    """Return what says where a key is stated: in the file of a problem, or on the command line; empty where not."""

    def place(key: str) -> str:
        found = problem.document.locate(Issue("", key=key))
        if not found.file:
            return ""
        if found.file.startswith("--set "):
            return f"--set {quote(found.file.removeprefix('--set '))} on the command line"
        stands = found.source and key.rsplit(".", 1)[-1] in found.source
        return f"line {found.line} of the file" if stands else ""

    return place


def verdict_word(verdict: str, color: bool) -> str:
    """Return the verdict, in its colour when `color`."""
    return f"{_STYLES[verdict]}{verdict}{_END}" if color else verdict


def refused_lines(word: str, stage: str, why: str) -> Iterator[str]:
    """Yield the verdict with what the stage means, and the reason."""
    yield f"{word}  {HEADS.get(stage, stage)} (stage: {stage})"
    yield from wrapped("Why      ", why)
