"""What holds of all values: they stay as they are, and comparing or copying them never surprises."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import synergrip as sg
from synergrip.conic.formulation import Formulation

VALUES: dict[str, Callable[[], Any]] = {
    "grasp": lambda: sg.load_problem("tripod").grasp,
    "problem": lambda: sg.load_problem("barrett-ball-hold"),
    "task": lambda: sg.Task(duration=1.0, limits=[sg.JointTorque([1.0, 2.0])]),
    "torque": lambda: sg.JointTorque([1.0, 2.0]),
    "wrench table": lambda: sg.WrenchTable([0.0, 1.0], np.ones((2, 6))),
    "motion table": lambda: sg.MotionTable([0.0, 1.0], np.ones((2, 6))),
    "waypoints": lambda: sg.Waypoints(times=[1.0], positions=[[0.0, 0.0, 0.01]]),
    "path": lambda: sg.PalmPath([0.0, 1.0, 2.0], np.zeros((3, 6))),
}


def arrays(value: Any) -> list[np.ndarray]:
    return [each for each in vars(value).values() if isinstance(each, np.ndarray)]


@pytest.mark.parametrize("name", list(VALUES))
def test_copies_are_read_only_and_comparisons_are_true_or_false(name: str) -> None:
    value = VALUES[name]()
    for again in (value, pickle.loads(pickle.dumps(value)), copy.deepcopy(value)):
        assert isinstance(hash(again), int)
        assert len(repr(again)) < 600
        assert (again == np.ones(3)) is False
        assert not any(array.flags.writeable for array in arrays(again))


@pytest.mark.parametrize("name", [name for name in VALUES if name not in ("grasp", "problem")])
def test_what_is_asked_compares_by_content(name: str) -> None:
    one, other = VALUES[name](), VALUES[name]()
    assert one == other
    assert hash(one) == hash(other)


def test_a_view_of_what_somebody_may_change_is_copied() -> None:
    numbers = np.eye(9) * 1e-4
    view = numbers.view()
    view.flags.writeable = False
    grasp = sg.load_problem("tripod").grasp.replace(C_s=view)
    limits = np.ones(4)
    seen = limits.view()
    seen.flags.writeable = False
    torque = sg.JointTorque(seen)
    numbers *= 2
    limits *= 2
    assert grasp.C_s[0, 0] == 1e-4
    assert np.array_equal(torque.limit, np.ones(4))


BAD_ROWS: list[tuple[str, Callable[[Any], Any]]] = [
    ("within.lower", lambda y: sg.within("k", ("a",), y, [np.nan], [1.0], [1.0])),
    ("within.lower", lambda y: sg.within("k", ("a",), y, [2.0], [1.0], [1.0])),
    ("within.unit", lambda y: sg.within("k", ("a",), y, [0.0], [1.0], [-1.0])),
    ("within.unit", lambda y: sg.within("k", ("a",), y, [0.0], [1.0], [0.0])),
    ("within.names", lambda y: sg.within("k", ("a", "b"), y, [0.0], [1.0], [1.0])),
    ("within.upper", lambda y: sg.within("k", ("a",), y, [0.0], ["x"], [1.0])),
    ("norm_within.bound", lambda y: sg.norm_within("k", "a", y, -1.0)),
    ("norm_within.bound", lambda y: sg.norm_within("k", "a", y, np.nan)),
    ("norm_within.value", lambda y: sg.norm_within("k", "a", None, 1.0)),
]


@pytest.mark.parametrize(("key", "make"), BAD_ROWS)
def test_bounds_of_ones_own_limits_are_judged(key: str, make: Callable[[Any], Any]) -> None:
    class Own(sg.Limit):
        def rows(self, formulation: Formulation) -> Any:
            first = formulation.force.after(np.eye(1, formulation.response.grasp.n_l))
            made = make(first)
            return made if isinstance(made, list) else [made]

        def usage(self, formulation: Formulation, motion: Any) -> Any:
            raise AssertionError("it is refused before")

    problem = sg.load_problem("tripod")
    with pytest.raises(sg.InputError) as caught:
        sg.plan(problem.grasp, problem.task.replace(limits=[*problem.task.limits, Own()]))
    assert caught.value.issues[0].key == f"Own.rows.{key}"
    assert isinstance(caught.value.__cause__, sg.InputError)


@pytest.mark.parametrize(
    ("changes", "fragment"),
    [({"scale": [0.0]}, "greater than 0"), ({"value": [[np.nan]]}, "got nan"), ({"items": ()}, "0 items")],
)
def test_a_usage_that_no_check_can_go_by_is_refused(changes: dict[str, Any], fragment: str) -> None:
    class Own(sg.Limit):
        def rows(self, formulation: Formulation) -> Any:
            return []

        def usage(self, formulation: Formulation, motion: Any) -> sg.Usage:
            own: dict[str, Any] = {"value": [[0.0]], "scale": [1.0], "items": ("x",), **changes}
            value = np.broadcast_to(np.array(own["value"]), (len(motion.times), 1))
            return sg.Usage("own", "N", own["items"], value, np.array([-1.0]), np.array([1.0]),
                            np.array(own["scale"]), motion.times)  # fmt: skip

    problem = sg.load_problem("tripod")
    with pytest.raises(sg.InputError, match=f"[uU]sage.*{fragment}"):
        sg.plan(problem.grasp, problem.task.replace(limits=[*problem.task.limits, Own()]))
