"""What goes wrong inside a limit or goal of one's own is told with its class, and with the original behind it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from scipy.sparse import SparseEfficiencyWarning

import synergrip as sg
from synergrip.conic.formulation import Formulation
from synergrip.conic.rows import Rows
from synergrip.statics.motion import Motion

problem = sg.load_problem("tripod")


def planned(limits: Sequence[sg.Limit] = (), goals: Sequence[sg.Goal] = (sg.LeastEffort(),)) -> Any:
    return sg.plan(problem.grasp, problem.task.replace(limits=[*problem.task.limits, *limits], goals=goals))


@dataclass(frozen=True)
class Sideways(sg.Limit):
    """The second tangential force of the first contact; `factor` is what rows and usage differ by."""

    most: float
    factor: float = 1.0

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        row = np.eye(formulation.response.grasp.n_l)[[2]]
        return [sg.norm_within(self.key, "sideways", formulation.force.after(row), self.most)]

    def usage(self, formulation: Formulation, motion: Motion) -> sg.Usage:
        most = np.array([self.most])
        return sg.Usage(
            "sideways", "N", ("first",), self.factor * motion.forces[:, [2]], -most, most, most, motion.times
        )


def test_a_limit_whose_usage_contradicts_its_rows_is_told_what_to_compare() -> None:
    free = planned()
    carried = float(np.abs(free.forces[:, 2]).max())
    assert planned(limits=[Sideways(2 * carried)]).verdict == "feasible"
    with pytest.raises(sg.InputError) as refused:
        planned(limits=[Sideways(2 * carried, factor=1000.0)])
    (issue,) = refused.value.issues
    assert issue.key == "Sideways.usage"
    assert "contradicts Sideways.rows" in issue.message
    assert "Compare the two" in issue.message
    assert "report" not in issue.message


def raising(error: Exception) -> Callable[..., Any]:
    def method(*_: Any) -> Any:
        raise error

    return method


def own(base: type, **methods: Callable[..., Any]) -> Any:
    return type("Mine", (base,), methods)()


ERRORS = [
    ValueError("shapes differ"),
    KeyError("thumb"),
    IndexError("9"),
    ZeroDivisionError("by 0"),
    AttributeError("x"),
]


@pytest.mark.parametrize("error", ERRORS, ids=lambda error: type(error).__name__)
def test_an_error_inside_a_method_names_class_and_method_and_keeps_the_original(error: Exception) -> None:
    nothing = lambda *_: []  # noqa: E731
    tried = {
        "Mine.rows": {"limits": [own(sg.Limit, rows=raising(error), usage=nothing)]},
        "Mine.usage": {"limits": [own(sg.Limit, rows=nothing, usage=raising(error))]},
        "Mine.objective": {"goals": [own(sg.Goal, objective=raising(error))]},
    }
    for key, changes in tried.items():
        with pytest.raises(sg.InputError) as refused:
            planned(**changes)
        assert str(refused.value) == f"{key}: raised {type(error).__name__}: {error}"
        assert refused.value.__cause__ is error
    summed = sg.WeightedSum([(tried["Mine.objective"]["goals"][0], 1.0)])
    with pytest.raises(sg.InputError, match=r"^Mine\.objective: raised"):
        planned(goals=[summed])


def test_a_refusal_inside_a_method_keeps_its_argument_and_one_of_a_base_is_told_once() -> None:
    class Wider(Sideways):
        def rows(self, formulation: Formulation) -> Sequence[Rows]:
            formulation.force.after(np.eye(2))
            return []

    class Again(Wider):
        def rows(self, formulation: Formulation) -> Sequence[Rows]:
            return super().rows(formulation)

    for kind in (Wider, Again):
        with pytest.raises(sg.InputError) as refused:
            planned(limits=[kind(1.0)])
        (issue,) = refused.value.issues
        assert issue.key == f"{kind.__name__}.rows.Affine.after.linear"
        assert "expected shape (p, 9)" in issue.message
        assert "got an array of shape (2, 2)" in issue.message


def test_an_interrupt_and_a_refusal_inside_a_method_stay_what_they_are() -> None:
    for error in (KeyboardInterrupt(), sg.Refusal("no")):
        with pytest.raises(type(error)) as raised:
            planned(limits=[own(sg.Limit, rows=raising(error), usage=raising(error))])  # type: ignore[arg-type]
        assert raised.value is error


def usage(**changes: Any) -> Callable[..., sg.Usage]:
    """The `usage` of a limit that bounds nothing, but for some of its arguments."""

    def method(self: sg.Limit, formulation: Formulation, motion: Motion) -> sg.Usage:
        kept: Any = {
            "title": "own", "unit": "N", "items": ("first",), "value": motion.forces[:, [0]], "lower": [-np.inf],
            "upper": [np.inf], "scale": [1.0], "times": motion.times,
        }  # fmt: skip
        return sg.Usage(**kept | {name: make(motion) for name, make in changes.items()})

    return method


def sideways(self: sg.Limit, formulation: Formulation) -> Sequence[Rows]:
    return [sg.norm_within(self.key, "all", formulation.force, 1e6)]


def twice(motion: Motion) -> Any:
    return motion.forces[:, [0, 0]]


PARTS: dict[str, tuple[dict[str, Any], str, str]] = {
    "a key that is no text": ({"key": 3}, "Mine.key", "expected a name, got 3"),
    "a key of nothing": ({"key": ""}, "Mine.key", "expected a name"),
    "a word misspelt": ({"watches": "force"}, "Mine.watches", "did you mean 'forces'"),
    "sizes without quantities": ({"bounded": lambda *_, **__: 3}, "Mine.bounded", "expected a pair of quantities"),
    "sizes of other quantities": ({"bounded": lambda _, f, **__: (f.force, [1.0])}, "Mine.bounded", "(m,)"),
    "other times": ({"usage": usage(times=lambda motion: motion.times + 1)}, "Mine.usage", "write motion.times"),
    "an endless size": ({"usage": usage(scale=lambda _: [np.inf])}, "Mine.usage", "as scale, got inf"),
    "a size of nothing": ({"usage": usage(scale=lambda _: [0])}, "Mine.usage", "as scale, got 0"),
    "a negative allowance": ({"usage": usage(allowance=lambda motion: np.full((len(motion.times), 1), -1.0))},
                             "Mine.usage", "as allowance, got -1"),
    "an item twice": (
        {"usage": usage(items=lambda _: ("a", "a"), value=twice, lower=lambda _: [0, 0], upper=lambda _: [9, 9],
                        scale=lambda _: [9, 9])}, "Mine.usage", "a name for each item"),
}  # fmt: skip


@pytest.mark.parametrize(("parts", "key", "told"), PARTS.values(), ids=PARTS)
def test_what_a_limit_of_ones_own_says_of_itself_is_judged(parts: dict[str, Any], key: str, told: str) -> None:
    right = {"rows": sideways, "usage": usage()}
    assert planned(limits=[own(sg.Limit, **right)]).verdict == "feasible"
    with pytest.raises(sg.InputError) as refused:
        planned(limits=[own(sg.Limit, **right | parts)])
    (issue,) = refused.value.issues
    assert issue.key == key
    assert told in issue.message


def test_rows_may_come_from_a_generator_and_a_goal_has_a_name() -> None:
    once = own(sg.Limit, rows=lambda self, formulation: iter(sideways(self, formulation)), usage=usage())
    assert planned(limits=[once]).verdict == "feasible"
    goal = own(sg.Goal, objective=lambda _, f: sg.Objective((sg.squares_of(f.force),)), name=3)  # type: ignore[arg-type]
    with pytest.raises(sg.InputError, match=r"^Mine\.name: expected a name, got 3"):
        planned(goals=[goal])


def test_a_solver_of_ones_own_that_fails_is_named_with_what_it_raised() -> None:
    error = ZeroDivisionError("by 0")
    with pytest.raises(sg.InputError, match=r"^solver: the function raised ZeroDivisionError: by 0$") as refused:
        sg.plan(problem.grasp, problem.task, raising(error))
    assert refused.value.__cause__ is error


WRONG: dict[str, tuple[Callable[[Any], Any], str]] = {
    "another width": (lambda f: f.force.after(np.eye(2)), "Affine.after.linear"),
    "one row": (lambda f: f.force.after(np.eye(9)[0]), "Affine.after.linear"),
    "no matrix": (lambda f: f.force.after("n"), "Affine.after.linear"),
    "a matrix of other knots": (lambda f: f.force.after(np.zeros((99, 1, 9))), "Affine.after.linear"),
    "masked": (lambda f: f.force.after(np.ma.masked_equal(np.eye(9), 1.0)), "Affine.after.linear"),
    "another length": (lambda f: f.force.plus(np.zeros(8)), "Affine.plus.known"),
    "bounds of another length": (lambda f: sg.within("k", list("abcdefghi"), f.force, [0, 1], 9, 1), "within.lower"),
    "names as a text": (lambda f: sg.within("k", "abcdefghi", f.force, 0, 9, 1), "within.names"),
    "names twice": (lambda f: sg.within("k", ["a"] * 9, f.force, 0, 9, 1), "within.names[1]"),
    "bounds of nan": (lambda f: sg.within("k", list("abcdefghi"), f.force, 0, np.nan, 1), "within.upper"),
    "a lower bound of infinity": (
        lambda f: sg.within("k", list("abcdefghi"), f.force, np.inf, np.inf, 1),
        "within.lower",
    ),
    "an upper bound of less": (lambda f: sg.within("k", list("abcdefghi"), f.force, -9, -np.inf, 1), "within.upper"),
    "a negative weight": (lambda f: sg.squares_of(f.force, -1.0), "squares_of.weights"),
    "no size": (lambda f: sg.within("k", list("abcdefghi"), f.force, 0, 9, 0), "within.unit"),
    "a key that is none": (lambda f: sg.norm_within(3, "a", f.force, 1.0), "norm_within.limit"),  # type: ignore[arg-type]
    "no item": (lambda f: sg.norm_within("k", "", f.force, 1.0), "norm_within.item"),
    "names of a scalar's rows": (lambda f: sg.below_scalar("k", ["a"], f.force), "below_scalar.names"),
    "no quantities below a scalar": (lambda f: sg.below_scalar("k", ["a"], 3), "below_scalar.value"),  # type: ignore[arg-type]
    "no key below a scalar": (lambda f: sg.below_scalar("", list("abcdefghi"), f.force), "below_scalar.limit"),
    "no side below a scalar": (
        lambda f: sg.below_scalar("k", list("abcdefghi"), f.force, side=3),  # type: ignore[arg-type]
        "below_scalar.side",
    ),
    "weights of another length": (lambda f: sg.squares_of(f.force, [1, 2]), "squares_of.weights"),  # type: ignore[arg-type]
}


@pytest.mark.parametrize(("make", "named"), WRONG.values(), ids=WRONG)
def test_what_a_limit_of_ones_own_calls_refuses_by_name(make: Callable[[Any], Any], named: str) -> None:
    formulation = planned().formulation
    assert formulation.force.after(np.eye(9).tolist()).plus(1.0).constant.shape == (formulation.knots, 9)
    with pytest.raises(sg.InputError) as refused:
        make(formulation)
    assert refused.value.issues[0].key == named


def test_a_list_of_bounds_is_as_good_as_an_array() -> None:
    force, names = planned().formulation.force, list("abcdefghi")
    lists = sg.within("k", names, force, [0.0] * 9, [9.0] * 9, [1.0] * 9)
    for one, other in zip(lists, sg.within("k", tuple(names), force, 0.0, np.full(9, 9.0), 1.0), strict=True):
        assert np.array_equal(one.constant, other.constant)
        assert np.array_equal(one.matrix, other.matrix)
        assert one.items == other.items


REACHED: dict[str, tuple[dict[str, Any], str]] = {
    "nothing": ({"reached": lambda *_: None}, "Usage.value"),
    "a word": ({"reached": lambda *_: "x"}, "Usage.value"),
    "too few": ({"reached": lambda self, motion: motion.torques[:, :2]}, "Usage.value"),
    "a unit that is no text": ({"unit": lambda *_: 3}, "Usage.unit"),
}


@pytest.mark.parametrize(("parts", "key"), REACHED.values(), ids=REACHED)
def test_what_a_limit_derived_from_one_of_the_library_reaches_is_judged(parts: dict[str, Any], key: str) -> None:
    assert planned(limits=[type("Mine", (sg.JointTorque,), {})(50.0)]).verdict == "feasible"
    with pytest.raises(sg.InputError) as refused:
        planned(limits=[type("Mine", (sg.JointTorque,), parts)(50.0)])
    assert [issue.key for issue in refused.value.issues] == [key]


class Odd(sg.Move):
    """A move whose profile says something else at its instants."""

    def over(self, setting: Any) -> Any:
        profile = super().over(setting)
        made = object.__new__(type("OddProfile", (type(profile),), {"at": lambda _, times: self.odd(times)}))
        made.__dict__.update(profile.__dict__)
        return made

    odd: Any = None


@pytest.mark.parametrize(
    ("odd", "told"),
    [(lambda times: np.zeros((len(times), 5)), "rows of 6 numbers, got 5"),
     (lambda times: np.full((len(times), 6), np.nan), "finite numbers"),
     (lambda times: np.zeros((len(times) + 1, 6)), "a row at each of 2 knots")],
)  # fmt: skip
def test_a_motion_of_ones_own_that_says_no_numbers_is_refused(odd: Any, told: str) -> None:
    move = type("Mine", (Odd,), {"odd": staticmethod(odd)})(axis=[0, 0, 1], lift=1e-3)
    with pytest.raises(sg.InputError, match=told) as refused:
        sg.plan(problem.grasp, problem.task.replace(target=move, knots=2))
    assert refused.value.issues[0].key == "Task.target"


@pytest.mark.parametrize("made", [None, 3, "x"])
def test_what_a_limit_of_ones_own_is_on_a_grasp_is_a_limit(made: Any) -> None:
    with pytest.raises(sg.InputError, match="expected a limit") as refused:
        planned(limits=[own(sg.Limit, rows=sideways, usage=usage(), on=lambda *_: made)])
    assert refused.value.issues[0].key.startswith("Task.limits[")


def test_a_load_of_ones_own_is_finite_numbers() -> None:
    class Endless(sg.Wrench):
        def over(self, setting: Any) -> Any:
            profile = super().over(setting)
            made = object.__new__(type("Odd", (type(profile),), {"at": lambda _, t: np.full((len(t), 6), np.nan)}))
            made.__dict__.update(profile.__dict__)
            return made

    with pytest.raises(sg.InputError, match="finite numbers") as refused:
        sg.plan(problem.grasp, problem.task.replace(loads=[Endless([0, 0, -1, 0, 0, 0])]))
    assert refused.value.issues[0].key == "Task.wrench"


def test_a_solver_of_ones_own_may_set_entries_of_its_program() -> None:
    task = problem.task.replace(goals=[sg.LargestMargin()], limits=[sg.NormalForce(upper=20.0)])
    usual = sg.plan(problem.grasp, task)

    def setting(_: Any, program: sg.Program, __: Any) -> Any:
        program.P[0, 0] = 7.0
        raise ZeroDivisionError

    with pytest.warns(SparseEfficiencyWarning), pytest.raises(sg.InputError, match="solver"):
        sg.plan(problem.grasp, task, setting)
    assert sg.plan(problem.grasp, task).margins.min() == pytest.approx(usual.margins.min())
