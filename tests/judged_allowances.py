"""Plans that allow for other values, and plans that do not, in the same samples of these values.

    python tests/judged_allowances.py [GRASPS [HANDS [SAMPLES [FIRST SEED [SCENARIOS]]]]]

GRASPS (50) random grasps given as matrices, with friction, loads and contact gaps that are allowed for; HANDS (6)
variations of bundled problems on hands, with friction, mass, loads and gaps. Of each plan SAMPLES (1000) values inside
what is allowed, and at its ends, are looked at: the forces of matrices by one elastic system written down anew, those
of hands by the second execution of `second_execution.py` (10 samples each, which take longer). Prints how many samples
of plans with and without allowances miss the asked margin, and how many slip.

SCENARIOS (40) random errors of the grasps of some bundled problems on hands, drawn and executed by code that shares
nothing with the package (`second_samples.py`): how many of them miss margin or normal force, with and without.
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from allowed_samples import Sample, elastic_forces, sample, slip_margins, with_mass
from random_tasks import random_task_on_grasp
from second_execution import executed
from second_samples import Sizes, off_by

from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.slip_margin import SlipMargin
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.planning.outcome import Outcome, Plan
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem
from synergrip.reports.data.json_plan import outcome_document
from synergrip.tasks.allowances import Allowances
from synergrip.tasks.scenarios import Scenarios
from synergrip.tasks.task import Task
from synergrip.tasks.wrenches import Wrench

REPOSITORY = Path(__file__).parent.parent
SAME, SHARE = 1e-3, 1e-3
"""How far below the asked margin a true state counts as kept [N], and as a share of the largest force."""
EXECUTED = 10
ON_HANDS = ("barrett-ball-hold", "gripper-box", "dlr-ball-move", "table2-soft-motors", "brown-asada-ball",
            "barrett-ball-lift-joints")  # fmt: skip


SCENARIOS = {
    "barrett-ball-hold": Sizes(0.5e-3, np.radians(1), 0.1),
    "gripper-box": Sizes(1e-3, np.radians(3), 0.2),
    "dlr-ball-move": Sizes(1e-3, np.radians(3), 0.2),
    "table2-soft-motors": Sizes(2e-6, np.radians(0.01), 0.1),
    "human-ball": Sizes(1e-3, np.radians(2), 0.2),
}
"""How far off the grasps of bundled problems may be; a hand of rigid joints is true to micrometres."""


def main(grasps: int, hands: int, samples: int, first: int, scenarios: int) -> None:
    """Print what becomes of many plans."""
    counted: Counter[str] = Counter()
    for seed in range(first, first + grasps):
        _matrices(np.random.default_rng([31, seed]), samples, counted)
    print("matrices", dict(sorted(counted.items())), flush=True)
    counted = Counter()
    for seed in range(first, first + hands):
        _hand(np.random.default_rng([37, seed]), ON_HANDS[seed % len(ON_HANDS)], counted)
    print("hands", dict(sorted(counted.items())), flush=True)
    for name, sizes in SCENARIOS.items() if scenarios else ():
        _scenarios(name, sizes, scenarios, first)


def _matrices(rng: np.random.Generator, samples: int, counted: Counter[str]) -> None:
    grasp, timed = random_task_on_grasp(rng)
    weight = float(np.linalg.norm(timed.wrench[:, :3], axis=1).max()) or 1.0
    limits = [SlipMargin(min(timed.margin, 0.05)), *(each for each in timed.limits if not each.couples_knots)]
    task = Task(loads=[Wrench(timed.wrench[0])], limits=limits, goals=[LeastEffort()], knots=1)
    allow = Allowances(
        friction_share=float(rng.uniform(0.05, 0.3)),
        load=[np.concatenate([0.3 * weight * rng.normal(size=3), 0.003 * weight * rng.normal(size=3)]) for _ in "ab"],
        load_box=np.array([0.1 * weight, 0.1 * weight, 0.0, 0.0, 0.0, 0.0]),
        contact_gap=float(10 ** rng.uniform(-6, -4)),
    )
    _counted(plan(grasp, task), plan(grasp, task.replace(allow=allow)), grasp, allow, samples, rng, counted)


def _counted(
    bare: Outcome, held: Outcome, grasp: Grasp, allow: Allowances, samples: int, rng: np.random.Generator,
    counted: Counter[str],
) -> None:  # fmt: skip
    counted[f"planned: {held.verdict}"] += 1
    if not (isinstance(held, Plan) and isinstance(bare, Plan)):
        return
    for _ in range(samples):
        drawn = sample(rng, allow, grasp)
        counted["samples"] += 1
        for name, made in (("with", held), ("without", bare)):
            forces = elastic_forces(grasp, made.dz_r, made.task.wrench + drawn.load, drawn.gaps)
            _told(counted, name, slip_margins(grasp, forces, drawn), forces, held.task.margin, room=1e-6)


def _told(counted: Counter[str], name: str, margins: Array, forces: Array, asked: float, room: float) -> None:
    least, allowed = float(margins.min()), max(room, room * float(np.abs(forces).max()))
    counted[f"{name} allowances: misses the margin"] += least < asked - allowed
    counted[f"{name} allowances: slips"] += least < -allowed


def _hand(rng: np.random.Generator, name: str, counted: Counter[str]) -> None:
    problem = load_problem(name, "task.knots=7")
    body = problem.held.body if problem.held else None
    assert body is not None
    weight = 9.81 * body.mass if body.mass else 2.0
    allow = Allowances(
        friction_share=float(rng.uniform(0.03, 0.1)),
        mass=(0.8 * body.mass, float(rng.uniform(1.05, 1.2)) * body.mass) if body.mass else None,
        contact_gap=float(rng.uniform(0, 2e-4 if np.any(problem.grasp.C_q) else 3e-5)),
        load=[np.concatenate([0.1 * weight * rng.normal(size=3), np.zeros(3)]) for _ in "ab"],
    )
    limits = [each for each in problem.task.limits if isinstance(each, SlipMargin | JointRange)]
    task = problem.task.replace(limits=limits)
    bare, held = plan(problem.grasp, task), plan(problem.grasp, task.replace(allow=allow))
    counted[f"planned: {held.verdict}"] += 1
    if not (isinstance(held, Plan) and isinstance(bare, Plan)):
        print(name, repr(held), flush=True)
        return
    for _ in range(EXECUTED):
        drawn = sample(rng, allow, problem.grasp)
        counted["samples"] += 1
        for said, made in (("with", held), ("without", bare)):
            _executed(problem.grasp, made, said, drawn, body.mass, counted)
    print(name, dict(sorted(counted.items())), flush=True)


def _executed(grasp: Grasp, made: Plan, said: str, drawn: Sample, own: float, counted: Counter[str]) -> None:
    document: dict[str, Any] = json.loads(json.dumps(outcome_document("", grasp, made)))
    stated = np.array(document["wrench"])
    document["wrench"] = with_mass(stated, _weight(made), drawn.mass, own, drawn.load).tolist()
    _off(document, grasp, drawn)
    found = executed(document, REPOSITORY)
    if found.ended is not None:
        counted[f"{said} allowances: not reached"] += 1
        return
    margins = slip_margins(grasp, found.forces, drawn)
    _told(counted, said, margins, found.forces, made.task.margin, room=SAME)


def _off(document: dict[str, Any], grasp: Grasp, drawn: Sample) -> None:
    """Put contacts off: their springs are shorter by the gap, ``C_s (lambda - lambda_0) = stretch + g n``."""
    early = np.zeros(grasp.n_l)
    early[grasp.normal_rows] = drawn.gaps
    document["execution"]["early_m"] = early.tolist()


def _weight(made: Plan) -> Array:
    """Return what goes by the mass: the whole load but for pushes and wrenches."""
    from synergrip.tasks.timing import _weight as weight_of

    course: Any = made.task.course
    parts = weight_of(course)
    return np.asarray(course.factor * sum((part.at(made.time) for part in parts), np.zeros((len(made.time), 6))))


def _scenarios(name: str, sizes: Sizes, count: int, first: int) -> None:
    """Print how many random errors of one grasp make its plans miss what is asked."""
    problem = load_problem(name, "task.knots=7")
    asked = Scenarios(position=sizes.position, normal=sizes.normal, compliance=sizes.compliance)
    held = plan(problem.grasp, problem.task.replace(allow=Allowances(scenarios=asked)))
    if not isinstance(held, Plan) or held.fresh is None:
        print(name, repr(held), flush=True)
        return
    counted: Counter[str] = Counter()
    for said, made in (("with", held), ("without", plan(problem.grasp, problem.task))):
        assert isinstance(made, Plan)
        document = json.loads(json.dumps(outcome_document("", problem.grasp, made)))
        for number in range(count):
            off = off_by(document, sizes, np.random.default_rng([41, first, number]), REPOSITORY)
            counted[said] += off is None or _missed(off, made)
    promised = f"{held.fresh.missing} of {held.fresh.count} fresh ones missed, look {held.fresh.looks}"
    print(f"{name}: of {count} miss {dict(counted)}; {promised}", flush=True)


def _missed(document: dict[str, Any], made: Plan) -> bool:
    """Return whether a second execution misses the slip margin that is asked for, or the bounds of normal forces."""
    found, normal = executed(document, REPOSITORY), made.grasp.normal_rows
    if found.ended is not None:
        return True
    room = max(SAME, SHARE * float(np.abs(made.forces).max()))
    most = [limit.upper for limit in made.task.limits if isinstance(limit, NormalForce)]
    over = any(float(found.forces[:, normal].max()) > each + room for each in most)
    return bool(over or found.margins.min() < made.task.margin - room)


if __name__ == "__main__":
    given = [int(each) for each in sys.argv[1:]]
    main(*(given + [50, 6, 1000, 0, 40][len(given) :]))
