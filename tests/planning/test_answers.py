"""Answers as values: short to look at, safe to compare, whole after a pickle, clear about what is another verdict's."""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from functools import cache, partial
from html import escape
from typing import Any

import numpy as np
import pytest

from synergrip.errors import InputError, SynergripError, VerdictError
from synergrip.planning.outcome import Infeasible, Outcome, Plan, Unknown
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem
from synergrip.reports.text.text_usages import worst_of
from synergrip.values import Value

FEASIBLE = ("barrett-ball-carry", "dlr-ball-corners", "tripod")
REFUSED = {"pinch-hard": "restraint", "barrett-ball-lift": "direction", "robonaut-handle-eigengrasps": "magnitude"}
OTHERS = ("synergrip.grasps", "synergrip.hands", "synergrip.conic.limits.", "synergrip.tasks.")
"""Rooms whose values are looked at elsewhere."""


@cache
def answered(name: str) -> Outcome:
    problem = load_problem("tripod" if name == "unknown" else name)
    outcome = plan(problem.grasp, problem.task)
    if name != "unknown":
        return outcome
    assert isinstance(outcome, Plan)
    return Unknown(outcome.task, outcome.analysis, "clarabel says 'maybe' and nothing verifies", outcome.decisions)


def every() -> tuple[str, ...]:
    return (*FEASIBLE, *REFUSED, "unknown")


def inside(value: Any) -> Iterator[Any]:
    """Yield every frozen value in a value, itself first."""
    if is_dataclass(value) and not isinstance(value, type):
        yield value
        for each in fields(value):
            yield from inside(getattr(value, each.name))
    elif isinstance(value, tuple):
        for each in value:
            yield from inside(each)


def told(value: Any) -> Iterator[Any]:
    """Yield the values that this room and those it stands on make; `Usage` and tasks at knots among them."""
    return (each for each in inside(value) if isinstance(each, Value) or not type(each).__module__.startswith(OTHERS))


@pytest.mark.parametrize("name", every())
def test_no_value_prints_more_than_a_few_lines(name: str) -> None:
    for each in told(answered(name)):
        text = repr(each)
        assert (len(text) < 1000, text.count("\n") < 4, type(each).__name__ in text) == (True, True, True), text


@pytest.mark.parametrize("name", every())
def test_values_are_compared_without_an_error(name: str) -> None:
    for each in told(answered(name)):
        hash(each)
        assert each == each
        assert (each != replace(each)) in (True, False)
        assert each != "something else"


def test_an_answer_says_what_matters() -> None:
    plan_, no = answered("barrett-ball-carry"), answered("barrett-ball-lift")
    assert isinstance(plan_, Plan)
    k, i = plan_.usages[0].worst()
    text = repr(plan_)
    assert f"{plan_.margins.min():.6g} N" in text
    assert plan_.grasp.contacts[i].name in text
    assert f"{len(plan_.time)} knots" in text
    assert f"t = {plan_.time[k]:.6g}" in text
    assert "direction" in repr(no)
    assert no.why[:40] in repr(no)
    assert "nothing verifies" in repr(answered("unknown"))


@pytest.mark.parametrize("name", every())
def test_a_notebook_shows_a_short_table(name: str) -> None:
    answer = answered(name)
    html = answer._repr_html_()
    assert answer.verdict in html
    shown, _, picture = html.partition("<svg")
    assert len(shown) < 4000
    if isinstance(answer, Plan):
        told = [row for usage in answer.usages for row in worst_of(usage)]
        assert html.count("<tr>") == 1 + len(told)
        for title, value, *_ in told:
            assert f"<td>{escape(title)}</td><td>{escape(value)}</td>" in html
        for contact in answer.grasp.contacts:
            assert f">{contact.name}</text>" in picture


def test_names_cannot_write_into_a_notebook() -> None:
    plan_ = answered("tripod")
    assert isinstance(plan_, Plan)
    hostile = replace(plan_.usages[0], items=("<b>x</b>", "C2", "C3"))
    html = replace(plan_, usages=(hostile, *plan_.usages[1:]))._repr_html_()
    assert "<b>x" not in html
    assert "&lt;b&gt;x" in html
    answer = answered("unknown")
    assert isinstance(answer, Unknown)
    assert "<b>x" not in replace(answer, why="<b>x</b>")._repr_html_()


