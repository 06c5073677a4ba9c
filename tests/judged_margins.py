"""How far numbers may go, judged by a second model.

    python tests/judged_margins.py 500 [first seed]

Random grasps given as matrices, with a plan and limits that leave some room around it. Of friction, load, peak force
and amplitude, and of the friction of every contact by itself, the second model (`least_changes.py`, in cvxpy) must have
a plan at the value that is attained, and none at the end that is proven. Counts the numbers, those with a proof, and
what is wrong.
"""

from __future__ import annotations

import sys
from collections import Counter
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from least_changes import LeastChanges
from too_much import with_plan

from synergrip.grasps.grasp import Grasp
from synergrip.margin.direct_number import DirectNumber
from synergrip.margin.found import Margins
from synergrip.margin.margins import margins
from synergrip.tasks.timed_task import TimedTask

NUMBERS = {
    "critical_friction_scale": "friction", "load_factor": "load", "least_peak_N": "force_cap",
    "largest_amplitude": "amplitude",
}  # fmt: skip
"""Number -> what the second model calls it."""
EACH = "critical_friction_per_contact"
ROOM = 1e-6
"""Share by which rows may be too narrow in the second model at a value that is attained."""


def wrong(number: DirectNumber, model: LeastChanges, stated: float) -> str:
    """Return what the second model has against a number, if anything.

    Args:
        number: of the planner.
        model: the second model of the task.
        stated: what the number is in the task.
    """
    name = NUMBERS[number.name]
    assert number.value is not None
    short = model.shortfall(name, number.value / stated)
    if short > ROOM:
        return f"{number.name}: at {number.value:.6g} rows must be wider by {short:.1e}"
    end = number.upper if number.value == number.lower else number.lower
    if number.proven and end is not None and model.shortfall(name, end / stated) <= 0:
        return f"{number.name}: there is a plan at {end:.6g}, which is said to be proven to have none"
    return ""


def wrong_alone(number: DirectNumber, contact: str, grasp: Grasp, task: TimedTask) -> str:
    """Return what the second model has against the least friction of one contact, if anything."""
    (own,) = (each for each in grasp.contacts if each.name == contact)

    def short(friction: float) -> float:
        kind = own.kind.slippery(friction / own.friction)
        return LeastChanges(grasp.replace(contact={contact: kind}), task).shortfall()

    assert number.value is not None
    if (widening := short(number.value)) > ROOM:
        return f"friction of {contact}: at {number.value:.6g} rows must be wider by {widening:.1e}"
    if number.proven and number.lower is not None and short(number.lower) <= 0:
        return f"friction of {contact}: there is a plan at {number.lower:.6g}, which is said to be proven to have none"
    return ""


def main(count: int, first: int) -> None:
    """Print what came of many grasps."""
    counted: Counter[str] = Counter()
    for seed in range(first, first + count):
        question = with_plan(np.random.default_rng([29, seed]), "force_cap")
        answer = None if question is None else margins(*question, only=[*NUMBERS, EACH])
        if question is None or not isinstance(answer, Margins):
            continue
        model, cap = LeastChanges(*question), max(getattr(limit, "upper", 0.0) for limit in question[1].limits[:1])
        counted["grasps"] += 1
        for number in answer.direct.values():
            if number.value is None or (number.name == "least_peak_N" and "force_cap" not in model.names):
                continue
            counted["numbers"] += 1
            counted["proven"] += number.proven
            if told := wrong(number, model, cap if number.name == "least_peak_N" else 1.0):
                counted["wrong"] += 1
                print(f"seed {seed}: {told}", flush=True)
        for contact, number in answer.on_request[EACH].items():
            counted["numbers"] += number.value is not None
            counted["proven"] += number.proven
            if number.value is not None and (told := wrong_alone(number, contact, *question)):
                counted["wrong"] += 1
                print(f"seed {seed}: {told}", flush=True)
    print(", ".join(f"{name} {counted[name]}" for name in ("grasps", "numbers", "proven", "wrong")))


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0)
