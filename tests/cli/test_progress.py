"""What a long solve tells while it runs is what it does."""

from __future__ import annotations

import logging
from dataclasses import replace

import pytest

from synergrip import Infeasible, load_problem, plan
from synergrip.cli import progress
from synergrip.conic.solution import Claim
from synergrip.log import LOG, LONG
from synergrip.planning.solvers import SOLVERS


def test_a_first_attempt_is_told_as_one_also_along_the_motion(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(progress, "PATIENCE", -1.0)
    problem = load_problem("table2-soft-motors")
    plan(problem.grasp, problem.task, progress.telling(SOLVERS["clarabel"]))
    told = capsys.readouterr().err.splitlines()
    assert any("along the motion, 1 knot: " in line for line in told)
    assert any("along the motion" not in line for line in told)
    assert not any("attempt" in line for line in told)


def test_what_is_asked_again_is_told_as_that(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def failing(question, program, settings):
        found = SOLVERS["clarabel"](question, program, settings)
        return replace(found, claim=Claim.NOTHING, x=0 * found.x)

    monkeypatch.setattr(progress, "PATIENCE", -1.0)
    problem = load_problem("pinch-soft")
    plan(problem.grasp, problem.task, progress.telling(failing))
    assert "rows, attempt 2 of 5 ..." in capsys.readouterr().err


def test_what_else_takes_long_is_told_as_it_begins(capsys: pytest.CaptureFixture[str]) -> None:
    try:
        for _ in range(2):  # as for two plans: it is told once
            progress.tell_what_takes_long()
        LONG.info("executing %d scenarios", 157)
        LONG.debug("what is short by itself")
        LOG.info("and nothing else")
        assert capsys.readouterr().err == "executing 157 scenarios ...\n"
    finally:
        LONG.handlers.clear()
        LONG.setLevel(logging.NOTSET)


def test_changes_that_are_tried_are_told_when_it_is_late(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(progress, "PATIENCE", -1.0)
    problem = load_problem("tripod", 'limits.normal_force="1 N"')
    refused = plan(problem.grasp, problem.task)
    assert isinstance(refused, Infeasible)
    try:
        progress.tell_what_takes_long()
        repairs = refused.repairs
        told = capsys.readouterr().err.splitlines()
        assert told[0] == "looking for what the start posture takes of each number ..."
        assert told[1:] == [f"planning with {each.set} ..." for each in repairs]
    finally:
        LONG.handlers.clear()
        LONG.setLevel(logging.NOTSET)
