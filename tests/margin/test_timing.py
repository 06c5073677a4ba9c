"""The fastest timing along a path of the palm: closed forms, the load, cones at all instants, files, refusals."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from command_line import run
from jaws_that_move import jaws
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

import synergrip as sg
from synergrip.grasps.scale import scale_of
from synergrip.margin.timing import attained, fastest_program
from synergrip.margin.timing.by_length import Leg, legs
from synergrip.margin.timing.fastest_program import Timing, Usual, fastest
from synergrip.margin.timing.loads import load_along
from synergrip.margin.timing.question import TimingQuestion, timing_question
from synergrip.planning.planning import plan_of_start_posture

G, MASS, MU, CAP, MARGIN, FAR = 9.81, 0.1, 0.5, 20.0, 0.5, 0.2
PAGE = (Path(__file__).parents[2] / "docs" / "margins.md").read_text(encoding="utf-8")
HELD = 2 * (MU * CAP - MARGIN) / MASS
"""[m/s^2] what two jaws hold across their normals: each carries half of it."""
LIMITS = (sg.SlipMargin(MARGIN), sg.NormalForce(upper=CAP))
DOWN = sg.Gravity((0, 0, -G))


@cache
def gripper() -> sg.Grasp:
    return replace(jaws(None, 0.02, 0.0, C_s=[1e-4, 1e-4, 1e-4, 1e-1], C_q=[0] * 6), lambda_0=None)


def carried(palm: sg.Palm | sg.PalmPath, limits: Sequence[sg.Limit] = LIMITS, **others: object) -> sg.Task:
    return sg.Task(**{"loads": [DOWN, palm], "limits": limits, **others})  # type: ignore[arg-type]


def shifted(shift: tuple[float, float, float]) -> sg.Palm:
    return sg.Palm(shift=shift, inertia=True)


def there_and_back() -> sg.PalmPath:
    times = np.linspace(0.0, 1.0, 41)
    poses = np.zeros((41, 6))
    poses[:, 1] = FAR * np.sin(np.pi * times) ** 2
    return sg.PalmPath(times, poses, inertia=True)


@pytest.mark.parametrize(
    ("palm", "seconds"),
    [
        # up with F - g, then braked by F + g
        (shifted((0, 0, FAR)), np.sqrt(2 * FAR * (1 / (HELD - G) + 1 / (HELD + G)))),
        # to the side, with gravity across: a^2 + g^2 = F^2, half of the way each
        (shifted((0, FAR, 0)), 2 * np.sqrt(FAR / np.sqrt(HELD**2 - G**2))),
        # out and back, with a stop between
        (there_and_back(), 4 * np.sqrt(FAR / np.sqrt(HELD**2 - G**2))),
    ],
)
def test_a_gripper_goes_by_full_acceleration_and_full_braking(palm: sg.Palm | sg.PalmPath, seconds: float) -> None:
    found = sg.fastest_timing(gripper(), carried(palm))
    assert found.proven
    assert found.lower == pytest.approx(seconds, rel=5e-5)
    assert found.value == found.upper == pytest.approx(seconds, rel=3e-3)
    assert found.value is not None
    assert found.lower is not None
    assert found.value > found.lower
    assert found.plan is not None
    assert found.plan.executed is not None
    assert found.plan.time[-1] == found.value
    assert found.share is not None
    assert (found.share[0], found.share[-1]) == (0.0, 1.0)
    assert np.all(np.diff(found.share) > 0)


def winding(count: int = 25) -> sg.PalmPath:
    """A path that turns about an axis that turns, never at rest."""
    times = np.linspace(0.0, 1.0, count)
    places = [0.2 * np.sin(3 * times), 0.1 * np.cos(4 * times), 0.15 * times]
    turns = [0.8 * times, 0.5 * np.sin(2 * times), 0.3 * times**2]
    return sg.PalmPath(times, np.column_stack([*places, *turns]), inertia=True)


def ball() -> tuple[sg.Grasp, sg.Task]:
    problem = sg.load_problem("barrett-ball-carry")
    return problem.grasp, problem.task


def test_speed_and_acceleration_load_the_object_as_the_motion_in_time_does() -> None:
    """The same poses at the instants of s(t), as a path of its own, whose spline is differentiated in time."""
    grasp, task = ball()
    (leg,) = legs(winding(), 0.0, 1.0, 0.05, 256)
    times = np.linspace(0.0, 0.7, 701)
    share = 0.3 * times / 0.7 + 0.7 * (times / 0.7) ** 2
    s = leg.length * share
    b = (leg.length * (0.3 / 0.7 + 1.4 * times / 0.49)) ** 2
    a = np.full(len(times), leg.length * 1.4 / 0.49)
    found = load_along(grasp, task, leg, s).wrench(a, b)
    poses = leg.palm.poses(s)
    rotations = Rotation.from_quat(poses[:, 3:]).as_rotvec()
    path = sg.PalmPath(times, np.hstack([poses[:, :3], rotations]), inertia=True)
    other = task.replace(loads=[task.loads[0], path], duration=None, knots=None).timed(grasp)
    expected = np.array([np.interp(times, other.times, column) for column in np.asarray(other.wrench).T]).T
    assert np.abs(found - expected)[5:-5].max() < 2e-4 * np.abs(expected).max()
    assert np.abs(load_along(grasp, task, leg, s).wrench(0 * a, b) - expected).max() > 0.1  # what a adds is seen


def asked(grasp: sg.Grasp, task: sg.Task, parts: int = 64) -> Timing:
    timed = task.timed(grasp)
    (palm,) = (load for load in task.loads if isinstance(load, sg.Palm | sg.PalmPath))
    path = legs(palm, 0.0, float(timed.times[-1]), scale_of(grasp).length, parts)
    rates = tuple(each for each in timed.limits if isinstance(each, sg.SynergyRate))

    def pose(usual: Usual) -> TimingQuestion:
        return timing_question(grasp, task, timed, path, usual)

    found = fastest(pose, (4.0, 1.0), rates)
    assert isinstance(found, Timing)
    return found


def test_cones_hold_on_both_sides_of_the_points_and_between_them() -> None:
    """Forces by the response of the grasp, at many instants of every part, from references that are linear there."""
    grasp, _ = ball()
    found = asked(grasp, carried(winding()), 128)
    question = found.question
    response, spaces = question.formulation.response, question.formulation.spaces
    alpha = found.v @ question.formulation.alpha.matrix.T
    (leg,) = question.legs
    a = np.diff(found.b) / (2 * np.diff(leg.at))
    least, most = np.inf, 0.0
    for share in np.linspace(0.0, 1.0, 33):
        at = leg.at[:-1] + share * np.diff(leg.at)
        wrench = load_along(grasp, question.task, leg, at).wrench(a, (1 - share) * found.b[:-1] + share * found.b[1:])
        inner = (1 - share) * alpha[:-1] + share * alpha[1:]
        forces = inner @ spaces.E_s.T - wrench @ response.right_inverse.T
        for contact, rows in zip(grasp.contacts, grasp.rows, strict=True):
            least = min(least, contact.slip_margin(forces[:, rows]).min())
        most = max(most, forces[:, grasp.normal_rows].max())
    assert MARGIN - 1e-4 < least < MARGIN + 2e-3
    assert most == pytest.approx(CAP, abs=1e-3)


def test_the_file_is_planned_with_the_asked_margin_and_no_faster(tmp_path: Path) -> None:
    done = run("margins", "barrett-ball-carry", "--only", "fastest_timing_s", "-o", str(tmp_path), "--format", "json")
    assert done.exit_code == 0, done.stderr
    found = json.loads(done.stdout)["fastest_timing_s"]
    assert found["proven"]
    assert found["lower"] < found["value"] < 1.1 * found["lower"] < found["given_s"] / 2
    shown = re.search(r"of the palm: (\S+) s instead of (\S+) s, not below (\S+) s", PAGE)
    assert shown is not None
    told = [found[name] for name in ("value", "given_s", "lower")]
    assert [float(each) for each in shown.groups()] == pytest.approx(told, rel=1e-3)
    file = tmp_path / "palm.csv"
    overrides = [f'task.palm={{path="{file}",inertia=true}}', f'task.duration="{found["value"]!r} s"', "task.knots=61"]
    again = sg.load_problem("barrett-ball-carry", overrides)
    answer = sg.plan(again.grasp, again.task)
    assert isinstance(answer, sg.Plan)
    assert answer.margins.min() > 0.5 - 1e-3
    path = sg.PalmPath.from_csv(file, inertia=True)
    for factor, verdict in ((1.002, "feasible"), (0.985, "infeasible")):
        times = np.asarray(path.times) * factor * found["lower"] / found["value"]
        loads = [again.task.loads[0], sg.PalmPath(times, path.poses, inertia=True)]
        faster = again.task.replace(loads=loads, duration=None, knots=None)
        assert plan_of_start_posture(again.grasp, faster).verdict == verdict


LIFTED = [DOWN, shifted((0, 0, FAR))]


@pytest.mark.parametrize(
    ("changes", "key", "told"),
    [
        ({"loads": [DOWN]}, "Task.loads", "none is given"),
        ({"loads": [DOWN, sg.Palm(axis="x", turn=1.0)]}, "Task.loads[1].inertia", "inertia=True"),
        ({"loads": [*LIFTED, sg.Push(force=1.0, direction="x", start=0.2)]}, "Task.loads[2]", "Push is bound"),
        ({"loads": [*LIFTED, sg.WrenchTable([0, 1], np.zeros((2, 6)))]}, "Task.loads[2]", "WrenchTable is"),
        ({"target": sg.Move(axis="z", lift=0.001)}, "Task.target", "target=Hold()"),
        ({"allow": sg.Allowances(mass=(0.1, 0.2))}, "Task.allow", "leave allow out"),
        ({"limits": [sg.SynergyAcceleration(1.0)]}, "limits.synergy_acceleration", "leave it out"),
    ],
)
def test_what_goes_by_the_clock_is_refused_by_name(changes: dict[str, object], key: str, told: str) -> None:
    with pytest.raises(sg.InputError) as refused:
        sg.fastest_timing(gripper(), sg.Task(**{"loads": LIFTED, "duration": 1.0, **changes}))  # type: ignore[arg-type]
    assert [issue.key for issue in refused.value.issues] == [key]
    assert told in str(refused.value)


def test_without_a_timing_it_says_why(tmp_path: Path) -> None:
    """A weight that no force within the cap carries has none, at any speed."""
    found = sg.fastest_timing(gripper(), carried(shifted((0, FAR, 0)), limits=(sg.NormalForce(upper=0.9),)))
    assert (found.value, found.lower, found.proven) == (None, None, False)
    assert "proven" in found.why
    with pytest.raises(sg.InputError, match="no timing keeps all limits"):
        found.write(tmp_path / "palm.csv")


def test_rates_are_kept_and_a_local_answer_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    """The bound with rates is of a convex program; where it is attained, steps from a slow start come to it, too."""
    grasp, task = ball()
    rate = 0.03
    task = task.replace(limits=[*LIMITS, sg.SynergyRate(rate)])
    found, free = asked(grasp, task), asked(grasp, task.replace(limits=LIMITS))
    assert found.least is not None
    assert free.least is not None
    assert found.least > 1.05 * free.least
    assert not found.local
    assert found.seconds == pytest.approx(found.least, rel=1e-5)
    monkeypatch.setattr(fastest_program, "kept_by", lambda *rest: False)
    local = asked(grasp, task)
    assert local.local
    assert found.least * (1 - 1e-6) <= local.seconds <= 1.01 * found.least
    question = local.question
    seconds = 2 * question.parts / (np.sqrt(local.b[:-1]) + np.sqrt(local.b[1:]))
    moved = np.abs(np.diff(local.v @ question.formulation.reference.matrix.T, axis=0)) / seconds[:, None]
    assert rate * 0.99 < moved.max() < rate * (1 + 1e-5)


def test_a_path_by_its_length_is_the_path() -> None:
    """At unit speed, whatever the timing it was given at; and as far from its poses as rounding."""
    (leg,) = legs(winding(), 0.0, 1.0, 0.05, 128)
    assert isinstance(leg, Leg)
    at = np.linspace(0.0, leg.length, 517)
    omega, _ = leg.palm.rotation_rates(at)
    speed = np.hypot(np.linalg.norm(leg.palm.velocity(np.zeros(3), at), axis=1), 0.05 * np.linalg.norm(omega, axis=1))
    assert np.abs(speed - 1).max() < 2e-4
    dense = winding(25)
    given = CubicSpline(np.asarray(dense.times), np.asarray(dense.poses)[:, :3])(np.linspace(0, 1, 20001))
    away = np.linalg.norm(leg.palm.poses(at)[:, None, :3][::40] - given[None], axis=2).min(axis=1)
    assert away.max() < 2e-5


def test_neither_the_frame_of_a_path_nor_its_timing_change_the_least_time() -> None:
    """Gravity is that of the palm at the start."""
    grasp, _ = ball()
    dense = winding(201)
    frame = Rotation.from_rotvec([0.4, -2.0, 1.1])
    poses = np.array(dense.poses)
    turned = np.hstack([
        frame.apply(poses[:, :3]) + np.array([3.0, -1.0, 0.5]), (frame * Rotation.from_rotvec(poses[:, 3:])).as_rotvec()
    ])  # fmt: skip
    other = sg.PalmPath(3.0 * (np.asarray(dense.times) + 0.2) ** 1.5 - 3.0 * 0.2**1.5, turned, inertia=True)
    one, again = (asked(grasp, carried(path)).least for path in (dense, other))
    assert one is not None
    assert again == pytest.approx(one, rel=2e-5)
    assert asked(grasp, carried(dense, limits=(*LIMITS[:1], sg.NormalForce(upper=19.0)))).least > 1.01 * one  # type: ignore[operator]


def test_where_the_hand_does_not_follow_the_fastest_timing_the_one_that_is_asked_is_made_faster(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem = sg.load_problem("barrett-ball-carry")
    monkeypatch.setattr(attained, "SLOWER", (1.001,))  # the hand needs 3 % more
    monkeypatch.setattr(attained, "HALVES_AS_ASKED", 1)
    found = sg.fastest_timing(problem.grasp, problem.task)
    assert found.lower is not None
    assert found.value is not None
    assert found.lower < found.value < found.given_s
    assert "with one factor on the times that are given" in found.why
    assert found.plan is not None
    assert found.path is not None
    assert found.share is not None
    assert found.given_share is not None
    even = np.linspace(0.0, 1.0, len(found.given_share))
    passed = np.interp(np.asarray(found.path.times) / found.value, even, found.given_share)
    np.testing.assert_allclose(found.share, passed, atol=1e-12)
    # a spline through 61 poses has the accelerations of the timing asked for but for a hundredth of the load
    asked = problem.task.replace(time_factor=found.value / found.given_s, knots=len(found.share))
    other = sg.plan(problem.grasp, asked)
    assert isinstance(other, sg.Plan)
    np.testing.assert_allclose(other.task.wrench, found.plan.task.wrench, atol=0.03)
