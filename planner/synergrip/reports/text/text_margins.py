"""Margins as text: how sure a grasp is, and how far its numbers may go."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from synergrip.documents.quantities import SHOWN_IN, plain
from synergrip.margin.direct_number import DirectNumber
from synergrip.margin.found import Margins
from synergrip.margin.measures import Measure, Worst
from synergrip.planning.told import notes_together
from synergrip.problems.problem import Problem
from synergrip.reports.text.part import Part, part_lines
from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_cases import case_table, guaranteed_margin
from synergrip.reports.text.text_disturbances import disturbance_part, quality_part
from synergrip.reports.text.text_on_request import attained_cells, several_part
from synergrip.reports.text.text_plan import verdict_word
from synergrip.reports.text.text_problem import problem_lines
from synergrip.reports.text.text_sensitivities import sensitivity_lines
from synergrip.reports.text.text_timing import timing_lines

ASKS = {
    "critical_friction_scale": ("how slippery", "times the friction"), "heaviest_kg": ("how heavy", ""),
    "load_factor": ("how much load", "times the load"), "least_peak_N": ("how hard to press", ""),
    "least_effort": ("how hard to pull", ""), "shortest_duration_s": ("how fast", ""),
    "largest_amplitude": ("how far", "times the motion"),
}  # fmt: skip
"""Name of a number -> what it answers, and the words for its unit where it has none."""


ROUNDING = 1e-8
"""[N], degrees or a share below which a margin is none."""


def margins_text(
    problem: Problem, found: Margins, color: bool = False, *, whole: bool = False, written: Path | None = None
) -> str:
    """Return what was asked, every margin where it is worst, and all that is known beside.

    Args:
        problem: what was asked.
        found: of it.
        color: whether the terminal shows colours.
        whole: whether every sensitivity is told, not those worth most alone.
        written: the file with the path of the palm in its fastest timing.
    """
    plan = found.plan
    slip = found.measures["slip margin"]
    least = slip.worst
    who = "the linear model of the start posture" if plan.executed is None else "the hand that moves"
    head = [
        *problem_lines(problem), "",
        f"{verdict_word(plan.verdict, color)}  smallest slip margin {told_value(slip, least.value)} "
        f"({least.name}, t = {least.time_s:.2f} s){guaranteed_margin(plan)}",
    ]  # fmt: skip
    linear = None if found.linear is None else {name: each.worst for name, each in found.linear.items()}
    parts = [head, [*part_lines(measures_part(found.measures, linear, who))], *_parts(found, whole=whole)]
    if found.timing is not None:
        parts.append([*timing_lines(problem, found.timing, written)])
    lines = [line for part in parts for line in (*part, "")][:-1]
    notes = notes_together(plan.notes, problem.notes)
    lines += [line for note in notes for line in wrapped("note     ", note)]
    return "\n".join([*lines, *(["interrupted; these numbers are finished"] if found.interrupted else [])])


def _parts(found: Margins, *, whole: bool) -> Iterator[list[str]]:
    """Yield the lines of each part that is there."""
    if found.plan.cases:
        yield [*_cases(found)]
    if found.direct:
        yield [*part_lines(numbers_part(found.direct))]
    for name, several in found.on_request.items():
        yield [*part_lines(several_part(name, several))]
    if found.disturbance is not None:
        yield [*part_lines(disturbance_part(found.disturbance))]
    if found.quality is not None:
        yield [*part_lines(quality_part(found.quality))]
    if found.sensitivities is not None:
        yield [*sensitivity_lines(found.sensitivities, found.plan.grasp, whole=whole)]


def measures_part(measures: Mapping[str, Measure], linear: Mapping[str, Worst] | None, who: str) -> Part:
    """Return where each measure is worst.

    Args:
        measures: by name.
        linear: where they are worst in the linear model of the start posture, where that is another.
        who: has the measures, in words.
    """
    rows = []
    for name, each in measures.items():
        worst = each.worst
        beside = () if linear is None else (told_value(each, linear[name].value),)
        where = f"{worst.name}, t = {worst.time_s:.2f} s"
        rows.append((name, told_value(each, worst.value), where, *beside, each.formula))
    head = ("", "worst", "at", *(() if linear is None else ("linear model",)), "formula")
    return Part(f"How sure it is: the worst of all knots, of {who}", head, tuple(rows))


def _cases(found: Margins) -> Iterator[str]:
    """Yield in which cases of what the task allows for the slip margin is smallest."""
    cases = found.plan.cases
    yield f"What is allowed for: the smallest slip margins of {len(cases)} cases"
    yield table(("slip margin", "at", "case"), case_table(cases))


def told_value(measure: Measure, value: float) -> str:
    """Return a value of a measure as people read it."""
    if np.isfinite(value):
        return f"{plain(value if abs(value) > ROUNDING else 0.0)} {measure.unit}".strip()
    return "none would do" if measure.most_is_worst else "no friction is needed"


def numbers_part(numbers: Mapping[str, DirectNumber]) -> Part:
    """Return the numbers that there are, where their other ends come from, and why there are no others."""
    there = [each for each in numbers.values() if each.value is not None]
    below = [
        f"{', '.join(ASKS[each.name][0] for each in there if each.why == why)}: {why}"
        for why in dict.fromkeys(each.why for each in there)
    ]
    below += [f"{ASKS[each.name][0]}: {each.why}" for each in numbers.values() if each.value is None]
    title = "How far it may go, each of these by itself" if there else ""
    return Part(title, ("", "attained", "end", "with"), tuple(map(_row, there)), tuple(below))


def _row(number: DirectNumber) -> tuple[str, ...]:
    return attained_cells(ASKS[number.name][0], number, lambda value: _with_unit(number, value))


def _with_unit(number: DirectNumber, value: float) -> str:
    factor, unit = SHOWN_IN.get(number.unit, (1.0, number.unit))
    if number.unit == "kg" and value < 1:
        factor, unit = 1e3, "g"
    return f"{plain(factor * value, 5)} {unit or ASKS[number.name][1]}".strip()
