"""Numbers of limits that could be others: the same one changes nothing, and one with more room gives more room."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from random_formulations import LIMITS, random_formulation

import synergrip as sg
from synergrip.conic.limits.file_key import FileKey
from synergrip.conic.limits.registry import LIMITS as FILE_KEYS
from synergrip.conic.rows import Kind, Rows

WITHOUT = {"friction reserve"}
"""Of ratios for each contact, which no key of a file states."""


@pytest.mark.parametrize("name", LIMITS)
def test_a_dial_turned_nowhere_changes_nothing_and_the_other_way_gives_room(name: str) -> None:
    formulation = random_formulation(1)[1]
    grasp = formulation.response.grasp
    limit = LIMITS[name](grasp).on(grasp)
    dials = limit.dials(grasp)
    assert bool(dials) is (name not in WITHOUT)
    for dial in dials:
        rows = limit.rows(formulation)
        for one, same in zip(rows, dial.turned(dial.value).rows(formulation), strict=True):
            np.testing.assert_allclose(same.matrix, one.matrix, rtol=1e-12, atol=1e-15)
            np.testing.assert_allclose(same.constant, one.constant, rtol=1e-12, atol=1e-15)
        eased = dial.value * 1.1 if dial.eased == "up" else max(dial.value / 1.1, dial.end)
        looser = dial.turned(eased)
        if isinstance(limit, sg.FrictionReserve):
            assert isinstance(looser, sg.FrictionReserve)
            assert np.all(looser.used(grasp) >= limit.used(grasp))
            assert np.any(looser.used(grasp) > limit.used(grasp))
        else:
            assert _room(looser.rows(formulation)) > _room(rows)


def _room(rows: Sequence[Rows]) -> float:
    """Return how far a motion of no size is inside all cones, in their own units; more room is more."""
    total = 0.0
    for part in rows:
        assert part.kind is not Kind.ZERO
        if part.over_time is not None:  # one cone of each item over all instants
            cones = np.vstack([np.full(len(part.items), part.over_time), part.constant]).T
        else:
            cones = part.constant.reshape(-1, part.dim)
        sizes = np.linalg.norm(part.matrix.reshape(-1, part.matrix.shape[-1]), axis=1).max()
        total += float((cones[:, 0] - np.linalg.norm(cones[:, 1:], axis=1)).sum()) / max(float(sizes), 1e-300)
    return total


VALUES = {
    "margin": '"0.4 N"', "margin_angle": '"3 deg"', "safety_factor": "1.3", "normal_force": '["0.5 N", "18 N"]',
    "joint_torque": "[1.2, 1.1, 1.0, 1.2, 1.1, 1.0, 1.2, 1.1]", "actuator_effort": "2.5",
    "sustained_torque": "0.9", "sustained_effort": "[1.5, 1.6, 1.7, 1.8]", "synergy_reference": "0.4",
    "synergy_rate": "2.0", "synergy_acceleration": "[9.0, 8.0, 7.0, 6.0]", "joint_range": '"hand"',
    "elastic_motion": '"1 mm"', "drift": '"2 mm"',
}  # fmt: skip


@pytest.mark.parametrize("key", FILE_KEYS, ids=lambda key: key.name)
def test_what_set_is_told_gives_the_limit_of_the_dial(key: FileKey) -> None:
    name = key.name
    stated = f"limits.{name}={VALUES[name]}"
    problem = sg.load_problem("barrett-ball-hold", stated)
    limit = _found(problem, name)
    for dial in limit.dials(problem.grasp):
        value = dial.value * 1.07 if dial.eased == "up" else max(dial.value / 1.07, dial.end)
        changed = sg.load_problem("barrett-ball-hold", [stated, dial.set(value)])
        formulation = sg.plan(problem.grasp, problem.task.replace(limits=[], linearise="once")).formulation
        told, meant = _found(changed, name).rows(formulation), dial.turned(value).rows(formulation)
        for one, other in zip(told, meant, strict=True):
            np.testing.assert_allclose(one.constant, other.constant, rtol=1e-8, atol=1e-9)


def _found(problem: sg.Problem, name: str) -> sg.Limit:
    """Return the limit of a key on the grasp of a problem."""
    return next(each.on(problem.grasp) for each in problem.timed.all_limits if each.key == f"limits.{name}")
