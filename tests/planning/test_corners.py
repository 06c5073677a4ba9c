"""Corners between the knots: lines of tables, peaks and jumps are seen wherever they lie, in plans and in checks."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from elastic_grasp import course, normal_forces, slip_margins
from judged_between import judged

from synergrip.files import bundled
from synergrip.linalg import Array, frozen
from synergrip.planning.check import judge_references
from synergrip.planning.instants import intersample_of
from synergrip.planning.outcome import Infeasible, Plan, Unknown
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.planning.references import References
from synergrip.planning.solvers import SOLVERS
from synergrip.problems.problem import Problem, load_problem
from synergrip.reports.text.text_between import between_lines
from synergrip.statics.analysis import analyse
from synergrip.tasks.marks import Marks

HEADER = "t_s,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm"
TRIPOD = bundled("problems") / "tripod.json"
LIMITS = "margin = '0.3 N'\nnormal_force = '20 N'"


def written(path: Path, times: Array, forces: Array) -> None:
    """Write a load without moments."""
    lines = np.column_stack([times, forces, np.zeros((len(times), 3))]).tolist()
    rows = [",".join(map(repr, line)) for line in lines]
    path.write_text("\n".join([HEADER, *rows]), encoding="utf-8")


def held(
    folder: Path, task: str, between: str = "hold", limits: str = LIMITS, goal: str = "minimise = 'effort'"
) -> Problem:
    """A puck that three fingers hold for a second."""
    text = f"""schema = 1
