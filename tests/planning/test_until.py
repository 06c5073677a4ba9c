"""A motion that is not followed to its end, and a way that ends: what is true until then is told in every form."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from second_execution import executed as executed_otherwise
from typer.testing import CliRunner

from synergrip import Plan, Unknown, load_problem, plan
from synergrip.cli.app import app
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.text.text_plan import verdict_lines

REPOSITORY = Path(__file__).resolve().parents[2]
FAR = ("gripper-box", "task.move[0].lift=10 mm", "task.knots=11")
LIFTED = "task.linearise=once", "limits.joint_range=none", "task.move[0].lift=120 mm", "task.knots=11"
SQUEEZED = ('goal={ minimise = "effort" }', "limits.margin=3 N", "limits.normal_force=30 N", "task.knots=5")


@cache
def unknown(name: str, *overrides: str) -> Unknown:
    problem = load_problem(name, overrides)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Unknown)
    return answer


def text_of(name: str, *overrides: str) -> str:
    """Return the text without its line breaks."""
    return " ".join("\n".join(verdict_lines(load_problem(name, overrides), unknown(name, *overrides))).split())


def test_what_is_followed_has_the_figures_of_a_second_execution() -> None:
    answer = unknown(*FAR)
    assert answer.reached is not None
    assert answer.motion is not None
    times, whole = answer.motion.times, answer.task.times
    count = int(np.sum(whole <= answer.reached.until_s))
    assert 3 < count == len(times) < len(whole)
    near = load_problem(FAR[0], ["task.move[0].lift=2 mm", FAR[2]])  # the same grasp and loads, with a plan
    shorter = plan(near.grasp, near.task)
    assert isinstance(shorter, Plan)
    document = json.loads(json.dumps(outcome_document("", near.grasp, shorter)))
    told = json.loads(json.dumps(outcome_document("", near.grasp, answer)))["true"]
    document["execution"]["load"] = {}
    document |= {"time_s": told["time_s"], "dz_r": told["dz_r"], "wrench": document["wrench"][:count]}
    there = executed_otherwise(document, REPOSITORY)
    assert there.ended is None
    assert np.array(told["lambda"]) == pytest.approx(there.forces, abs=1e-3)
    assert np.array(told["du"])[:, :3] == pytest.approx(there.du[:, :3], abs=1e-6)
    assert np.array(told["margin"]["per_contact_N"]) == pytest.approx(there.margins, abs=1e-3)
    assert answer.usages[0].value == pytest.approx(there.margins, abs=1e-3)


def test_what_holds_until_then_is_said() -> None:
    answer = unknown(*FAR)
    assert "until t = 0.8 s all limits hold, at the knots and between them" in answer.notes
    assert max(float(usage.excess.max()) for usage in answer.usages) < 1e-3
    assert answer.usages["slip margin"].value.min() >= 0.5 - 1e-3
    text = text_of(*FAR)
    assert "at the first 5 of 11 knots, until t = 0.8 s; pads of 8 mm radius roll; the object is held with" in text
    assert "largest normal force 2.647 N" in text


def test_it_is_saved_and_is_no_plan_to_check_or_play(tmp_path: Path) -> None:
    answer = unknown(*FAR)
    (file,) = answer.save(tmp_path)
    document = json.loads(file.read_text())
    true, margins = document["true"], document["limits"][0]
    assert (document["verdict"], document["exit_code"], document["stage"]) == ("unknown", 3, "reach")
    assert len(document["time_s"]) == 11
    for key in ("time_s", "dz_r", "lambda", "du", "q", "smallest_stiffness_N_m"):
        assert len(true[key]) == 5, key
    assert margins["series"]["values"] == true["margin"]["per_contact_N"]
    assert document["reached"]["until_s"] >= true["time_s"][-1]
    for command in (["check", str(tmp_path), FAR[0]], ["simulate", str(tmp_path)]):
        found = CliRunner().invoke(app, command)
        assert found.exit_code == 2
        assert "its verdict is 'unknown'" in found.stderr


def test_a_way_that_ends_early_has_the_figures_until_then() -> None:
    """The finger runs over the edge of its face; the states before that are those of a plan of fewer knots."""
    answer = unknown("gripper-box", *LIFTED)
    assert answer.stage == "execution"
    assert answer.executed is not None
    assert answer.motion is not None
    got = len(answer.motion.times)
    assert 3 < got == len(answer.executed.states) == len(answer.usages[0].value) < 11
    assert f"ends before t = {answer.task.times[got]:.3g} s" in answer.why
    assert answer.executed.residual < 1e-8
    note = answer.notes[0]
    assert note.startswith(f"until t = {answer.motion.times[-1]:.3g} s limits are missed: slip margin -")


def test_a_squeeze_that_misses_a_limit_says_by_how_much() -> None:
    answer = unknown("utah-mit-ball", *SQUEEZED)
    assert answer.reached is None
    assert answer.usages[0].value.shape == (1, 4)
    worst = float(answer.usages[0].value.min())
    assert 0.0 < worst < 3.0 - 1e-3
    (note,) = answer.notes
    assert note.startswith(f"at t = 0 s limits are missed: slip margin {worst:.4g} N (index/tip, t = 0 s;")
    assert "at the first of 5 knots, t = 0 s;" in text_of("utah-mit-ball", *SQUEEZED)
