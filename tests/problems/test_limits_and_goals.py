"""[limits] on motion, [goal] with orders and weights, [task] with tracking: values, defaults, and refusals."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from named_goals import goals, names_of, ranges_of, weights_of

from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.object_error import ObjectError
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.errors import InputError
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem, located
from synergrip.problems.problem_file import read_problem_file

HAND = Path(__file__).parents[1] / "data" / "bad_inputs" / "hand.toml"
AXES = ("x", "y", "z", "rx", "ry", "rz")
ALL_SQUARES = "{effort=1, torque=2, actuator=3, references=4, travel=5, smooth=6, centred=0.5, steady=0.2}"
SQUARES = {
    "effort": 1.0, "torque": 2.0, "actuator": 3.0, "references": 4.0, "travel": 5.0, "smooth": 6.0, "centred": 0.5,
    "steady": 0.2,
}  # fmt: skip


def read(*overrides: str) -> Any:
    return read_problem_file(HAND, overrides)[0]


def issues(*overrides: str) -> list[tuple[str, str]]:
    with pytest.raises(InputError) as caught:
        read(*overrides)
    return [(issue.key, issue.message) for issue in caught.value.issues]


def test_nothing_of_it_is_asked_unless_stated() -> None:
    problem = read("goal={}")
    for name in ("synergy_acceleration", "joint_range", "elastic_motion", "drift"):
        assert getattr(problem.limits, name) is None
    assert (problem.goal.names, dict(problem.goal.weights)) == (("effort",), {})
    assert (problem.task.tracking, problem.task.tolerance, problem.task.axes) == ("rigid", None, AXES)
    assert problem.task.drift is None


@pytest.mark.parametrize(
    ("override", "path", "value"),
    [
        ("limits.synergy_acceleration=0.5", "limits.synergy_acceleration", 0.5),
        ("limits.synergy_acceleration=[1, 2.5]", "limits.synergy_acceleration", (1.0, 2.5)),
        ("limits.joint_range=hand", "limits.joint_range", "hand"),
        ("limits.joint_range=none", "limits.joint_range", "none"),
        ("limits.elastic_motion=0.5 mm", "limits.elastic_motion", 0.0005),
        ("limits.drift=2 mm", "limits.drift", 0.002),
        ("goal={maximise='margin'}", "goal.names", ("margin",)),
        *((f"goal.minimise={name}", "goal.names", (name,)) for name in (*SQUARES, "peak_force")),
        ("goal={minimise={travel=0.1}}", "goal.names", ("travel",)),
        (f"goal={{minimise={ALL_SQUARES}}}", "goal.weights", SQUARES),
        ("goal={order=['smooth']}", "goal.names", ("smooth",)),
        ("goal={order=['margin', 'effort', 'travel']}", "goal.names", ("margin", "effort", "travel")),
        ("goal={order=['peak_force', 'margin', 'torque', 'references', 'centred']}", "goal.names",
         ("peak_force", "margin", "torque", "references", "centred")),
        ("goal={order=['travel', 'smooth', 'actuator']}", "goal.names", ("travel", "smooth", "actuator")),
        ("task.axes=['z']", "task.axes", ("z",)),
        ("task.axes=['rz', 'x']", "task.axes", ("rz", "x")),
        ("task={axes=['x', 'ry'], drift='3 mm'}", "task.drift", 0.003),
        ("task={tracking='compliant', tolerance='0.2 mm'}", "task.tracking", "compliant"),
        ("task={tracking='compliant', tolerance='0.2 mm'}", "task.tolerance", 0.0002),
    ],
)  # fmt: skip
def test_every_form_of_a_value(override: str, path: str, value: object) -> None:
    found: Any = read(override)
    for part in path.split("."):
        found = getattr(found, part)
    assert (dict(found) if isinstance(value, dict) else found) == value


@pytest.mark.parametrize(
    ("override", "key", "fragment"),
    [
        ("limits.synergy_acceleration=0", "limits.synergy_acceleration", "must be greater than 0, got 0"),
        ("limits.synergy_acceleration=[1, -1]", "limits.synergy_acceleration[1]", "must be greater than 0, got -1"),
        ("limits.synergy_acceleration=[]", "limits.synergy_acceleration", "expected one or more numbers, got 0"),
        ("limits.synergy_acceleration='1 rad/s'", "limits.synergy_acceleration", "expected a number, got '1 rad/s'"),
        ("limits.synergy_acceleration=hand", "limits.synergy_acceleration", "expected a number, got 'hand'"),
        ("limits.joint_range=1", "limits.joint_range", "'hand'"),
        ("limits.joint_range=hnad", "limits.joint_range", "'hand'"),
        ("limits.elastic_motion=1", "limits.elastic_motion", "1 has no unit; expected a length"),
        ("limits.elastic_motion=0 mm", "limits.elastic_motion", "must be greater than 0"),
        ("limits.elastic_motion=1 deg", "limits.elastic_motion", "'deg' is a unit of angle"),
        ("limits.drift=-1 mm", "limits.drift", "must be greater than 0"),
        ("limits.drift=1 N", "limits.drift", "'N' is a unit of force"),
        ("goal={maximise='effort'}", "goal.maximise", "'margin'"),
        ("goal.minimise=margin", "goal.minimise", "'margin' is not one of"),
        ("goal.minimise=travle", "goal.minimise", "did you mean 'travel'?"),
        ("goal={minimise={}}", "goal.minimise", "expected a goal or weights such as { effort = 1, travel = 0.1 }"),
        ("goal={minimise=['effort']}", "goal.minimise", "expected a goal or weights such as"),
        ("goal={minimise=1}", "goal.minimise", "expected a goal or weights such as"),
        ("goal={minimise={efort=1}}", "goal.minimise.efort", "did you mean 'effort'?; only sums of squares"),
        ("goal={minimise={peak_force=1}}", "goal.minimise.peak_force", "only sums of squares have weights"),
        ("goal={minimise={margin=1}}", "goal.minimise.margin", "only sums of squares have weights"),
        ("goal={minimise={effort=0}}", "goal.minimise.effort", "must be greater than 0, got 0"),
        ("goal={minimise={effort=1, smooth=-0.1}}", "goal.minimise.smooth", "must be greater than 0, got -0.1"),
        ("goal={minimise={effort='1'}}", "goal.minimise.effort", "expected a number, got '1'"),
        ("goal={order=[]}", "goal.order", "expected at least 1 entry, got 0"),
        ("goal={order='effort'}", "goal.order", "expected a list, got 'effort'"),
        ("goal={order=['margn']}", "goal.order[0]", "did you mean 'margin'?"),
        ("goal={order=['weighted']}", "goal.order[0]", "'weighted' is not one of"),
        ("goal={order=['smooth', 'smooth']}", "goal.order[1]", "'smooth' is listed twice"),
        ("goal={order=['effort', 'travel', 'effort']}", "goal.order[2]", "'effort' is listed twice"),
        ("goal={order=['effort', 'margin']}", "goal.order[1]",
         "'effort' before it leaves no force open; put 'margin' first"),
        ("goal={order=['torque', 'travel', 'peak_force']}", "goal.order[2]", "'torque' before it leaves no force open"),
        ("goal={order=['actuator', 'effort']}", "goal.order[1]", "'actuator' before it leaves no force open"),
        ("goal={maximise='margin', order=['effort']}", "goal.order", "the goal is given already by 'maximise'"),
        ("goal={minimise='effort', order=['travel']}", "goal.order", "the goal is given already by 'minimise'"),
        ("goal={minimise={effort=1}, order=['travel']}", "goal.order", "several goals are written as order = [...]"),
        ("goal={maximise='margin', minimise={effort=1}}", "goal.minimise", "given already by 'maximise'"),
        ("task.tracking=rigd", "task.tracking", "did you mean 'rigid'?"),
        ("task.tracking=compliant", "task.tracking", "write for example tolerance = \"0.5 mm\""),
        ("task={tracking='compliant', tolerance='0 mm'}", "task.tolerance", "must be greater than 0"),
        ("task.tolerance=1", "task.tolerance", "1 has no unit; expected a length"),
        ("task.axes=[]", "task.axes", "expected at least 1 entry, got 0"),
        ("task.axes=['w']", "task.axes[0]", "'w' is not one of"),
        ("task.axes=z", "task.axes", "expected a list, got 'z'"),
        ("task.axes=['x', 'rz', 'x']", "task.axes[2]", "'x' is listed twice"),
        ("task.drift=1 mm", "task.drift", "for the axes that 'axes' leaves out, and it leaves none"),
        ("task={axes=['x'], drift='0 mm'}", "task.drift", "must be greater than 0"),
        ("task={axes=['x'], drift=1}", "task.drift", "1 has no unit; expected a length"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_where_it_stands(override: str, key: str, fragment: str) -> None:
    ((found, message),) = issues(override)
    assert found == key
    assert fragment in message


def test_two_faults_of_an_order_are_told_at_once() -> None:
    found = issues("goal={order=['effort', 'margin', 'travel', 'travel']}")
    assert [key for key, _ in found] == ["goal.order[1]", "goal.order[3]"]


def test_limits_on_motion_reach_the_task_with_the_ranges_of_the_hand() -> None:
    task = load_problem(
        "barrett-ball-hold",
        ["limits.synergy_acceleration=[1, 2, 3, 4]", "limits.joint_range=hand", "limits.elastic_motion=1 mm",
         "limits.drift=2 mm", "goal={order=['effort', 'centred']}"],
    ).timed  # fmt: skip
    found = {limit.key: limit for limit in task.limits}
    acceleration, ranges = found["limits.synergy_acceleration"], found["limits.joint_range"]
    assert isinstance(acceleration, SynergyAcceleration)
    assert acceleration.limit.tolist() == [1, 2, 3, 4]
    assert isinstance(ranges, JointRange)
    assert ranges.start.tolist() == ranges_of(task.goals).start.tolist()
    assert ranges.start[1] == pytest.approx(np.radians(61) / 3)  # finger1_outer follows its inner joint by 1/3
    assert ranges.lower[0] == 0
    assert ranges.upper[0] == pytest.approx(np.radians(140))
    assert found["limits.elastic_motion"] == ElasticMotion(1e-3)
    assert found["limits.drift"] == ObjectError(2e-3)
    assert names_of(task.goals) == ("effort", "centred")


def test_the_ranges_of_a_hand_bind_unless_they_are_let_go() -> None:
    """Of a hand whether or not they are asked for; of matrices never; as a limit in code, too."""
    for overrides, bound in (([], True), (["limits.joint_range=hand"], True), (["limits.joint_range=none"], False)):
        task = load_problem("barrett-ball-hold", overrides).timed
        (ranges,) = (limit for limit in task.limits if isinstance(limit, JointRange))
        assert ranges.lets_go is not bound
        assert (ranges in task.kept) is bound
        assert task.watches_references is bound
    problem = load_problem("barrett-ball-hold")
    own = problem.task.replace(limits=[JointRange(lower=-np.inf, upper=np.inf)]).timed(problem.grasp)
    assert not [limit for limit in own.kept if isinstance(limit, JointRange)]
    again = problem.timed.on(problem.grasp)
    assert sum(isinstance(limit, JointRange) for limit in again.limits) == 1
    assert not [limit for limit in load_problem("tripod").timed.limits if isinstance(limit, JointRange)]


def test_tracking_reaches_the_task_and_adds_its_own_limits() -> None:
    task = load_problem(
        "barrett-ball-roll",
        ["task.tracking=compliant", "task.tolerance=0.4 mm", "task.axes=['rx']", "task.drift=3 mm",
         "goal={minimise={effort=1, travel=0.1}}"],
    ).timed  # fmt: skip
    assert (task.tracking, task.tolerance, task.axes, task.drift) == ("compliant", 4e-4, ("rx",), 3e-3)
    assert (names_of(task.goals), weights_of(task.goals)) == (("weighted",), {"effort": 1.0, "travel": 0.1})
    added = {limit.key: limit for limit in task.kept if limit not in task.limits}
    assert added["task.tolerance"] == ObjectError(4e-4, ("rx",), "whole", "task.tolerance", "tracking error")
    rest = ("x", "y", "z", "ry", "rz")
    assert added["task.drift"] == ObjectError(3e-3, rest, "whole", "task.drift", "drift on free axes")


@pytest.mark.parametrize(
    ("overrides", "key", "fragment"),
    [
        (["limits.synergy_acceleration=[1, 2]"], "limits.synergy_acceleration", "expected 1 numbers"),
        (["limits.joint_range=hand"], "limits.joint_range", "needs a [hand]; a grasp file states no joint ranges"),
        (["goal={minimise='centred'}"], "goal.minimise", "'centred' needs a [hand]; a grasp file states no joint"),
        (["goal={order=['effort', 'centred']}"], "goal.order[1]", "'centred' needs a [hand]"),
        (["goal={minimise={effort=1, centred=2}}"], "goal.minimise.centred", "'centred' needs a [hand]"),
    ],
)
def test_what_a_grasp_file_cannot_answer_is_refused(overrides: list[str], key: str, fragment: str) -> None:
    with pytest.raises(InputError) as caught:
        load_problem("pinch-soft", overrides)
    (issue,) = caught.value.issues
    assert issue.key == key
    assert fragment in issue.message


def refused_goal(*overrides: str) -> str:
    """The key of the goal that the program finds to be without bound."""
    problem = load_problem("pinch-soft", overrides)
    with pytest.raises(InputError, match="nothing bounds the largest margin") as caught:
        plan(problem.grasp, problem.task)
    error = located(problem, caught.value)
    assert isinstance(error, InputError)
    assert error.issues[0].file
    return error.issues[0].key


def test_a_margin_in_an_order_needs_something_that_bounds_it() -> None:
    bounded = ["limits={joint_torque=3}", "goal={order=['margin', 'smooth']}"]
    assert load_problem("pinch-soft", bounded).timed.goals == goals("margin", "smooth")
    assert refused_goal("limits={synergy_rate=3}", "goal={order=['margin', 'smooth']}") == "goal.order[0]"
    assert refused_goal("limits={}", "goal={maximise='margin'}") == "goal.maximise"


def test_a_peak_before_the_margin_bounds_it() -> None:
    problem = load_problem("pinch-soft", ["limits={}", "goal={order=['peak_force', 'margin']}"])
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    assert [decision.goal for decision in outcome.decisions][:2] == ["least peak normal force", "largest margin"]
    for order, key in (("['margin', 'peak_force']", "goal.order[0]"), ("['travel', 'margin']", "goal.order[1]")):
        assert refused_goal("limits={}", f"goal={{order={order}}}") == key