grasp = {{ file = '{TRIPOD}' }}
[task]
duration = "1 s"
between = "{between}"
{task}
[limits]
{limits}
[goal]
{goal}
"""
    (folder / "held.toml").write_text(text, encoding="utf-8")
    return load_problem(folder / "held.toml")


def spiked(folder: Path, size: float, knots: int, between: str = "hold", goal: str = "minimise = 'effort'") -> Problem:
    """1 N down, and for 2 ms another force that falls between all knots."""
    times, forces = np.array([0, 0.3331, 0.3341, 0.3351, 1]), np.zeros((5, 3))
    forces[:, 2], forces[2] = -1, (size, 0, -1)
    written(folder / "load.csv", times, forces)
    return held(folder, f"knots = {knots}\nwrench = 'load.csv'", between, goal=goal)


def dense(outcome: Plan, times: Array, wrench: Array) -> Array:
    """Slip margins (K, n_c) by statics written down anew, the references linear between the knots."""
    task, grasp = outcome.task, outcome.analysis.grasp
    dz_r = np.column_stack([np.interp(times, task.times, column) for column in outcome.motion.dz_r.T])
    return slip_margins(grasp, course(grasp, times, dz_r, wrench).forces)


@pytest.mark.parametrize("knots", [2, 5, 11])
def test_a_spike_between_the_knots_is_kept_when_it_is_to_be_held(knots: int, tmp_path: Path) -> None:
    problem = spiked(tmp_path, 6.0, knots)
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    assert outcome.between is not None
    assert outcome.between.exact
    assert outcome.between.corners == (0.3331, 0.3341, 0.3351)
    times = np.union1d(np.linspace(0, 1, 2001), [0.3331, 0.3341, 0.3351])
    course_of = problem.timed.course
    assert course_of is not None
    load = course_of.load_at(times)
    assert load is not None
    least = dense(outcome, times, load).min()
    assert least == pytest.approx(outcome.between.usages[0].value.min(), abs=1e-9)
    assert least == pytest.approx(0.3, abs=1e-6)  # no more than is needed: there is no reserve
    assert "and so at all times" in " ".join(" ".join(between_lines(outcome)).split())


def test_a_spike_is_told_when_it_is_only_to_be_reported(tmp_path: Path) -> None:
    problem = spiked(tmp_path, 6.0, 5, "report")
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    assert outcome.between is not None
    assert outcome.between.excess > 0.1
    told = " ".join(" ".join(between_lines(outcome)).split())
    assert "3 corners between the knots and straight lines from one to the next" in told
    assert "at t = 0.334 s, past its limit of 0.3 N" in told
    judged = judge_references(problem.grasp, problem.timed, References(problem.timed.times, outcome.motion.dz_r, {}))
    assert judged.verdict == "feasible"
    assert judged.between is not None
    assert judged.between.excess == pytest.approx(outcome.between.excess)
    problem = spiked(tmp_path, 6.0, 5)
    strict = judge_references(problem.grasp, problem.timed, References(problem.timed.times, outcome.motion.dz_r, {}))
    assert [check.name for check in strict.checks if not check.passed] == ["between the knots"]


def test_a_spike_that_no_squeeze_stands_is_proven_by_rows_at_its_corners(tmp_path: Path) -> None:
    problem = spiked(tmp_path, 100.0, 11)
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Infeasible)
    assert outcome.certificate.verified
    assert outcome.program is not None
    y = outcome.certificate.y
    assert y is not None
    weight = {True: 0.0, False: 0.0}
    for block, rows in outcome.program.slices():
        weight[block.between] += float(np.abs(y[rows]).sum())
    assert weight[True] > 0
    at_knots = spiked(tmp_path, 100.0, 11, "report")
    assert isinstance(plan(at_knots.grasp, at_knots.task), Plan)


@pytest.mark.parametrize("goal", ["maximise = 'margin'", "minimise = 'effort'", "minimise = 'peak_force'"])
def test_the_second_formulation_keeps_the_same_corners(goal: str, tmp_path: Path) -> None:
    problem = spiked(tmp_path, 4.0, 4, "hold", goal)
    one, two = (plan(problem.grasp, problem.task, SOLVERS[name]) for name in ("clarabel", "cvxpy"))
    assert isinstance(one, Plan)
    assert isinstance(two, Plan)
    np.testing.assert_allclose(two.motion.forces, one.motion.forces, atol=1e-5 * np.abs(one.motion.forces).max())


STEP = "{{ force = '{} N', direction = 'x', start = '{} s', end = '{} s' }}"
WEIGHT = "wrench = [0, 0, -1, 0, 0, 0]"


def test_a_step_is_off_just_before_it_begins_and_just_after_it_ends(tmp_path: Path) -> None:
    problem = held(tmp_path, f"knots = 6\n{WEIGHT}\npush = [{STEP.format(5, 0.4, 0.6)}]")
    intersample = intersample_of(problem.timed, analyse(problem.grasp))
    assert intersample is not None
    assert intersample.exact
    near = np.abs(intersample.grid.times - 0.5) < 0.11
    assert intersample.grid.wrench[near, 0].tolist() == [0, 5, 5, 0]
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    assert outcome.between is not None
    assert outcome.between.load_departure == pytest.approx(5.0, rel=0.02)
    assert outcome.between.corners == pytest.approx((0.4, 0.6))
    for time, force in ((0.4, 0.0), (0.4, 5.0), (0.6, 5.0), (0.6, 0.0)):
        assert dense(outcome, np.array([time]), np.array([[force, 0, -1, 0, 0, 0]])).min() >= 0.3 - 1e-6


CAP = 15.5


class Bumped:
    """A smooth bump of a force between two knots."""

    def load_at(self, times: Array) -> Array:
        load = np.tile([0.0, 0, -1, 0, 0, 0], (len(times), 1))
        load[:, 0] = 20 * np.sin(np.pi * times) ** 2
        return load

    def target_at(self, times: Array) -> Array:
        return np.zeros((len(times), 0))

    marks = Marks(curved=((0.0, 1.0),))


@pytest.mark.parametrize(("cap", "verdict"), [(30.0, Plan), (CAP, Unknown), (9.0, Infeasible)])
def test_a_no_that_only_the_reserve_makes_is_no_proof(cap: float, verdict: type, tmp_path: Path) -> None:
    problem = held(tmp_path, f"knots = 5\n{WEIGHT}", limits=f"normal_force = '{cap} N'")
    bump = Bumped()
    task = replace(problem.timed, wrench=frozen(bump.load_at(problem.timed.times)), course=bump)
    outcome = plan(problem.grasp, task)
    assert isinstance(outcome, verdict)
    if isinstance(outcome, Unknown):
        assert "more knots make the reserve smaller" in outcome.why


def test_flat_lines_of_a_table_are_no_corners_and_lines_on_the_knots_neither(tmp_path: Path) -> None:
    forces = np.tile([0.0, 0, -1], (101, 1))
    forces[42, 0] = 3.0
    written(tmp_path / "load.csv", np.linspace(0, 1, 101), forces)
    problem = held(tmp_path, "knots = 11\nwrench = 'load.csv'")
    intersample = intersample_of(problem.timed, analyse(problem.grasp))
    assert intersample is not None
    assert intersample.corners.times == pytest.approx([0.41, 0.42, 0.43])


def test_a_line_next_to_a_knot_counts_when_its_load_is_another(tmp_path: Path) -> None:
    forces = np.tile([0.0, 0, -1], (5, 1))
    forces[3, 0] = 50.0
    written(tmp_path / "load.csv", np.array([0, 0.5 - 1e-10, 0.5, 0.5 + 1e-10, 1]), forces)
    problem = held(tmp_path, "knots = 3\nwrench = 'load.csv'", "report")
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    assert outcome.between is not None
    assert outcome.between.load_departure == pytest.approx(50.0, rel=0.02)


def test_jumps_that_meet_are_seen_from_both_sides(tmp_path: Path) -> None:
    """One push ends where another begins: before, both at once, after."""
    push = f"push = [{STEP.format(2, 0.2, 0.4)}, {STEP.format(3, 0.4, 0.8)}]"
    problem = held(tmp_path, f"knots = 6\n{WEIGHT}\n{push}")
    intersample = intersample_of(problem.timed, analyse(problem.grasp))
    assert intersample is not None
    assert intersample.grid.wrench[np.abs(intersample.grid.times - 0.4) < 1e-9, 0].tolist() == [2, 5, 3]


def test_normal_forces_are_those_of_the_statics(tmp_path: Path) -> None:
    problem = spiked(tmp_path, 6.0, 5)
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    assert outcome.between is not None
    looks = intersample_of(problem.timed, outcome.analysis)
    assert looks is not None
    dz_r = np.column_stack([np.interp(looks.all.times, problem.timed.times, z) for z in outcome.motion.dz_r.T])
    normal = normal_forces(problem.grasp, course(problem.grasp, looks.all.times, dz_r, looks.all.wrench).forces)
    assert outcome.between.usages[1].value == pytest.approx(normal, abs=1e-9)


def test_claims_between_the_knots_of_files_with_lines_anywhere_are_those_of_every_line() -> None:
    """`python tests/judged_between.py` judges more of them."""
    found = [judged(seed) for seed in range(40)]
    wrong = [f"seed {each.seed}, {each.verdict}: {line}" for each in found for line in each.wrong]
    assert not wrong, "\n".join(wrong)
    assert sum(each.passed for each in found) >= 8  # so that the test can fail
