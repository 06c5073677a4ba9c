"""A limit and a goal of one's own, written outside the package: planned with, verified by their own usage."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from random_formulations import random_formulation
from small_grasps import tripod

from synergrip.conic.build import build
from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.goals.goal import Goal, Objective, squares_of
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.goals.weighted_sum import WeightedSum
from synergrip.conic.limits.differences import Differences
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.slip_margin import SlipMargin
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.rows import Item, Kind, Rows, below_scalar, nonnegative, norm_within
from synergrip.errors import InputError
from synergrip.linalg import Array, frozen
from synergrip.planning.outcome import Infeasible, Outcome, Plan
from synergrip.planning.planning import plan
from synergrip.planning.pyramids import Request, compare
from synergrip.planning.solvers import SOLVERS
from synergrip.problems.problem import load_problem
from synergrip.statics.motion import Motion
from synergrip.tasks.timed_task import TimedTask, still

TIMES = np.linspace(0, 1, 3)
WEIGHT = [0, 0, -3.0, 0, 0, 0]


@dataclass(frozen=True)
class TotalSqueeze(Limit):
    """The normal forces add up to at most `most` [N]. No more than it takes: rows and usage."""

    most: float

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        normals = formulation.response.grasp.normal_rows
        total = formulation.force.after(-np.eye(formulation.response.grasp.n_l)[normals].sum(axis=0, keepdims=True))
        room = Affine(frozen(total.matrix / self.most), frozen(1 + total.constant / self.most))
        return [nonnegative(self.key, (Item("all contacts"),), room)]

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        total = motion.forces[:, formulation.response.grasp.normal_rows].sum(axis=1, keepdims=True)
        most = np.array([self.most])
        return Usage("total squeeze", "N", ("all contacts",), total, np.array([-np.inf]), most, most, motion.times)


@dataclass(frozen=True)
class EvenSqueeze(Goal):
    """The normal forces near a number [N]."""

    near: float

    def objective(self, formulation: Formulation) -> Objective:
        grasp = formulation.response.grasp
        apart = formulation.force.after(np.eye(grasp.n_l)[grasp.normal_rows]).plus(-self.near)
        return Objective((squares_of(apart, 1 / formulation.force_unit),))


class LeastTotal(Goal):
    """Minimise s with ``sum of normal forces <= s``, s in units of force."""

    has_scalar = True

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        grasp, unit = formulation.response.grasp, formulation.force_unit
        total = formulation.force.after(np.eye(grasp.n_l)[grasp.normal_rows].sum(axis=0, keepdims=True) / unit)
        return [below_scalar("total", ["all"], total)]

    def objective(self, formulation: Formulation) -> Objective:
        return Objective(epigraph=1.0)


def asked(*limits: Limit, goals: tuple[Goal, ...] = (LeastEffort(),)) -> TimedTask:
    return TimedTask(TIMES, WEIGHT, still(TIMES), 0.0, (SlipMargin(0.2), *limits), goals)  # type: ignore[arg-type]


def planned(outcome: Outcome) -> Plan:
    assert isinstance(outcome, Plan), outcome
    return outcome


def total(outcome: Plan) -> float:
    return float(outcome.motion.forces[:, outcome.analysis.grasp.normal_rows].sum(axis=1).max())


def test_a_limit_of_ones_own_turns_the_answer_and_is_named_in_the_proof() -> None:
    grasp = tripod()
    least = total(planned(plan(grasp, asked(goals=(LeastTotal(),)))))
    tight, loose = (plan(grasp, asked(TotalSqueeze(share * least))) for share in (0.99, 1.01))
    assert isinstance(tight, Infeasible)
    assert tight.certificate.verified
    assert {conflict.key for conflict in tight.conflicts} == {"TotalSqueeze", "limits.margin"}
    found = planned(loose)
    assert found.usages[1].title == "total squeeze"
    assert [check.passed for check in found.checks if check.name == "total squeeze"] == [True]
    assert total(found) <= 1.01 * least * (1 + 1e-6)
    free = planned(plan(grasp, asked(TotalSqueeze(100 * least))))
    assert total(free) == pytest.approx(total(planned(plan(grasp, asked()))), rel=1e-6)


def test_the_usage_of_ones_own_limit_is_what_verifies_it() -> None:
    """Rows that forget the limit end in a plan that its usage refuses."""

    class Forgetful(TotalSqueeze):
        def rows(self, formulation: Formulation) -> Sequence[Rows]:
            return []

    with pytest.raises(InputError, match=r"^Forgetful\.usage: contradicts Forgetful\.rows: .* is 4\.5 at t = 0 s"):
        plan(tripod(), asked(Forgetful(1.0)))


def test_a_goal_of_ones_own_is_best_alone_in_a_sum_and_among_others() -> None:
    grasp, near = tripod(), 9.0
    alone = planned(plan(grasp, asked(goals=(EvenSqueeze(near),))))
    normals = alone.motion.forces[:, grasp.normal_rows]
    assert normals == pytest.approx(near, rel=1e-5)
    assert alone.decisions[0].goal == "even squeeze"
    summed = planned(plan(grasp, asked(goals=(WeightedSum(((EvenSqueeze(near), 1.0), (LeastEffort(), 1.0))),))))
    assert total(planned(plan(grasp, asked()))) < total(summed) < total(alone)
    after = planned(plan(grasp, asked(NormalForce(upper=50.0), goals=(LeastTotal(), EvenSqueeze(near)))))
    least = planned(plan(grasp, asked(goals=(LeastTotal(),))))
    assert total(after) == pytest.approx(total(least), rel=1e-5)


@pytest.mark.parametrize("load", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("goals", [(LeastTotal(), LeastEffort()), (LeastTotal(), EvenSqueeze(0.1), LeastEffort())])
def test_a_scalar_of_ones_own_is_kept_by_the_goals_after_it(load: float, goals: tuple[Goal, ...]) -> None:
    """In whatever units the later programs are asked: the proof that no plan squeezes less is another program."""
    wrench = np.tile(np.array([1.0, 0.5, -3.0, 0, 0, 0]) * load, (3, 1))
    task = replace(asked(goals=goals), wrench=wrench, margin=0.2 * load)
    found = planned(plan(tripod(below=0.2), task))
    assert found.decisions[0].goal == "least total"
    assert len(found.decisions) >= 2
    assert not [note for note in found.notes if "not verified" in note]
    for share, verdict in ((1 - 1e-5, "infeasible"), (1 + 1e-5, "feasible")):
        bounded = replace(task, limits=(TotalSqueeze(share * total(found)),), goals=(LeastEffort(),))
        assert plan(tripod(below=0.2), bounded).verdict == verdict


@dataclass(frozen=True)
class LeastPeakTorque(Goal):
    """Minimise s with ``|tau| <= s``, s in units of its own [N m]."""

    unit: float
    has_scalar = True

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        names = formulation.response.grasp.joints
        size = np.eye(len(names)) / self.unit
        sides = (("highest", size), ("lowest", -size))
        return [below_scalar("peak", names, formulation.torque.after(signed), side) for side, signed in sides]

    def objective(self, formulation: Formulation) -> Objective:
        return Objective(epigraph=1.0)


@pytest.mark.parametrize("unit", [1e-3, 1e-2, 1.0, 1e2])
def test_what_is_given_up_of_a_scalar_is_a_share_of_it(unit: float) -> None:
    """The size of a scalar of one's own is anybody's: the program after it has the room that it needs, and no more."""
    problem = load_problem("pinch-soft")  # where the least torque is that of one plan only
    found = planned(plan(problem.grasp, problem.task.replace(goals=[LeastPeakTorque(unit), LeastEffort()])))
    assert [decision.goal for decision in found.decisions] == ["least peak torque", "least contact effort"]
    assert not [note for note in found.notes if "not verified" in note]
    least = planned(plan(problem.grasp, problem.task.replace(goals=[LeastPeak()])))
    assert total(found) == pytest.approx(total(least), rel=1e-6)


@dataclass(frozen=True, eq=False)
class JointRate(Differences):
    """Joints move no faster than this."""

    key = "JointRate"
    title = "joint rate"
    of = "joint"

    def value(self, formulation: Formulation) -> Affine:
        return formulation.joint

    def differences(self, times: Array) -> tuple[Array, Array]:
        return np.diff(times), -np.ones((len(times) - 1, 1))

    def reached(self, motion: Motion) -> Array:
        rates = np.diff(motion.dq, axis=0) / np.diff(motion.times)[:, None]
        return np.vstack([np.zeros_like(rates[:1]), rates])


def test_differences_are_those_of_the_quantity_that_a_limit_names() -> None:
    """Rows of joints, at random unknowns: how far their rates are from the bound, in units of the longest step's."""
    formulation, v = random_formulation(1)[1], np.random.default_rng(2)
    unknowns, limit = v.normal(size=(formulation.knots, formulation.n_v)), JointRate(0.3)
    program = build(formulation, [limit], LeastEffort())
    slack = program.b - program.A @ program.solution(unknowns)
    steps = np.diff(formulation.times)[:, None]
    change, room = np.diff(formulation.joint.at(unknowns), axis=0), 0.3 * steps
    expected = np.stack([room + change, room - change]) / room.max()
    assert slack.reshape(expected.shape) == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_a_limit_in_a_unit_of_its_own_is_kept_on_the_hand_that_moves_as_closely_as_forces_are() -> None:
    problem = load_problem("dlr-ball-move")

    def rates(found: Plan) -> Array:
        motion = found.motion
        return np.abs(np.diff(motion.dq, axis=0)) / np.diff(motion.times)[:, None]

    free = planned(plan(problem.grasp, problem.task))
    limit = JointRate(0.5 * float(rates(free).max()))
    found = planned(plan(problem.grasp, problem.task.replace(limits=[*problem.task.limits, limit])))
    assert rates(found).max() == pytest.approx(0.5 * rates(free).max(), rel=1e-3)


