"""What is missed between the knots is asked for at them, also where the steps of the passes before were short."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from synergrip import Plan, Unknown, load_problem, plan
from synergrip.explain import explained
from synergrip.linalg import frozen
from synergrip.planning import executed_cases, walked
from synergrip.planning.between import Between
from synergrip.planning.in_cases import limits_of_cases
from synergrip.planning.kept_between import MORE, MoreAtKnots
from synergrip.reports.text.text_between import between_lines

KNOCKED = (
    "limits.normal_force=39.9 N", 'goal={ minimise = "holding" }', "limits.margin=0.227 N",
    'task.push=[{force="3.8 N", direction="x", start="1 s", end="1.2 s"}]',
)  # fmt: skip


@pytest.mark.parametrize("knots", [21, 41])
def test_what_a_jump_of_the_load_takes_is_had_by_longer_steps(knots: int) -> None:
    """The passes end with steps of 0.002 rad; with the three times that the next round began with no program had it."""
    problem = load_problem("utah-mit-ball", [*KNOCKED, f"task.knots={knots}"])
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    assert answer.between is not None
    room = max(1e-3, 1e-3 * float(np.abs(answer.forces).max()))
    assert min(answer.margins.min(), answer.between.usages[0].value.min()) >= 0.227 - room


def test_more_knots_are_told_where_they_are_seen_to_help_only(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is missed between the knots has no advice of its own; a change that was planned with has."""
    monkeypatch.setattr(walked, "_with_more", lambda *_: None)
    problem = load_problem("utah-mit-ball", [*KNOCKED, "task.knots=21"])
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Unknown)
    assert answer.between_only
    assert answer.why.startswith("at the true equilibrium limits are missed: between the knots: ")
    assert "more knots" not in answer.why
    asked = list[Any]()
    monkeypatch.setattr(explained, "more_knots", lambda *of: asked.append(of) or iter(()))
    monkeypatch.setattr(explained, "_tried", lambda *_, **__: ([], False))
    assert not answer.explanation.others
    assert len(asked) == 1


def test_what_cases_miss_is_asked_for_also_beside_limits_over_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """The mean over time of torques counts in every case; rates of references, the same in all of them, do not."""
    monkeypatch.setattr(executed_cases, "LOOKED_UP", 0)
    allowed = ('allow.mass=["50 g", "300 g"]', 'limits.margin="50 mN"', "task.knots=5")
    problem = load_problem("barrett-ball-carry", [*allowed, "limits.sustained_torque=3", "limits.synergy_rate=9"])
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    task, limits = answer.task, limits_of_cases(answer.task)
    usages = answer.cases[0].usages
    over = [1.1 * np.max(usage.upper) if usage.title == "sustained torque" else 0.0 for usage in usages]
    worst = tuple(
        replace(usage, value=frozen(np.full_like(usage.value, value)), lower=frozen(np.full_like(usage.lower, -9)))
        for usage, value in zip(usages, over, strict=True)
    )
    more = MoreAtKnots.none(task, 3).for_what_is_missing(Between(0, 0.0, 0.0, 0.0, worst), task, limits)
    assert more is not None
    shares = dict(zip([limit.key for limit in task.kept], more.shares, strict=True))
    assert shares.pop("limits.sustained_torque") == pytest.approx(MORE * 0.1)
    assert set(shares.values()) == {0.0}
    assert "limits.synergy_rate" in shares


def test_knots_do_not_straighten_a_jump() -> None:
    problem = load_problem("human-ball", ["task.knots=5", "task.between=report"])
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    assert isinstance(answer.between, Between)
    assert answer.between.excess > 0
    said = 'without task.between = "report" they are kept there'
    assert f"{said}, more knots straighten it" in " ".join(" ".join(between_lines(answer)).split())
    margins = answer.between.usages[0]
    k = margins.worst()[0]
    times = np.array(margins.times)
    times[k + 1] = times[k]
    jump = replace(answer.between, usages=(replace(margins, times=times), *answer.between.usages[1:]))
    told = " ".join(" ".join(between_lines(replace(answer, between=jump))).split())
    assert told.endswith(said)
