"""What `margins` does not look for twice, and where it stops to look: with the same answers."""

from __future__ import annotations

from functools import partial

import pytest

import synergrip as sg
from synergrip.changes import extreme as looking
from synergrip.changes.asked import Asked
from synergrip.changes.turning import friction_dial
from synergrip.margin import direct
from synergrip.margin.found import Margins
from synergrip.margin.margins import margins
from synergrip.planning.outcome import Plan, Unknown
from synergrip.planning.pace import BRIEF
from synergrip.planning.planning import planned_with

PUSHED = 'task.push=[{force="0.1 N",direction=[0,1,0],at=["0 mm","0 mm","0 mm"]}]'


def asked_of(name: str) -> tuple[Asked, Plan]:
    problem = sg.load_problem(name)
    made = sg.plan(problem.grasp, problem.task)
    assert isinstance(made, Plan)
    return Asked.of(made.grasp, problem.task, made.task), made


def looked_for(monkeypatch: pytest.MonkeyPatch, overrides: tuple[str, ...]) -> tuple[list[str], Margins]:
    """Which numbers are looked for, and what is found."""
    names: list[str] = []

    def noted(of: direct.Wanted, *rest: object) -> sg.DirectNumber:
        names.append(of.name)
        return found(of, *rest)  # type: ignore[arg-type]

    found = direct.number_of
    monkeypatch.setattr(direct, "number_of", noted)
    problem = sg.load_problem("gripper-box", overrides)
    answer = margins(problem.grasp, problem.task, only=["heaviest_kg", "load_factor"])
    assert isinstance(answer, Margins)
    return names, answer


@pytest.mark.parametrize("factor", [1.0, 0.8])
def test_the_factor_of_a_weight_is_that_of_the_mass(monkeypatch: pytest.MonkeyPatch, factor: float) -> None:
    names, answer = looked_for(monkeypatch, (f"task.load_factor={factor}",))
    assert names == ["heaviest_kg"]
    heaviest, load = answer.direct["heaviest_kg"], answer.direct["load_factor"]
    assert heaviest.value is not None
    assert load.value is not None
    body = answer.plan.grasp.held
    assert body is not None
    assert load.value == pytest.approx(heaviest.value / body.body.mass, rel=1e-9)
    again = sg.load_problem("gripper-box", [load.setting])
    assert again.task.load_factor == pytest.approx(factor * load.value, rel=1e-9)
    assert isinstance(sg.plan(again.grasp, again.task), Plan)


def test_a_load_that_is_pushed_as_well_is_looked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    names, answer = looked_for(monkeypatch, (PUSHED,))
    assert names == ["heaviest_kg", "load_factor"]
    assert answer.direct["load_factor"].value is not None


@pytest.mark.parametrize("name", ["tripod", "table2-hard-joints", "gripper-box"])
def test_guesses_end_where_halving_ends(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    asked, made = asked_of(name)
    dial, posed = friction_dial(asked), asked.posed(made.analysis)
    assert dial is not None
    assert posed is not None
    guessed = looking.extreme(dial, posed, posed.program())
    monkeypatch.setattr(looking, "_guessed", lambda good, bad, *rest: (good, bad))
    halved = looking.extreme(dial, posed, posed.program())
    assert guessed.value == pytest.approx(halved.value, rel=2e-4)
    assert guessed.past is not None


@pytest.mark.parametrize(
    "missing",
    [lambda v: None, lambda v: -1.0, lambda v: 1.0, lambda v: 3.0 - v],
    ids=["none", "below", "above", "line"],
)
def test_wrong_guesses_leave_what_is_looked_for_between(missing: object) -> None:
    good, bad = looking._guessed(2.0, 0.5, missing, partial(lambda end, v: v >= end, 1.3))  # type: ignore[arg-type]
    assert bad < 1.3 <= good


def test_guesses_close_in_on_an_end_from_both_sides() -> None:
    good, bad = looking._guessed(2.0, 0.5, lambda v: 1.3 / v - 1, lambda v: v >= 1.3)
    assert bad < 1.3 <= good
    assert good - bad < 1e-4


def test_passes_that_find_too_little_margin_are_given_up() -> None:
    problem = sg.load_problem("utah-mit-ball", ["contacts.friction_factor=0.456"])
    answer = planned_with(BRIEF, problem.grasp, problem.task)
    assert isinstance(answer, Unknown)
    along = [each for each in answer.decisions if each.program is not answer.decisions[0].program]
    assert len(along) <= 4