def test_a_loosened_limit_of_ones_own_has_that_much_more_room_in_the_heads_of_its_cones() -> None:
    formulation = planned(plan(tripod(), asked())).formulation
    for limit, heads in ((TotalSqueeze(50.0), [1.0]), (SmallTangential(0, 1.0), [1.0, 0.0, 0.0])):
        loose, (rows,) = limit.loosened(0.1), limit.rows(formulation)
        (more,) = loose.rows(formulation)
        assert more.constant - rows.constant == pytest.approx(np.tile(0.1 * np.array(heads), (3, 1)))
        assert np.array_equal(more.matrix, rows.matrix)
        assert (loose.key, loose.watches, loose.couples_knots) == (limit.key, "references", False)


def test_a_goal_that_nothing_bounds_is_named() -> None:
    class MostTotal(LeastTotal):
        def objective(self, formulation: Formulation) -> Objective:
            return Objective(epigraph=-1.0)

        def rows(self, formulation: Formulation) -> Sequence[Rows]:
            (rows,) = super().rows(formulation)
            return [replace(rows, matrix=frozen(-rows.matrix), constant=frozen(-rows.constant),
                            epigraph=frozen(-rows.epigraph))]  # fmt: skip

    with pytest.raises(InputError, match="nothing bounds 'most total'"):
        plan(tripod(), asked(goals=(MostTotal(),)))
    most = planned(plan(tripod(), asked(NormalForce(upper=5.0), goals=(MostTotal(), LeastEffort()))))
    assert total(most) == pytest.approx(15.0, rel=1e-5)


