"""Goals one after the other: the first keeps its best value, the next is best among those, whoever solves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from named_goals import goals, names_of, ranges_of
from random_tasks import moving_random_task

from synergrip.conic.goals.centred_joints import CentredJoints
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.conic.solution import Settings, Solution
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.planning.solvers import SOLVERS
from synergrip.tasks.timed_task import TimedTask

ORDERS = [
    ("margin", "effort", "travel"),
    ("margin", "torque", "smooth"),
    ("peak_force", "margin", "torque", "references"),
    ("effort", "smooth"),
    ("effort", "centred"),
    ("actuator", "references"),
    ("smooth", "effort"),
    ("travel", "effort"),
    ("references",),
    ("weighted", "travel"),
    ("steady", "references"),
    ("margin", "steady", "smooth"),
    ("smooth", "steady", "torque"),
    ("margin", "holding"),
    ("holding", "references"),
]
WEIGHTS = {"effort": 1.0, "torque": 0.3, "smooth": 1e-3}


def task_of(seed: int, order: tuple[str, ...]) -> tuple[Grasp, TimedTask]:
    """A random task over five uneven knots, without limits that forbid it."""
    rng = np.random.default_rng(seed)
    grasp, task = moving_random_task(rng)
    start = rng.uniform(-0.5, 0.5, grasp.n_q)
    ranges = JointRange(frozen(start), frozen(start - rng.uniform(0.5, 1, grasp.n_q)), frozen(start + 0.7))
    return grasp, replace(
        task, goals=goals(*order, weights=WEIGHTS, ranges=ranges), margin=0.0,
    )  # fmt: skip


def values(outcome: Plan) -> dict[str, float]:
    """Return what each goal measures of a plan, by formulas of its own."""
    motion, scale = outcome.motion, outcome.analysis.response.scale
    h = np.diff(motion.times)[:, None]
    rates = np.diff(motion.dz_r, axis=0) / h
    span = (h[1:] + h[:-1]) / 2
    bends = np.diff(rates, axis=0) / span

    def squares(array: Array) -> float:
        return float((array**2).sum())

    effort, torque = squares(motion.forces * scale.force), squares(motion.torques / scale.length)
    smooth = squares(bends * np.sqrt(span))
    knots, duration, units = len(motion.times), motion.times[-1] - motion.times[0], outcome.formulation.stated
    weighted = (effort + 0.3 * torque) / units.force**2 + 1e-3 * knots * duration**3 * smooth / units.reference**2
    return {
        "margin": -float(outcome.margins.min()),
        "peak_force": float(motion.forces[:, outcome.analysis.grasp.normal_rows].max()),
        "effort": effort,
        "torque": torque,
        "actuator": squares(motion.efforts / scale.length),
        "holding": squares(motion.efforts[1:] * np.sqrt(h / 3))
        + squares(motion.efforts[:-1] * np.sqrt(h / 3))
        + float((h / 3 * motion.efforts[1:] * motion.efforts[:-1]).sum()),
        "references": squares(motion.dz_r),
        "travel": squares(rates * np.sqrt(h)),
        "smooth": smooth,
        "steady": squares(np.diff(motion.forces * scale.force, axis=0) / np.sqrt(h)),
        "weighted": weighted,
        **({"centred": _off_centre(outcome)} if "centred" in names_of(outcome.task.goals) else {}),
    }


def _off_centre(outcome: Plan) -> float:
    ranges = ranges_of(outcome.task.goals)
    middle, half = (ranges.lower + ranges.upper) / 2, (ranges.upper - ranges.lower) / 2
    return float((((ranges.start + outcome.motion.dq - middle) / half) ** 2).sum())


@pytest.mark.parametrize("order", ORDERS, ids="-".join)
def test_each_goal_is_best_among_those_before_it(order: tuple[str, ...]) -> None:
    found = 0
    for seed in range(200, 207):
        grasp, task = task_of(seed, order)
        outcome = plan(grasp, task)
        if not isinstance(outcome, Plan):
            continue
        found += 1
        assert all(decision.certificate.verified for decision in outcome.decisions)
        assert not [note for note in outcome.notes if "not verified" in note], (seed, outcome.notes)
        reached = values(outcome)
        for k, name in enumerate(order):
            best = plan(grasp, replace(task, goals=task.goals[: k + 1]))  # nobody comes after this goal
            assert isinstance(best, Plan)
            size = max(abs(values(best)[name]), 1e-3)
            assert reached[name] <= values(best)[name] + 2e-5 * size, (seed, name)
    assert found >= 3


@pytest.mark.parametrize("order", ORDERS, ids="-".join)
def test_both_formulations_choose_the_same_plan(order: tuple[str, ...]) -> None:
    compared = 0
    for seed in range(200, 206):
        grasp, task = task_of(seed, order)
        one, two = plan(grasp, task), plan(grasp, task, SOLVERS["cvxpy"])
        assert one.verdict == two.verdict
        if isinstance(one, Plan) and isinstance(two, Plan):
            compared += 1
            first, second = values(one), values(two)
            for name in order:
                assert first[name] == pytest.approx(second[name], rel=2e-5, abs=2e-5), (seed, name)
    assert compared


def test_the_least_motion_of_a_redundant_hand_beats_any_other_choice() -> None:
    """Perturb the redundancy of a plan that travels least: forces stay, the travel grows."""
    for seed in (89, 130, 146, 213):
        grasp, task = task_of(seed, ("effort", "travel"))
        outcome = plan(grasp, replace(task, limits=task.limits[:2]))
        assert isinstance(outcome, Plan)
        assert outcome.gamma.size
        rng = np.random.default_rng(0)
        least = values(outcome)["travel"]
        for size in (1e-3, 1e-1):
            gamma = outcome.gamma + size * rng.normal(size=outcome.gamma.shape)
            dz_r = outcome.analysis.coordinates.references(outcome.alpha, outcome.beta, gamma)
            moved = replace(outcome, motion=replace(outcome.motion, dz_r=dz_r))
            assert values(moved)["travel"] > least


def test_centring_joints_needs_their_ranges() -> None:
    grasp, task = task_of(200, ("effort",))
    with pytest.raises(InputError, match=r"CentredJoints\.start: needs a hand with joint ranges"):
        plan(grasp, replace(task, goals=(*task.goals, CentredJoints())))


def test_an_interrupt_keeps_what_the_goals_before_have_led_to() -> None:
    grasp, task = task_of(203, ("margin", "effort", "travel"))
    whole = plan(grasp, task)
    assert isinstance(whole, Plan)
    asked: list[str] = []

    def impatient(question: Question, program: Program, settings: Settings) -> Solution:
        asked.append(question.goal.name)
        if "effort" in question.goal.name:
            raise KeyboardInterrupt
        return SOLVERS["clarabel"](question, program, settings)

    kept = plan(grasp, task, impatient)
    assert isinstance(kept, Plan)
    assert kept.exit_code == 130
    assert "interrupted while solving for 'least contact effort'" in " ".join(kept.notes)
    assert asked == ["largest margin", "least contact effort"]  # and nothing after it
    assert kept.margins.min() == pytest.approx(whole.largest_margin, abs=1e-6)
