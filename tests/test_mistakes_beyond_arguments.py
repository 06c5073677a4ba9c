"""Mistakes that no single value shows: places, methods of one's own, arguments that contradict each other."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from held_ball import grasp

import synergrip as sg

any_call: Any = sg
"""Every public name, without its types: these calls are wrong on purpose."""
PAIR = sg.GraspStack.of([grasp] * 2)
MISTAKES: dict[str, tuple[Callable[[], Any], str]] = {
    "places beyond a stack": (lambda: PAIR.taken([0, 2]), "places"),
    "places by name": (lambda: PAIR.taken("a"), "places"),
    "places between": (lambda: PAIR.taken([0.5]), "places"),
    "yes or no for others": (lambda: PAIR.taken([True, False, True]), "places"),
    "a slice by names": (lambda: PAIR["a":"b"], "places"),  # type: ignore[misc]
    "places beyond responses": (lambda: sg.respond_many([grasp]).taken([1]), "indices"),
    "a stack of numbers": (
        lambda: any_call.GraspStack(matrices=1, points=2, w_0=3, like=4),
        "GraspStack.matrices",
    ),
    "a stack of other points": (
        lambda: sg.GraspStack(PAIR.matrices, np.zeros((1, 3, 3)), np.zeros((2, 6)), grasp),
        "GraspStack.points",
    ),
}


@pytest.mark.parametrize(("mistake", "named"), MISTAKES.values(), ids=MISTAKES)
def test_a_mistake_is_refused_by_the_name_of_its_argument(mistake: Callable[[], Any], named: str) -> None:
    with pytest.raises(sg.InputError) as refused:
        mistake()
    lines = [line for line in str(refused.value).splitlines() if line.startswith(f"{named}: ")]
    assert lines, refused.value


@pytest.mark.parametrize("stack", [PAIR, sg.GraspStack.varied(grasp, w_0=np.eye(6)[:2])], ids=["given", "varied"])
def test_grasps_of_a_stack_are_taken_by_places_or_by_yes_and_no(stack: sg.GraspStack) -> None:
    for places, those in (([True, False], [0]), (np.array([False, False]), []), ([1, -2, 0], [1, 0, 0]), ([], [])):
        taken = stack.taken(places)
        assert taken.w_0.tolist() == stack.w_0[np.array(those, dtype=int)].tolist()
        assert [each.w_0.tolist() for each in taken] == [stack[place].w_0.tolist() for place in those]
