"""``plan --pyramids``: what it adds, what it refuses, and that it has no say in the answer."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import Any

import command_line
import numpy as np
import pytest
from command_line import run

from synergrip.conic.program import Program
from synergrip.conic.solution import Claim, Solution
from synergrip.conic.solvers import qpsolvers_
from synergrip.linalg import frozen

KEYS = {
    "facets", "rejected", "effort", "effort_ratio", "peak_ratio", "margin_N", "solver", "status", "verified", "failed",
    "gap", "time_s", "time_ratio",
}  # fmt: skip
ELASTIC = 'limits.elastic_motion="2 mm"'
VOLATILE = ("programs", "pyramids", "provenance")
"""Times are in both."""


document = partial(command_line.document, "plan")


def without_times(answer: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in answer.items() if key not in VOLATILE}


def test_the_comparison_is_added_and_nothing_else_changes() -> None:
    plain, compared = document("barrett-ball-hold"), document("barrett-ball-hold", "--pyramids", "8")
    assert "pyramids" not in plain
    found = compared["pyramids"]
    assert {*found} == KEYS
    assert without_times(plain) == without_times(compared)
    assert (found["facets"], found["rejected"], found["verified"], found["failed"]) == (8, False, True, [])
    assert found["effort_ratio"] > 1.05
    assert found["peak_ratio"] > 1.05
    assert found["solver"].startswith("osqp")
    assert found["time_s"] > 0
    stored = json.loads(Path("out/barrett-ball-hold/plan.json").read_text(encoding="utf-8"))
    assert stored["pyramids"] == found


def test_text_tells_the_price_after_the_answer() -> None:
    text = run("plan", "barrett-ball-hold", "--pyramids", "8", "--qp-solver", "highs").stdout
    answer, _, rest = text.partition("\npyramids ")
    assert "feasible  smallest slip margin" in answer
    said = " ".join(rest.split())
    assert "8 facets inscribed in each friction cone (a comparison, no part of the verdict)" in said
    assert "contact effort +19.5 %, largest normal force +16.7 %" in said
    assert "highs (qpsolvers " in said
    assert "verified, its references keep every limit and the true cones, goal within" in said
    margin = run("plan", "barrett-ball-hold", "--pyramids", "8", "--set", 'goal={maximise="margin"}').stdout
    assert "smallest slip margin 1.056 N (cones: 1.372 N), contact effort -16.5 %, largest normal force +0.0 %" in (
        " ".join(margin.split())
    )


@pytest.mark.parametrize("x", [7.0, np.nan])
def test_a_lying_solver_changes_neither_verdict_nor_exit_code(x: float, monkeypatch: pytest.MonkeyPatch) -> None:
    plain = document("barrett-ball-hold")

    def lies(program: Program, *_: object) -> Solution:
        nothing = frozen(np.zeros(len(program.b)))
        return Solution(Claim.OPTIMAL, frozen(np.full(len(program.q), x)), nothing, "liar", "solved", 1, 0.0)

    monkeypatch.setattr(qpsolvers_, "solve", lies)
    compared = document("barrett-ball-hold", "--pyramids", "8")
    assert without_times(plain) == without_times(compared)
    assert (compared["verdict"], compared["exit_code"]) == ("feasible", 0)
    found = compared["pyramids"]
    assert (found["status"], found["verified"]) == ("solved", False)
    text = " ".join(run("plan", "barrett-ball-hold", "--pyramids", "8").stdout.split())
    wrong = "returned no references" if np.isnan(x) else "its references break slip margin ("
    assert f"liar says 'solved': not verified, {'it ' if np.isnan(x) else ''}{wrong}" in text


def test_a_rejected_grasp_is_told_as_such_and_stays_feasible() -> None:
    ask = ("barrett-ball-hold", "--pyramids", "8", "--set", "limits.margin=1.2 N")
    found = document(*ask)
    assert (found["verdict"], found["pyramids"]["rejected"]) == ("feasible", True)
    assert (found["pyramids"]["effort_ratio"], found["pyramids"]["margin_N"]) == (None, None)
    text = " ".join(run("plan", *ask).stdout.split())
    assert "rejected, no plan keeps them (proven), although the cones allow one" in text


def test_without_a_plan_there_is_nothing_to_compare() -> None:
    assert document("barrett-ball-lift", "--pyramids", "8", code=1)["pyramids"] is None
    result = run("plan", "barrett-ball-lift", "--pyramids", "8")
    assert result.exit_code == 1
    assert "nothing to compare" in result.stdout


def test_an_interrupted_comparison_leaves_the_plan_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object) -> Solution:
        raise KeyboardInterrupt

    plain = document("barrett-ball-hold")
    monkeypatch.setattr(qpsolvers_, "solve", interrupted)
    stopped = document("barrett-ball-hold", "--pyramids", "8")
    assert stopped["pyramids"] is None
    assert without_times(plain) == without_times(stopped)
    result = run("plan", "barrett-ball-hold", "--pyramids", "8")
    assert result.exit_code == 0
    assert result.stdout.rstrip().endswith("pyramids not compared: interrupted")


def test_other_cones_are_named() -> None:
    found = document("barrett-ball-hold", "--pyramids", "8", "--set", ELASTIC)["pyramids"]
    expected = "pyramids replace friction cones only; this problem has other cones: limits.elastic_motion"
    assert expected in found["status"]
    assert (found["solver"], found["verified"], found["time_s"]) == (None, False, None)
    assert found["effort_ratio"] > 1.05
    assert expected in " ".join(run("plan", "barrett-ball-hold", "--pyramids", "8", "--set", ELASTIC).stdout.split())


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--pyramids", "2"), "expected 3 to 64 facets"),
        (("--pyramids", "-8"), "expected 3 to 64 facets"),
        (("--pyramids", "8", "--qp-solver", "oqsp"), "did you mean 'osqp'"),
        (("--qp-solver", "osqp"), "add --pyramids 8"),
    ],
)
def test_bad_options_are_bad_input_and_nothing_is_solved(options: tuple[str, ...], message: str) -> None:
    result = run("plan", "barrett-ball-hold", *options)
    assert result.exit_code == 2
    assert message in result.stderr
    assert not Path("out").exists()
    error = document("barrett-ball-hold", *options, code=2)["error"]
    assert message in error["message"]
    assert error["key"] == ("--qp-solver" if "--qp-solver" in options else "--pyramids")