def same(one: Any, other: Any) -> bool:
    """Tell whether two values hold the same; what is worked out when it is asked for, as its value."""
    one, other = (each() if isinstance(each, partial) else each for each in (one, other))
    if isinstance(one, np.ndarray):
        return np.array_equal(one, other, equal_nan=True)
    if hasattr(one, "tocoo"):
        return one.shape == other.shape and (one != other).nnz == 0
    if isinstance(one, SynergripError):
        return str(one) == str(other) and all(same(value, getattr(other, key)) for key, value in vars(one).items())
    if is_dataclass(one) and not isinstance(one, type):
        return type(one) is type(other) and all(same(getattr(one, f.name), getattr(other, f.name)) for f in fields(one))
    if isinstance(one, tuple | list):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same(each, other[key]) for key, each in one.items())
    if isinstance(one, float):
        return one == other or (one != one and other != other)
    return one == other if isinstance(one, str | int | frozenset | None) else type(one) is type(other)


@pytest.mark.parametrize("name", every())
def test_an_answer_is_whole_after_a_pickle(name: str) -> None:
    answer = answered(name)
    back = pickle.loads(pickle.dumps(answer))
    assert repr(back) == repr(answer)
    assert not [f.name for f in fields(answer) if not same(getattr(answer, f.name), getattr(back, f.name))]
    for each in inside(back):
        arrays = [value for value in vars(each).values() if isinstance(value, np.ndarray)]
        assert not isinstance(each, Value) or not [array for array in arrays if array.flags.writeable], type(each)
    again = plan(back.grasp, back.task)  # and can be worked with
    assert type(again) is type(answer) or isinstance(answer, Unknown)


@pytest.mark.parametrize("name", ["pinch-hard", "barrett-ball-lift"])
def test_a_pickled_refusal_still_explains(name: str) -> None:
    answer = answered(name)
    assert isinstance(answer, Infeasible)
    assert answer.refusal is not None
    back = pickle.loads(pickle.dumps(answer.refusal))
    assert type(back) is type(answer.refusal)
    assert same(answer.refusal, back)


@pytest.mark.parametrize("error", [InputError.at("a.b", "expected a number"), VerdictError.at("Plan.why", "no")])
def test_errors_are_whole_after_a_pickle(error: InputError) -> None:
    back = pickle.loads(pickle.dumps(error))
    assert type(back) is type(error)
    assert back.issues == error.issues
    assert str(back) == str(error)


@pytest.mark.parametrize(
    ("name", "attribute", "words"),
    [
        ("barrett-ball-lift", "margins", ("'infeasible'", "only Plan has", ".why", ".conflicts", ".stage")),
        ("barrett-ball-lift", "frame", ("only Plan has .frame",)),
        ("barrett-ball-carry", "why", ("'feasible'", "only Infeasible or Unknown has", ".dz_r", ".margins")),
        ("barrett-ball-carry", "conflicts", ("only Infeasible has",)),
        ("unknown", "dz_r", ("'unknown'", ".why")),
    ],
)
def test_attributes_of_another_verdict_say_so(name: str, attribute: str, words: tuple[str, ...]) -> None:
    answer = answered(name)
    assert not hasattr(answer, attribute)
    with pytest.raises(VerdictError) as raised:
        getattr(answer, attribute)
    assert isinstance(raised.value, AttributeError)
    assert isinstance(raised.value, InputError)
    assert not [word for word in words if word not in str(raised.value)], str(raised.value)


def test_a_misspelt_attribute_is_an_ordinary_mistake() -> None:
    with pytest.raises(AttributeError, match="no attribute 'margin'; did you mean 'margins'") as raised:
        answered("tripod").margin  # type: ignore[union-attr]  # noqa: B018
    assert not isinstance(raised.value, VerdictError)


def test_arrays_of_a_plan_are_at_hand() -> None:
    answer = answered("barrett-ball-carry")
    assert isinstance(answer, Plan)
    T, grasp = len(answer.time), answer.grasp
    assert answer.dz_r.shape == (T, grasp.n_z)
    assert answer.forces.shape == (T, grasp.n_l)
    assert answer.margins.shape == (T, grasp.n_c)
    assert answer.exit_code == 0
    assert answer.dz_r is answer.motion.dz_r
    assert not answer.forces.flags.writeable
