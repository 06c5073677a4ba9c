"""A motion that is followed a little farther at a time: as good as one planned at once, and honest where it ends."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from synergrip.planning.beginning import walk_from_hold
from synergrip.planning.executing import Executor
from synergrip.planning.growing import LONGEST, Way
from synergrip.planning.outcome import Infeasible, Plan, Unknown
from synergrip.planning.planning import plan, plan_of_start_posture
from synergrip.planning.reach import reached_by
from synergrip.planning.solvers import SOLVERS
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.problems.problem import load_problem
from synergrip.tasks.timed_task import still


@cache
def held(name: str, *overrides: str) -> tuple[Walker, Plan]:
    """Return who walks a problem, and a plan of its loads without the motion."""
    problem = load_problem(name, overrides)
    task = problem.timed
    hold = plan(problem.grasp, replace(task, target=still(task.times), course=None))
    assert isinstance(hold, Plan)
    return Walker(task, hold.analysis, Executor.of(hold.analysis, task), SOLVERS["clarabel"]), hold


@cache
def grown(name: str, *overrides: str) -> tuple[Walker, Walk]:
    walker, hold = held(name, *overrides)
    return walker, walk_from_hold(walker, hold.dz_r)


ROLL = ("barrett-ball-roll", "task.knots=11")
FAR = ("gripper-box", "task.knots=11", "task.move[0].lift=40 mm")


def test_a_grown_walk_is_the_one_that_begins_with_the_linear_plan() -> None:
    _, walk = grown(*ROLL)
    problem = load_problem(*ROLL[:1], ROLL[1:])
    direct = plan(problem.grasp, problem.task)
    assert isinstance(direct, Plan)
    assert walk.true
    assert walk.until is None
    assert walk.behind < 1e-5
    largest = np.abs(direct.forces).max()
    assert walk.executed.states.forces == pytest.approx(direct.forces, abs=0.01 * largest)
    assert walk.executed.margins.min() == pytest.approx(direct.margins.min(), abs=1e-3)
    assert np.abs(walk.executed.du - direct.motion.du).max() < 1e-4


def test_where_a_grown_walk_ends_it_is_what_it_says_until_then() -> None:
    walker, walk = grown(*FAR)
    reached, times = reached_by(walk, walker), walker.task.times
    assert walk.until is not None
    assert walk.true
    assert times[0] < reached.until_s < times[-1]
    assert np.isinf(walk.behind)
    count = len(walk.references)
    begin = walker.executor.setting.start.taken([0] * count)
    whole = walker.executor.run(times[:count], walk.references, walker.task.wrench[:count], begin)
    assert whole.du[-1] == pytest.approx(reached.pose, abs=1e-9)
    wanted = [np.interp(reached.until_s, times, column) for column in walker.wanted.T]
    assert np.linalg.norm(reached.pose[:3] - wanted[:3]) < 2e-3  # elastic motion is left


def test_it_says_what_keeps_it_from_going_on() -> None:
    walker, walk = grown(*FAR)
    because = reached_by(walk, walker).because
    assert "nearest pose" in because
    assert "straight" in because or "limit" in because


def test_joints_of_idle_fingers_keep_nothing_from_going_on() -> None:
    """Index and little finger are straight, which is where the ranges of their joints end, from the start."""
    posture = {
        **_bent("thumb", ("tmc_abd", "tmc_flex", "mcp", "ip"), (8.8, 40.15, -9.83, 11.56)),
        **_bent("middle", FINGER, (2.4, -12.74, 27.19, 24.92)),
        **_bent("ring", FINGER, (-1.41, -7.78, 20.17, 50.22)),
    }
    problem = load_problem({
        "schema": 1,
        "hand": {"model": "human", "posture": posture, "synergies": "all"},
        "object": {
            "shape": {"sphere": {"radius": "36 mm"}},
            "position": ["-22.28 mm", "116.8 mm", "-10.23 mm"],
            "mass": "50 g",
        },
        "contacts": {"friction": 0.8, "stiffness": "8 N/mm", "at": ["thumb/tip", "middle/tip", "ring/tip"]},
        "task": {"duration": "2 s", "knots": 5, "move": [{"axis": "x", "lift": "60 mm"}]},
        "limits": {"margin": "0.2 N"},
    })  # fmt: skip
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Unknown)
    assert answer.reached is not None
    assert "straight" in answer.reached.because
    assert not any(idle in answer.reached.because for idle in ("index", "little"))


FINGER = ("mcp_abd", "mcp_flex", "pip", "dip")


def _bent(finger: str, joints: tuple[str, ...], values: tuple[float, ...]) -> dict[str, str]:
    return {f"{finger}_{joint}": f"{value} deg" for joint, value in zip(joints, values, strict=True)}


def test_the_way_is_cut_where_it_is_asked_for() -> None:
    walker, _ = held(*FAR)
    way = Way.of(walker)
    for gone in (0.0, 0.3 * way.end, way.gone[4], way.end):
        part = way.until(float(gone))
        count = len(part.task.times)
        assert way.gone[count - 1] >= gone
        assert count == 1 or way.gone[count - 2] < gone
        assert part.wanted[: count - 1] == pytest.approx(walker.wanted[: count - 1])
        own = [np.interp(gone, way.gone, column) for column in walker.wanted.T]
        assert part.wanted[-1] == pytest.approx(own)
    assert way.end > LONGEST


def test_a_squeeze_that_the_motors_cannot_give_is_not_blamed_on_joints_that_a_short_step_stops() -> None:
    """The start posture keeps the margin; the hand that moves would need more effort than its motors have."""
    problem = load_problem("brown-asada-ball", ("limits.margin=0.55 N", "object.mass=95 g"))
    assert isinstance(plan_of_start_posture(problem.grasp, problem.task), Plan)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Unknown)
    assert answer.stage == "execution"
    assert "does not hold the object within its limits at t = 0 s" in answer.why
    assert "limits.margin (middle/tip) and limits.actuator_effort (motor1) cannot both be kept there" in answer.why
    assert "joint '" not in answer.why


def test_an_object_that_is_not_even_held_where_it_starts_is_not_told_of_as_not_brought_on() -> None:
    problem = load_problem("barrett-ball-roll", ("limits.margin=1.4956 N", "task.knots=5"))
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Unknown)
    assert answer.stage == "execution"
    assert answer.reached is None
    held = "the hand that moves does not hold the object within its limits at t = 0 s: limits.margin (finger1/tip, "
    assert answer.why.startswith(held)


def test_a_contact_that_leaves_its_face_is_what_is_told_of_shorter_pieces_too() -> None:
    """The last pieces before the edge are not taken for other reasons; the edge is why there is no more."""
    problem = load_problem({
        "schema": 1,
        "hand": {"model": "gripper", "posture": "box"},
        "object": {
            "shape": {"box": {"size": ["40 mm", "30 mm", "4 mm"]}},
            "position": ["0 mm", "0 mm", "120 mm"],
            "mass": "100 g",
        },
        "contacts": {
            "model": "soft", "friction": 0.6, "spin_friction": "5 mm", "stiffness": "8 N/mm",
            "spin_stiffness": "2 N m/rad", "at": ["left/tip", "right/tip"],
        },
        "task": {
            "duration": "2 s", "knots": 11, "gravity": [0, 0, 9.81], "move": [{"axis": "z", "lift": "-10 mm"}],
        },
        "limits": {"margin": "0.3 N", "normal_force": "40 N"},
        "goal": {"minimise": "peak_force"},
    })  # fmt: skip
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Unknown)
    assert answer.reached is not None
    assert "runs over the edge of its face" in answer.reached.because
    once = plan(problem.grasp, problem.task.replace(linearise="once"))
    assert isinstance(once, Unknown | Infeasible)
    assert 'task.linearise = "along"' in " ".join([once.why, *getattr(once, "hints", ())])