@pytest.mark.parametrize("part", [{"limits": (TotalSqueeze(50.0),)}, {"goals": (EvenSqueeze(3.0),)}])
def test_the_second_formulation_says_that_it_does_not_know_it(part: dict[str, Any]) -> None:
    with pytest.raises(InputError, match=r"solver: the CVXPY formulation knows no (limit Total|goal Even)Squeeze; use"):
        plan(tripod(), replace(asked(), **part), SOLVERS["cvxpy"])


def test_the_same_limit_may_stand_twice_with_other_numbers() -> None:
    found = planned(plan(tripod(), asked(TotalSqueeze(50.0), TotalSqueeze(40.0))))
    assert [usage.title for usage in found.usages].count("total squeeze") == 2


def test_limits_and_goals_of_ones_own_hold_between_the_knots() -> None:
    """Where the load is straight, rows at the knots are all there is to ask for."""
    found = planned(plan(tripod(), replace(asked(TotalSqueeze(50.0)), between="hold")))
    assert found.between is None or found.between.excess < 1e-6


@dataclass(frozen=True)
class Broken(Limit):
    """A limit that returns what it is made with."""

    given: Any

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        return self.given(formulation) if callable(self.given) else self.given

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        nothing = np.zeros(2)
        return Usage("broken", "N", ("a",), motion.forces, nothing, nothing, nothing, motion.times)


