"""What one `plan` costs beside the solving alone: ``python tests/benchmarks/one_plan.py [GRASPS] [RUNS]``.

Random grasps given as matrices, with their Analysis at hand, of 3 hard and of 4 soft contacts, as in `many.py`; limits
of cones, normal force and joint torque, at one knot and at 41 under a load that changes. For the largest margin, by
itself and with its tie-break, and for least effort, which leaves nothing open. Tasks that have a plan only.

Prints milliseconds a plan, those of Clarabel as it comes (matrices made, set up and solved to 1e-8, default settings,
one thread) on the programs that the plan was made with, and the ratio: processor times, medians of runs taken in turns.
Then the share of each stage in the plan's time, measured in a run of its own.
"""

from __future__ import annotations

import sys
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import wraps
from importlib import import_module
from typing import Any
from unittest.mock import patch

from many import FORMS, GOALS, MARGIN, in_turns

import numpy as np  # isort: skip - after the threads
from random_cone_problems import grasp_like, random_wrenches
from scipy import sparse

import synergrip as sg
from synergrip.conic.program import Program
from synergrip.conic.solvers.clarabel_ import cones_of

TURNS = {1: 10, 41: 2}
"""Knots, and how many turns each of the RUNS has: as many as a machine that others use, too, asks for."""
ASKED = {**{name: (goal, False) for name, goal in GOALS.items()}, "with tie-break": (GOALS["largest margin"], True)}
"""Goals, and whether what they leave open is settled."""
STAGES = {
    "arguments": ("planning.planning:_judged",),
    "formulation": ("planning.planning:formulated",),
    "assembly": ("conic.question:build",),
    "solver": ("conic.solvers.clarabel_:solve",),
    "certificate": ("conic.decide:judge",),
    "figures": ("planning.first_goal:verified_plan",),
    "doubts": ("planning.planning:grasp_doubts", "planning.planning:task_doubts"),
}
"""Where each stage is entered; its share is without those inside it. What is left is "between them"."""


def cold(program: Program) -> None:
    """Solve a program by Clarabel as it comes."""
    import clarabel

    options = clarabel.DefaultSettings()
    options.verbose, options.max_threads = False, 1
    P, A = sparse.triu(sparse.csc_matrix(program.P), format="csc"), sparse.csc_matrix(program.A)
    clarabel.DefaultSolver(P, program.q, A, program.b, cones_of(program), options).solve()


def tasks(form: str, goal: str, knots: int, count: int) -> Iterator[tuple[sg.Analysis, sg.Task, sg.Plan]]:
    """Yield analyses, tasks, and their plans."""
    kinds, n_z = FORMS[form]
    rng, found = np.random.default_rng(0), 0
    limits = [sg.NormalForce(upper=10.0), sg.JointTorque(0.5), sg.SlipMargin(MARGIN)]
    while found < count:
        analysis = sg.analyse(grasp_like(rng, kinds, n_z))
        first, last = random_wrenches(rng, 2, 0.5)
        load = sg.Wrench(tuple(first)) if knots == 1 else sg.WrenchTable([0.0, 1.0], [first, last])
        task = sg.Task(duration=1.0, knots=knots, loads=[load], limits=limits, goals=[ASKED[goal][0]],
                       tie_break=ASKED[goal][1])  # fmt: skip
        plan = sg.plan(analysis, task)
        if isinstance(plan, sg.Plan):
            found += 1
            yield analysis, task, plan


@contextmanager
def watched(spent: dict[str, float]) -> Iterator[None]:
    """Add up the processor time of each stage, without that of stages inside it."""
    inside: list[float] = []

    def timed(stage: str, call: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(call)
        def run(*args: Any, **named: Any) -> Any:
            inside.append(0.0)
            start = time.perf_counter()
            try:
                return call(*args, **named)
            finally:
                whole = time.perf_counter() - start
                spent[stage] += whole - inside.pop()
                if inside:
                    inside[-1] += whole

        return run

    with ExitStack() as stack:
        for stage, places in STAGES.items():
            for place in places:
                module, name = place.split(":")
                found = import_module(f"synergrip.{module}")
                stack.enter_context(patch.object(found, name, timed(stage, getattr(found, name))))
        yield


def shares(plan_all: Callable[[], object]) -> str:
    """Return the share of each stage, in words."""
    spent: dict[str, float] = defaultdict(float)
    start = time.perf_counter()
    with watched(spent):
        plan_all()
    whole = time.perf_counter() - start
    spent["between them"] = whole - sum(spent.values())
    return ", ".join(f"{stage} {seconds / whole:.0%}" for stage, seconds in spent.items())


def main() -> None:
    """Print a line, and the shares, for each form of grasp, goal and number of knots."""
    count, runs = (int(text) for text in (*sys.argv[1:], *("20", "7")[len(sys.argv) - 1 :]))
    for form in FORMS:
        for goal in ASKED:
            for knots, turns in TURNS.items():
                asked = list(tasks(form, goal, knots, count))
                programs = [decision.program for *_, plan in asked for decision in plan.decisions]

                def plan_all(asked: list[Any] = asked) -> None:
                    for analysis, task, _ in asked:
                        sg.plan(analysis, task)

                def solve_all(programs: list[Program] = programs) -> None:
                    for program in programs:
                        cold(program)

                took = in_turns({"plan": (count, plan_all), "cold": (count, solve_all)}, turns * runs)
                ours, theirs = 1e-3 * took["plan"], 1e-3 * took["cold"]
                solved = f"{len(programs) / count:.1f} programs"
                print(f"{form} {goal:>14} {knots:>3} knots: plan {ours:.2f} ms, Clarabel {theirs:.2f} ms "
                      f"({solved}), {ours / theirs:.2f} times\n    {shares(plan_all)}", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
