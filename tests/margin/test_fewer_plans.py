"""What `margins` does not look for twice, and where it stops to look: with the same answers."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial

import pytest

import synergrip as sg
from synergrip.changes import extreme as looking
from synergrip.changes.asked import Asked
from synergrip.changes.at_a_value import no_plan, posed_at
from synergrip.changes.turning import friction_dial, load_dial
from synergrip.margin import along, direct
from synergrip.margin.along import Search
from synergrip.margin.found import Margins
from synergrip.margin.margins import margins
from synergrip.planning import beginning
from synergrip.planning.outcome import Plan, Unknown
from synergrip.planning.pace import BRIEF, WHOLE, Effort
from synergrip.planning.planning import planned_with
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.statics.motion import Motion

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


def test_a_factor_asked_for_alone_is_that_of_the_mass_too(monkeypatch: pytest.MonkeyPatch) -> None:
    _, both = looked_for(monkeypatch, ())
    problem = sg.load_problem("gripper-box")
    alone = margins(problem.grasp, problem.task, only=["load_factor"])
    assert isinstance(alone, Margins)
    assert alone.direct["load_factor"].value == both.direct["load_factor"].value


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


@pytest.mark.parametrize("name", ["heaviest_kg", "load_factor", "least_effort"])
def test_beyond_a_reserve_an_end_is_proven_near_by(knock: tuple[Asked, Plan], name: str) -> None:
    asked, made = knock
    dial = next(each for each in direct.wanted(asked, made) if each.name == name).dial
    posed = asked.posed(made.analysis)
    assert dial is not None
    assert posed is not None
    assert not posed.strict
    own = posed_at(dial, dial.value, posed)
    assert own is not None
    found = looking.extreme(dial, own, own.program())
    assert found.value is not None
    assert found.past is not None
    assert 0 < abs(found.past - found.value) < 0.02 * abs(found.value)
    assert no_plan(posed_at(dial, found.past, posed, every=True)), "the task without a reserve has a plan there"


@pytest.fixture(scope="module")
def knock() -> tuple[Asked, Plan]:
    return asked_of("robonaut-handle-knock")


def test_a_motion_over_some_knots_that_does_not_arrive_is_not_begun_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    begun: list[object] = []

    def noted(walker: Walker, linear: Motion) -> Walk:
        begun.append(walker)
        return begins(walker, linear)

    begins = beginning._from_plan
    monkeypatch.setattr(beginning, "_from_plan", noted)
    problem = sg.load_problem("human-glass-set-down", ["object.mass=1.62 kg"])
    answer = planned_with(BRIEF, problem.grasp, problem.task)
    assert isinstance(answer, Unknown)
    assert answer.stage in ("reach", "execution")
    assert len(begun) == 1


@cache
def of_tripod() -> tuple[Asked, Plan]:
    return asked_of("tripod")


def tried(
    monkeypatch: pytest.MonkeyPatch, end: float, lack: Callable[[float], float] | None
) -> tuple[list[float], Search]:
    """Which values of a load are tried along a motion, and what is known then."""
    asked, made = of_tripod()
    dial, values = load_dial(asked, made.task), list[float]()
    assert dial is not None

    def outcome(of: object, value: float, effort: object) -> Plan | None:
        values.append(value)
        return made if value <= end else None

    monkeypatch.setattr(along, "outcome_at", outcome)
    monkeypatch.setattr(along, "_lacking", lambda value, _: () if lack is None else ((value, lack(value)),))
    return values, Search.of(dial, 8.0, made).over(3)


@pytest.mark.parametrize("end", [1.05, 2.0, 3.3, 5.5, 7.5, 7.9, 7.999])
@pytest.mark.parametrize(
    ("shape", "share"), [(lambda v, end: v - end, 0.97), (lambda v, end: v**2 - end**2, 0.75)], ids=["line", "bent"]
)
def test_where_the_margin_ends_is_told_by_a_line(
    monkeypatch: pytest.MonkeyPatch, end: float, shape: Callable[[float, float], float], share: float
) -> None:
    values, search = tried(monkeypatch, end, lambda value: shape(value, end))
    assert search.good <= end < (search.bad or 8.0)
    assert search.good > share * end
    assert len(values) == len({*values}) == search.count <= 3


@pytest.mark.parametrize("end", [1.05, 2.0, 5.5, 7.9, 7.999])
def test_where_nothing_is_known_of_the_margin_it_lies_between(monkeypatch: pytest.MonkeyPatch, end: float) -> None:
    values, search = tried(monkeypatch, end, None)
    assert search.good <= end < (search.bad or 8.0)
    assert len(values) == len({*values}) == search.count <= 3


@pytest.mark.parametrize("far", [8.0, 100.0])
@pytest.mark.parametrize("few", [1.05, 1.6, 3.0, 5.0])
@pytest.mark.parametrize("more", [1.0, 1.01, 1.3, 2.5])
def test_where_a_few_passes_give_up_all_effort_decides(
    monkeypatch: pytest.MonkeyPatch, few: float, more: float, far: float
) -> None:
    """Also where a few passes come a fraction as far as those of `plan`, and where they are right."""
    end = few * more if few * more < far else 0.9985 * far
    values, search = searched(monkeypatch, few, end, far)
    assert search.good <= end < (search.bad or far)
    assert search.sure
    assert search.count == len(values) <= 13
    told = search.told(lambda value: f"{value:.4g}")
    assert "a few passes" not in told
    assert search.good > 0.75 * end
    assert (search.gap <= along.NEAR) == (f"no more was tried after {search.count} plans" not in told)


def test_where_a_few_passes_are_right_one_value_is_asked_again(monkeypatch: pytest.MonkeyPatch) -> None:
    values, search = searched(monkeypatch, 7.85, 7.85, 8.0)
    assert [effort for _, effort in values].count(WHOLE) == 1
    assert values[-1] == (search.bad, WHOLE)


def test_where_no_value_is_left_without_a_plan_all_of_the_way_is_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    values, search = searched(monkeypatch, 6.0, 9.0, 8.0)
    assert values[-1] == (search.good, WHOLE)
    assert search.good == pytest.approx(7.993, rel=1e-3)
    assert not search.told(str)


def searched(
    monkeypatch: pytest.MonkeyPatch, few: float, end: float, far: float
) -> tuple[list[tuple[float, Effort]], Search]:
    """What is tried of a load where a few passes find plans up to one value, and all effort up to another."""
    asked, made = of_tripod()
    dial, values = load_dial(asked, made.task), list[tuple[float, Effort]]()
    assert dial is not None
    unknown = Unknown(made.task, made.analysis, "given up", ())

    def outcome(of: object, value: float, effort: Effort) -> Plan | Unknown:
        values.append((value, effort))
        return made if value <= (few if effort is BRIEF else end) else unknown

    monkeypatch.setattr(along, "outcome_at", outcome)
    monkeypatch.setattr(along, "_lacking", lambda value, _: ())
    search = Search.of(dial, far, made).over(direct.TRIES).on(direct.TRIES + direct.CLOSER)
    return values, search.surely(direct.SURE)


def test_a_mass_does_not_stop_short_of_where_the_margin_ends() -> None:
    problem = sg.load_problem("utah-mit-ball", ["contacts.friction=0.48"])
    answer = margins(problem.grasp, problem.task, only=["heaviest_kg"])
    assert isinstance(answer, Margins)
    heaviest = answer.direct["heaviest_kg"].value
    assert heaviest is not None
    assert heaviest > 0.5
    for mass, planned in ((heaviest, Plan), (1.02 * heaviest, Unknown)):
        again = sg.load_problem("utah-mit-ball", ["contacts.friction=0.48", f"object.mass={mass} kg"])
        assert isinstance(sg.plan(again.grasp, again.task), planned)


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