def _row(matrix: Any, constant: Any, epigraph: Any = (0.0,)) -> Rows:
    each = (frozen(matrix), frozen(constant), frozen(epigraph))
    return Rows("own", Kind.NONNEGATIVE, 1, (Item("a"),), *each)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (5, "Broken.rows: expected a list of Rows, got int"),
        ([5], "Broken.rows: expected a list of Rows, got list"),
        (lambda f: [_row(np.zeros((1, 99)), np.zeros((3, 1)))], "a column for each unknown"),
        (
            lambda f: [_row(np.zeros((1, f.n_v)), np.zeros((1, 4)))],
            r"Rows.constant: expected shape \(K, 1\)",
        ),
        (lambda f: [_row(np.zeros((1, f.n_v)), 1.0)], r"Rows.constant: expected shape \(K, 1\)"),
        (lambda f: [_row(np.zeros((1, f.n_v)), np.full((3, 1), np.nan))], "expected finite numbers"),
        (
            lambda f: [_row(np.zeros((1, f.n_v)), np.zeros((3, 1)), (0.0, 1.0))],
            r"Rows.epigraph: expected shape \(1,\)",
        ),
        ([], r"Usage.value: expected shape \(3, 1\) for 3 instants and 1 items of 'broken', got \(3, 9\)"),
    ],
)
def test_rows_and_usages_that_do_not_fit_are_refused_by_name(given: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        plan(tripod(), asked(Broken(given)))


def test_squares_of_what_is_written_as_a_list_are_arrays_of_floats() -> None:
    for matrix, constant in (([[1.0, 2.0]], np.zeros((1, 1))), (np.ones((1, 2), np.float32), np.ones((1, 1), int))):
        made = squares_of(Affine(matrix, constant), 2.0)  # type: ignore[arg-type]
        assert made.matrix.dtype == made.constant.dtype == np.float64
        assert made.matrix.tolist() == (2 * np.array(matrix)).tolist()


def test_rows_that_couple_knots_are_no_rows_of_a_limit_that_says_it_couples_none() -> None:
    """Between the knots they would be asked for as if they spoke of an instant."""
    coupled = SynergyRate(1.0)
    with pytest.raises(InputError, match=r"Broken\.rows: .* write couples_knots = True in the class"):
        plan(tripod(), asked(Broken(coupled.rows)))

    class Coupled(Broken):
        couples_knots = True

        def usage(self, formulation: Formulation, motion: Motion) -> Usage:
            return coupled.usage(formulation, motion)

    one, other = (planned(plan(tripod(), asked(limit))) for limit in (coupled, Coupled(coupled.rows)))
    assert other.motion.dz_r == pytest.approx(one.motion.dz_r, rel=1e-6)


def test_a_class_without_a_method_says_which() -> None:
    class NoUsage(Limit):
        def rows(self, formulation: Formulation) -> Sequence[Rows]:
            return []

    class Nothing(Goal):
        pass

    for kind, method in ((NoUsage, "usage"), (Nothing, "objective")):
        with pytest.raises(InputError, match=f"{kind.__name__}: has no method '{method}'; write it"):
            kind()


class NoObjective(Goal):
    """A goal that returns a number."""

    def objective(self, formulation: Formulation) -> Objective:
        return 1.0  # type: ignore[return-value]


class Undeclared(Goal):
    """A scalar that it does not tell of."""

    def objective(self, formulation: Formulation) -> Objective:
        return Objective(epigraph=1.0)


@pytest.mark.parametrize(
    ("goal", "message"),
    [(NoObjective(), "expected an Objective, got float"), (Undeclared(), "expected squares and no epigraph")],
)
def test_objectives_that_are_none_are_refused_by_name(goal: Goal, message: str) -> None:
    with pytest.raises(InputError, match=rf"{type(goal).__name__}\.objective: {message}"):
        plan(tripod(), asked(goals=(goal,)))


@dataclass(frozen=True)
class SmallTangential(Limit):
    """``||(t, o)|| <= most`` of one contact [N]: a cone of three rows about a contact, and no friction cone."""

    contact: int
    most: float

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        grasp = formulation.response.grasp
        rows = grasp.rows[self.contact]
        tangential = formulation.force.after(np.eye(grasp.n_l)[rows.start + 1 : rows.start + 3])
        part = norm_within(self.key, grasp.contacts[self.contact].name, tangential, self.most)
        return [replace(part, items=(Item(grasp.contacts[self.contact].name),))]

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        grasp = formulation.response.grasp
        rows = grasp.rows[self.contact]
        size = np.linalg.norm(motion.forces[:, rows.start + 1 : rows.start + 3], axis=1, keepdims=True)
        most = np.array([self.most])
        name = grasp.contacts[self.contact].name
        return Usage("tangential", "N", (name,), size, np.array([-np.inf]), most, most, motion.times)


def test_pyramids_replace_friction_cones_and_no_cone_about_a_contact() -> None:
    """A limit just above what the load takes is not narrowed: nothing is rejected, and the limit is named as a cone."""
    cones = planned(plan(tripod(), asked(SmallTangential(0, 1.001))))
    size = np.linalg.norm(cones.motion.forces[:, 1:3], axis=1)
    assert size == pytest.approx(1.0, rel=1e-6)  # a third of the weight, and within four facets at most 0.707
    comparison = compare(cones, Request(4))
    assert comparison.rejected is False
    assert comparison.other_cones == ("SmallTangential",)
    assert comparison.pyramids is not None


@pytest.mark.parametrize("weight", [1e6, 1e-3, 1e-8, 1e-12, 1e-30])
def test_a_goal_of_ones_own_in_any_unit_is_the_same_goal(weight: float) -> None:
    """Squares of forces in micronewtons or in giganewtons: the least of them is the least."""

    class Small(Goal):
        def objective(self, formulation: Formulation) -> Objective:
            return Objective((squares_of(formulation.force, weight),))

    problem = load_problem("barrett-ball-hold")
    found = plan(problem.grasp, problem.task.replace(knots=3, goals=[Small()]))
    usual = plan(problem.grasp, problem.task.replace(knots=3))
    assert isinstance(found, Plan)
    assert isinstance(usual, Plan)
    assert float((found.forces**2).sum()) == pytest.approx(float((usual.forces**2).sum()), rel=1e-6)
