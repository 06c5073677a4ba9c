"""Least changes by a few instants, and proofs that do without some rows: the whole program says the same."""

from __future__ import annotations

import numpy as np
import pytest

import synergrip as sg
from synergrip.changes import few_instants, least_change
from synergrip.changes.asked import Asked, Posed
from synergrip.changes.at_a_value import CLOSE, posed_at, solved
from synergrip.changes.few_instants import by_few_instants
from synergrip.changes.some_rows import instants_of, leading, of_rows, proven_without
from synergrip.changes.turning import dials
from synergrip.conic.decide import Decision
from synergrip.conic.limits.dial import Dial
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.pace import SHORT, WHOLE

NOES = (
    ("human-glass", "limits.synergy_reference=0.01"),
    ("human-ball-5", "limits.margin=2 N"),
    ("tripod", "limits.normal_force=1 N"),
    ("barrett-ball-still", "limits.joint_torque=0.05"),
)


def posed(name: str, change: str) -> tuple[Posed, tuple[Dial[Asked], ...]]:
    problem = sg.load_problem(name, [change])
    no = sg.plan(problem.grasp, problem.task)
    assert isinstance(no, Infeasible)
    asked = Asked.of(no.grasp, problem.task, no.task)
    found = asked.posed(no.analysis)
    assert found is not None
    return found, dials(asked, no.task, found.analysis)


@pytest.mark.parametrize(("name", "change"), NOES)
def test_few_instants_find_the_least_friction(name: str, change: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """As near as whole programs do, or none where the largest friction there is does not help."""
    there, numbers = posed(name, change)
    friction = next(each for each in numbers if each.cause == "friction")
    begun = solved("any plan", there.program())
    tries, close = least_change._tries(friction), least_change._close(friction, 0.0)
    few = by_few_instants(friction, there, begun, tries, close)
    monkeypatch.setattr(least_change, "by_few_instants", lambda *args: None)
    whole = least_change.least_change(friction, there, there.program())
    assert few is not None
    assert few.proven
    assert (few.value is None) == (whole.value is None)
    if few.value is not None and whole.value is not None:
        assert few.value == pytest.approx(whole.value, rel=2 * CLOSE)
        beyond = posed_at(friction, few.value * (1 + CLOSE), there)
        assert beyond is not None
        assert solved("any plan", beyond.program()).acceptable


def test_instants_are_added_where_those_that_were_taken_do_not_do(monkeypatch: pytest.MonkeyPatch) -> None:
    """The instant that is at fault as it is need not be the one that asks for most friction."""
    there, numbers = posed(*NOES[0])
    friction = next(each for each in numbers if each.cause == "friction")
    looked: list[np.ndarray] = []

    def first_knot_first(program: object, ray: np.ndarray) -> np.ndarray:
        looked.append(leading(program, ray) if looked else np.array([10]))  # type: ignore[arg-type]
        return looked[-1]

    monkeypatch.setattr(few_instants, "leading", first_knot_first)
    begun = solved("any plan", there.program())
    found = by_few_instants(friction, there, begun, least_change._tries(friction), least_change._close(friction, 0.0))
    assert len(looked) > 1
    assert found is not None
    assert found.value == pytest.approx(2.44638, rel=2 * CLOSE)


@pytest.mark.parametrize(("name", "change"), NOES)
def test_a_proof_does_without_what_cannot_help(name: str, change: str) -> None:
    """Each number that it is said of has no plan as far as it goes; of what helps it is never said."""
    there, numbers = posed(name, change)
    program = there.program()
    no = solved("any plan", program)
    for dial in (each for each in numbers if each.smooth):
        column = least_change.turning_column(dial, there, program)
        assert column is not None
        assert no.certificate.y is not None
        slow = least_change._by_one_program(dial, there, program, column)
        assert slow is not None
        if proven_without(program, no.certificate.y, column != 0):
            assert slow.value is None
            assert slow.proven


def test_some_rows_ask_for_less() -> None:
    there, _ = posed(*NOES[0])
    program = there.program()
    every = of_rows(program, np.ones(len(program.b), dtype=bool))
    assert (every.A != program.A).nnz == 0
    np.testing.assert_array_equal(every.b, program.b)
    no: Decision = solved("any plan", program)
    assert no.certificate.y is not None
    few = np.isin(instants_of(program), leading(program, no.certificate.y))
    assert 0 < few.sum() < len(few)
    assert solved("any plan", of_rows(program, few)).infeasible
    assert not proven_without(program, no.certificate.y, few)


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("robonaut-handle", ["limits.normal_force=20.883 N"]),
        ("barrett-ball-still", ["limits.joint_torque=1.2643"]),
        ("human-glass", ["limits.synergy_reference=0.01", "contacts.friction_factor=4.17"]),
    ],
)
def test_what_is_planned_briefly_keeps_every_limit(name: str, changes: list[str]) -> None:
    """As what is planned with all effort does; and it says that it may not be the best."""
    problem = sg.load_problem(name, changes)
    asked = Asked(problem.grasp, problem.task)
    brief, whole = asked.outcome(SHORT), asked.outcome(WHOLE)
    assert isinstance(whole, Plan)
    assert isinstance(brief, Plan)
    assert all(check.passed for check in brief.checks)
    assert brief.task.goals == whole.task.goals
    assert any("may not be the best" in note for note in brief.notes)
    assert not any("may not be the best" in note for note in whole.notes)
    if whole.largest_margin is not None:
        assert brief.largest_margin is not None
        assert brief.largest_margin <= whole.largest_margin + 2e-2
