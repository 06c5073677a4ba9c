"""Answers that rest on maps which are not known well say so, and give no verdict when they might be turned."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import command_line
import numpy as np
import pytest

from synergrip.files import bundled
from synergrip.linalg import frozen
from synergrip.planning import planning
from synergrip.planning.accuracy import InDoubtError, accuracy_notes
from synergrip.planning.outcome import Plan, Unknown
from synergrip.planning.planning import plan
from synergrip.planning.stages import Stage
from synergrip.planning.verified import identities, verified_plan
from synergrip.problems.problem import load_problem
from synergrip.statics.analysis import Analysis, analyse


def pinch_that_yields(share: float) -> str:
    """Write the bundled pinch with contacts that yield together 1 / share times as much as to a squeeze."""
    folder = bundled("problems")
    grasp = json.loads((folder / "pinch-soft.json").read_text(encoding="utf-8"))
    C_s = 1e-3 * np.eye(8)
    C_s[0, 4] = C_s[4, 0] = -1e-3 * (1 - share)
    grasp["C_s"] = C_s.tolist()
    Path("pinch-soft.json").write_text(json.dumps(grasp), encoding="utf-8")
    Path("pinch.toml").write_text((folder / "pinch-soft.toml").read_text(encoding="utf-8"), encoding="utf-8")
    return "pinch.toml"


def checks(document: dict[str, Any]) -> dict[str, float]:
    return {check["name"]: check["error"] for check in document["checks"]}


def test_nothing_is_said_of_what_is_known_well() -> None:
    problem = pinch_that_yields(1.0)
    assert "sensitive" not in command_line.run("plan", problem).stdout
    assert "response" not in checks(command_line.document("plan", problem))
    found = command_line.document("analyse", problem)
    assert found["notes"] == []
    assert max(each["error"] for each in found["accuracy"].values()) < 1e-12
    assert set(found["accuracy"]) == set(found["maps"])


def test_what_hangs_on_the_last_digits_is_told_where_it_does_not_matter_yet() -> None:
    problem = pinch_that_yields(3e-8)
    words = "sensitive: what synergy references do to the"
    told = command_line.document("plan", problem)
    assert told["verdict"] == "feasible"
    assert any(note.startswith(words) for note in told["notes"])
    assert 1e-8 < checks(told)["response"] < 1e-6
    assert words in " ".join(command_line.run("plan", problem).stdout.split())
    found = command_line.document("analyse", problem)
    assert found["notes"][0].startswith(words)
    assert 1e-8 < found["accuracy"]["dlambda_dzr"]["sensitivity"] < 1e-6
    assert words in " ".join(command_line.run("analyse", problem).stdout.split())


def test_no_verdict_where_the_last_digits_could_turn_it() -> None:
    problem = pinch_that_yields(1e-11)
    told = command_line.document("plan", problem, code=3)
    assert told["verdict"] == "unknown"
    assert told["why"]["text"].startswith("sensitive: what synergy references do to the")
    for margin in ("0.1 N", "1e6 N"):  # neither a plan nor a proof
        assert command_line.run("plan", problem, "--set", f"limits.margin={margin}").exit_code == 3


def inaccurate(analysis: Analysis, error: float) -> Analysis:
    accuracy = {name: replace(each, lost=error * each.size) for name, each in analysis.response.accuracy.items()}
    return replace(analysis, response=replace(analysis.response, accuracy=accuracy))


def test_what_is_inaccurate_is_said_and_decides_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = load_problem("pinch-soft")
    found = analyse(problem.grasp, problem.timed.wrench)
    assert list(accuracy_notes(inaccurate(found, 1e-9).response)) == []
    (note,) = accuracy_notes(inaccurate(found, 3e-7).response)
    assert note.startswith("inaccurate: what ")
    assert "may be wrong by 3e-07 of its size" in note
    for error, kind in ((3e-7, Plan), (3e-6, Unknown)):
        monkeypatch.setattr(planning, "analyse", lambda *_, error=error: inaccurate(found, error))
        outcome = plan(problem.grasp, problem.task)
        assert isinstance(outcome, kind)
        assert any("inaccurate" in text for text in (outcome.notes if isinstance(outcome, Plan) else [outcome.why]))


def test_references_far_larger_than_their_forces_magnify_the_error() -> None:
    """A plan whose forces are the small difference of what large references do is not ticked."""
    problem = load_problem("pinch-soft")
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    wanted = outcome.alpha, outcome.beta, outcome.gamma
    known = inaccurate(outcome.analysis, 1e-8)
    assert all(check.passed for check in identities(known, outcome.motion, wanted))
    large = replace(outcome.motion, dz_r=frozen(1e3 * outcome.motion.dz_r))
    assert "response" in {check.name for check in identities(known, large, wanted) if not check.passed}
    stage = Stage(outcome.formulation, (), outcome.decisions[-1], outcome.decisions)  # type: ignore[arg-type]
    assert isinstance(verified_plan(outcome.task, known, stage, None), Plan)
    with pytest.raises(InDoubtError, match="too little to say that the limits hold"):
        verified_plan(outcome.task, inaccurate(outcome.analysis, 1e-5), stage, None)
