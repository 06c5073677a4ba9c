"""The fewest synergies for a task, against every subset planned by itself."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from math import comb

import numpy as np
import pytest
from random_tasks import random_task_on_grasp

from synergrip import load_problem
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.errors import InputError
from synergrip.explain.synergies.needed_points import Pointed
from synergrip.explain.synergies.synergies_needed import synergies_needed
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.other_synergies import chosen, of_whole_set
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan_of_start_posture
from synergrip.statics.analysis import analyse
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import in_motions

GOALS = {"margin": LargestMargin(), "effort": LeastEffort(), "peak_force": LeastPeak()}
Every = dict[tuple[int, ...], Plan | None]


def case(seed: int) -> tuple[Grasp, TimedTask]:
    """A random grasp of 4 or 5 synergies and a task that these can do."""
    rng = np.random.default_rng(seed)
    while True:
        grasp, task = random_task_on_grasp(rng)
        if grasp.n_z in (4, 5) and isinstance(plan_of_start_posture(grasp, task), Plan):
            return grasp, task


def every_subset(grasp: Grasp, task: TimedTask, by: str) -> Every:
    """What planning says of each subset of the synergies, one by one."""
    wish = replace(in_motions(analyse(grasp, task.wrench), task), goals=(GOALS[by],))
    found: Every = {}
    for size in range(1, grasp.n_z + 1):
        for picks in combinations(range(grasp.n_z), size):
            outcome = plan_of_start_posture(chosen(grasp, picks), wish.for_synergies(picks))
            assert isinstance(outcome, Plan | Infeasible)
            found[picks] = outcome if isinstance(outcome, Plan) else None
    return found


def worth(plan: Plan, by: str) -> float:
    if by == "margin":
        assert plan.largest_margin is not None
        return plan.largest_margin
    if by == "peak_force":
        return -float(plan.forces[:, plan.grasp.normal_rows].max())
    return -float(np.sqrt((np.abs(plan.forces * plan.analysis.response.scale.force) ** 2).sum(axis=1).mean()))


@pytest.mark.parametrize(("seed", "by"), [(0, "peak_force"), (1, "effort"), (2, "margin"), (3, "peak_force")])
def test_the_fewest_and_the_best_are_those_of_all_subsets(seed: int, by: str) -> None:
    grasp, task = case(seed)
    every = every_subset(grasp, task, by)
    needed = synergies_needed(grasp, task, by=by)
    fewest = min(len(picks) for picks, plan in every.items() if plan is not None)
    names = {tuple(grasp.synergies[i] for i in picks): plan for picks, plan in every.items()}
    assert needed.fewest == fewest
    assert needed.proven
    assert needed.all_minimal
    assert set(needed.minimal) == {each for each, plan in names.items() if plan and len(each) == fewest}
    assert needed.refuted == tuple((comb(grasp.n_z, k), comb(grasp.n_z, k)) for k in range(1, fewest))
    for size, (first, best) in enumerate(zip(needed.first, needed.best, strict=True), 1):
        assert first.synergies == grasp.synergies[:size]
        assert (first.verdict == "feasible") == (names[first.synergies] is not None)
        assert first.certified
        able = [plan for each, plan in names.items() if len(each) == size and plan is not None]
        assert (best.verdict == "feasible") == bool(able)
        found = names[best.synergies]
        if able:
            assert found is not None
            most = max(worth(plan, by) for plan in able)
            assert worth(found, by) >= most - 1e-5 * abs(most)
            figure = {"margin": best.largest_margin, "peak_force": best.peak, "effort": best.effort}[by]
            assert figure == pytest.approx(abs(most), rel=1e-5)


@pytest.mark.parametrize("seed", [0, 3])
def test_step_by_step_none_of_the_found_can_be_left_out_and_no_more_is_claimed(seed: int) -> None:
    grasp, task = case(seed)
    every = every_subset(grasp, task, "effort")
    needed = synergies_needed(grasp, task, by="effort", most=1)
    (names, *_) = needed.minimal
    picks = tuple(grasp.synergies.index(name) for name in names)
    assert every[picks] is not None
    assert all(every[fewer] is None for fewer in combinations(picks, len(picks) - 1) if fewer)
    assert not needed.all_minimal
    assert needed.fewest is not None
    assert needed.proven == (needed.fewest == 1)
    assert [point.every for point in needed.best] == [size == grasp.n_z for size in range(1, grasp.n_z + 1)]


def test_an_interrupt_keeps_the_numbers_that_are_finished() -> None:
    grasp, task = case(0)

    def told(size: int, done: int, of: int) -> None:
        if size == 3:
            raise KeyboardInterrupt

    needed = synergies_needed(grasp, task, told=told)
    assert needed.interrupted
    assert [len(point.synergies) for point in needed.best] == [1, 2]


def test_a_margin_that_nothing_bounds_has_no_bound() -> None:
    grasp, task = case(0)
    free = replace(task, limits=())
    needed = synergies_needed(grasp, free, by="margin")
    assert needed.best[-1].largest_margin == np.inf
    assert needed.fewest is not None


def test_a_hand_has_all_of_its_set_and_the_first_of_them_do_what_is_known() -> None:
    """Peak forces of 5.38 N with the first 6 of the Santello synergies, none with 5, in the linear model."""
    problem = load_problem("human-glass")
    whole, origins = of_whole_set(problem.grasp)
    assert whole.synergies == tuple(f"pc{i}" for i in range(1, 16))
    assert list(origins) == [*range(6), *([None] * 9)]
    task = replace(problem.timed.for_synergies(origins), linearise="once")
    pointed = Pointed(whole, task, along=False)
    five, six, four = pointed.at(range(5)), pointed.at(range(6)), pointed.at((0, 3, 4, 13))
    assert (five.verdict, five.stage, five.certified, five.peak) == ("infeasible", "magnitude", True, None)
    assert six.peak == pytest.approx(5.3808, abs=1e-4)
    assert four.verdict == "feasible"  # fewer, when they are not the first ones


def test_compliances_and_limits_of_a_set_are_those_of_the_problem() -> None:
    problem = load_problem("human-glass", ["hand.compliance.synergy=0.1", "limits.synergy_reference=0.5"])
    whole, origins = of_whole_set(problem.grasp)
    assert np.array_equal(whole.C_z, 0.1 * np.eye(15))
    reference = next(
        limit
        for limit in problem.timed.for_synergies(origins).limits
        if hasattr(limit, "limit") and limit.key.endswith("reference")
    )
    assert reference.limit.tolist() == [0.5] * 15


def test_wrong_arguments_are_named() -> None:
    grasp, task = case(0)
    with pytest.raises(InputError, match="by"):
        synergies_needed(grasp, task, by="speed")
    with pytest.raises(InputError, match="up_to"):
        synergies_needed(grasp, task, up_to=99)
    with pytest.raises(InputError, match="picks"):
        chosen(grasp, [99])
