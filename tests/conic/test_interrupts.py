"""Ctrl-C while a solver runs stops it at its next iteration, and nothing else changes."""

from __future__ import annotations

import signal
import threading

import pytest

from synergrip.conic.solution import Claim, Settings
from synergrip.conic.solvers import clarabel_
from synergrip.conic.solvers.interrupts import interruptible
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.planning.solvers import Answerer
from synergrip.problems.problem import load_problem


def test_an_interrupt_is_told_to_the_solver_and_raised_when_it_has_stopped() -> None:
    said: list[bool] = []

    def solved() -> None:
        with interruptible() as stop:
            said.append(stop(None))
            signal.raise_signal(signal.SIGINT)
            said.append(stop(None))

    with pytest.raises(KeyboardInterrupt):
        solved()
    assert said == [False, True]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_without_an_interrupt_nothing_is_raised() -> None:
    with interruptible() as stop:
        assert not stop(None)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_a_program_that_handles_signals_itself_is_left_alone() -> None:
    heard: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: heard.append(number))
    try:
        with interruptible() as stop:
            signal.raise_signal(signal.SIGINT)
            assert not stop(None)
        assert heard == [signal.SIGINT]
    finally:
        signal.signal(signal.SIGINT, before)


def test_another_thread_solves_as_ever() -> None:
    problem = load_problem("pinch-soft")
    found: list[object] = []
    thread = threading.Thread(target=lambda: found.append(plan(problem.grasp, problem.task).verdict))
    thread.start()
    thread.join()
    assert found == ["feasible"]


def test_clarabel_stops_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    problem, iterations, pressing = load_problem("barrett-ball-hold", ["task.knots=81"]), [], []

    class Counting:
        """The solver, which tells how often it asks whether to stop; somebody presses Ctrl-C at the first time."""

        def __init__(self, *data) -> None:
            self.solver = solver(*data)

        def set_termination_callback(self, stop) -> None:
            def asked(info):
                iterations.append(info)
                if pressing:
                    signal.raise_signal(signal.SIGINT)
                return stop(info)

            self.solver.set_termination_callback(asked)

        def solve(self):
            return self.solver.solve()

    import clarabel

    solver = clarabel.DefaultSolver
    monkeypatch.setattr(clarabel, "DefaultSolver", Counting)
    answer = first_answer(problem)
    assert answer.claim is Claim.OPTIMAL
    assert len(iterations) > 5
    iterations.clear()
    pressing.append(True)
    with pytest.raises(KeyboardInterrupt):
        first_answer(problem)
    assert len(iterations) <= 1


def first_answer(problem):
    """Return what Clarabel says of the first question that planning asks."""
    asked = []

    def ask(question, program, settings):
        asked.append(clarabel_.solve(program, Settings()))
        return asked[-1]

    answerer: Answerer = ask
    plan(problem.grasp, problem.task, answerer)
    return asked[0]
