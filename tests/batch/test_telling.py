"""What is told while many tasks are planned, what an interrupt keeps, and why there is no plan."""

from __future__ import annotations

import signal
import threading
from typing import Any

import numpy as np
import pytest
from held_ball import grasp as held
from random_cone_problems import grasp_like, random_wrenches

import synergrip as sg
from synergrip.batch import keeping, telling
from synergrip.batch.compiling import Compiled
from synergrip.batch.many_plans import OF_HAND

RNG = np.random.default_rng(9)
GRASP, WRENCHES = grasp_like(RNG, ["hard"] * 3), random_wrenches(RNG, 6)
ALONE = sg.Task(knots=1, limits=[sg.NormalForce(upper=10.0), sg.FrictionReserve(1.1)])
"""A task that is planned one by one."""


def test_what_is_planned_one_by_one_tells_how_far_it_is_and_an_interrupt_keeps_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(telling, "SELDOM", 0.0)
    shares = list[float]()
    whole = sg.plan_many(GRASP, ALONE, wrenches=WRENCHES, progress=lambda what, share: shares.append(share))
    np.testing.assert_allclose(shares, [*np.arange(1, 7) / 6, 1.0])
    plan, begun = keeping.plan_of_start_posture, list[object]()

    def pressed(*given: Any) -> Any:
        begun.append(given)
        if len(begun) == 4:
            raise KeyboardInterrupt
        return plan(*given)

    monkeypatch.setattr(keeping, "plan_of_start_posture", pressed)
    found = sg.plan_many(GRASP, ALONE, wrenches=WRENCHES)
    assert found.finished.tolist() == [True] * 3 + [False] * 3
    assert found.one_by_one.tolist() == [True] * 3 + [False] * 3
    assert np.array_equal(found.forces[:3], whole.forces[:3], equal_nan=True)


@pytest.mark.parametrize(
    ("progress", "got"), [("yes", "got 'yes'"), (lambda share: None, r"got one that takes \(share\)")]
)
def test_who_is_told_must_take_a_text_and_a_share(progress: Any, got: str) -> None:
    for ask in (sg.plan_many, lambda *given, **named: sg.margins_many(*given, of="load_factor", **named)):
        with pytest.raises(sg.InputError, match=f"^progress: expected a function of two arguments.*{got}"):
            ask(GRASP, ALONE, wrenches=WRENCHES, progress=progress)


class Function:
    """One that Numba would compile, which somebody interrupts meanwhile."""

    __module__ = "somewhere"

    class stats:
        cache_path = "nowhere"
        cache_hits: dict[str, int] = {}  # noqa: RUF012


def test_compiling_is_announced_and_an_interrupt_waits_for_its_end(caplog: pytest.LogCaptureFixture) -> None:
    told, calls = list[str](), list[str]()

    def prepare(function: Any) -> None:
        signal.raise_signal(signal.SIGINT)  # which falls into a callback of the compiler, and would be lost there
        calls.append("to its end")

    compiled = Compiled("kernel", (), lambda stamp: Function(), prepare, "about half a minute")
    assert threading.current_thread() is threading.main_thread()
    with caplog.at_level("WARNING", "synergrip"), pytest.raises(KeyboardInterrupt):
        compiled.ready(lambda what, share: told.append(what))
    assert calls == ["to its end"]
    assert compiled.loaded
    assert told == ["compiling the kernel, once on this machine: about half a minute (an interrupt waits for its end)"]
    assert told[0] in caplog.text


def test_a_no_names_the_limit_that_clashes_most() -> None:
    torque = sg.Task(knots=1, limits=[sg.NormalForce(upper=50.0), sg.JointTorque(0.05)])
    force = sg.Task(knots=1, limits=[sg.NormalForce(upper=1.0), sg.JointTorque(5.0)])
    for task in (torque, force):
        many = sg.plan_many(GRASP, task, wrenches=WRENCHES)
        no = np.flatnonzero(many.verdicts == "infeasible")
        assert len(no)
        assert set(many.clashes[many.verdicts == "feasible"]) <= {""}
        for i in no:
            one = many.plan(int(i))
            assert isinstance(one, sg.Infeasible)
            assert many.clashes[i] == next(each.key for each in one.conflicts if not each.friction)
    assert {"limits.normal_force"} == set(many.clashes[no])


def test_plans_of_a_hand_say_what_they_are_not_and_which_kernel_it_was() -> None:
    task = sg.Task(knots=1, loads=[sg.Gravity((0, 0, -9.81))], limits=[sg.NormalForce(upper=15.0)], linearise="once")
    stack = [held, held.replace(mass=0.4)]
    many = sg.plan_many(stack, task, masses=[0.1, 20.0], kernel="numpy")
    assert many.verdicts.tolist() == sg.plan_many(held, task, masses=[0.1, 20.0]).verdicts.tolist()
    assert many.verdicts.tolist() == ["feasible", "infeasible"]
    assert many.notes == (OF_HAND,)
    assert "note" not in repr(many)
    assert many.kernel == "numpy"
    assert many.plan(-1).verdict == "infeasible"
    with pytest.raises(sg.InputError, match="place: "):
        many.plan(2)


def test_masses_in_another_unit_are_noted_of_one_object_however_it_is_held() -> None:
    task = sg.Task(knots=1, loads=[sg.Gravity((0, 0, -9.81))], limits=[sg.NormalForce(upper=15.0)], linearise="once")
    for grasp in (held, [held, held.replace(friction=0.7)], [held, held.replace(mass=0.4)]):
        many = sg.plan_many(grasp, task, masses=[0.1, 100.0], kernel="numpy")
        (noted,) = (note for note in many.notes if note != OF_HAND)
        assert noted.startswith("masses: 100 kg in the box around the ball")
        assert noted.endswith("is it in another unit?")
