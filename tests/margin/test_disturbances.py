"""Extra wrenches: closed forms, a second model, sampled directions, and the hand that moves."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from command_line import run
from second_disturbances import SecondModel, some_question
from small_grasps import pinch

import synergrip as sg
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import frozen
from synergrip.margin.disturbance.executed_wrench import executed_wrench
from synergrip.margin.disturbance.leaving import along, balls, proven
from synergrip.planning.outcome import Plan
from synergrip.tasks.timed_task import TimedTask, still

MU, NU, LENGTH, SQUEEZE, CAP = 0.5, 0.005, 0.02, 4.0, 6.0
TIME = frozen([0.0])


def squeezed(grasp: Grasp, *limits: sg.Limit) -> Plan:
    """Two fingers that squeeze with a force of their own, without any load."""
    task = TimedTask(TIME, frozen(np.zeros((1, 6))), still(TIME), MU * SQUEEZE, limits, (LeastEffort(),))
    made = sg.plan(grasp, task)
    assert isinstance(made, Plan)
    return made


def test_a_pinch_withstands_what_its_closed_forms_say() -> None:
    """Along x until a finger lifts off; along y and z, and about them, half of it by each finger; spin about x."""
    found = sg.disturbances(squeezed(pinch(MU, NU)), box=(1.0, 0, 0, 0, 0, 0))
    each = [one.passive.upper for one in found.along[::2]]
    force, moment = 2 * MU * SQUEEZE, 2 * MU * SQUEEZE * LENGTH
    assert each == pytest.approx([2 * SQUEEZE, force, force, 2 * NU * SQUEEZE, moment, moment], rel=1e-6)
    spin = LENGTH / (2 * NU)  # of the ball, spin and the force along x together are the nearest
    assert found.passive.upper == pytest.approx(SQUEEZE / np.hypot(spin, 0.5), rel=1e-6)
    assert found.passive.lower == pytest.approx(found.passive.upper, rel=1e-8)
    assert found.passive.proven
    assert found.passive.limit == "friction cone"
    assert found.box is not None
    assert found.box.passive.upper == pytest.approx(2 * SQUEEZE, rel=1e-6)
    assert (found.length, found.executed, found.of) == (pytest.approx(LENGTH), None, "the start posture")


def test_a_pinch_whose_squeeze_answers_withstands_what_its_cap_allows() -> None:
    """Spin takes half of it by each finger, a force along x takes from the squeeze twice: L / (2 nu) s + |x| = cap."""
    found = sg.disturbances(squeezed(pinch(MU, NU), NormalForce(upper=CAP)))
    closed = CAP / np.hypot(LENGTH / (2 * NU), 1.0)
    assert found.active.upper is not None
    assert found.active.lower <= closed <= found.active.upper * (1 + 1e-9)
    assert found.active.upper == pytest.approx(closed, rel=1e-4)
    assert found.active.lower > 0.8 * closed
    assert found.known_share == found.active.lower / found.active.upper
    y = found.along[2]
    assert y.active.lower <= 2 * MU * CAP <= (y.active.upper or 0.0)
    assert y.active.upper == pytest.approx(2 * MU * CAP, rel=1e-4)
    assert y.active.proven
    assert found.passive.upper == found.slip.upper
    full = squeezed(pinch(MU, NU), NormalForce(upper=SQUEEZE * (1 + 1e-6)))
    used = sg.disturbances(full)  # the cap is used up: nothing is left within it, but friction is
    assert used.passive.upper == pytest.approx(0.0, abs=1e-4)
    assert used.passive.limit == "limits.normal_force"
    assert used.slip.upper == pytest.approx(found.slip.upper, rel=1e-5)


@pytest.mark.parametrize("d", [1, 2, 4, 7])
def test_balls_are_exact_and_proven(d: int) -> None:
    rng = np.random.default_rng(d)
    start, change = rng.normal(size=(60, d)), rng.normal(size=(60, d, 6))
    start[:, 0] = np.linalg.norm(start[:, 1:], axis=1) + rng.uniform(0.01, 2, 60)
    start[:10, 1:] = 0.0
    change[10:20, 0] *= d == 1  # heads that do not change
    change[20:30, 1:] *= 1e-9
    found = balls(start, change)
    assert np.allclose(found.lower, found.upper, rtol=1e-7)
    assert np.all(proven(start, change, found.sigma, found.lower))
    assert not np.any(proven(start, change, found.sigma, found.upper * 1.001))
    units = rng.normal(size=(500, 6))
    units /= np.linalg.norm(units, axis=1)[:, None]
    ends = found.lower, found.upper, found.towards
    for value, moved, lower, upper, towards in zip(start, change, *ends, strict=True):
        assert along(np.broadcast_to(value, (500, d)), units @ moved.T).min() >= lower
        assert np.linalg.norm(towards) == pytest.approx(1.0)
        beyond = value + 1.0001 * upper * moved @ towards
        assert np.linalg.norm(beyond[1:]) > beyond[0]


def test_a_second_model_withstands_as_much() -> None:
    plan = next(each for each in (some_question(i) for i in range(10)) if each is not None)
    rng, widths = np.random.default_rng(0), np.array([1.0, 0.5, 0.8, 0.02, 0.01, 0.03])
    found, model = sg.disturbances(plan, box=widths), SecondModel(plan)
    unit = plan.formulation.force_unit
    assert found.box is not None
    assert found.passive.upper is not None
    assert found.active.upper is not None
    assert found.passive.lower > 1e-3 * unit
    assert found.passive.upper == pytest.approx(model.radius(), rel=1e-4, abs=1e-5 * unit)
    assert found.slip.upper == pytest.approx(SecondModel(plan, cones_alone=True).radius(), rel=1e-4, abs=1e-5 * unit)
    assert found.box.passive.upper == pytest.approx(model.factor(widths), rel=1e-4, abs=1e-5 * unit)
    units = rng.normal(size=(10_000, 6))
    units /= np.linalg.norm(units, axis=1)[:, None]
    assert model.worst(found.passive.lower * units) <= 1e-6 * unit
    assert found.passive.wrench is not None
    assert model.worst(1.1 * np.linalg.solve(model.unscale, found.passive.wrench)[None]) > 1e-6 * unit
    for direction in units[:2]:
        assert model.has_answer(found.active.lower * direction, 1e-6 * unit)
    assert found.active.wrench is not None
    beyond = np.linalg.solve(model.unscale, found.active.wrench)
    assert np.linalg.norm(beyond) == pytest.approx(found.active.upper)
    assert not model.has_answer(beyond * 1.0005)
    assert found.passive.lower <= found.active.lower <= found.active.upper


def test_a_ball_does_not_depend_on_the_frame() -> None:
    grasp = pinch(MU, NU, compliance=(1e-3, 3e-4))
    moved = tuple(replace(each, point=frozen(each.point + np.array([0.3, -0.2, 0.1]))) for each in grasp.contacts)
    here = sg.disturbances(squeezed(grasp, NormalForce(upper=CAP)))
    there = sg.disturbances(squeezed(replace(grasp, contacts=moved, G=grasp_matrix(moved)), NormalForce(upper=CAP)))
    assert there.passive.upper == pytest.approx(here.passive.upper, rel=1e-6)
    assert there.active.upper == pytest.approx(here.active.upper, rel=1e-4)
    assert there.along[0].passive.upper == pytest.approx(there.along[0].slip.upper, rel=1e-9)
    assert np.allclose(there.centroid, [0.3, -0.2, 0.1])


def test_only_the_direction_of_a_wrench_counts_however_large() -> None:
    made = squeezed(pinch(MU, NU))
    ends = [
        sg.disturbances(made, directions=[[size, size, 0, 0, 0, 0]]).along[0].passive for size in (1, 1e200, 1e-320)
    ]
    assert [each.upper for each in ends] == pytest.approx([ends[0].upper] * 3, rel=1e-12)


def test_what_says_nothing_of_an_instant_is_left_out_by_name_and_what_is_allowed_for_changes_nothing() -> None:
    grasp = pinch(MU, NU)
    task = sg.Task(
        loads=[sg.Wrench((0, 0, -1, 0, 0, 0))], limits=[sg.SlipMargin(0.5)], goals=[sg.LeastEffort()], knots=3
    )
    plain, sustained, allowing = (
        sg.plan(grasp, each)
        for each in (
            task, task.replace(limits=[sg.SlipMargin(0.5), sg.SustainedEffort(20.0)]),
            task.replace(limits=[sg.SlipMargin(0.3)], allow=sg.Allowances(friction=(0.4, 0.5))),
        )
    )  # fmt: skip
    assert isinstance(plain, Plan)
    assert isinstance(sustained, Plan)
    assert isinstance(allowing, Plan)
    assert sg.disturbances(plain).left_out == ()
    assert sg.disturbances(sustained).left_out == ("limits.sustained_effort",)
    stated = float(allowing.margins.min())  # at the friction that is stated, more than was asked for
    along = sg.disturbances(allowing, directions=[(0, 0, -1, 0, 0, 0)]).along[0]
    assert along.slip.upper == pytest.approx(2 * stated, rel=1e-6)


def test_what_moves_freely_is_not_withstood() -> None:
    """Two hard fingers leave the turn about the line between them; a force along that line is withstood."""
    hard = sg.load_problem("pinch-hard").grasp
    task = TimedTask(TIME, frozen(np.zeros((1, 6))), still(TIME), 1.0, (NormalForce(upper=20.0),), (LeastEffort(),))
    made = sg.plan(hard, task)
    assert isinstance(made, Plan)
    found = sg.disturbances(made)
    for ball in (found.passive, found.slip, found.active):
        assert (ball.lower, ball.upper, ball.limit) == (0.0, 0.0, "free motion")
    turn = next(each for each in found.along if each.passive.limit == "free motion")
    assert turn.active.upper == 0.0
    assert max(each.passive.lower for each in found.along) > 1.0


def test_a_hand_that_moves_withstands_the_worst_wrench_and_not_half_as_much_again() -> None:
    problem = sg.load_problem("gripper-box")
    made = sg.plan(problem.grasp, problem.task)
    assert isinstance(made, Plan)
    found = sg.disturbances(made, directions=[(0, 0, -2, 0, 0, 0)])
    assert found.of == "the true equilibria"
    assert found.executed is not None
    assert found.executed.holds
    assert found.executed.margin == pytest.approx(0.02 * made.margins.min(), abs=3e-3)
    assert found.slip.wrench is not None
    more = executed_wrench(made, replace(found.slip, wrench=frozen(1.5 * found.slip.wrench)))
    assert more is not None
    assert not more.holds
    (down,) = found.along
    assert (down.unit, down.wrench.tolist()) == ("N", [0, 0, -1, 0, 0, 0])
    assert down.passive.lower >= found.passive.lower  # a force through the middle of the contacts is of its own size


@pytest.mark.parametrize(
    ("arguments", "key"),
    [({"directions": [(0, 0, 1)]}, "directions"), ({"directions": np.zeros((1, 6))}, "directions"),
     ({"box": (1, 1, 1, 0, 0, -1)}, "box"), ({"box": 1.0}, "box"), ({"plan": None}, "plan")],
)  # fmt: skip
def test_what_is_no_direction_and_no_box_is_refused(arguments: dict[str, object], key: str) -> None:
    with pytest.raises(sg.InputError) as error:
        sg.disturbances(**{"plan": squeezed(pinch(MU, NU)), **arguments})  # type: ignore[arg-type]
    assert error.value.issues[0].key.endswith(key)


def test_the_command_line_tells_what_is_withstood() -> None:
    arguments = ("margins", "pinch-soft", "--only", "disturbance", "--direction", "0 0 -1 0 0 0")
    done = run(*arguments, "--box", "1,1,1,0,0,0", "--format", "json")
    told = json.loads(done.stdout)["disturbance"]
    assert told["passive_N"]["lower"] <= told["passive_N"]["upper"] <= told["active_N"]["upper"]
    (down,) = told["along"]
    assert down["direction"] == [0, 0, -1, 0, 0, 0]
    assert told["box"]["passive"]["upper"] > 0
    text = run(*arguments)
    assert "0 0 -1 0 0 0" in text.stdout
    assert "any direction" in text.stdout
    wrong = run("margins", "pinch-soft", "--box", "1 2 3")
    assert (wrong.exit_code, "--box" in wrong.stderr) == (2, True)
