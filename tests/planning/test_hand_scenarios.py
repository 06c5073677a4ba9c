"""Plans on a hand that hold for a share of random grasps, as samples that they have never seen say."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from command_line import run

import synergrip as sg
from synergrip.changes.asked import Asked
from synergrip.explain.explained import explained
from synergrip.planning.check import judge_references
from synergrip.planning.executed_scenarios import Samples
from synergrip.planning.executing import Executor
from synergrip.planning.known_samples import DESIGN, Number, unseen
from synergrip.planning.outcome import Plan
from synergrip.planning.references import References
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.text.text_cases import case_lines
from synergrip.tasks.scenarios import LOOKS

LIKELY = sg.Scenarios(position=5e-4, normal=np.radians(1), compliance=0.1, share=0.2, confidence=0.9, seed=4)
PROBLEM = sg.load_problem("barrett-ball-hold", ["task.knots=3", "task.between=report"])
TASK = PROBLEM.task.replace(allow=sg.Allowances(scenarios=LIKELY))


def planned(task: sg.Task = TASK) -> Plan:
    made = sg.plan(PROBLEM.grasp, task)
    assert isinstance(made, Plan)
    return made


@cache
def likely() -> Plan:
    return planned()


def share_that_misses(made: Plan, scenarios: sg.Scenarios, count: int = 25) -> float:
    """Of samples of another seed, executed one by one."""
    missed = 0
    for number in range(count):
        own = scenarios.on_hand(made.grasp, 0, number)
        assert made.executed is not None
        found = replace(Executor.of(made.analysis, made.task), setting=own).run(
            made.time, made.dz_r, made.task.wrench, made.executed.states
        )
        missed += not found.whole or found.margins.min() < made.task.margin - 1e-3 * np.abs(made.forces).max()
    return missed / count


def test_a_plan_holds_for_its_share_and_one_without_does_not(monkeypatch: pytest.MonkeyPatch) -> None:
    """Fresh samples are none of those that it was made with, and none is looked at twice."""
    asked = list[list[Number]]()

    def noted(self: Samples, numbers: Sequence[Number], why: str, known=Samples.executed) -> object:  # type: ignore[no-untyped-def]
        asked.append(list(numbers))
        return known(self, numbers, why)

    monkeypatch.setattr(Samples, "executed", noted)
    made = planned()
    fresh = made.fresh
    assert fresh is not None
    assert fresh.count == LIKELY.fresh(fresh.allowed)
    assert fresh.missing <= fresh.allowed
    assert fresh.share == LIKELY.share_at_most(fresh.missing, fresh.count) <= LIKELY.share
    assert len(set(asked[-1])) == fresh.count
    assert not set(asked[-1]) & {number for numbers in asked[:-1] for number in numbers}
    assert asked[0] == [(0, number) for number in range(min(DESIGN, LIKELY.fresh()))]
    other = replace(LIKELY, seed=99)
    assert share_that_misses(made, other) <= LIKELY.share
    assert share_that_misses(planned(PROBLEM.task), other) > 3 * LIKELY.share


def test_each_look_is_at_others_and_has_its_part_of_the_doubt(monkeypatch: pytest.MonkeyPatch) -> None:
    """A plan that is made with no samples misses at first; what missed then it is made with."""
    monkeypatch.setattr("synergrip.planning.executed_scenarios.first", lambda fresh: unseen())
    made = planned()
    assert made.fresh is not None
    assert 2 <= made.fresh.looks <= LOOKS
    assert made.fresh.made_with == (made.fresh.looks - 1) * LIKELY.fresh()
    assert made.fresh.count >= np.log((1 - LIKELY.confidence) / LOOKS) / np.log(1 - LIKELY.share)


def test_what_cannot_be_kept_is_unknown_and_says_what_is_missed() -> None:
    tight = TASK.replace(limits=[sg.SlipMargin(0.5), sg.NormalForce(upper=12.2)])
    assert sg.plan(PROBLEM.grasp, tight.replace(allow=None)).verdict == "feasible"
    unsure = sg.plan(PROBLEM.grasp, tight)
    assert isinstance(unsure, sg.Unknown)
    assert (unsure.stage, unsure.exit_code) == ("execution", 3)
    assert "scenarios executed at the true equilibrium" in unsure.why
    assert "scenario 0." in unsure.why
    assert not explained(unsure, short=True).others  # what was planned without scenarios would help nobody


def test_what_is_planned_at_the_start_posture_is_judged_by_one_look() -> None:
    once = TASK.replace(linearise="once")
    assert sg.plan(PROBLEM.grasp, once.replace(allow=None)).verdict == "feasible"
    unsure = sg.plan(PROBLEM.grasp, once)
    assert isinstance(unsure, sg.Unknown)
    assert "fresh scenarios executed at the true equilibrium" in unsure.why


def test_references_of_anybody_are_judged_by_samples_of_their_own() -> None:
    for made, passed in ((likely(), True), (planned(PROBLEM.task), False)):
        judged = judge_references(PROBLEM.grasp, TASK.timed(PROBLEM.grasp), References(made.time, made.dz_r, {}))
        (share,) = (check for check in judged.checks if check.name == "what is allowed: share of scenarios")
        assert share.passed is passed
        assert share.error > 0
        assert share.tolerance == LIKELY.share


def test_document_and_text_say_what_is_promised() -> None:
    made = likely()
    assert made.fresh is not None
    told = outcome_document("", PROBLEM.grasp, made)["allowances"]["scenarios"]
    assert {key: told[key] for key in ("count", "missing", "share", "confidence", "seed", "instants", "at")} == {
        "count": made.fresh.count, "missing": made.fresh.missing, "share": 0.2, "confidence": 0.9, "seed": 4,
        "instants": 3, "at": "true equilibrium",
    }  # fmt: skip
    assert json.dumps(told)
    text = " ".join(" ".join(case_lines(made)).split())
    assert f"{made.fresh.count} fresh scenarios (seed 4), executed at the true equilibria at 3 instants" in text
    assert "with a confidence of 90 %, all but 20 % of any others" in text


def test_who_interrupts_the_samples_has_no_promise(monkeypatch: pytest.MonkeyPatch) -> None:
    count = 0

    def stopped(self: Samples, number: Number, known=Samples._executed) -> object:  # type: ignore[no-untyped-def]
        nonlocal count
        count += 1
        if count == 12:
            raise KeyboardInterrupt
        return known(self, number)

    monkeypatch.setattr(Samples, "_executed", stopped)
    with pytest.raises(KeyboardInterrupt, match=r"after 11 of 16 scenarios .* nothing is known"):
        sg.plan(PROBLEM.grasp, TASK)


def test_what_is_refused_names_its_key(tmp_path: Path) -> None:
    with pytest.raises(sg.InputError, match=r"Task\.allow\.scenarios\.share: takes .* more than the 1000"):
        sg.plan(PROBLEM.grasp, TASK.replace(allow=sg.Allowances(scenarios=replace(LIKELY, share=0.001))))
    done = run("plan", "barrett-ball-hold", "--set", 'allow.scenarios={ position = "1 mm", share = 0.001 }')
    assert done.exit_code == 2
    assert "allow.scenarios.share" in done.stderr
    free = sg.load_problem("gripper-box", ["task.knots=3", "contacts.model=hard"])
    unloaded = free.task.replace(loads=[sg.Wrench((0,) * 6)], target=sg.Hold())
    with pytest.raises(sg.InputError, match=r"allow\.scenarios: these contacts leave a motion of the object free"):
        sg.plan(free.grasp, unloaded.replace(allow=sg.Allowances(scenarios=LIKELY)))
    slides = sg.load_problem("gripper-box", ["task.knots=3", "contacts.model=frictionless"])
    tilted = slides.task.replace(allow=sg.Allowances(scenarios=sg.Scenarios(normal=0.1)))
    with pytest.raises(sg.InputError, match=r"allow\.scenarios\.normal: a contact of which only"):
        sg.plan(slides.grasp, tilted)


def test_margins_and_explanations_ask_for_what_is_guaranteed_alone() -> None:
    """One plan takes many samples, and each number many plans."""
    both = TASK.replace(allow=sg.Allowances(friction_share=0.1, scenarios=LIKELY))
    for task, rest in ((TASK, None), (both, sg.Allowances(friction_share=0.1))):
        timed = task.timed(PROBLEM.grasp)
        asked = Asked.of(PROBLEM.grasp, task, timed).task
        assert isinstance(asked, sg.Task)
        assert asked.allow == rest
        posed = Asked.of(PROBLEM.grasp, timed, timed).timed.allowed
        assert posed is not None
        assert posed.scenarios is None
