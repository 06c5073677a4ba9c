from dataclasses import replace

import numpy as np
import pytest

from synergrip.margin.front import FrontPoint
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem
from synergrip.reports.text.front_report import front_text


@pytest.mark.parametrize(
    ("kinds", "unit"),
    [
        (("hinge",) * 4, " N m"),
        (("slide",) * 4, " N"),
        (("slide", "hinge", "slide", "hinge"), ""),  # the largest of torques and forces has no unit
        (None, " N m"),  # a grasp file does not say
    ],
)
def test_torques_are_told_in_the_unit_of_the_joints(kinds, unit):
    problem = load_problem("gripper-box")
    answer = plan(problem.grasp, problem.task)
    hand = problem.held.hand
    if kinds is not None:
        joints = tuple(replace(joint, kind=kind) for joint, kind in zip(hand.joints, kinds, strict=True))
        held = replace(problem.held, hand=replace(hand, joints=joints))
    else:
        held = None
    last = front_text(
        replace(problem, grasp=replace(problem.grasp, held=held)), [FrontPoint(0.5, 2.0, answer)], False
    ).splitlines()[-1]
    assert last.split("  ")[-1].strip() == f"{np.abs(answer.motion.torques).max():.4g}{unit}"
