"""Margins as text: how sure a grasp is, and how far its numbers may go."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from synergrip.documents.quantities import SHOWN_IN, plain
from synergrip.margin.direct_number import DirectNumber
from synergrip.margin.found import Margins
from synergrip.margin.measures import Measure
from synergrip.planning.told import notes_together
from synergrip.problems.problem import Problem
from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_cases import case_table, guaranteed_margin
from synergrip.reports.text.text_disturbances import disturbance_lines, quality_lines
from synergrip.reports.text.text_on_request import attained_cells, several_lines
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
    slip = found.measures["slip margin"].worst
    who = "the linear model of the start posture" if plan.executed is None else "the hand that moves"
    head = [
        *problem_lines(problem), "",
        f"{verdict_word(plan.verdict, color)}  smallest slip margin {_value(found.measures['slip margin'])} "
        f"({slip.name}, t = {slip.time_s:.2f} s){guaranteed_margin(plan)}",
    ]  # fmt: skip
    parts = [head, [f"How sure it is: the worst of all knots, of {who}", _measures(found)], *_parts(found, whole=whole)]
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
        yield [*_numbers(found)]
    for name, several in found.on_request.items():
        yield [*several_lines(name, several)]
    if found.disturbance is not None:
        yield [*disturbance_lines(found.disturbance)]
    if found.quality is not None:
        yield [*quality_lines(found.quality)]
    if found.sensitivities is not None:
        yield [*sensitivity_lines(found.sensitivities, found.plan.grasp, whole=whole)]


def _measures(found: Margins) -> str:
    rows = []
    for name, each in found.measures.items():
        worst = each.worst
        linear = () if found.linear is None else (_value(found.linear[name]),)
        rows.append((name, _value(each), f"{worst.name}, t = {worst.time_s:.2f} s", *linear, each.formula))
    linear = () if found.linear is None else ("linear model",)
    return table(("", "worst", "at", *linear, "formula"), rows)


def _cases(found: Margins) -> Iterator[str]:
    """Yield in which cases of what the task allows for the slip margin is smallest."""
    cases = found.plan.cases
    yield f"What is allowed for: the smallest slip margins of {len(cases)} cases"
    yield table(("slip margin", "at", "case"), case_table(cases))


def _value(measure: Measure) -> str:
    value = measure.worst.value
    if np.isfinite(value):
        return f"{plain(value if abs(value) > ROUNDING else 0.0)} {measure.unit}".strip()
    return "none would do" if measure.most_is_worst else "no friction is needed"


def _numbers(found: Margins) -> Iterator[str]:
    """Yield the numbers that there are, and why there are no others."""
    there = [each for each in found.direct.values() if each.value is not None]
    if there:
        yield "How far it may go, each of these by itself"
        yield table(("", "attained", "end", "with"), [_row(each) for each in there])
        for why in dict.fromkeys(each.why for each in there):
            names = ", ".join(ASKS[each.name][0] for each in there if each.why == why)
            yield from wrapped("         ", f"{names}: {why}")
    for each in found.direct.values():
        if each.value is None:
            yield from wrapped("         ", f"{ASKS[each.name][0]}: {each.why}")


def _row(number: DirectNumber) -> tuple[str, ...]:
    return attained_cells(ASKS[number.name][0], number, lambda value: _with_unit(number, value))


def _with_unit(number: DirectNumber, value: float) -> str:
    factor, unit = SHOWN_IN.get(number.unit, (1.0, number.unit))
    if number.unit == "kg" and value < 1:
        factor, unit = 1e3, "g"
    return f"{plain(factor * value, 5)} {unit or ASKS[number.name][1]}".strip()
