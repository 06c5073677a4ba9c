"""What counts as verified of many programs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from random_tasks import hand_like_grasp

import synergrip as sg
from synergrip.linalg import frozen
from synergrip.planning.planning import plan_of_start_posture


def test_the_largest_margin_is_known_where_it_falls_short_and_cones_that_do_not_hold_bound_no_force() -> None:
    """Its forces leave the box by which a no is proven, which counts on friction cones."""
    grasp, wrench = hand_like_grasp(np.random.default_rng(26), {"hard": 1.0}), np.array([0, 0, -10.0, 0, 0, 0])
    task = sg.Task(knots=1, limits=[sg.NormalForce(upper=0.5), sg.SlipMargin(0.2)], goals=[sg.LeastEffort()])
    many = sg.plan_many(grasp, task, wrenches=wrench[None])
    one = plan_of_start_posture(grasp, replace(task.timed(grasp), wrench=frozen(wrench[None]), course=None))
    assert many.verdicts[0] == one.verdict == "infeasible"
    assert not many.one_by_one[0]
    assert isinstance(one, sg.Infeasible)
    assert one.largest_margin is not None
    assert one.largest_margin < -1
    assert many.largest_margin[0] == pytest.approx(one.largest_margin, abs=1e-6)
