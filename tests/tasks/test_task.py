"""Tasks made in code: the same as from a file, varied, and judged argument by argument."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from dataclasses import MISSING, fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.slip_margin import SlipMargin
from synergrip.errors import InputError
from synergrip.files import bundled
from synergrip.grasps.objects import Object, Sphere
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan
from synergrip.problems.problem import Problem, load_problem
from synergrip.statics.analysis import analyse
from synergrip.tasks.gravity import Gravity
from synergrip.tasks.hold import Hold
from synergrip.tasks.motion_tables import ModesTable, MotionTable
from synergrip.tasks.moves import ModeMove, Move, Moves
from synergrip.tasks.palm_motion import Palm
from synergrip.tasks.palm_path import PalmPath
from synergrip.tasks.pushes import Push
from synergrip.tasks.registry import LOADS, TARGETS
from synergrip.tasks.stated import Load, Motion, Setting
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.waypoints import Waypoints
from synergrip.tasks.wrenches import Wrench, WrenchTable

WEIGHT = Gravity((0, 0, -9.81))
PROBLEMS = bundled("problems")
IN_CODE: dict[str, dict[str, Any]] = {
    "barrett-ball-hold": {"loads": [WEIGHT, Palm(axis="x", turn=np.pi)]},
    "pinch-soft": {"loads": [Wrench((0, 0, -2, 0.004, 0, 0))]},
    "tripod": {
        "loads": [WrenchTable.from_csv(PROBLEMS / "tripod-wrench.csv")],
        "target": MotionTable.from_csv(PROBLEMS / "tripod-motion.csv"),
    },
    "barrett-ball-arm": {
        "loads": [WEIGHT, PalmPath.from_csv(PROBLEMS / "barrett-ball-arm.csv", inertia=True)],
    },
}
"""Loads and target of bundled problems; the rest of these tasks says nothing of them."""
EXAMPLES: tuple[Load | Motion, ...] = (
    WEIGHT, Wrench((1, 2, 3, 4, 5, 6)), WrenchTable([0, 2], np.ones((2, 6))),
    Push(force=3, direction=(0, 3, 4), start=0.5, end=1.5, profile="half-sine"),
    Palm(axis="x", turn=1.0, inertia=True), PalmPath([0, 0.5, 1, 2], np.zeros((4, 6)), inertia=True),
    Hold(), Move(axis="z", lift=0.01), ModeMove(mode=2, amplitude=0.01),
    Move(axis="z", lift=0.01) + Move(axis="x", roll=1),
    Waypoints(times=[1, 2], positions=[[0, 0, 1], [0, 1, 0]]), MotionTable([0, 2], np.ones((2, 6))),
    ModesTable([0, 2], np.ones((2, 3))),
)  # fmt: skip
BALL = Object(title="ball", mass=0.2, position=np.array([0.0, 0.0, 0.1]), shape=Sphere(0.05))


def same(one: TimedTask, other: TimedTask) -> None:
    """Exactly the same at the knots and between them."""
    for name in ("times", "wrench"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
    np.testing.assert_array_equal(one.target.values, other.target.values)
    assert one.target.kind == other.target.kind
    for name in ("margin", "goals", "tolerance", "tracking", "axes", "drift", "between"):
        assert getattr(one, name) == getattr(other, name)
    assert one.course is not None
    assert other.course is not None
    between = np.linspace(one.times[0], one.times[-1], 101)
    np.testing.assert_array_equal(one.course.load_at(between), other.course.load_at(between))
    np.testing.assert_array_equal(one.course.target_at(between), other.course.target_at(between))
    for name in ("corners", "curved"):
        np.testing.assert_array_equal(getattr(one.course.marks, name), getattr(other.course.marks, name))


def in_code(problem: Problem, **arguments: Any) -> Task:
    """A task of these loads and this target, with time, tracking, limits and goals of a problem."""
    asked = problem.task
    return Task(
        duration=asked.duration, knots=asked.knots, limits=asked.limits, goals=asked.goals, tracking=asked.tracking,
        tolerance=asked.tolerance, axes=asked.axes, drift=asked.drift, between=asked.between, **arguments,
    )  # fmt: skip


@pytest.mark.parametrize("name", list(IN_CODE))
def test_a_task_in_code_is_that_of_the_file_and_so_is_its_plan(name: str) -> None:
    problem = load_problem(name)
    task = in_code(problem, **IN_CODE[name])
    same(task.timed(problem.grasp), problem.timed)
    one, other = plan(problem.grasp, task), plan(problem.grasp, problem.timed)
    assert isinstance(one, Plan)
    assert isinstance(other, Plan)
    np.testing.assert_array_equal(one.motion.dz_r, other.motion.dz_r)


STATED: list[tuple[list[str], dict[str, Any]]] = [
    (["task.gravity=[0, 0, -9.81]", 'task.palm={axis=[1, -2, 0.5], turn="1.1 rad"}'],
     {"loads": [WEIGHT, Palm(axis=(1, -2, 0.5), turn=1.1)]}),
    (["task.gravity=[0, 0, -9.81]", 'task.palm={shift=["0.1 m", "0 m", "0.2 m"], inertia=true, profile="cubic"}'],
     {"loads": [WEIGHT, Palm(shift=(0.1, 0, 0.2), inertia=True, profile="cubic")]}),
    (["task.gravity=[0, 0, -9.81]", 'task.push=[{force="3 N", direction=[1, 2, 3], at=["1 m", "0 m", "0 m"], '
      'start="0.2 s", end="0.7 s", profile="trapezoid", ramp="0.1 s"}, {force="1 N", direction="y"}]'],
     {"loads": [WEIGHT, Push(force=3, direction=(1, 2, 3), point=(1, 0, 0), start=0.2, end=0.7, profile="trapezoid",
                             ramp=0.1), Push(force=1, direction="y")]}),
    (["task.gravity=[0, 0, -9.81]", 'task.move=[{axis="z", lift="0.01 m"}, {axis=[0, 3, 4], roll="0.1 rad"}]'],
     {"loads": [WEIGHT], "target": Move(axis="z", lift=0.01) + Move(axis=(0, 3, 4), roll=0.1)}),
    (["task.gravity=[0, 0, -9.81]", 'task.move=[{mode=1, amplitude="0.01 m", profile="linear"}]'],
     {"loads": [WEIGHT], "target": ModeMove(mode=1, amplitude=0.01, profile="linear")}),
    (["task.wrench=[0, 0, -2, 0, 0, 0]", 'task.profile="spline"',
      'task.waypoint=[{time="0.4 s", position=["0 m", "0 m", "0.01 m"]}, {time="1 s", rotation=["0 rad", "1 rad", '
      '"0 rad"]}]'],
     {"loads": [Wrench((0, 0, -2, 0, 0, 0))],
      "target": Waypoints(times=[0.4, 1], positions=[[0, 0, 0.01], [0, 0, 0]], rotations=[[0, 0, 0], [0, 1, 0]],
                          profile="spline")}),
]  # fmt: skip


@pytest.mark.parametrize(("overrides", "arguments"), STATED)
def test_each_load_and_target_in_code_is_that_of_its_key(overrides: list[str], arguments: dict[str, Any]) -> None:
    problem = load_problem("barrett-ball-hold", ['task={duration="1 s"}', *overrides])
    same(in_code(problem, **arguments).timed(problem.grasp), problem.timed)


@pytest.mark.parametrize("kind", [*LOADS, *TARGETS], ids=lambda kind: kind.__name__)
def test_every_load_and_target_has_values_marks_and_documentation(kind: type) -> None:
    value = next(each for each in EXAMPLES if type(each) is kind)
    profile = value.over(Setting(0.0, 2.0, BALL))
    assert profile is not None
    times = np.linspace(0, 2, 5)
    width = 6 if isinstance(value, Load) or value.kind == "motion" else np.shape(profile.at(times))[1]
    assert profile.at(times).shape == (5, width)
    assert profile.marks.corners.ndim == 1
    assert (kind.__doc__ or "").count("Example:") == 1
    assert f"`{kind.__name__}`" in (Path(__file__).parents[2] / "docs" / "problem-file.md").read_text(encoding="utf-8")
    assert len(repr(value)) < 400
    assert value == value
    assert isinstance(hash(value), int)
    again = pickle.loads(pickle.dumps(value)).over(Setting(0.0, 2.0, BALL))
    np.testing.assert_array_equal(again.at(times), profile.at(times))


def test_the_load_factor_multiplies_the_whole_load_and_what_a_hand_holds_at_the_start() -> None:
    problem = load_problem("barrett-ball-hold")
    task = problem.task.replace(loads=[WEIGHT, Push(force=1, direction="x", start=0.3, end=0.6)], load_factor=1.5)
    timed, once = task.timed(problem.grasp), task.replace(load_factor=1).timed(problem.grasp)
    assert timed.wrench == pytest.approx(1.5 * once.wrench)
    assert timed.course is not None
    assert once.course is not None
    for one, other in zip(timed.course.marks.jumps, once.course.marks.jumps, strict=True):
        assert one.change == pytest.approx(1.5 * other.change)
    answer = plan(problem.grasp, task)
    assert answer.analysis is not None
    assert answer.analysis.grasp.w_0 == pytest.approx(1.5 * once.wrench[0])
    matrices = load_problem("pinch-soft")
    held = replace(matrices.grasp, w_0=np.array([0, 0, -1.0, 0, 0, 0]), lambda_0=None)
    assert Task(load_factor=2, knots=3).timed(held).wrench == pytest.approx(np.tile(2 * held.w_0, (3, 1)))


def test_a_task_is_varied_without_touching_the_first_one() -> None:
    problem = load_problem("barrett-ball-hold")
    lighter = problem.task.replace(duration=3.0, knots=7, loads=[Gravity((0, 0, -1.0))])
    assert lighter.timed(problem.grasp).times == pytest.approx(np.linspace(0, 3, 7))
    assert len(problem.task.timed(problem.grasp).times) == len(problem.timed.times)
    strict = problem.task.replace(limits=[SlipMargin(1e3), NormalForce(0.0, 20.0)])
    assert isinstance(plan(problem.grasp, strict), Infeasible)
    best = problem.task.replace(limits=[NormalForce(0.0, 20.0)], goals=[LargestMargin(), LeastEffort()])
    assert best.timed(problem.grasp).goals == (LargestMargin(), LeastEffort())


def test_an_analysis_stands_for_its_grasp_and_holds_the_load_too() -> None:
    problem = load_problem("barrett-ball-hold")
    bare = replace(problem.grasp, w_0=np.zeros(6))
    by_analysis, by_grasp = plan(analyse(bare), problem.task), plan(bare, problem.task)
    assert isinstance(by_analysis, Plan)
    assert isinstance(by_grasp, Plan)
    np.testing.assert_array_equal(by_analysis.motion.forces, by_grasp.motion.forces)
    assert by_analysis.analysis.grasp.w_0 == pytest.approx(problem.timed.wrench[0])


def test_solvers_are_asked_by_name() -> None:
    problem = load_problem("pinch-soft")
    one, two = (plan(problem.grasp, problem.task, solver=name) for name in ("clarabel", "cvxpy"))
    assert isinstance(one, Plan)
    assert isinstance(two, Plan)
    assert one.motion.forces == pytest.approx(two.motion.forces, abs=1e-4)


PINCH, HOLD = load_problem("pinch-soft"), load_problem("barrett-ball-hold")
POSES = np.zeros((2, 6))
MISTAKES: list[tuple[Callable[[], Any], str, str]] = [
    (lambda: Gravity(9.81), "Gravity.acceleration", "expected shape (3,)"),  # type: ignore[arg-type]
    (lambda: Gravity((0, 0, np.nan)), "Gravity.acceleration", "nan"),
    (lambda: Gravity((0, 0, 1e200)), "Gravity.acceleration", "too large"),
    (lambda: Wrench((1, 2, 3)), "Wrench.values", "expected shape (6,)"),
    (lambda: Wrench("gravity"), "Wrench.values", "got 'gravity'"),  # type: ignore[arg-type]
    (lambda: WrenchTable([1, 0], POSES), "WrenchTable.times", "0 s comes after 1 s"),
    (lambda: WrenchTable([0, 1], np.zeros((6, 2))), "WrenchTable.values", "got (6, 2)"),
    (lambda: WrenchTable([], POSES), "WrenchTable.times", "one or more instants"),
    (lambda: WrenchTable.from_csv("no-such.csv"), "", "no-such.csv"),
    (lambda: Push(force=-1, direction="x"), "Push.force", "of at least 0, got -1"),
    (lambda: Push(force=1, direction="-x"), "Push.direction", "'-x' is not 'x'"),
    (lambda: Push(force=1, direction=(0, 0, 0)), "Push.direction", "needs a direction"),
    (lambda: Push(force=1, direction="x", profile="ramp"), "Push.profile", "'trapezoid'"),  # type: ignore[arg-type]
    (lambda: Push(force=1, direction="x", profile="trapezoid"), "Push.ramp", "needs ramp"),
    (lambda: Push(force=1, direction="x", start="1 s"), "Push.start", "got '1 s'"),  # type: ignore[arg-type]
    (lambda: Palm(), "Palm.turn", "needs a motion"),
    (lambda: Palm(turn=1.0), "Palm.axis", "goes with turn"),
    (lambda: Palm(shift=(1, 0, 0)), "Palm.shift", "give inertia=True"),
    (lambda: Palm(axis="x", turn=1, inertia=1), "Palm.inertia", "expected True or False"),  # type: ignore[arg-type]
    (lambda: PalmPath([0, 1], POSES, inertia=True), "PalmPath.times", "at least 4"),
    (lambda: PalmPath([0, 1], [[0] * 6, [0, 0, 0, 3, 0, 0]]), "PalmPath.poses", "which way is not clear"),
    (lambda: Move(axis="z"), "Move.lift", "needs lift"),
    (lambda: ModeMove(mode=0, amplitude=1), "ModeMove.mode", "from 1 to 6, got 0"),
    (lambda: Move(axis="z", lift=1) + ModeMove(mode=1, amplitude=1), "Moves.parts", "cannot be mixed"),
    (lambda: Move(axis="z", lift=1) + 3, "Moves.parts", "got 3"),  # type: ignore[operator]
    (lambda: Moves(()), "Moves.parts", "got none"),
    (lambda: Waypoints(times=[1, 0.5], positions=np.zeros((2, 3))), "Waypoints.times", "comes after 1 s"),
    (lambda: Waypoints(times=[0, 0.5], positions=np.zeros((2, 3))), "Waypoints.times", "after the start"),
    (lambda: Waypoints(times=[1]), "Waypoints.positions", "is missing"),
    (lambda: Waypoints(times=[1], modes=[[1]], rotations=[[0, 0, 1]]), "Waypoints.rotations", "leave out rotations"),
    (lambda: ModesTable([0, 1], [1, 2]), "ModesTable.values", "got (2,)"),  # type: ignore[list-item]
    (lambda: Task(duration=0), "Task.duration", "of at least 1e-06, got 0"),
    (lambda: Task(duration="2 s"), "Task.duration", "got '2 s'"),  # type: ignore[arg-type]
    (lambda: Task(knots=2.5), "Task.knots", "whole number"),  # type: ignore[arg-type]
    (lambda: Task(target="hold"), "Task.target", "got 'hold'"),  # type: ignore[arg-type]
    (lambda: Task(loads=WEIGHT), "Task.loads", "write loads=[...] around it"),  # type: ignore[arg-type]
    (lambda: Task(loads=[(0, 0, -9.81)]), "Task.loads[0]", "got a list"),  # type: ignore[list-item]
    (lambda: Task(limits=[0.5]), "Task.limits[0]", "expected a limit"),  # type: ignore[list-item]
    (lambda: Task(goals=["effort"]), "Task.goals[0]", "expected a goal"),  # type: ignore[list-item]
    (lambda: Task(goals=[]), "Task.goals", "got none"),
    (lambda: Task(tracking="rigd"), "Task.tracking", "did you mean 'rigid'"),  # type: ignore[arg-type]
    (lambda: Task(tracking="compliant"), "Task.tolerance", "greater than 0"),
    (lambda: Task(axes=("x", "roll")), "Task.axes[1]", "'rx'"),  # type: ignore[arg-type]
    (lambda: Task(drift=1e-3), "Task.drift", "leaves none"),
    (lambda: Task(load_factor=-1), "Task.load_factor", "got -1"),
    (lambda: Task(loads=[Palm(axis="x", turn=1)]), "Task.loads[0]", "changes nothing without Gravity"),
    (lambda: Task(loads=[WEIGHT, WEIGHT]), "Task.loads[1]", "given already by loads[0]"),
    (lambda: Task(knots=1, target=Move(axis="z", lift=1)), "Task.knots", "at least 2 knots"),
    (lambda: Task(duration=1, target=Waypoints(times=[2], modes=[[1]])), "Task.target.times", "after the end"),
    (lambda: Task().replace(mass=1), "Task.mass", "'duration'"),
    (lambda: Task(loads=[WEIGHT]).timed(PINCH.grasp), "Task.loads[0]", "give the weight as a Wrench"),
    (lambda: Task(loads=[Push(force=1, direction="x", end=2)]).timed(PINCH.grasp), "Task.loads[0].end", "ends at 2 s"),
    (lambda: Task(loads=[WrenchTable([0, 1], POSES)], duration=3).timed(PINCH.grasp), "Task.loads[0]", "covers 0 s"),
    (lambda: plan(PINCH.grasp, Task(target=ModeMove(mode=6, amplitude=1e-3))), "Task.target", "mode 6 is asked for"),
    (lambda: plan("barrett", Task()), "grasp", "expected a Grasp or an Analysis, got str"),  # type: ignore[arg-type]
    (lambda: plan(PINCH.grasp, {}), "task", "expected a Task, got dict"),  # type: ignore[arg-type]
    (lambda: plan(PINCH.grasp, Task(), solver="scs"), "solver", "'clarabel' or 'cvxpy'"),
    (lambda: Task().timed(3), "grasp", "expected a Grasp, got int"),  # type: ignore[arg-type]
]  # fmt: skip


@pytest.mark.parametrize(("mistake", "key", "fragment"), MISTAKES)
def test_a_mistake_in_code_names_its_argument(mistake: Callable[[], Any], key: str, fragment: str) -> None:
    with pytest.raises(InputError) as caught:
        mistake()
    (issue,) = caught.value.issues
    assert issue.key == key
    assert fragment in str(issue)


NONSENSE: list[Any] = [
    None, -1, float("nan"), float("inf"), "abc", "", [], [1], [[1, 2], [3]], {}, {1}, object(), True, 1j, int, b"x",
    np.zeros((0, 6)), np.zeros((2, 3, 4)), np.array("a"), 10**400, [10**400], [None] * 3, ["x"] * 6,
]  # fmt: skip
LEAST: dict[str, Any] = {
    "times": [1, 2, 3, 4], "values": np.zeros((4, 6)), "poses": np.zeros((4, 6)), "acceleration": (0, 0, -9),
    "force": 1, "direction": "x", "axis": "x", "mode": 1, "amplitude": 1, "parts": (),
}  # fmt: skip
"""What must be given, with values that are right."""


@pytest.mark.parametrize("kind", [*LOADS, *TARGETS, Task], ids=lambda kind: kind.__name__)
def test_nonsense_in_any_argument_is_an_input_error_or_means_something(kind: Any) -> None:
    needed = {field.name: LEAST[field.name] for field in fields(kind) if field.default is MISSING}
    for name in (field.name for field in fields(kind)):
        refused = 0
        for value in NONSENSE:
            try:
                kind(**{**needed, name: value})
            except InputError:
                refused += 1
        assert refused > len(NONSENSE) / 2
