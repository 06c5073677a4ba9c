"""A plan along the motion is what a physics engine makes of it; `python tests/judged_playing.py` plays more of them."""

from __future__ import annotations

from judged_playing import Case, judged, linear

from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan

PROBLEM = Case("gripper-box", ("task.move[0].lift=-4 mm", "task.knots=21")).problem


def test_what_is_planned_along_the_motion_happens() -> None:
    answer = plan(PROBLEM.grasp, PROBLEM.task.replace(linearise="along"))
    assert isinstance(answer, Plan)
    found = judged(answer)
    assert found.agrees, str(found)
    assert abs(found.played - found.promised) < 0.03, str(found)


def test_what_is_planned_at_the_start_posture_does_not() -> None:
    found = judged(linear(PROBLEM))
    assert not found.agrees, str(found)
    assert found.off > 3e-4, str(found)
